// A storey of closed rooms with twelve lamps each: what a point costs if most lamps never reach it.
#pragma once

#include "lichtmc/room.hpp"

namespace lichtmc::bench {

// nx × nz rooms of 6 × 3 × 5 m, 0.2 m apart, with 120 receivers in each, 0.75 m above the floor.
Room storey_of_rooms(int nx, int nz);

// Simulates the receivers to a relative error of 1 %; returns the number of points that the same time would bring to
// exactly 1 %.
double points_to_one_percent(const Room& room);

}  // namespace lichtmc::bench
