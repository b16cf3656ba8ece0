#pragma once
// One label on one mesh, as data: what the fuzzer makes, what a failure prints, and what tests/corpus/labels/ holds.
//
// The text form, one item a line, numbers with 17 digits so that they come back as they were:
//   mesh float | double                 how coordinates are stored
//   v x y z                             a vertex; mesh coordinates
//   f a b c                             a face; counted from 0
//   contour part letter                 followed by its points
//   p u v                               a point in the label plane
//   origin | right | up | towards x y z the frame; world coordinates
//   center x y z                        the centre of projection; absent: parallel
//   wrap radius x y z                   round an axis of this direction; absent: not wrapped
//   matrix 16 numbers                   the layer's matrix by rows; absent: identity
//   height h                            world units
//   along viewpoint | label | surface
//   stretch s                           largest allowed
//   works                               the label must be made: a refusal is a fault
//   # text                              comment

#include "random_mesh.h"
#include "vcg_ext/text_label.h"

#include <istream>
#include <limits>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace vcg::textlabel::test {

struct LabelCase {
	bool isFloat = true;  ///< coordinates of the mesh: float32 or float64
	Soup mesh;            ///< coordinates are exact in that type
	Outline outline;
	LabelFrame frame;
	double height = 0;
	ExtrudeAlong along = ExtrudeAlong::Viewpoint;
	double maxStretch = 8;
	bool mustWork = false;  ///< a refusal is a fault
	std::string family;     ///< of the generator; not part of the text form
	std::string comment;
};

inline const char* Name(ExtrudeAlong along)
{
	constexpr const char* names[] = {"viewpoint", "label", "surface"};
	return names[int(along)];
}

/// Write a case in the text form.
inline void Write(std::ostream& out, const LabelCase& c)
{
	const auto precision = out.precision(std::numeric_limits<double>::max_digits10);
	const auto point = [&](const char* name, const vcg::Point3d& p) {
		out << name << ' ' << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
	};
	std::istringstream comment(c.comment);
	for (std::string line; std::getline(comment, line);) out << "# " << line << '\n';
	out << "mesh " << (c.isFloat ? "float" : "double") << '\n';
	for (const vcg::Point3d& p : c.mesh.vertices) point("v", p);
	for (const auto& f : c.mesh.faces) out << "f " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
	for (const Contour& contour : c.outline.contours) {
		out << "contour " << contour.part << ' ' << contour.letter << '\n';
		for (const vcg::Point2d& p : contour.points) out << "p " << p[0] << ' ' << p[1] << '\n';
	}
	point("origin", c.frame.origin);
	point("right", c.frame.u);
	point("up", c.frame.v);
	point("towards", c.frame.w);
	if (c.frame.perspective) point("center", c.frame.center);
	if (c.frame.wrapRadius != 0) {
		out << "wrap " << c.frame.wrapRadius;
		point("", c.frame.wrapAxis);
	}
	out << "matrix";
	for (int i = 0; i < 16; ++i) out << ' ' << c.frame.toWorld.ElementAt(i / 4, i % 4);
	out << "\nheight " << c.height << "\nalong " << Name(c.along) << "\nstretch " << c.maxStretch << '\n';
	if (c.mustWork) out << "works\n";
	out.precision(precision);
}

namespace detail {

/// Numbers that operator>> does not read: nan and inf.
inline double ReadNumber(std::istream& in)
{
	std::string word;
	in >> word;
	size_t used = 0;
	const double x = std::stod(word, &used);  // throws std::invalid_argument
	if (used != word.size()) throw std::invalid_argument(word);
	return x;
}

inline vcg::Point3d ReadPoint(std::istream& in)
{
	vcg::Point3d p;
	for (int i = 0; i < 3; ++i) p[i] = ReadNumber(in);
	return p;
}

inline int ReadIndex(std::istream& in)
{
	int i = -1;
	if (!(in >> i) || i < 0) throw std::invalid_argument("index");
	return i;
}

/// @return false when the word is unknown
inline bool ReadItem(const std::string& word, std::istream& in, LabelCase& c)
{
	std::string name;
	if (word == "mesh") {
		in >> name;
		c.isFloat = name == "float";
		return c.isFloat || name == "double";
	}
	if (word == "along") {
		in >> name;
		for (const ExtrudeAlong along :
		     {ExtrudeAlong::Viewpoint, ExtrudeAlong::LabelNormal, ExtrudeAlong::SurfaceNormal})
			if (name == Name(along)) return c.along = along, true;
		return false;
	}
	if (word == "v") return c.mesh.add(ReadPoint(in)), true;
	if (word == "f") {
		const int a = ReadIndex(in), b = ReadIndex(in), d = ReadIndex(in);
		return c.mesh.faces.push_back({a, b, d}), std::max({a, b, d}) < int(c.mesh.vertices.size());
	}
	if (word == "contour") {
		const int part = ReadIndex(in), letter = ReadIndex(in);
		c.outline.contours.push_back({{}, part, letter});
		c.outline.partCount = std::max(c.outline.partCount, part + 1);
		return true;
	}
	if (word == "p" && !c.outline.contours.empty()) {
		const double x = ReadNumber(in), y = ReadNumber(in);
		return c.outline.contours.back().points.push_back({x, y}), true;
	}
	if (word == "origin") return c.frame.origin = ReadPoint(in), true;
	if (word == "right") return c.frame.u = ReadPoint(in), true;
	if (word == "up") return c.frame.v = ReadPoint(in), true;
	if (word == "towards") return c.frame.w = ReadPoint(in), true;
	if (word == "center") return c.frame.center = ReadPoint(in), c.frame.perspective = true;
	if (word == "wrap") return c.frame.wrapRadius = ReadNumber(in), c.frame.wrapAxis = ReadPoint(in), true;
	if (word == "matrix") {
		for (int i = 0; i < 16; ++i) c.frame.toWorld.ElementAt(i / 4, i % 4) = ReadNumber(in);
		return true;
	}
	if (word == "height") return c.height = ReadNumber(in), true;
	if (word == "stretch") return c.maxStretch = ReadNumber(in), true;
	if (word == "works") return c.mustWork = true;
	return false;
}

}  // namespace detail

/// Read a case.
/// @throws std::runtime_error naming the line that can't be read
inline LabelCase ReadLabelCase(std::istream& in)
{
	LabelCase c;
	int number = 0;
	for (std::string line, word; std::getline(in, line);) {
		++number;
		std::istringstream items(line);
		if (!(items >> word)) continue;
		if (word == "#") {
			c.comment += line.substr(std::min<size_t>(line.size(), 2)) + "\n";
			continue;
		}
		bool good = false;
		try {
			good = detail::ReadItem(word, items, c) && items.eof() | !(items >> word);
		} catch (const std::logic_error&) {  // std::stod
		}
		if (!good) throw std::runtime_error("line " + std::to_string(number) + ": " + line);
	}
	return c;
}

}  // namespace vcg::textlabel::test
