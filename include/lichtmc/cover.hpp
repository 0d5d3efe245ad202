// Surfaces that lie in the plane of others and cover them.
#pragma once

#include <cstddef>

namespace lichtmc {

// A part of one surface lies under another one in its plane (docs/physics.md, "Faces in one plane"): it receives no
// light.
struct Cover {
  std::size_t over = 0;   // indices into Room::surfaces
  std::size_t under = 0;  // may be the same surface
  bool behind = false;    // on the back of the surface `under`; only if it is two-sided
  double area_m2 = 0.0;
  // The part of the area on which no rule decides: both lie in patches of the same area and face the same way. The
  // first in the order of the room counts.
  double undecided_m2 = 0.0;
};

}  // namespace lichtmc
