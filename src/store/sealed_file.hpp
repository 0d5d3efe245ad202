// A seal on a file: its first 512 bytes say what it is, how long, and the checksum of all that follows. Any bit that
// changes, anywhere, is found before anything else reads the file. HDF5 leaves such a block to its users.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace lichtmc {

inline constexpr std::size_t seal_bytes = 512;

// What a file with this title (a line) begins with, where `rest` follows.
std::string seal_of(std::string_view title, std::string_view rest);

// Throws InputError saying what is wrong: the file is missing, of another title, or damaged.
void check_seal(const std::filesystem::path& file, std::string_view title);

}  // namespace lichtmc
