// boolean_cases FOLDER: labels on planar faces, for a judge that makes the same ones by a mesh boolean (boolean_oracle_test.py).
//
// Parallel projection onto a plane makes a letter a prism. Each case is a text file FOLDER/NAME.txt; numbers are exact:
//   height H                       > 0 raised, < 0 sunk
//   frame OX OY OZ UX ... WZ       origin, reading direction, up, towards the viewer
//   contour N, then N lines X Y    in the label plane; outer ones counter-clockwise, holes clockwise
//   part V F, then V lines X Y Z, then F lines I J K
//   labelled V F, likewise

#include <fstream>
#include <iostream>

#include "test_mesh.h"
#include "text_outline.h"
#include "vcg_ext/text_label.h"

namespace {

using namespace vcg::textlabel;
using test_mesh::DoubleMesh;
using vcg::Point3d;

struct Place {
	const char* name;
	test_mesh::Shape part;  ///< its top at z = 0
	Point3d towardsViewer, up;
};

/// A plate that was turned: the viewer looks along its normal.
Place Turned(const char* name, const test_mesh::Shape& part, const Point3d& towardsViewer, const Point3d& up)
{
	const LabelFrame f = FrameFromDirection({0, 0, 0}, towardsViewer, up);
	return {name, part.moved([&](const Point3d& p) { return f.u * p[0] + f.v * p[1] + f.w * p[2]; }), towardsViewer,
	        up};
}

std::vector<Place> Places()
{
	const test_mesh::Shape box = test_mesh::Box(60, 40, 8), grid = test_mesh::Slab(60, 40, 8, 60, 40);
	return {{"box", box, {0, 0, 1}, {0, 1, 0}},
	        {"grid", grid, {0, 0, 1}, {0, 1, 0}},
	        {"grid_text_turned", grid, {0, 0, 1}, {0.3, 1, 0}},
	        Turned("turned_box", box, {0.3, -0.5, 0.8}, {0.2, 1, 0.1}),
	        Turned("turned_grid", grid, {-0.7, 0.1, 0.2}, {0, 0.1, 1}),
	        Turned("steeply_turned_grid", grid, {1, 1, -1}, {0, 1, 0})};
}

void Write(std::ostream& out, const char* name, const test_mesh::Shape& s)
{
	out << name << ' ' << s.points.size() << ' ' << s.faces.size() << '\n';
	for (const Point3d& p : s.points) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
	for (const auto& f : s.faces) out << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
}

void WriteCase(const std::string& file, const Place& place, const Outline& outline, double height)
{
	const LabelFrame frame = FrameFromDirection({0, 0, 0}, place.towardsViewer, place.up);
	LabelOptions options;
	options.height = height;
	DoubleMesh m;
	test_mesh::Fill(m, place.part);
	LabelMesh(m, outline, frame, options);
	std::ofstream out(file);
	out.precision(17);
	out << "height " << height << "\nframe";
	for (const Point3d& p : {frame.origin, frame.u, frame.v, frame.w})
		for (int i = 0; i < 3; ++i) out << ' ' << p[i];
	out << '\n';
	for (const Contour& c : outline.contours) {
		out << "contour " << c.points.size() << '\n';
		for (const vcg::Point2d& p : c.points) out << p[0] << ' ' << p[1] << '\n';
	}
	Write(out, "part", place.part);
	Write(out, "labelled", test_mesh::ToShape(m));
	if (!out.flush()) throw std::runtime_error("cannot write " + file);
}

}  // namespace

int main(int count, char** values)
{
	if (count != 2) return std::cerr << "usage: boolean_cases FOLDER\n", 2;
	const std::pair<const char*, double> texts[] = {{"A43", 12}, {"SN-0123456789 gqy%&@", 3}, {"Größe\nN° 8", 7}};
	try {
		for (const Place& place : Places())
			for (const auto& [text, size] : texts)
				for (const double height : {1.5, -1.5}) {
					textlabel::TextOptions options;
					options.size = size;
					const std::string name =
						std::string(place.name) + "_" + std::to_string(int(size)) + (height > 0 ? "_raised" : "_sunk");
					WriteCase(std::string(values[1]) + "/" + name + ".txt", place,
					          textlabel::MakeTextOutline(text, options).outline, height);
				}
	} catch (const std::exception& e) {
		return std::cerr << "boolean_cases: " << e.what() << '\n', 1;
	}
	return 0;
}
