// Leaves surfaces that are not measured out of a result.
#pragma once

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Removes their tile maps and tiles, which took the scores of the walk, from the tiling and the results. The incident
// power of all tiles is then unknown (NaN): that of the measured surfaces is in their results.
void keep_measured(const Room& room, Result& result);

}  // namespace lichtmc
