// Whether the totals of photons can be those of a walk.
#pragma once

#include "run/state_data.hpp"

namespace lichtmc {

// Ranges, and that the estimator is one of the three, have been checked. truncated: histories end after a given number
// of flights. Checked are the number of histories, the lengths of the lists, and the balance of what was emitted. Throws
// Hdf5Error.
void check_photons(const Counted& photons, bool truncated);

}  // namespace lichtmc
