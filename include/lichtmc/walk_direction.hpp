// The direction of a random walk.
#pragma once

#include <cstdint>
#include <string_view>

namespace lichtmc {

enum class WalkDirection : std::uint32_t {
  forward = 0,   // from the emitters: photons score on the tiles where they land
  backward = 1,  // from a receiver or a tile: the walk collects direct light at every surface on its way
};

// "forward" or "backward".
std::string_view to_string(WalkDirection direction);

}  // namespace lichtmc
