// Manifold as a peer: a Python process that has manifold3d, asked line by line (manifold_worker.py).

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#include "peer.h"

namespace bench {
namespace {

void WriteMesh(const std::string& path, const IndexedMesh& mesh)
{
	std::ofstream out(path, std::ios::binary);
	const std::int64_t size[2] = {std::int64_t(mesh.positions.size()), std::int64_t(mesh.faces.size())};
	const auto put = [&out](const void* data, size_t bytes) {
		out.write(static_cast<const char*>(data), std::streamsize(bytes));
	};
	put(size, sizeof size);
	for (const auto& p : mesh.positions) put(p.V(), 3 * sizeof(double));
	put(mesh.faces.data(), mesh.faces.size() * sizeof mesh.faces[0]);
	if (!out.flush()) throw std::runtime_error("can't write " + path);
}

IndexedMesh ReadMesh(const std::string& path)
{
	std::ifstream in(path, std::ios::binary);
	std::int64_t size[2] = {0, 0};
	const auto get = [&in](void* data, size_t bytes) { in.read(static_cast<char*>(data), std::streamsize(bytes)); };
	get(size, sizeof size);
	IndexedMesh mesh;
	mesh.positions.resize(size_t(size[0]));
	mesh.faces.resize(size_t(size[1]));
	for (auto& p : mesh.positions) get(p.V(), 3 * sizeof(double));
	get(mesh.faces.data(), mesh.faces.size() * sizeof mesh.faces[0]);
	if (!in) throw std::runtime_error("can't read " + path);
	return mesh;
}

/// A process with a pipe in and a pipe out.
class Worker {
public:
	explicit Worker(const char* python)
	{
		int in[2], out[2];
		if (pipe2(in, O_CLOEXEC) != 0 || pipe2(out, O_CLOEXEC) != 0)  // not handed on to the next worker
			throw std::runtime_error("no pipe");
		process_ = fork();
		if (process_ < 0) throw std::runtime_error("no process");
		if (process_ == 0) {
			dup2(in[0], 0);
			dup2(out[1], 1);
			execlp(python, python, TEXTLABEL_SOURCE_DIR "/tests/bench/manifold_worker.py", nullptr);
			_exit(127);
		}
		close(in[0]);
		close(out[1]);
		to_ = fdopen(in[1], "w");
		from_ = fdopen(out[0], "r");
	}
	~Worker()
	{
		std::fclose(to_);  // it ends with its input
		std::fclose(from_);
		waitpid(process_, nullptr, 0);
	}
	Worker(const Worker&) = delete;
	Worker& operator=(const Worker&) = delete;

	/// @return the answer; empty when there is no process
	std::string ask(const std::string& line)
	{
		std::fprintf(to_, "%s\n", line.c_str());
		std::fflush(to_);
		std::string answer;
		for (int c; (c = std::fgetc(from_)) != EOF && c != '\n';) answer += char(c);
		return answer;
	}

private:
	pid_t process_;
	std::FILE *to_, *from_;
};

class Manifold : public Peer {
public:
	Manifold(const std::string& python, const std::string& folder)
		: worker_(python.c_str()), folder_(folder), about_(worker_.ask("about"))
	{}
	std::string about() const override { return about_; }
	void load(const IndexedMesh& part, const IndexedMesh& prism) override
	{
		WriteMesh(folder_ + "/part", part);
		WriteMesh(folder_ + "/prism", prism);
		worker_.ask("load " + folder_ + "/part " + folder_ + "/prism");
	}
	double runAlone(Operation operation, IndexedMesh* result) override
	{
		const double seconds = secondsOf("alone " + nameOf(operation) + " " + (result ? folder_ + "/result" : "-"));
		if (result && seconds >= 0) *result = ReadMesh(folder_ + "/result");
		return seconds;
	}
	double run(Operation operation) override { return secondsOf("run " + nameOf(operation)); }

private:
	static std::string nameOf(Operation operation) { return operation == Operation::Union ? "union" : "difference"; }
	double secondsOf(const std::string& question)
	{
		const std::string answer = worker_.ask(question);
		const double seconds = answer.empty() ? -1 : std::atof(answer.c_str());
		if (seconds < 0) std::fprintf(stderr, "Manifold: %s\n", answer.c_str());
		return seconds;
	}

	Worker worker_;
	std::string folder_, about_;
};

}  // namespace

std::unique_ptr<Peer> MakeManifold(const std::string& python, const std::string& folder)
{
	std::signal(SIGPIPE, SIG_IGN);  // a Python without manifold3d ends before it is asked
	auto peer = std::make_unique<Manifold>(python, folder);
	if (peer->about().empty()) return nullptr;
	return peer;
}

}  // namespace bench
