// Estimator::automatic: chooses the estimator with the smallest error per flight in this room, by a short pilot of
// each.
//
// All estimators have the same mean, so the best has the smallest relative variance for the same work. The variance is
// that of the requested figure (area-weighted rms of the tiles' relative errors, or rms of the receivers'); the work is
// the number of flights. Flights are counted, not timed: the same room, settings and seed give the same choice on any
// machine under any load. A flight costs nearly the same with all three (docs/performance.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc {

// The candidates: the estimator of the settings; for `automatic`, those that the room allows.
std::vector<Estimator> candidates_for(const Room& room, const Settings& settings);

// Histories of a pilot: at most 1/20 of those to be simulated (for absorption 1/80), but enough to estimate a
// variance, and with an upper limit.
std::uint64_t pilot_histories(std::uint64_t photons, Estimator estimator);

// The results of one estimator. Values and standard errors are of the same tiles or receivers in the same order for all
// estimators.
struct Pilot {
  Estimator estimator = Estimator::collision;
  std::vector<double> values;  // of tiles in a forward walk: without integrated direct light
  std::vector<double> errors;  // 0 for a tile without hits
  std::vector<double> hits;    // of tiles in a forward walk
  double flights = 0.0;
};

struct Choice {
  std::size_t best = 0;  // index of the pilot
  std::string reason;    // a sentence
};

// The mean over all pilots: the same for all, so that an estimator gains nothing by missing tiles that others hit.
std::vector<double> pooled_values(const std::vector<Pilot>& pilots);

// Likely values and errors of tiles after forward pilots. Most tiles have few hits or none after a pilot, but they
// determine the error of a long run.
struct CountedTiles {
  std::vector<double> areas;       // m²
  std::vector<std::uint32_t> map;  // of each tile
  std::size_t maps = 0;
};

// The likely irradiance of the tiles from their scores: a Bayesian estimate, because a few hits determine the mean of a
// tile poorly. The prior is a gamma distribution of shape 1 about the mean of the tile map. With Poisson-distributed
// hits the posterior mean is (hits + 1)/(hits expected + 1) times that of the tile map.
std::vector<double> likely_values(const std::vector<Pilot>& pilots, const CountedTiles& tiles);

// Replaces each pilot's errors by likely ones. The variance of a tile's power is its mean power times a factor that
// depends on the estimator and on the number of reflections before the tile: it is smaller for small weights. Tiles of
// similar irradiance share one factor; those with few hits are grouped until they have some thousand hits. Tiles that
// no pilot has hit, such as the outsides of walls, are left out.
void make_errors_likely(std::vector<Pilot>& pilots, const std::vector<double>& likely, const CountedTiles& tiles);

// means: the references of the relative errors, at least `floor`; values with a mean of 0 are left out. weights: of the
// values in the mean of squares, for example areas. of_what: a part of the sentence, "the tiles".
Choice choose_best(const std::vector<Pilot>& pilots, const std::vector<double>& means, double floor,
                   const std::vector<double>& weights, const std::string& of_what);

}  // namespace lichtmc
