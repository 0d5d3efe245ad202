// The parts of check_room().
#pragma once

#include "lichtmc/room.hpp"

namespace lichtmc {

// Whether surfaces and reflectance maps are sound, and there is a triangle with an area. Throws InputError as
// check_room().
void check_surfaces(const Room& room);

// Whether there are emitters, and they are sound.
void check_emitters(const Room& room);

}  // namespace lichtmc
