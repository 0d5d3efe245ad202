// Whether the totals of photons can have come of a walk.
#pragma once

#include "run/state_data.hpp"

namespace lichtmc {

// Ranges, and that the estimator is one of the three, have been checked. truncated: histories are cut off after some
// flights. Exact identities of integers hold for every walk, so for every sum of walks (see walk/walk.cpp):
//
//   histories             those in whole batches of the ranges
//   emitted               absorbed + escaped + residual + lost
//   scores                tile by tile, map by map and of all together: the same sum
//   hits                  of `collision` and `weight` impacts, of `absorption` photons absorbed; where direct light is
//                         integrated, less what ended the first flight: at most one a history
//
// Throws Hdf5Error.
void check_photons(const Counted& photons, Direct direct, bool truncated);

}  // namespace lichtmc
