// The content of a State.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/fields.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/state.hpp"
#include "walk/backward.hpp"
#include "walk/channel_sums.hpp"
#include "walk/part_sums.hpp"
#include "walk/round_plan.hpp"
#include "walk/totals.hpp"

namespace lichtmc {

// The total number of histories, or rounds, of ranges.
std::uint64_t count_of(const std::vector<HistoryRange>& ranges);

template <>
inline constexpr bool is_row<HistoryRange> = true;

// The common data of walks in both directions.
struct Walked {
  Estimator estimator = Estimator::collision;  // as used
  std::string choice;                          // reason, if `automatic` has chosen it
  std::vector<HistoryRange> ranges;            // in order, not adjacent
  double seconds = 0.0;                        // wall-clock time
  std::vector<ConvergencePoint> convergence;

  // Histories, or rounds, of all ranges.
  std::uint64_t size() const { return count_of(ranges); }
};

// Photons scored on tiles. Ranges are of histories; the totals are those of their whole batches.
struct Counted : Walked {
  std::uint64_t pilot = 0;  // histories after which the estimator was chosen; 0 if it was given
  std::shared_ptr<const Totals> totals;
};

// Backward walks from origins. Ranges are of rounds.
struct BackwardState : Walked {
  RoundPlan plan;  // the histories of a round
  BackwardCount count;
  std::shared_ptr<const std::vector<BackwardSums>> sums;  // per origin
};

// Sums of a state that may be modified: copied only if there is another reference to them.
template <class Sums>
std::shared_ptr<Sums> own(std::shared_ptr<const Sums> sums) {
  if (sums.use_count() > 1) return std::make_shared<Sums>(*sums);
  return std::const_pointer_cast<Sums>(std::move(sums));
}

struct StateData {
  std::string version;
  Fingerprint room{};
  Settings settings;               // as requested
  Engine engine = Engine::embree;  // as used
  std::optional<Counted> photons;
  std::optional<BackwardState> tile_walks;
  std::optional<BackwardState> receivers;
  // Impulse responses, of the rounds of `receivers`; null: not asked for.
  std::shared_ptr<const ChannelSums> channels;
  // Parts of groups of emitters, of the same rounds; null: not kept.
  std::shared_ptr<const PartSums> parts;
  std::string note;
};

template <class F, class... Things>
void visit_walked(const F& f, Things&... walked) {
  f(Field{"estimator", FieldRole::same}, walked.estimator...);
  f(Field{"choice", FieldRole::record}, walked.choice...);
  f(Field{"seconds", FieldRole::record}, walked.seconds...);
  f(Field{"ranges"}, walked.ranges...);
  f(Field{"convergence", FieldRole::record}, walked.convergence...);
}

template <class F, AllOf<Counted>... Things>
void visit_fields(const F& f, Things&... photons) {
  visit_walked(f, photons...);
  f(Field{"pilot", FieldRole::request}, photons.pilot...);
  f(Field{"totals"}, photons.totals...);
}

template <class F, AllOf<BackwardState>... Things>
void visit_fields(const F& f, Things&... walks) {
  visit_walked(f, walks...);
  f(Field{"plan", FieldRole::same}, walks.plan...);
  f(Field{"count"}, walks.count...);
  f(Field{"sums"}, walks.sums...);
}

template <class F, AllOf<StateData>... Things>
void visit_fields(const F& f, Things&... state) {
  f(Field{"version", FieldRole::same}, state.version...);
  f(Field{"room", FieldRole::same}, state.room...);
  f(Field{"engine", FieldRole::same}, state.engine...);
  f(Field{"note", FieldRole::record}, state.note...);
  f(Field{"settings", FieldRole::request}, state.settings...);
  f(Field{"photons"}, state.photons...);
  f(Field{"tile_walks"}, state.tile_walks...);
  f(Field{"receivers"}, state.receivers...);
  f(Field{"channels"}, state.channels...);
  f(Field{"parts"}, state.parts...);
}

// States with the same fingerprint have the same sums and will continue in the same way: a hash (XXH3, 128 bits) of all
// fields except records and the use of the machine.
Fingerprint fingerprint(const StateData& data);

}  // namespace lichtmc
