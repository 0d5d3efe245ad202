// The parts of check_room().
#pragma once

#include "lichtmc/room.hpp"

namespace lichtmc {

// Checks that surfaces and reflectance maps are valid, and that a triangle has an area. Throws InputError as
// check_room().
void check_surfaces(const Room& room);

// Checks that there are emitters, and that they are valid.
void check_emitters(const Room& room);

// Checks that the points of calculation areas are receivers of the room.
void check_areas(const Room& room);

}  // namespace lichtmc
