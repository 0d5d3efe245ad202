// The walk for the receivers of a room: photons from the emitters that contribute to all of them, walks from each, or
// both, and in which shares.
//
// The choice has the smallest error for the same work. A short pilot of each candidate gives its variance; the work is
// counted in rays, not timed. So the same room, settings and seed give the same choice on any machine, in every part of
// a run, whatever the number of photons. The histories of pilots are not part of the results.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/settings.hpp"
#include "walk/direct_light.hpp"
#include "walk/receiver_walk.hpp"
#include "walk/round_plan.hpp"

namespace lichtmc {

struct ReceiverPlan {
  RoundPlan plan;
  Estimator estimator = Estimator::weight;
  std::string reason;  // a sentence; empty if nothing was left to choose
};

// Chooses what the settings leave open: the walk, its shares, the estimator. direct: of every receiver. served_share:
// of the receivers that an impact of a photon faces, those that it serves (learn_reach.hpp), on average. If `stop` ends
// a pilot, the choice is of no use; in rooms that absorb almost nothing, where pilots would not end, it is made without
// them.
ReceiverPlan choose_receiver_plan(const Room& room, const Scene& scene, const DirectLight& light,
                                  const std::vector<ReferencePoint>& receivers,
                                  const std::vector<DirectIrradiance>& direct, double served_share,
                                  const Settings& settings, const Abandon& stop);

// The kind of walk that a plan is.
ReceiverWalk walk_of(const RoundPlan& plan);

// The largest number of histories that a round of any plan for this number of receivers has.
std::uint64_t most_histories_of_round(std::uint64_t receivers);

// The error floor of receivers with these irradiances, W/m² or lx.
double receiver_error_floor(const Settings& settings, const std::vector<double>& irradiances);

}  // namespace lichtmc
