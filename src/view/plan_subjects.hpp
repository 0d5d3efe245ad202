// Selects the parts of surfaces that get a plan.
#pragma once

#include <cstddef>
#include <vector>

#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "view/flat_pieces.hpp"

namespace lichtmc {

// A flat piece and the side that its plan shows.
struct PlanSubject {
  std::size_t map = 0;
  FlatPiece piece;  // without triangles: the whole tile map
  bool from_behind = false;
};

// The lit flat pieces with at least 2 % of the room's surface area; for surfaces with less than half of their area in
// such pieces, also the whole tile map. Largest first. The plan shows the side with the larger lit area; if both sides
// have tiles, there is a plan of each lit side.
std::vector<PlanSubject> plan_subjects(const Room& room, const Result& result, const LitSides& lit);

}  // namespace lichtmc
