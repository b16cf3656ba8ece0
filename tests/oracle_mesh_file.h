#pragma once
// Reads mesh files for checks: STL (text or binary), OBJ, PLY (binary, little-endian). Triangles only, as they are in the file,
// equal points not merged (in an STL each face has three points of its own). It shares no code with what it checks.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace oracle {

struct MeshFile {
	std::vector<std::array<double, 3>> points;
	std::vector<std::array<int, 3>> faces;
};

namespace file_detail {

inline std::string ReadAll(const std::string& path)
{
	std::ifstream in(path, std::ios::binary);
	if (!in) throw std::runtime_error("can't read " + path);
	std::ostringstream bytes;
	bytes << in.rdbuf();
	return bytes.str();
}

/// A value of a binary file, as T in its bytes.
template <class T>
T Take(const std::string& bytes, size_t& at)
{
	T value;
	if (at + sizeof value > bytes.size()) throw std::runtime_error("file ends too early");
	std::memcpy(&value, bytes.data() + at, sizeof value);
	at += sizeof value;
	return value;
}

inline void AddFace(MeshFile& mesh, const std::array<std::array<double, 3>, 3>& corners)
{
	const int first = static_cast<int>(mesh.points.size());
	mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
	mesh.faces.push_back({first, first + 1, first + 2});
}

inline MeshFile ReadStlText(const std::string& bytes)
{
	MeshFile mesh;
	std::istringstream in(bytes);
	std::array<std::array<double, 3>, 3> corners;
	size_t corner = 0;
	for (std::string word; in >> word;) {
		if (word != "vertex") continue;
		std::string x, y, z;  // through strings: streams don't read nan
		in >> x >> y >> z;
		corners[corner] = {double(std::stof(x)), double(std::stof(y)), double(std::stof(z))};
		corner = (corner + 1) % 3;
		if (corner == 0) AddFace(mesh, corners);
	}
	return mesh;
}

/// The size tells text from binary; a binary header may well begin with "solid".
inline MeshFile ReadStl(const std::string& bytes)
{
	constexpr size_t kHeader = 80, kFace = 50;
	size_t at = kHeader;
	if (bytes.size() < kHeader + 4) return ReadStlText(bytes);
	const auto count = Take<std::uint32_t>(bytes, at);
	if (bytes.size() != kHeader + 4 + kFace * count) return ReadStlText(bytes);
	MeshFile mesh;
	for (std::uint32_t f = 0; f < count; ++f) {
		for (int i = 0; i < 3; ++i) Take<float>(bytes, at);  // the normal
		std::array<std::array<double, 3>, 3> corners;
		for (auto& p : corners)
			for (double& x : p) x = Take<float>(bytes, at);
		AddFace(mesh, corners);
		Take<std::uint16_t>(bytes, at);
	}
	return mesh;
}

inline MeshFile ReadObj(const std::string& bytes)
{
	MeshFile mesh;
	std::istringstream in(bytes);
	for (std::string line; std::getline(in, line);) {
		std::istringstream words(line);
		std::string kind, word;
		words >> kind;
		if (kind == "v") {
			std::array<double, 3> p;
			words >> p[0] >> p[1] >> p[2];
			mesh.points.push_back(p);
		}
		std::vector<int> polygon;
		while (kind == "f" && words >> word) {
			const int i = std::stoi(word);  // up to the first slash
			polygon.push_back(i > 0 ? i - 1 : static_cast<int>(mesh.points.size()) + i);
		}
		for (size_t i = 2; i < polygon.size(); ++i) mesh.faces.push_back({polygon[0], polygon[i - 1], polygon[i]});
	}
	return mesh;
}

inline double TakePly(const std::string& type, const std::string& bytes, size_t& at)
{
	if (type == "float" || type == "float32") return Take<float>(bytes, at);
	if (type == "double" || type == "float64") return Take<double>(bytes, at);
	if (type == "int" || type == "int32") return Take<std::int32_t>(bytes, at);
	if (type == "uint" || type == "uint32") return Take<std::uint32_t>(bytes, at);
	if (type == "short" || type == "int16") return Take<std::int16_t>(bytes, at);
	if (type == "ushort" || type == "uint16") return Take<std::uint16_t>(bytes, at);
	if (type == "uchar" || type == "uint8") return Take<std::uint8_t>(bytes, at);
	if (type == "char" || type == "int8") return Take<std::int8_t>(bytes, at);
	throw std::runtime_error("PLY type " + type);
}

struct PlyElement {
	struct Property {
		std::string countType, type, name;  ///< countType is empty but for lists
	};
	std::string name;
	size_t count = 0;
	std::vector<Property> properties;
};

inline std::vector<PlyElement> ReadPlyHeader(const std::string& bytes, size_t& at)
{
	std::vector<PlyElement> elements;
	std::istringstream in(bytes);
	for (std::string line; std::getline(in, line) && line.rfind("end_header", 0) != 0;) {
		std::istringstream words(line);
		std::string kind, a, b, c, d;
		words >> kind >> a >> b >> c >> d;
		if (kind == "format" && a != "binary_little_endian") throw std::runtime_error("PLY format " + a);
		if (kind == "element") elements.push_back({a, std::stoul(b), {}});
		if (kind == "property")
			elements.back().properties.push_back(a == "list" ? PlyElement::Property{b, c, d}
			                                                 : PlyElement::Property{"", a, b});
	}
	at = static_cast<size_t>(in.tellg());
	return elements;
}

inline MeshFile ReadPly(const std::string& bytes)
{
	MeshFile mesh;
	size_t at = 0;
	for (const PlyElement& element : ReadPlyHeader(bytes, at))
		for (size_t n = 0; n < element.count; ++n) {
			std::map<std::string, double> values;
			std::vector<int> polygon;
			for (const auto& p : element.properties) {
				const size_t length = p.countType.empty() ? 1 : static_cast<size_t>(TakePly(p.countType, bytes, at));
				for (size_t i = 0; i < length; ++i) {
					values[p.name] = TakePly(p.type, bytes, at);
					if (!p.countType.empty()) polygon.push_back(static_cast<int>(values[p.name]));
				}
			}
			if (element.name == "vertex") mesh.points.push_back({values["x"], values["y"], values["z"]});
			for (size_t i = 2; i < polygon.size(); ++i) mesh.faces.push_back({polygon[0], polygon[i - 1], polygon[i]});
		}
	return mesh;
}

}  // namespace file_detail

/// Read a mesh by the ending of its name; throws std::runtime_error.
inline MeshFile ReadMeshFile(const std::string& path)
{
	using namespace file_detail;
	const std::string bytes = ReadAll(path);
	std::string ending = path.substr(path.rfind('.') + 1);
	for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
	if (ending == "stl") return ReadStl(bytes);
	if (ending == "obj") return ReadObj(bytes);
	if (ending == "ply") return ReadPly(bytes);
	throw std::runtime_error("unknown kind of mesh file: " + path);
}

}  // namespace oracle
