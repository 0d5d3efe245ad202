// Receivers from a table.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc {

// A heading names the columns x, y, z (position in m, glTF's axes), nx, ny, nz (normal) and, as far as they are wanted,
// name, area (m²), fov (half angle in degrees), concentrator_index and filter_gain, in any order and case, also with a
// unit: "x (m)", "x [m]" or "x/m". An empty area, fov, concentrator_index or filter_gain is the default of Receiver.
// Other columns are not read. Without a heading the columns are x,y,z,nx,ny,nz or x,y,z,nx,ny,nz,name. The columns are
// separated by commas, semicolons, tabs or blanks, the same in the whole table; a decimal comma is allowed where commas
// do not separate. Quotes as in RFC 4180; rows without content and rows that begin with # are not read. UTF-8, with or
// without a byte order mark, or UTF-16 with one.
struct ReceiverTable {
  std::vector<Receiver> receivers;  // field of view 90° (half angle), area 1 m²; "receiver_N" where a name is empty
  std::vector<std::string> notes;   // what was not read, one sentence each
};

// Reads a table from its bytes; `name` is that of its source, for messages. Throws InputError that names the source,
// the row (its line), the value and the cause. Nothing is guessed: a row that does not fit the columns is an error.
ReceiverTable parse_receiver_table(std::string_view bytes, const std::string& name);

// The largest table that is read, in bytes.
inline constexpr std::size_t largest_receiver_table = std::size_t{1} << 28;

// The same from a regular file of at most largest_receiver_table bytes. Throws InputError also if it cannot be read.
ReceiverTable read_receiver_table(const std::filesystem::path& file);

}  // namespace lichtmc
