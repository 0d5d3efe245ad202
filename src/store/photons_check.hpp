// Checks whether the totals of photons can be those of a walk.
#pragma once

#include "run/state_data.hpp"

namespace lichtmc {

// Checks the number of histories, the lengths of the lists, and the balance of the emitted power. Ranges and estimator
// must have been checked before. truncated: histories end after a given number of flights. Throws Hdf5Error.
void check_photons(const Counted& photons, bool truncated);

}  // namespace lichtmc
