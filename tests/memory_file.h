#pragma once
// For fuzz targets: bytes as a file.

#include <cstdlib>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

/// A file that lives in memory, under a name that any program can open.
class MemoryFile {
public:
	MemoryFile(const void* bytes, std::size_t size) : m_file(memfd_create("fuzz", 0))
	{
		if (m_file < 0 || write(m_file, bytes, size) != static_cast<ssize_t>(size)) std::abort();
	}
	~MemoryFile() { close(m_file); }
	std::string path() const { return "/proc/self/fd/" + std::to_string(m_file); }

private:
	int m_file;
};
