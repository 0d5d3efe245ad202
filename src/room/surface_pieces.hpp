// The connected pieces of a surface.
#pragma once

#include <cstddef>

#include "lichtmc/room.hpp"

namespace lichtmc {

struct SurfacePieces {
  std::size_t count = 0;     // pieces that have no edge in common
  bool closed = false;       // every edge belongs to two triangles: bodies such as boxes
  double facing_down = 0.0;  // share of the area whose front looks within 60° of straight down, 0 … 1
};

SurfacePieces pieces_of(const Surface& surface);

}  // namespace lichtmc
