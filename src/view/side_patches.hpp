// Judges from test impacts which sides of triangles light gets to.
#pragma once

#include <cstdint>
#include <vector>

#include "lichtmc/picture.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// `impacts`: on side 2 n + (0 front, 1 back) of each triangle n of the room, surface by surface.
//
// A side counts as lit if it gets a thousandth of the mean, which leaks through cracks do not reach. Few triangles have
// enough impacts for that, so each is judged together with the rest of its plane, and that with its surroundings on the
// surface: neighbours that go on within 30°, then theirs, until the impacts decide. The surroundings stay as small as
// that allows, because the walls of a cave go on in its outer skin without an edge. Small separate pieces without an
// impact are judged by all sides near them in the room.
LitSides judge_sides(const Room& room, const std::vector<std::uint32_t>& impacts);

}  // namespace lichtmc
