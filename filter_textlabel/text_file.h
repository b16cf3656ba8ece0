#pragma once
// A file's bytes, whatever stands under its name.

#include <cstdint>
#include <memory>
#include <string>

namespace textlabel {

struct FileBytes {
	std::shared_ptr<const std::string> bytes;  ///< null when it could not be read
	bool exists = true;
	const char* why = "";  ///< it could not be read, as in "it is a folder"
};

/// Read a regular file that is not empty.
/// @param[in] largest  bytes
FileBytes ReadWholeFile(const std::string& file, std::uintmax_t largest);

}  // namespace textlabel
