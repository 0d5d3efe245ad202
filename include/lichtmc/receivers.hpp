// Receivers in numbers: a grid of points above the floor.
#pragma once

#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Points that look up, `height_m` metres above the lowest point of the room, `spacing_m` (> 0) apart along x and z and
// at least half of that from the room's bounds, named "grid_COLUMN_ROW". Left out are points with nothing below them
// (outside an L-shaped room) and points inside closed pieces of furniture. Area 1 m², the whole hemisphere in view.
//
// Throws InputError where height or spacing is not a finite number, the spacing not above 0, or no point is left.
std::vector<Receiver> receiver_grid(const Room& room, double height_m, double spacing_m);

}  // namespace lichtmc
