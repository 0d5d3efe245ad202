#include "run/receiver_plan.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "base/message.hpp"
#include "run/error_measure.hpp"
#include "run/pilot.hpp"

namespace lichtmc {

namespace {

// The histories of a round for each receiver: few, because a standard error needs tens of rounds, also in short runs.
// More photons in a set are spread more evenly: 32 have 0.7 times the variance of independent ones, 1024 have 0.35
// times (docs/performance.md).
constexpr std::uint64_t histories_of_round = 8192;
constexpr std::uint32_t most_of_kind = 32;

// Walks of a round, if there are no photons: with 32 from each, 1000 receivers leave 30 rounds of a million.
constexpr std::uint64_t walks_of_round = 32768;

// A pilot ends after this work, some milliseconds: all pilots together take some hundredths of a second.
constexpr double pilot_work = 1.5e4;
constexpr std::size_t most_pilot_receivers = 128;
// A pilot with this work is given up: the room absorbs almost nothing.
constexpr double endless_work = 100.0 * pilot_work;
static_assert(most_pilot_receivers <= ReceiverBlocks::size);

// Work in units of one flight by Embree through a room of some thousand triangles (some 0.13 µs), measured by
// lichtmc_bench. A room that casts no shadow is simple.
struct UnitCosts {
  double flight = 1.0;
  double shadow_ray = 0.45;
  double bundled_ray = 0.22;
  double connection = 0.012;
};

UnitCosts costs_of(const Scene& scene) {
  if (scene.tracer->casts_shadows()) return {};
  return {scene.engine == Engine::cuboid ? 0.25 : 0.5, 0.0, 0.0, 0.012};
}

// The work of flights and of light samples.
double work_of_walks(const BackwardCount& count, const UnitCosts& costs) {
  const TraceCount& traced = count.traced;
  return costs.flight * static_cast<double>(traced.rays - traced.shadow_rays) +
         costs.shadow_ray * static_cast<double>(traced.shadow_rays - traced.bundled);
}

// The work of impacts that contribute to receivers.
double work_of_connections(const BackwardCount& count, const UnitCosts& costs) {
  return costs.bundled_ray * static_cast<double>(count.traced.bundled) +
         costs.connection * static_cast<double>(count.connections);
}

// Numbers of rounds far beyond those of runs.
constexpr std::uint64_t first_pilot_round = std::uint64_t{1} << 40;

std::uint32_t power_of_two_below(double value, std::uint32_t most) {
  const double limited = std::clamp(value, 1.0, static_cast<double>(most));
  return std::bit_floor(static_cast<std::uint32_t>(limited));
}

// The plan for receivers with `ratio` photons for each walk, or the nearest that is allowed; infinite: photons only, 0:
// walks only. served: the share of the receivers that an impact serves: only these count for photons.
RoundPlan plan_with(double ratio, std::size_t receivers, double served) {
  const std::uint32_t most =
      power_of_two_below(static_cast<double>(histories_of_round) / static_cast<double>(receivers), most_of_kind);
  if (!(ratio > 0.0)) {
    const double walks = static_cast<double>(walks_of_round) / static_cast<double>(receivers);
    return {0, static_cast<std::uint32_t>(std::clamp(walks, 1.0, static_cast<double>(most_of_kind)))};
  }
  if (std::isinf(ratio)) {
    const double photons = static_cast<double>(histories_of_round) / (served * static_cast<double>(receivers));
    return {power_of_two_below(photons, most_of_kind), 0};
  }
  if (ratio >= 1.0) {
    const std::uint32_t forward = std::max(most, power_of_two_below(ratio, most_of_kind));
    return {forward, std::max(1U, static_cast<std::uint32_t>(std::lround(forward / ratio)))};
  }
  const std::uint32_t backward = std::max(most, power_of_two_below(1.0 / ratio, most_of_kind));
  return {power_of_two_below(backward * ratio, most_of_kind), backward};
}

// What a pilot has found about a plan.
struct Trial {
  RoundPlan plan;
  Estimator estimator = Estimator::weight;
  double variance = 0.0;  // of a round: mean over the receivers of its square relative to the irradiance
  double work = 0.0;      // of a round, for all receivers of the room
  double cost() const { return variance * work; }
};

// Those of the receivers of a pilot, which are spread evenly over all.
template <class OfReceiver>
std::vector<OfReceiver> sample_of(const std::vector<OfReceiver>& all) {
  const std::size_t n = std::min(all.size(), most_pilot_receivers);
  std::vector<OfReceiver> sample;
  for (std::size_t k = 0; k < n; ++k) sample.push_back(all[k * all.size() / n]);
  return sample;
}

class Pilots {
 public:
  Pilots(const Room& room, const Scene& scene, const DirectLight& light, const std::vector<ReferencePoint>& receivers,
         const std::vector<DirectIrradiance>& direct, double served_share, const Settings& settings,
         const Abandon& stop)
      : room_(room),
        scene_(scene),
        light_(light),
        settings_(settings),
        stop_(stop),
        scale_(room),
        all_(receivers.size()),
        served_share_(served_share),
        costs_(costs_of(scene)),
        blocks_(sample_of(receivers), *scene.tracer) {
    for (const DirectIrradiance& one : sample_of(direct)) direct_.push_back(one.value);
  }

  // The variance of a round of the plan, from smaller rounds with the same shares: of histories without quasi-random
  // points it is the same.
  Trial run(const RoundPlan& plan, Estimator estimator) const {
    const std::uint32_t common = plan.two_way() ? std::gcd(plan.forward, plan.backward) : 1;
    Trial trial = run_rounds({plan.forward / common, plan.backward / common}, estimator);
    trial.plan = plan;
    trial.variance /= common;
    trial.work *= common;
    return trial;
  }

 private:
  struct Counts {
    BackwardCount photons;  // from the emitters
    BackwardCount walks;    // from the receivers

    double work(const UnitCosts& costs) const {
      return work_of_walks(photons, costs) + work_of_connections(photons, costs) + work_of_walks(walks, costs);
    }
  };

  struct GivenUp {};

  // The work for all receivers of the room: photons fly once for every block of receivers, their impacts serve a share
  // of them; walks start from each.
  double work_for_all(const Counts& counts) const {
    const double blocks = std::ceil(static_cast<double>(all_) / ReceiverBlocks::size);
    const double times = static_cast<double>(all_) / static_cast<double>(direct_.size());
    return blocks * work_of_walks(counts.photons, costs_) +
           times * served_share_ * work_of_connections(counts.photons, costs_) +
           times * work_of_walks(counts.walks, costs_);
  }

  Trial run_rounds(const RoundPlan& plan, Estimator estimator) const {
    Settings settings = settings_;
    settings.estimator = estimator;
    // Every impact serves all receivers of the sample.
    ReceiverRounds rounds({room_, scene_, light_, blocks_, nullptr}, scale_, settings, plan);
    const std::size_t n = direct_.size();
    std::vector<double> sums(n, 0.0);
    std::vector<double> squares(n, 0.0);
    Counts counts;
    std::uint64_t done = 0;
    constexpr std::uint64_t fewest_rounds = 8;
    for (std::uint64_t step = fewest_rounds; done == 0 || counts.work(costs_) < pilot_work;) {
      std::vector<double> irradiance(step * n, 0.0);
      try {
        const std::uint64_t first = first_pilot_round + done;
        rounds.collect({0, n, first, first + step}, irradiance, counts.photons, counts.walks, [&]() -> bool {
          // Walks obey only after many flights, because runs need their ends; of a pilot nothing is kept.
          if (stop_() || counts.work(costs_) > endless_work) throw GivenUp();
          return false;
        });
      } catch (const GivenUp&) {
        return {plan, estimator, std::numeric_limits<double>::quiet_NaN(), 0.0};
      }
      done += step;
      for (std::size_t k = 0; k < irradiance.size(); ++k) {
        sums[k % n] += irradiance[k];
        squares[k % n] += irradiance[k] * irradiance[k];
      }
      if (counts.photons.impacts + counts.walks.impacts == 0) break;  // nothing meets a surface
      step = std::min(done, std::max<std::uint64_t>(1, 16384 / plan.histories(n)));
    }
    const auto number = static_cast<double>(done);
    return {plan, estimator, relative_variance(sums, squares, number), work_for_all(counts) / number};
  }

  double relative_variance(const std::vector<double>& sums, const std::vector<double>& squares, double n) const {
    std::vector<double> irradiance = direct_;
    for (std::size_t k = 0; k < sums.size(); ++k) irradiance[k] += sums[k] / n;
    const double floor = receiver_error_floor(settings_, irradiance);
    double sum = 0.0;
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const double variance = std::max(0.0, (squares[k] - sums[k] * sums[k] / n) / (n - 1.0));
      const double against = std::max(irradiance[k], floor);
      if (against > 0.0) sum += variance / (against * against);
    }
    return sum / static_cast<double>(sums.size());
  }

  const Room& room_;
  const Scene& scene_;
  const DirectLight& light_;
  const Settings& settings_;
  const Abandon& stop_;
  BackwardScale scale_;
  std::size_t all_;      // receivers
  double served_share_;  // of them, by an impact
  UnitCosts costs_;
  ReceiverBlocks blocks_;  // a sample of the receivers: one block
  std::vector<double> direct_;
};

std::string in_words(ReceiverWalk walk) {
  switch (walk) {
    case ReceiverWalk::next_event:
      return "next-event estimation";
    case ReceiverWalk::backward:
      return "backward walks";
    default:
      break;
  }
  return "two-way walks";
}

std::string shares(const RoundPlan& plan) {
  if (!plan.two_way()) return {};
  return " (" + to_text(plan.forward, "photon") + " from the emitters with " + to_text(plan.backward, "walk") +
         " from each)";
}

bool is_known(const Trial& trial) {
  return trial.cost() > 0.0 && std::isfinite(trial.cost());
}

// A pilot may miss rare large scores of photons near a receiver, or of walks near an emitter, which two-way walks do
// not have: walks in one direction must be better by this factor.
constexpr double margin = 0.85;

std::size_t best_of(const std::vector<Trial>& trials) {
  std::size_t best = trials.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < trials.size(); ++k) {
    const double cost = trials[k].cost() / (trials[k].plan.two_way() ? 1.0 : margin);
    if (!is_known(trials[k]) || !(cost < least)) continue;
    least = cost;
    best = k;
  }
  return best;
}

// Why a plan was chosen, beside the cheapest of each other kind of walk and estimator.
std::string reason_of(const std::vector<Trial>& trials, std::size_t best) {
  const Trial& chosen = trials[best];
  const ReceiverWalk chosen_kind = walk_of(chosen.plan);
  std::string text = in_words(chosen_kind) + shares(chosen.plan) + " with the estimator '" +
                     std::string(to_string(chosen.estimator)) +
                     (chosen_kind == ReceiverWalk::next_event ? "' was" : "' were") +
                     " chosen for the receivers: for the same error, ";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  std::vector<std::string> others;
  std::vector<std::string> same_walk;
  for (const ReceiverWalk kind : {ReceiverWalk::two_way, ReceiverWalk::next_event, ReceiverWalk::backward}) {
    for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption}) {
      double least = std::numeric_limits<double>::infinity();
      for (const Trial& trial : trials) {
        if (walk_of(trial.plan) == kind && trial.estimator == estimator && is_known(trial))
          least = std::min(least, trial.cost());
      }
      const bool same_estimator = estimator == chosen.estimator;
      if ((kind == chosen_kind && same_estimator) || std::isinf(least)) continue;
      (kind == chosen_kind ? same_walk : others)
          .push_back(in_words(kind) + (same_estimator ? "" : " with '" + std::string(to_string(estimator)) + "'") +
                     (kind == ReceiverWalk::next_event ? " takes " : " take ") + short_number(least / chosen.cost()) +
                     " times");
    }
  }
  others.insert(others.end(), same_walk.begin(), same_walk.end());
  if (others.empty()) return {};
  for (std::size_t k = 0; k < others.size(); ++k) text += (k > 0 ? ", " : "") + others[k] + (k == 0 ? " the work" : "");
  return text + " (by a short pilot).";
}

}  // namespace

ReceiverWalk walk_of(const RoundPlan& plan) {
  if (plan.two_way()) return ReceiverWalk::two_way;
  return plan.forward > 0 ? ReceiverWalk::next_event : ReceiverWalk::backward;
}

std::uint64_t most_histories_of_round(std::uint64_t receivers) {
  return std::uint64_t{2} * most_of_kind * receivers;
}

double receiver_error_floor(const Settings& settings, const std::vector<double>& irradiances) {
  if (irradiances.empty()) return 0.0;
  const double sum = std::accumulate(irradiances.begin(), irradiances.end(), 0.0);
  return error_floor(settings, sum / static_cast<double>(irradiances.size()));
}

ReceiverPlan choose_receiver_plan(const Room& room, const Scene& scene, const DirectLight& light,
                                  const std::vector<ReferencePoint>& receivers,
                                  const std::vector<DirectIrradiance>& direct, double served_share,
                                  const Settings& settings, const Abandon& stop) {
  const ReceiverWalk walk = settings.receiver_walk;
  std::vector<Estimator> estimators = candidates_for(room, settings);
  // Late bins of impulse responses need photons that fly long.
  if (settings.channel.wanted() && estimators.size() > 1) estimators = {Estimator::weight};
  // Weight comes first: receivers are points, so that a score is never a matter of hitting them or not.
  if (estimators.size() > 1) std::swap(estimators[0], estimators[1]);
  const double one_way = walk == ReceiverWalk::backward ? 0.0 : std::numeric_limits<double>::infinity();
  const auto plan_of = [&](double ratio) { return plan_with(ratio, receivers.size(), served_share); };
  const bool fixed = walk == ReceiverWalk::backward || walk == ReceiverWalk::next_event;
  if (fixed && estimators.size() == 1) return {plan_of(one_way), estimators.front(), {}};

  const Pilots pilots(room, scene, light, receivers, direct, served_share, settings, stop);
  const RoundPlan only_photons = plan_of(std::numeric_limits<double>::infinity());
  const RoundPlan only_walks = plan_of(0.0);
  std::optional<Trial> photons;
  std::optional<Trial> walks;
  if (walk != ReceiverWalk::backward) photons = pilots.run(only_photons, estimators.front());
  if (walk != ReceiverWalk::next_event) walks = pilots.run(only_walks, estimators.front());
  std::vector<Trial> trials;
  for (const std::optional<Trial>& one : {photons, walks}) {
    if (one && std::isnan(one->variance)) return {plan_of(fixed ? one_way : 1.0), estimators.front(), {}};
    if (one && walk != ReceiverWalk::two_way) trials.push_back(*one);
  }
  if (!fixed && walks->work > 0.0 && photons->work > 0.0) {
    // Photons for each walk, if both take the same work.
    const double balanced = (walks->work / only_walks.backward) / (photons->work / only_photons.forward);
    for (const double share : {16.0, 4.0, 1.0, 0.25, 0.0625})
      trials.push_back(pilots.run(plan_of(share * balanced), estimators.front()));
  }
  std::size_t best = best_of(trials);
  if (best == trials.size()) {
    // Nothing scores: no surface reflects, or no light arrives.
    return {plan_of(fixed ? one_way : walk == ReceiverWalk::automatic ? 0.0 : 1.0), estimators.front(), {}};
  }
  const RoundPlan plan = trials[best].plan;
  for (std::size_t k = 1; k < estimators.size(); ++k) trials.push_back(pilots.run(plan, estimators[k]));
  best = best_of(trials);
  return {trials[best].plan, trials[best].estimator, reason_of(trials, best)};
}

}  // namespace lichtmc
