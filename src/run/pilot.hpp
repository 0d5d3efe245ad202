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

// Histories of a pilot: one in 20 of those that are to be simulated at most (for absorption one in 80), but enough to
// tell a variance, and never more than there is use for.
std::uint64_t pilot_histories(std::uint64_t photons, Estimator estimator);

// What one estimator has found. Values and standard errors are of the same tiles or receivers in the same order for
// all.
struct Pilot {
  Estimator estimator = Estimator::collision;
  std::vector<double> values;  // of tiles that photons are counted on: without what is known besides
  std::vector<double> errors;  // of one that was not hit: 0
  std::vector<double> hits;    // of tiles that photons are counted on
  double flights = 0.0;
};

struct Choice {
  std::size_t best = 0;  // index of the pilot
  std::string reason;    // a sentence
};

// The mean of what the pilots have found: one for all, so that no estimator gains by having missed what others hit.
std::vector<double> pooled_values(const std::vector<Pilot>& pilots);

// What pilots of counted photons tell of tiles most of which they have hit a few times or not at all, though it is
// those tiles that a long run will be judged by.
struct CountedTiles {
  std::vector<double> areas;       // m²
  std::vector<std::uint32_t> map;  // of each tile
  std::size_t maps = 0;
};

// The likely irradiance of the tiles, of what was counted. A tile is not known to be as bright, or as dark, as its few
// hits say: its mean is drawn towards that of its tile map. A gamma law of shape 1 about the map's mean, with hits by
// Poisson's law, has the mean (hits + 1)/(hits expected + 1) times the map's.
std::vector<double> likely_values(const std::vector<Pilot>& pilots, const CountedTiles& tiles);

// Replaces each pilot's errors by likely ones. The variance of a tile's power is its mean power times a factor that
// depends on the estimator and on how far from the emitters the light of the tile has come: less for weights that have
// become small on the way. Tiles as dark as each other share one factor, dark ones with few hits that of some thousand
// hits together. Tiles that no pilot has hit, as the outsides of walls, count for none.
void make_errors_likely(std::vector<Pilot>& pilots, const std::vector<double>& likely, const CountedTiles& tiles);

// means: that errors are relative to. weights: of the values in the mean of squares, for example areas. `of_what` comes
// into the sentence: "the tiles".
Choice choose_best(const std::vector<Pilot>& pilots, const std::vector<double>& means,
                   const std::vector<double>& weights, const std::string& of_what);

}  // namespace lichtmc
