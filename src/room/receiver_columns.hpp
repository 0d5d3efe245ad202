// The columns of a table of receivers: which is which, and how they are separated.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/csv.hpp"

namespace lichtmc {

// Position, normal and, only with a heading, the edges of cells, and what else a receiver has.
inline constexpr std::array<std::string_view, 16> receiver_numbers{
    "x",          "y", "z", "nx", "ny", "nz", "ux", "uy", "uz", "vx", "vy", "vz", "area", "fov", "concentrator_index",
    "filter_gain"};
inline constexpr std::size_t needed_numbers = 6;    // the first of them
inline constexpr std::size_t numbers_of_cell = 12;  // the first of them: with the edges
inline constexpr std::size_t area_number = 12, fov_number = 13, concentrator_number = 14, filter_number = 15;

struct ReceiverColumns {
  std::array<std::size_t, receiver_numbers.size()> numbers{0, 1, 2, 3, 4, 5};  // of receiver_numbers
  bool cells = false;                                                          // it has the edges
  std::array<bool, receiver_numbers.size()> found{};                           // named by the heading
  std::optional<std::size_t> name;
  std::size_t least = 6;             // number of fields of a row
  std::size_t most = 7;              // without a heading a row may have a name or not
  bool heading = false;              // named by a heading
  std::vector<std::string> ignored;  // headings of columns that are not read
};

// Blanks, tabs and no-break spaces at the ends removed.
std::string_view trimmed(std::string_view text);

// Whether a field looks like a number, also like one that is refused: "1,5", "nan", "0x10".
bool looks_like_number(std::string_view text);

// Whether a row names columns: all of x, y, z, nx, ny, nz.
bool names_all_columns(const CsvRow& row);

// The columns that a heading names. `where` is its source and row, for messages. Throws InputError if a column is
// missing, is named twice or has another unit than metres, square metres (area) and degrees (fov), or if not all of the
// edges' columns are there.
ReceiverColumns columns_of(const CsvRow& heading, const std::string& where);

// The separator of a table, from its first row: the first of tab, semicolon, comma and blank by which it is a heading
// with all columns, or begins with six numbers. If it fits none, the one that gives the most fields.
char separator_of(std::string_view first_row);

}  // namespace lichtmc
