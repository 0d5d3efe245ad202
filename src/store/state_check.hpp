// Checks whether a state can be the result of a run. The seal detects damage; this detects files that another program
// has changed and sealed again. The library relies on these conditions: sizes are used as indices, ranges as counts,
// and sums are subtracted from each other.
#pragma once

#include "run/state_data.hpp"

namespace lichtmc {

// Conditions: the settings are valid and request the walks of the state; the estimators are those of the settings;
// ranges are in order, not adjacent, of whole batches except the end of the last; lengths of arrays are consistent; the
// balance is correct; times are valid (docs/state.md, "What is checked"). Numbers of tiles and receivers are compared
// with the room when results are computed. Throws Hdf5Error.
void check_state(const StateData& data);

}  // namespace lichtmc
