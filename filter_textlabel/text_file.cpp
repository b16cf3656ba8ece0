#include "text_file.h"

#include <filesystem>
#include <fstream>

namespace textlabel {

FileBytes ReadWholeFile(const std::string& file, std::uintmax_t largest)
{
	namespace fs = std::filesystem;
	// A NUL would cut the name short in the systems below, and open another file than the one written.
	if (file.find('\0') != std::string::npos) return {nullptr, false, "NUL"};
	const fs::path path = fs::u8path(file);
	std::error_code error;
	const fs::file_status status = fs::status(path, error);
	if (!fs::exists(status)) return {nullptr, false, "no such file"};
	if (fs::is_directory(status)) return {nullptr, true, "it is a folder"};
	if (!fs::is_regular_file(status)) return {nullptr, true, "it is not a regular file"};
	const std::uintmax_t size = fs::file_size(path, error);
	if (error || size > largest) return {nullptr, true, "it is too large"};
	if (size == 0) return {nullptr, true, "the file is empty"};
	auto bytes = std::make_shared<std::string>(static_cast<std::size_t>(size), '\0');
	std::ifstream stream(path, std::ios::binary);
	if (!stream.read(bytes->data(), static_cast<std::streamsize>(size))) return {nullptr, true, "it cannot be read"};
	return {std::move(bytes), true, ""};
}

}  // namespace textlabel
