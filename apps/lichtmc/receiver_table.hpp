// Receivers from a table: x,y,z,nx,ny,nz[,name], one row each.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc::app {

// Reads a table of receivers from a file, or from stdin where the name is "-": numbers with commas between, metres on
// glTF's axes, then the direction that each report_arguments to, then its name where it has one. A first row of words,
// empty rows and rows that begin with # are passed over. Each sees the whole hemisphere and has an area of 1 m². Throws
// InputError naming the file, the row and the value.
std::vector<Receiver> read_receivers(const std::string& file);

}  // namespace lichtmc::app
