// The figures of calculation areas, with their errors.
//
// Points share photons and light samples: their errors are correlated. So every error follows from the differences
// between groups of rounds (walk/jackknife_groups.hpp), which contain these correlations.
//
// The lowest of many values with errors is too low on average. How much, a bootstrap tells: the values are varied by
// their errors, correlations included, 200 times, and the lowest of each set is b lower on average than that of the
// values themselves. Where one point is clearly the lowest, that is all of the bias (almost 0); where many points have
// the same true value it is 0.41 of it (√2 − 1: the values contain the errors already once). 1.5 b is taken off; what
// remains is between −0.9 b and + 0.5 b, and b is added to the standard error (squares). Coverage is tested:
// tests/verification. (B. Efron, R. Tibshirani, An Introduction to the Bootstrap, 1993, ch. 10.)
#pragma once

#include <cstddef>
#include <vector>

#include "lichtmc/area.hpp"
#include "lichtmc/emitter_parts.hpp"

namespace lichtmc {

// The figures of an area if the parts have these factors, without verdicts and initial values.
AreaResult area_figures(const Area& area, const EmitterParts& parts, const std::vector<double>& factors);

// All areas with the parts multiplied by factors; initial values and verdicts included.
std::vector<AreaResult> area_results(const std::vector<Area>& areas, const EmitterParts& parts,
                                     const std::vector<double>& factors);

// What a run has to reach: the largest relative standard error of the means and the minima of all areas. NaN if one is
// not known.
struct AreaErrors {
  double relative = 0.0;       // to the figure or to the error floor, whichever is greater
  double without_floor = 0.0;  // to the figure
};
AreaErrors largest_errors(const std::vector<Area>& areas, const EmitterParts& parts, double floor);

}  // namespace lichtmc
