// What a State holds.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lichtmc/result.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/state.hpp"
#include "walk/backward.hpp"
#include "walk/totals.hpp"

namespace lichtmc {

// How many histories, or rounds, ranges have together.
std::uint64_t count_of(const std::vector<HistoryRange>& ranges);

// Of a walk in either direction.
struct Walked {
  Estimator estimator = Estimator::collision;  // as used
  std::string choice;                          // why, where it was chosen
  std::vector<HistoryRange> ranges;            // in order, apart from each other
  double seconds = 0.0;                        // wall-clock time
  std::vector<ConvergencePoint> convergence;

  // Histories, or rounds, of all ranges.
  std::uint64_t size() const { return count_of(ranges); }
};

// Photons counted on tiles. Ranges are of histories; the totals are those of their whole batches.
struct Counted : Walked {
  std::uint64_t pilot = 0;  // histories after which an estimator was chosen; 0 where it was given
  std::shared_ptr<const Totals> totals;
};

// Walks back from origins. Ranges are of rounds.
struct BackwardState : Walked {
  std::uint32_t group = 1;  // walks in a round
  BackwardCount count;
  std::shared_ptr<const std::vector<BackwardSums>> sums;  // per origin
};

struct StateData {
  std::string version;
  Fingerprint room{};
  Settings settings;               // as asked for
  Engine engine = Engine::embree;  // as used
  std::optional<Counted> photons;
  std::optional<BackwardState> tile_walks;
  std::optional<BackwardState> receivers;
  std::string note;
};

// Two states with the same fingerprint have counted the same and are to go on in the same way: a hash (XXH3, 128 bits)
// of all but the note, the threads and how long it took.
Fingerprint fingerprint(const StateData& data);

}  // namespace lichtmc
