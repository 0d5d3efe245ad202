// Estimator::automatic: which estimator buys most accuracy per flight in this room, found by a short pilot of each.
//
// All estimators have the same mean, so that the one with the least relative variance for the same work is best: the
// variances are those of the figure that was asked for (area-weighted rms of the tiles' relative errors, or rms of the
// receivers'), the work is the number of flights. Flights are counted and not timed, so that the same room, settings
// and seed make the same choice on any machine, busy or idle; a flight costs nearly the same with all three
// (docs/performance.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc {

// Estimators that can be chosen from: the one in the settings; or, for `automatic`, those that the room allows.
std::vector<Estimator> candidates_for(const Room& room, const Settings& settings);

// Histories of a pilot: one in 64 of those that are to be simulated at most, but enough to tell a variance, and never
// more than there is use for.
std::uint64_t pilot_histories(std::uint64_t photons);

// What one estimator has found. Values and standard errors are of the same tiles or receivers in the same order for
// all; an error of one that was not hit is 0.
struct Pilot {
  Estimator estimator;
  std::vector<double> values;
  std::vector<double> errors;
  std::vector<double> hits;  // of tiles that are counted on
  double flights = 0.0;
};

struct Choice {
  std::size_t best = 0;  // index of the pilot
  std::string reason;    // a sentence
};

// The mean of what the pilots have found: one for all, so that no estimator gains by having missed what others hit.
std::vector<double> pooled_values(const std::vector<Pilot>& pilots);

// means: that errors are relative to. weights: of the values in the mean of squares, for example areas. `of_what` comes
// into the sentence: "the tiles".
Choice choose_best(const std::vector<Pilot>& pilots, const std::vector<double>& means,
                   const std::vector<double>& weights, const std::string& of_what);

}  // namespace lichtmc
