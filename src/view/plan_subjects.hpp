// What plans are drawn of.
#pragma once

#include <cstddef>
#include <vector>

#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "view/flat_pieces.hpp"

namespace lichtmc {

// A piece that gets a plan, seen from one side.
struct PlanSubject {
  std::size_t map = 0;
  FlatPiece piece;  // no triangles: the tile map as a whole
  bool from_behind = false;
};

// The flat pieces that get light, and the tile maps of surfaces that are mostly of smaller pieces; largest first. A
// piece is seen from the side that gets light on more of it; where both sides of a surface have tiles, from each that
// gets some. What is less than 2 % of the room's surface is left out.
std::vector<PlanSubject> plan_subjects(const Room& room, const Result& result, const LitSides& lit);

}  // namespace lichtmc
