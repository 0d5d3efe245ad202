// Leaves what light cannot reach out of the means of a result.
#pragma once

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "walk/unreached.hpp"

namespace lichtmc {

// Sets the unreached areas, and refers means, their errors, lowest irradiances and counts of tiles to the rest. Powers,
// areas and the tiles' own results do not change. A surface that light cannot reach at all keeps its mean of 0.
void leave_out_unreached(const Room& room, const UnreachedSides& unreached, Result& result);

}  // namespace lichtmc
