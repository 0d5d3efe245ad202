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

struct PlanSubjects {
  std::vector<PlanSubject> subjects;     // largest first
  std::vector<std::size_t> small_parts;  // tile maps as large that get no plan, because a plan of them is not readable
};

// The lit flat pieces with at least 2 % of the room's surface area; for curved surfaces, of which less than half is in
// such pieces, also the whole tile map, if it is readable. The plan shows the side with the larger lit area; if both
// sides have tiles, there is a plan of each lit side.
//
// A tile map is readable if it has at most 12 parts, and 90 % of its cells are in parts of at least a twentieth of its
// longer side: 24 of the 480 units of a plan; and if 12 connected pieces of the surface have 90 % of its area, since
// the map of a surface in many pieces shows them without their places. Of a surface with 90 % of its area in flat
// pieces of at least 1 % each (a body with plane sides) the map is not readable: it is the surface unfolded.
PlanSubjects plan_subjects(const Room& room, const Result& result, const LitSides& lit);

}  // namespace lichtmc
