// Layout of the pictures; the geometry is in picture_surface.h and picture_raster.h, the light in picture_painter.h.

#include "picture.h"
#include "picture_painter.h"

#include <QFileInfo>
#include <QImage>
#include <QImageWriter>
#include <QSaveFile>
#include <QString>

#include <stdexcept>
#include <vcg/space/box3.h>

namespace textlabel {
namespace {

using detail::Camera;
using detail::DepthBuffer;
using detail::PanelPainter;
using detail::PictureSurface;
using vcg::Point3d;

constexpr double pi = 3.14159265358979323846;

void Require(bool condition, const char* what)
{
	if (!condition) throw std::invalid_argument(what);
}

void CheckInput(const PictureMesh& mesh, const PictureOptions& options)
{
	Require(options.width > 0 && options.height > 0 && options.samples > 0, "picture size");
	Require(mesh.colors.empty() || mesh.colors.size() == mesh.triangles.size(), "one colour for each face");
	Require(mesh.isLabel.empty() || mesh.isLabel.size() == mesh.triangles.size(), "one label flag for each face");
	for (const auto& t : mesh.triangles)
		for (int i : t) Require(i >= 0 && size_t(i) < mesh.positions.size(), "index of a corner");
}

void CheckView(const PictureView& view)
{
	const double area = (view.direction ^ view.up).Norm();
	Require(std::isfinite(area) && area > 0, "direction and up of the view");
	Require(std::isfinite(view.extent) && view.extent > 0, "extent of the view");
}

Picture EmptyPicture(const PictureOptions& options)
{
	const size_t pixels = size_t(options.width) * size_t(options.height);
	return {options.width, options.height, std::vector<std::uint8_t>(3 * pixels, 255)};
}

Point3d TurnAround(const Point3d& v, const Point3d& axis, double degrees)
{
	const Point3d a = Point3d(axis).Normalize();
	const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
	return v * c + (a ^ v) * s + a * ((a * v) * (1 - c));
}

/// The finite corners of the label's faces, or of all when none is a label face or all are asked for.
std::vector<Point3d> PointsToFit(const PictureMesh& mesh, bool onlyLabel)
{
	const bool some = onlyLabel && std::count(mesh.isLabel.begin(), mesh.isLabel.end(), 1) > 0;
	std::vector<char> used(mesh.positions.size(), 0);
	for (size_t f = 0; f < mesh.triangles.size(); f++)
		if (!some || mesh.isLabel[f])
			for (int i : mesh.triangles[f]) used[size_t(i)] = 1;
	std::vector<Point3d> points;
	for (size_t i = 0; i < used.size(); i++)
		if (used[i] && std::isfinite(mesh.positions[i].SquaredNorm())) points.push_back(mesh.positions[i]);
	return points;
}

/// Number of pixels of a thumbnail in which the label is seen.
int VisibleLabel(const PictureMesh& mesh, const PictureView& view)
{
	constexpr int side = 240;
	const DepthBuffer seen =
		detail::ScanMesh(mesh, detail::ProjectAll(mesh, detail::MakeCamera(view, side, side)), side, side);
	return int(
		std::count_if(seen.face.begin(), seen.face.end(), [&](int f) { return f >= 0 && mesh.isLabel[size_t(f)]; }));
}

/// How a label is best looked at. People look down at things that stand on a table: towards a label on top the view comes from its
/// lower side, and what is upright in the picture is the table's upwards; towards one on a wall it comes from somewhat above.
/// @param[in] tilt  degrees away from the label's direction: on top, on a wall
/// @param[in] turn  degrees to the right
PictureView LabelView(const Point3d& direction, const Point3d& up, std::array<double, 2> tilt, double turn)
{
	const Point3d d = Point3d(direction).Normalize(), right = (up ^ d).Normalize(), v = d ^ right;
	const bool onTop = d[2] > 0.7;
	PictureView view;
	view.up = onTop ? d : v;
	const Point3d above = TurnAround(d, right, -tilt[1]), below = TurnAround(d, right, tilt[1]);
	const Point3d tilted = onTop ? TurnAround(d, right, tilt[0]) : below[2] > above[2] ? below : above;
	view.direction = TurnAround(tilted, view.up, turn);
	return view;
}

PictureView PartView(const PictureMesh& mesh, const Point3d& direction, const Point3d& up, double side,
                     const PictureOptions& options)
{
	const PictureView view = LabelView(direction, up, {46, 24}, 28 * side);
	return FitView(mesh, view.direction, view.up, options);
}

/// The three-quarter view from the right (1) or the left (-1), whichever shows more of the label; from before (0) when that shows
/// far more.
double BestSide(const PictureMesh& mesh, const Point3d& direction, const Point3d& up, const PictureOptions& options)
{
	if (mesh.isLabel.empty()) return 1;
	double best = 1, most = -1;
	for (const double side : {1.0, -1.0, 0.0}) {
		const PictureView view = PartView(mesh, direction, up, side, options);
		const double visible = VisibleLabel(mesh, view) * (side == 0 ? 0.6 : 1);
		if (visible <= most) continue;
		most = visible;
		best = side;
	}
	return best;
}

}  // namespace

PictureColor Picture::at(int x, int y) const
{
	const size_t i = 3 * (size_t(y) * size_t(width) + size_t(x));
	return {rgb[i], rgb[i + 1], rgb[i + 2]};
}

Picture RenderPicture(const PictureMesh& mesh, const PictureView& view, const PictureOptions& options)
{
	CheckInput(mesh, options);
	CheckView(view);
	Picture picture = EmptyPicture(options);
	const PictureSurface surface = detail::AnalyseSurface(mesh, options.creaseAngle);
	PanelPainter(mesh, surface, view, options, {0, 0, options.width, options.height}).paint(picture);
	return picture;
}

PictureView FitView(const PictureMesh& mesh, const Point3d& direction, const Point3d& up, const PictureOptions& options,
                    bool onlyLabel)
{
	PictureView view;
	view.direction = direction;
	view.up = up;
	CheckView(view);
	const std::vector<Point3d> points = PointsToFit(mesh, onlyLabel);
	if (points.empty()) return view;
	const double aspect = double(options.width) / options.height, filled = 1 - 2 * options.margin;
	const Camera camera = detail::MakeCamera(view, 1, 1);
	vcg::Box3d box;
	for (const Point3d& p : points) box.Add(camera.turn(p));
	const Point3d c = box.Center();
	view.focus = camera.right * c[0] + camera.up * c[1] + camera.direction * c[2];
	const double height = std::max(box.DimY(), box.DimX() / aspect) / filled;
	if (!(height > 0) || !std::isfinite(height)) return view;
	view.extent = height;
	view.distance = 4 * std::max(height, box.DimZ());
	for (int round = 0; round < 3; round++) {  // near points are magnified: settles at once, the camera is far
		const Camera closer = detail::MakeCamera(view, 1, 1);
		vcg::Box3d seen;
		for (const Point3d& p : points) seen.Add(closer.project(p));
		view.focus += (camera.right * (seen.Center()[0] - 0.5) - camera.up * (seen.Center()[1] - 0.5)) * view.extent;
		view.extent *= std::max(seen.DimY(), seen.DimX() / aspect) / filled;
	}
	return view;
}

Picture RenderLabelPicture(const PictureMesh& mesh, const Point3d& direction, const Point3d& up,
                           const PictureOptions& options)
{
	CheckInput(mesh, options);
	const bool hasLabel = std::count(mesh.isLabel.begin(), mesh.isLabel.end(), 1) > 0;
	Picture picture = EmptyPicture(options);
	const PictureSurface surface = detail::AnalyseSurface(mesh, options.creaseAngle);
	PictureOptions whole = options;
	if (hasLabel) whole.width = options.width * 5 / 8;
	const double side = BestSide(mesh, direction, up, whole);
	const PictureView partView = PartView(mesh, direction, up, side, whole);
	PanelPainter(mesh, surface, partView, whole, {0, 0, whole.width, whole.height}).paint(picture);
	if (!hasLabel) return picture;
	const int gap = 4, left = whole.width + gap;
	PictureOptions closeUp = options;
	closeUp.width = options.width - left;
	closeUp.height = (options.height - gap) / 2;
	closeUp.margin = 0.14;
	const PictureView raw = LabelView(direction, up, {30, 22}, 14 * side);
	PictureView near = FitView(mesh, raw.direction, raw.up, closeUp, true);
	near.distance = partView.distance;
	PanelPainter(mesh, surface, near, closeUp, {left, 0, closeUp.width, closeUp.height}).paint(picture);
	closeUp.edges = PictureEdges::All;
	const int lower = closeUp.height + gap;
	closeUp.height = options.height - lower;
	PanelPainter(mesh, surface, near, closeUp, {left, lower, closeUp.width, closeUp.height}).paint(picture);
	return picture;
}

bool WritePicture(const Picture& picture, const std::string& path)
{
	const QImage image(picture.rgb.data(), picture.width, picture.height, 3 * picture.width, QImage::Format_RGB888);
	QSaveFile file(QString::fromStdString(path));
	return file.open(QIODevice::WriteOnly) && image.save(&file, PictureFormat(path).c_str()) && file.commit();
}

std::string PictureFormat(const std::string& path)
{
	const QByteArray ending = QFileInfo(QString::fromStdString(path)).suffix().toLower().toLatin1();
	return QImageWriter::supportedImageFormats().contains(ending) ? ending.toStdString() : std::string();
}

}  // namespace textlabel
