// bench_part TRIANGLES FILE.stl|FILE.ply: the cushion of the benchmarks as a binary file (whole_process.sh).

#include "bench_part.h"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>

namespace {

using bench::IndexedMesh;

class Bytes {
public:
	template <class T>
	void add(T value)
	{
		char raw[sizeof value];
		std::memcpy(raw, &value, sizeof value);
		bytes_.insert(bytes_.end(), raw, raw + sizeof value);
	}
	void add(const vcg::Point3d& p)
	{
		for (int i = 0; i < 3; ++i) add(float(p[i]));
	}
	bool write(const std::string& path, const std::string& head) const
	{
		std::ofstream out(path, std::ios::binary);
		out.write(head.data(), std::streamsize(head.size())).write(bytes_.data(), std::streamsize(bytes_.size()));
		return bool(out.flush());
	}

private:
	std::vector<char> bytes_;
};

bool WriteStl(const IndexedMesh& mesh, const std::string& path)
{
	constexpr size_t headSize = 80;
	Bytes bytes;
	bytes.add(std::uint32_t(mesh.faces.size()));
	for (const auto& f : mesh.faces) {
		bytes.add(vcg::Point3d(0, 0, 0));  // the reader computes normals
		for (const int v : f) bytes.add(mesh.positions[size_t(v)]);
		bytes.add(std::uint16_t(0));
	}
	return bytes.write(path, std::string(headSize, ' '));
}

bool WritePly(const IndexedMesh& mesh, const std::string& path)
{
	Bytes bytes;
	for (const auto& p : mesh.positions) bytes.add(p);
	for (const auto& f : mesh.faces) {
		bytes.add(std::uint8_t(3));
		for (const int v : f) bytes.add(std::int32_t(v));
	}
	return bytes.write(
		path, "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
				  "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
				  std::to_string(mesh.faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n");
}

}  // namespace

int main(int count, char** words)
{
	if (count != 3) return std::cerr << "usage: bench_part TRIANGLES FILE.stl|FILE.ply\n", 2;
	const std::string path = words[2];
	const IndexedMesh mesh = bench::MakeCushion(std::atof(words[1]));
	const bool isStl = path.size() > 4 && path.compare(path.size() - 4, 4, ".stl") == 0;
	if (isStl ? WriteStl(mesh, path) : WritePly(mesh, path)) return 0;
	std::cerr << "bench_part: can't write " << path << '\n';
	return 1;
}
