// Reads files that a user or a room names. They may be anything: a folder, a device without end, a pipe that nobody
// writes to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace lichtmc {

// The content of a file, or the reason why it was not read.
struct FileContent {
  std::string bytes;
  std::string fault;     // empty if it was read: "it is a folder", "No such file or directory", …
  bool missing = false;    // there is no file of this name
  bool too_large = false;  // it has more bytes than the limit
};

// Reads a regular file (symbolic links are followed) of at most `most_bytes`. Anything else, and a larger file, is a
// fault; the call never waits for a pipe or device. Of a file that is longer than `needed_bytes` only these are read,
// and `most_bytes` does not apply. std::bad_alloc if memory is not sufficient.
FileContent read_regular_file(const std::filesystem::path& file, std::uint64_t most_bytes);
FileContent read_start_of_file(const std::filesystem::path& file, std::uint64_t needed_bytes);

// The same, for a file that must exist. Throws InputError: "Cannot read NAME (REASON; allowed: a regular file of up to
// N bytes). REMEDY" `name`: the file as the user knows it. remedy_if_too_large: in place of `remedy`; empty: the same.
std::string require_regular_file(const std::filesystem::path& file, std::uint64_t most_bytes, const std::string& name,
                                 const std::string& remedy, const std::string& remedy_if_too_large = {});

}  // namespace lichtmc
