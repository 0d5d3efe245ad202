// A grid of receivers above the floor.
#pragma once

#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Receivers with normals upwards, `height_m` metres above the lowest point of the room, `spacing_m` (> 0) metres apart
// along x and z and at least half of that from the room's bounds, named "grid_COLUMN_ROW". Points with no surface below
// them (outside an L-shaped room) and points inside closed pieces of furniture are left out. Area 1 m²; the field of
// view is the whole hemisphere.
//
// Throws InputError if height or spacing is not a finite number, the spacing is not above 0, or no point is left.
std::vector<Receiver> receiver_grid(const Room& room, double height_m, double spacing_m);

}  // namespace lichtmc
