#include "camera_xml.h"
#include "label_request.h"
#include "request_error.h"

#include <QByteArray>
#include <QString>
#include <QStringList>
#include <QXmlStreamReader>
#include <cmath>
#include <cstring>
#include <vector>

namespace textlabel {
namespace {

/// The numbers of one attribute.
class CameraAttributes {
public:
	explicit CameraAttributes(const QXmlStreamAttributes& attributes)
		: attributes_(attributes), binary_(attributes.value("BinaryData").trimmed() == QLatin1String("1"))
	{}

	bool has(const char* name) const { return attributes_.hasAttribute(QLatin1String(name)); }
	/// @return at least `count` finite numbers
	std::vector<double> numbers(const char* name, size_t count) const
	{
		const QString text = attributes_.value(QLatin1String(name)).toString();
		std::vector<double> result = binary_ ? fromBytes(text, count) : fromText(text);
		if (result.size() < count) fail(name);
		for (const double number : result)
			if (!std::isfinite(number)) fail(name);
		return result;
	}
	/// Two pixel counts.
	std::array<int, 2> pixels(const char* name) const
	{
		constexpr double most = 1 << 24;
		std::vector<double> size;
		if (binary_) {
			const QByteArray bytes = QByteArray::fromBase64(attributes_.value(QLatin1String(name)).toLatin1());
			std::array<std::int32_t, 2> raw{};
			if (size_t(bytes.size()) < sizeof raw) fail(name);
			std::memcpy(raw.data(), bytes.constData(), sizeof raw);
			size = {double(raw[0]), double(raw[1])};
		} else size = numbers(name, 2);
		for (const double length : {size[0], size[1]})
			if (!(length >= 0 && length <= most)) fail(name);
		return {int(size[0]), int(size[1])};
	}
	bool isPerspective() const
	{
		const QStringRef type = attributes_.value("CameraType").trimmed();
		bool isNumber = true;
		const int number = type.isEmpty() ? 0 : type.toInt(&isNumber);
		if (!isNumber) fail("CameraType");
		return number == 0;
	}

private:
	[[noreturn]] static void fail(const char* name)
	{
		throw RequestError(RequestProblem::CameraIncomplete, "camera", name);
	}

	static std::vector<double> fromText(const QString& text)
	{
		std::vector<double> result;
		for (const QString& part : text.simplified().split(' ')) {
			bool isNumber = false;
			result.push_back(part.toDouble(&isNumber));
			if (!isNumber) return {};
		}
		return result;
	}
	/// Single or double precision, as the MeshLab that wrote it; the number of bytes tells.
	static std::vector<double> fromBytes(const QString& text, size_t count)
	{
		const QByteArray bytes = QByteArray::fromBase64(text.toLatin1());
		const size_t size = size_t(bytes.size());
		std::vector<double> result;
		for (size_t i = 0; i < count; ++i) {
			if (size == count * sizeof(double)) {
				double number;
				std::memcpy(&number, bytes.constData() + i * sizeof number, sizeof number);
				result.push_back(number);
			} else if (size == count * sizeof(float)) {
				float number;
				std::memcpy(&number, bytes.constData() + i * sizeof number, sizeof number);
				result.push_back(double(number));
			}
		}
		return result;
	}

	QXmlStreamAttributes attributes_;
	bool binary_;
};

Camera CameraOf(const CameraAttributes& attributes)
{
	Camera camera;
	const auto translation = attributes.numbers("TranslationVector", 3);
	const auto rotation = attributes.numbers("RotationMatrix", 16);
	for (int i = 0; i < 3; ++i) {
		camera.viewpoint[i] = -translation[size_t(i)];
		camera.right[i] = rotation[size_t(i)];
		camera.up[i] = rotation[size_t(4 + i)];
		camera.backwards[i] = rotation[size_t(8 + i)];
	}
	camera.perspective = attributes.isPerspective();
	const auto readPair = [&](const char* name, std::array<double, 2>& pair) {
		if (!attributes.has(name)) return;
		const auto numbers = attributes.numbers(name, 2);
		pair = {numbers[0], numbers[1]};
	};
	readPair("PixelSizeMm", camera.pixelSizeMm);
	readPair("CenterPx", camera.centerPx);
	if (attributes.has("FocalMm")) camera.focalMm = attributes.numbers("FocalMm", 1)[0];
	if (attributes.has("ViewportPx")) camera.viewportPx = attributes.pixels("ViewportPx");
	Orthonormalize(camera);
	return camera;
}

std::string Row(const vcg::Point3d& p)
{
	return NumberText(p[0]) + " " + NumberText(p[1]) + " " + NumberText(p[2]) + " ";
}

}  // namespace

void Orthonormalize(Camera& camera)
{
	constexpr double sixDigits = 1e-4;  // what the numbers of a copied camera may be off, with room
	vcg::Point3d *const x = &camera.right, *const y = &camera.up, *const z = &camera.backwards;
	for (const double defect : {*x * *x - 1, *y * *y - 1, *z * *z - 1, *x * *y, *y * *z, *z * *x, (*x ^ *y) * *z - 1})
		if (!(std::abs(defect) < sixDigits)) throw RequestError(RequestProblem::CameraNotRotation, "camera");
	*z /= z->Norm();
	*x = *y ^ *z;
	*x /= x->Norm();
	*y = *z ^ *x;
}

Camera ReadCamera(const std::string& xml)
{
	QXmlStreamReader reader(QByteArray(xml.data(), int(xml.size())));
	while (!reader.atEnd()) {
		reader.readNext();
		if (reader.isStartElement() && reader.name() == QLatin1String("VCGCamera"))
			return CameraOf(CameraAttributes(reader.attributes()));
	}
	if (reader.hasError())
		throw RequestError(RequestProblem::CameraNotXml, "camera", reader.errorString().toStdString())
			.measured(double(reader.lineNumber()), double(reader.columnNumber()));
	throw RequestError(RequestProblem::CameraMissing, "camera");
}

std::string WriteCamera(const Camera& camera)
{
	const auto pair = [](const auto& p) { return NumberText(p[0]) + " " + NumberText(p[1]); };
	const vcg::Point3d zero(0, 0, 0);
	return "<!DOCTYPE ViewState><project><VCGCamera TranslationVector=\"" + Row(zero - camera.viewpoint) +
	       "1\" RotationMatrix=\"" + Row(camera.right) + "0 " + Row(camera.up) + "0 " + Row(camera.backwards) +
	       "0 0 0 0 1 \" CameraType=\"" + (camera.perspective ? "0" : "1") + "\" BinaryData=\"0\" FocalMm=\"" +
	       NumberText(camera.focalMm) + "\" LensDistortion=\"0 0\" PixelSizeMm=\"" + pair(camera.pixelSizeMm) +
	       "\" ViewportPx=\"" + pair(camera.viewportPx) + "\" CenterPx=\"" + pair(camera.centerPx) + "\"/></project>";
}

}  // namespace textlabel
