// Which surfaces of a room are measured.
#pragma once

#include <algorithm>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Whether all are, so that results include every surface.
inline bool measures_all(const Room& room) {
  return std::all_of(room.surfaces.begin(), room.surfaces.end(),
                     [](const Surface& surface) { return surface.measured; });
}

}  // namespace lichtmc
