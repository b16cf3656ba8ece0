#pragma once
// Mesh files as a host reads them, and what judges who know nothing of this project say of them: CGAL (oracle_cgal) and admesh
// (oracle_admesh.sh).

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <unistd.h>

#include "oracle_mesh_file.h"
#include "test_mesh.h"
#include "vcg_ext/validate.h"

#include <vcg/space/box3.h>

namespace real_mesh {

using test_mesh::Shape;
using namespace vcg::textlabel;

/// The folder of real meshes; it need not be there.
inline std::filesystem::path Folder()
{
	if (const char* given = std::getenv("TEXTLABEL_REAL_MESHES")) return given;
	return std::filesystem::path(TEXTLABEL_SOURCE_DIR) / "../shared/meshes";
}

inline IndexedMesh ToIndexed(const Shape& s)
{
	IndexedMesh m;
	m.positions = s.points;
	for (const auto& f : s.faces) m.faces.push_back({f[0], f[1], f[2]});
	return m;
}

/// The mesh of a file with equal points merged, as MeshLab reads an STL file.
inline Shape Load(const std::filesystem::path& file, bool asFloat32)
{
	const oracle::MeshFile raw = oracle::ReadMeshFile(file.string());
	IndexedMesh mesh;
	for (const auto& p : raw.points) mesh.positions.emplace_back(p[0], p[1], p[2]);
	mesh.faces = raw.faces;
	mesh = PrepareForReport(std::move(mesh), {asFloat32, true});
	Shape s;
	s.points = mesh.positions;
	s.faces = mesh.faces;
	return s;
}

/// Whether float32 holds the coordinates of a file as well as any printer needs: to a millionth of the part.
inline bool FitsFloat32(const std::filesystem::path& file)
{
	constexpr double enough = 1e-6;
	double error = 0;
	vcg::Box3d box;
	for (const auto& p : oracle::ReadMeshFile(file.string()).points) {
		box.Add({p[0], p[1], p[2]});
		for (const double x : p) error = std::max(error, std::abs(double(float(x)) - x));
	}
	return error <= enough * box.Diag();
}

template <class T>
void Put(std::ofstream& out, const T& x)
{
	out.write(reinterpret_cast<const char*>(&x), sizeof x);
}

/// A binary STL file: float32, each face for itself.
inline void WriteStl(const Shape& s, const std::string& file)
{
	std::ofstream out(file, std::ios::binary);
	const std::string head(80, ' ');
	out.write(head.data(), 80);
	Put(out, static_cast<std::uint32_t>(s.faces.size()));
	for (const auto& f : s.faces) {
		for (int i = 0; i < 3; ++i) Put(out, 0.0f);
		for (const int v : f)
			for (int i = 0; i < 3; ++i) Put(out, static_cast<float>(s.points[size_t(v)][i]));
		Put(out, static_cast<std::uint16_t>(0));
	}
}

/// A binary PLY file with coordinates in doubles.
inline void WritePly(const Shape& s, const std::string& file)
{
	std::ofstream out(file, std::ios::binary);
	out << "ply\nformat binary_little_endian 1.0\nelement vertex " << s.points.size()
		<< "\nproperty double x\nproperty double y\nproperty double z\nelement face " << s.faces.size()
		<< "\nproperty list uchar int vertex_indices\nend_header\n";
	for (const auto& p : s.points)
		for (int i = 0; i < 3; ++i) Put(out, double(p[i]));
	for (const auto& f : s.faces) {
		Put(out, static_cast<std::uint8_t>(3));
		for (const int v : f) Put(out, static_cast<std::int32_t>(v));
	}
}

// ---- other judges ----

using Answer = std::map<std::string, double>;

/// The key=value words that a command prints; empty when it fails.
inline Answer Ask(const std::string& command)
{
	Answer answer;
	FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
	if (pipe == nullptr) return answer;
	char word[256];
	while (std::fscanf(pipe, "%255s", word) == 1) {
		const std::string text = word;
		const size_t equals = text.find('=');
		if (equals != std::string::npos) answer[text.substr(0, equals)] = std::atof(text.c_str() + equals + 1);
	}
	return pclose(pipe) == 0 ? answer : Answer();
}

/// What admesh had to do to an STL file; empty without admesh.
inline Answer AskAdmesh(const std::string& file)
{
	return Ask("bash '" TEXTLABEL_SOURCE_DIR "/tests/oracle_admesh.sh' '" + file + "'");
}

/// What CGAL counts in a mesh file; empty without the program.
/// @param[in] folder  of the program oracle_cgal
inline Answer AskCgal(const std::string& folder, const std::string& file)
{
	return Ask("'" + folder + "/oracle_cgal' '" + file + "'");
}

/// The first of some counts that has grown, in words; empty when none has.
inline std::string Worse(const Answer& before, const Answer& after, const std::vector<const char*>& keys)
{
	for (const char* key : keys) {
		const auto a = before.find(key), b = after.find(key);
		if (a == before.end() && b == after.end()) continue;
		if (a == before.end() || b == after.end()) return std::string(key) + " is said of one of them only";
		if (b->second > a->second) return std::string(key) + " " + std::to_string(long(b->second));
	}
	return {};
}

/// What admesh finds worse in an STL file than in the one of the part before; empty when nothing. What it does to repair an open
/// part, such as filling holes, depends on the order of the faces: there only what it found counts.
inline std::string AdmeshFault(const Answer& before, const Answer& after)
{
	if (after.empty()) return "admesh cannot read the file";
	const auto openSides = [](Answer a) {
		return a["disconnected_1"] + 2 * a["disconnected_2"] + 3 * a["disconnected_3"];
	};
	if (openSides(after) > openSides(before)) return "open sides";
	std::vector<const char*> keys = {"degenerate"};
	if (openSides(before) == 0)
		keys.insert(keys.end(), {"edges_fixed", "removed", "added", "reversed", "backwards", "parts"});
	return Worse(before, after, keys);
}

/// The same of CGAL; each piece of a face that crossed others may cross them, so crossings count where there were none.
inline std::string CgalFault(const Answer& before, const Answer& after)
{
	if (after.empty()) return "CGAL cannot read the file";
	const auto at = [&](const char* key) {
		const auto found = before.find(key);
		return found == before.end() ? 0 : found->second;
	};
	std::string fault = Worse(before, after, {"repeated_index", "collinear"});
	if (fault.empty() && at("crossing_pairs") == 0) fault = Worse(before, after, {"crossing_pairs"});
	for (const char* key : {"manifold_oriented", "closed"})
		if (fault.empty() && at(key) > 0 && (after.count(key) == 0 || after.at(key) == 0))
			fault = std::string("no longer ") + key;
	return fault;
}

/// Both of them on one part before and after. A shape in doubles is not for admesh, whose files are float32.
class OtherJudges {
public:
	/// @param[in] programs  folder of the program oracle_cgal
	OtherJudges(const Shape& before, bool isFloat, const std::string& programs)
		: programs_(programs),
		  work_(std::filesystem::temp_directory_path() / ("other_judges-" + std::to_string(getpid())))
	{
		std::filesystem::create_directories(work_);
		before_ = ask(before, isFloat);
	}
	~OtherJudges() { std::filesystem::remove_all(work_); }
	OtherJudges(const OtherJudges&) = delete;
	OtherJudges& operator=(const OtherJudges&) = delete;

	/// @return what is wrong, or empty
	std::string fault(const Shape& after, bool isFloat) const
	{
		const auto answer = ask(after, isFloat);
		const std::string admesh = isFloat ? AdmeshFault(before_[0], answer[0]) : "";
		if (!admesh.empty()) return "admesh: " + admesh;
		const std::string cgal = CgalFault(before_[1], answer[1]);
		return cgal.empty() ? "" : "CGAL: " + cgal;
	}

private:
	std::array<Answer, 2> ask(const Shape& shape, bool isFloat) const
	{
		const std::string file = (work_ / (isFloat ? "part.stl" : "part.ply")).string();
		isFloat ? WriteStl(shape, file) : WritePly(shape, file);
		return {isFloat ? AskAdmesh(file) : Answer(), AskCgal(programs_, file)};
	}

	std::string programs_;
	std::filesystem::path work_;
	std::array<Answer, 2> before_;
};

}  // namespace real_mesh
