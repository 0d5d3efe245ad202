// The seal of a file: its first 512 bytes (the user block of HDF5) contain its title, its size, and the checksum of all
// following bytes. A changed bit anywhere is detected before the file is read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace lichtmc {

inline constexpr std::size_t seal_bytes = 512;

// The seal of a file with this title (one line) whose other bytes are `rest`.
std::string seal_of(std::string_view title, std::string_view rest);

// Throws InputError if the file is missing, has another title, or is damaged.
void check_seal(const std::filesystem::path& file, std::string_view title);

// The same for the bytes of such a file. source: what messages call them.
void check_seal(std::string_view bytes, const std::string& source, std::string_view title);

}  // namespace lichtmc
