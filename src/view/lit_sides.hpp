// Which sides of a room's surfaces light gets to: the others can be looked through in pictures.
#pragma once

#include "lichtmc/picture.hpp"
#include "lichtmc/room.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

// By photons from the emitters that are never absorbed, counted on either side of every triangle. Triangles are judged
// together with those that go on from them within 30°, so that chance leaves no holes: a side counts as lit where it
// gets a thousandth of the mean, what leaks through cracks being less. Pieces so small that chance decides count as
// lit.
LitSides find_lit_sides(const Room& room, const Scene& scene);

}  // namespace lichtmc
