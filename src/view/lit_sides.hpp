// Which sides of a room's surfaces light gets to: the others can be looked through in pictures.
#pragma once

#include "lichtmc/picture.hpp"
#include "lichtmc/room.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

// By photons from the emitters that are never absorbed, counted on either side of every triangle; judge_sides()
// decides.
LitSides find_lit_sides(const Room& room, const Scene& scene);

}  // namespace lichtmc
