// Receivers from a table: x,y,z,nx,ny,nz[,name], one row each.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc::app {

// Reads a table of receivers from a file, or from stdin if the name is "-": numbers separated by commas, the position
// in metres on glTF's axes, then the normal, then optionally a name. A first row of words, empty rows and rows that
// begin with # are skipped. Each receiver has a field of view of 90° (half angle) and an area of 1 m². Throws
// InputError that names the file, the row and the value.
std::vector<Receiver> read_receivers(const std::string& file);

}  // namespace lichtmc::app
