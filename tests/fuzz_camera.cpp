// Fuzz target: any bytes as the XML of a camera.
//
//   tests/fuzz.sh camera -max_total_time=600
//
// What is accepted must be a camera: axes orthonormal and right-handed, numbers finite, and the same when written
// and read again. The rest is refused by a RequestError.

#include "camera_xml.h"
#include "request_error.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vcg/space/point3.h>

using namespace textlabel;

namespace {

void Require(bool holds)
{
	if (!holds) std::abort();
}

void Check(const Camera& c)
{
	constexpr double rounding = 1e-12;
	const vcg::Point3d &x = c.right, &y = c.up, &z = c.backwards;
	for (const double defect : {x * x - 1, y * y - 1, z * z - 1, x * y, y * z, z * x, (x ^ y) * z - 1})
		Require(std::abs(defect) < rounding);
	for (int i = 0; i < 3; ++i) Require(std::isfinite(c.viewpoint[i]));
}

bool AreNear(const vcg::Point3d& a, const vcg::Point3d& b)
{
	constexpr double rounding = 1e-12;
	return (a - b).Norm() <= rounding * (1 + a.Norm());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size)
{
	// as a document, and in place of a piece of a good one, so that the fuzzer need not find out what surrounds a camera
	std::string text(reinterpret_cast<const char*>(data), size), spliced = WriteCamera(Camera());
	if (size >= 2) spliced.replace(spliced.size() * data[0] / 256, data[1], text.substr(2));
	for (const std::string& xml : {text, spliced}) {
		try {
			const Camera c = ReadCamera(xml);
			Check(c);
			const Camera again = ReadCamera(WriteCamera(c));
			Check(again);
			Require(AreNear(c.viewpoint, again.viewpoint) && AreNear(c.right, again.right) && AreNear(c.up, again.up));
			Require(c.perspective == again.perspective && c.viewportPx == again.viewportPx);
		} catch (const RequestError&) {}
	}
	return 0;
}
