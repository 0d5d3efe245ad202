// Whether what a state says can have come of a run. The seal finds damage; this finds files that another program, or
// somebody, has changed and sealed again. The rest of the library relies on what is checked: it indexes by the sizes,
// counts by the ranges and subtracts sums from each other.
#pragma once

#include "run/state_data.hpp"

namespace lichtmc {

// Settings are sound and ask for the walks that there are; estimators are those of the settings; ranges are in order,
// apart, of whole batches but for the last one's end; arrays are as long as each other; sums are such as scores make
// (docs/state.md, "What is checked"). The room is not known here: numbers of tiles and receivers are compared with it
// when results are made. Throws Hdf5Error.
void check_state(const StateData& data);

}  // namespace lichtmc
