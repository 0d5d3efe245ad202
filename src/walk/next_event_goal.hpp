// The goal of photons that contribute to receivers, and their walks for each estimator: templates, which
// make_next_event.cpp and make_next_event_paths.cpp compile without and with the paths of light.
#pragma once

#include <algorithm>
#include <cassert>
#include <numeric>

#include "room/emitter_shape.hpp"
#include "walk/channel_scores.hpp"
#include "walk/choose_policy.hpp"
#include "walk/emitter_groups.hpp"
#include "walk/flight_paths.hpp"
#include "walk/kernel.hpp"
#include "walk/launch_words.hpp"
#include "walk/next_event.hpp"

namespace lichtmc {

// Goal of the forward walk for receivers: light is scattered to them from every surface that a photon survives, as
// backward walks collect it there.
// keeps_paths: it also records the path of the light (channel_scores.hpp).
template <class Policy, bool keeps_paths>
class NextEventGoal : public GoalBase {
 public:
  NextEventGoal(const Room& room, const Scene& scene, const DirectLight& light, const Stream& stream,
                const RoundPlan& plan, const ReceiverReach* reach, std::uint32_t max_flights,
                const ForwardPathParts* paths, const EmitterGroups* groups)
      : room_(&room),
        scene_(&scene),
        stream_(stream),
        max_flights_(max_flights),
        reach_(reach),
        words_(stream, plan.forward),
        first_impact_(room, *scene.tracer, light),
        plan_(plan),
        power_(total_power(room)),
        groups_(groups),
        parts_(groups != nullptr ? groups->size() : 1),
        emitter_(batch_histories),
        from_(batch_histories),
        ratio_(batch_histories, 0.0F),
        left_(Policy::scores_every_impact ? 0 : batch_histories),
        flight_paths_(paths != nullptr ? &paths->planes : nullptr),
        delay_m_(paths != nullptr ? paths->delay_m.data() : nullptr),
        left_paths_(keeps_paths && !Policy::scores_every_impact ? batch_histories : 0) {
    // Every thread makes a table in every step: in rooms of many facets that would take longer than the impacts.
    constexpr std::size_t most_in_table = 65536;
    if (scene.tracer->facets().size() > most_in_table) return;
    for (const Facet& facet : scene.tracer->facets()) normals_.emplace_back(world_normal(*scene.tracer, facet));
  }

  void begin(const ReceiverLanes& receivers, std::uint64_t first_round, std::uint32_t rounds, BackwardCount& count) {
    receivers_ = &receivers;
    first_history_ = first_round * plan_.forward;
    count_ = &count;
    sums_.assign(std::size_t{rounds} * parts_ * whole_lanes(receivers.size()), 0.0);
    impacts_.clear();
    impact_paths_.clear();
  }
  // Adds the mean over the photons of each round, in W/m² or lx, as NextEvent::simulate() says. scores: receives their
  // paths, if they are kept, as rounds first_scored, first_scored + 1, …
  void end(std::uint32_t rounds, double* irradiance, ChannelScores* scores, std::size_t first_scored) {
    if constexpr (keeps_paths) {
      contribute_by_rounds(rounds, *scores, first_scored);
    } else {
      contribute();
    }
    const std::size_t n = receivers_->size();
    const double unit = power_ / plan_.forward / (receivers_->size_m() * receivers_->size_m());
    for (std::size_t row = 0; row < std::size_t{rounds} * parts_; ++row) {
      for (std::size_t k = 0; k < n; ++k)
        irradiance[row * n + receivers_->number(k)] += unit * sums_[row * whole_lanes(n) + k];
    }
  }

  void start(Wave& wave, std::uint32_t n) {
    flight_ = 0;
    scene_->launcher->launch_all(words_, first_history_, n, wave.rays, wave.photon.data(), emitter_.data());
    for (std::uint32_t i = 0; i < n; ++i) from_[wave.photon[i]] = {wave.rays.facet[i], wave.rays.s[i], wave.rays.t[i]};
    if (!Policy::scores_every_impact) std::fill(left_.begin(), left_.end(), Impact{});
  }
  Misses misses() const { return scene_->misses; }
  TraceCount& traced() { return count_->traced; }

  // Paths need the geometry of every flight, set_ratios() that of the first.
  void move(Wave& wave, std::size_t from, std::size_t to) const {
    if (!keeps_paths && flight_ > 0) return;
    wave.rays.set_start(to, wave.rays.start(from));
    wave.rays.set_direction(to, wave.rays.direction(from));
    wave.rays.length[to] = wave.rays.length[from];
  }
  void escape(const Wave& wave, std::size_t i) { score_last(wave.photon[i], 1.0); }

  void land(Wave& wave) {
    const Rays& rays = wave.rays;
    count_->impacts += rays.size;
    if constexpr (keeps_paths) {
      if (flight_ == 0) start_paths(wave);
      flight_paths_.land(wave);
    }
    if (++flight_ == 1 && plan_.two_way()) set_ratios(wave);
    for (std::size_t i = 0; i < rays.size; ++i) wave.surface[i] = scene_->surface_of[rays.facet[i]];
  }

  static constexpr bool watches_absorption = !Policy::scores_every_impact;
  static constexpr bool in_lanes = Policy::chooses_in_lanes;
  // Variant 3: only the last surface that the photon survived scores.
  void absorb(const Wave& wave, std::size_t i, double reflectance) {
    score_last(wave.photon[i], 1.0 / (1.0 - reflectance));
  }
  void absorb_all(const Wave& wave, const std::uint32_t* at, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k)
      score_last(wave.photon[at[k]], 1.0 / (1.0 - scene_->reflectance_of[wave.surface[at[k]]]));
  }

  // From the impact at the end of the last flight that is allowed, another flight leads to the receiver.
  void reflect(const Wave& wave, std::uint32_t flight) {
    if (flight == max_flights_) return;
    for (std::size_t i = 0; i < wave.rays.size; ++i) {
      Impact impact = impact_of(wave, i);
      if (receivers_->has_cells()) place_in_cells(wave.photon[i], flight, impact);
      if constexpr (Policy::scores_every_impact) {
        impacts_.push_back(impact);
        if constexpr (keeps_paths) impact_paths_.push_back(path_of(wave.photon[i], flight));
      } else {
        left_[wave.photon[i]] = impact;
        if constexpr (keeps_paths) left_paths_[wave.photon[i]] = path_of(wave.photon[i], flight);
      }
    }
    if constexpr (!keeps_paths) contribute();
  }

 private:
  // The part of a path that its end at the emitter determines: the same for all impacts of the photon.
  void set_ratios(const Wave& wave) {
    const double per_area =
        plan_.backward / (static_cast<double>(plan_.forward) * receivers_->size_m() * receivers_->size_m());
    for (std::size_t i = 0; i < wave.rays.size; ++i) {
      const std::uint32_t photon = wave.photon[i];
      ratio_[photon] = static_cast<float>(
          per_area * first_impact_.backward_over_forward(emitter_[photon], from_[photon], wave.rays, i));
    }
  }

  Impact impact_of(const Wave& wave, std::size_t i) const {
    const Rays& rays = wave.rays;
    const glm::vec3 normal = normals_.empty()
                                 ? glm::vec3(world_normal(*scene_->tracer, scene_->tracer->facets()[rays.facet[i]]))
                                 : normals_[rays.facet[i]];
    const std::uint32_t photon = wave.photon[i];
    Impact impact;
    impact.start = rays.start(i);
    impact.point = receivers_->point(impact.start);
    impact.normal = rays.behind[i] != 0 ? -normal : normal;
    impact.weight = Policy::carries_weight && Policy::scores_every_impact ? static_cast<float>(wave.weight[i]) : 1.0F;
    impact.backward_ratio = ratio_[photon];
    impact.row = photon / plan_.forward;
    if (groups_ != nullptr) impact.row = impact.row * parts_ + groups_->of_emitter[emitter_[photon]];
    if (reach_ != nullptr) {
      impact.cell = reach_->cell_of(scene_->tracer->world_point(glm::dvec3(impact.start)), glm::dvec3(impact.normal));
      impact.turn = stream_.draw(first_history_ + photon, flight_, Purpose::receivers)[0] % ReceiverReach::one_in;
    }
    return impact;
  }

  void place_in_cells(std::uint32_t photon, std::uint32_t flight, Impact& impact) const {
    const Words words = stream_.draw(first_history_ + photon, flight, Purpose::cell);
    impact.in_cell_u = static_cast<float>(unit_open(words[0]) - 0.5);
    impact.in_cell_v = static_cast<float>(unit_open(words[1]) - 0.5);
  }

  void score_last(std::uint32_t photon, double factor) {
    if constexpr (!Policy::scores_every_impact) {
      Impact impact = left_[photon];
      impact.weight *= static_cast<float>(factor);
      if (!(impact.weight > 0.0F)) return;
      impacts_.push_back(impact);
      if constexpr (keeps_paths) impact_paths_.push_back(left_paths_[photon]);
    }
  }

  // Point emitters have their place exactly, points of openings that of the flight; on area lights flights start one
  // step off the plane.
  void start_paths(const Wave& wave) {
    for (std::size_t i = 0; i < wave.rays.size; ++i) {
      const std::uint32_t photon = wave.photon[i];
      const glm::dvec3 start = visit_shape(
          room_->emitters[emitter_[photon]],
          [&](const auto& point) {
            if (opening_of(point) == nullptr) return point.position;
            return scene_->tracer->world_point(glm::dvec3(wave.rays.start(i)));
          },
          [&](const auto& /*area*/) {
            const glm::dvec3 off = scene_->tracer->world_point(glm::dvec3(wave.rays.start(i)));
            return flight_paths_.planes().nearest(from_[photon].facet, off);
          });
      flight_paths_.start(photon, start, delay_m_[emitter_[photon]]);
    }
  }
  ImpactPath path_of(std::uint32_t photon, std::uint32_t order) const {
    return {flight_paths_.point(photon), flight_paths_.length_m(photon), emitter_[photon], order};
  }

  // The impacts of one round after the other: a stable order by rounds, so that it depends on the round alone.
  void contribute_by_rounds(std::uint32_t rounds, ChannelScores& scores, std::size_t first_scored) {
    order_.resize(impacts_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return impacts_[a].row < impacts_[b].row; });
    std::vector<Impact> of_round;
    std::vector<ImpactPath> paths;
    const double unit = power_ / plan_.forward / (receivers_->size_m() * receivers_->size_m());
    auto next = order_.begin();
    for (std::uint32_t round = 0; round < rounds; ++round) {
      of_round.clear();
      paths.clear();
      for (; next != order_.end() && impacts_[*next].row == round; ++next) {
        of_round.push_back(impacts_[*next]);
        paths.push_back(impact_paths_[*next]);
      }
      scores.open(first_scored + round);
      const ImpactRecord record{&scores, paths, unit};
      count_->connections +=
          receivers_->irradiate(of_round, *scene_->tracer, reach_, value_, sums_, count_->traced, &record);
      scores.close();
    }
    impacts_.clear();
    impact_paths_.clear();
  }

  // Light from the impacts to all receivers that see them.
  void contribute() {
    count_->connections += receivers_->irradiate(impacts_, *scene_->tracer, reach_, value_, sums_, count_->traced);
    impacts_.clear();
  }

  const Room* room_;
  const Scene* scene_;
  Stream stream_;
  std::uint32_t max_flights_;  // of a path from an emitter to a receiver; 0: no limit
  const ReceiverReach* reach_;
  QuasiRandomWords words_;
  FirstImpact first_impact_;
  RoundPlan plan_;
  double power_;                 // of all emitters, W or lm
  const EmitterGroups* groups_;  // whose parts are kept apart; null: all emitters together
  std::uint32_t parts_;          // number of groups
  std::uint32_t flight_ = 0;
  const ReceiverLanes* receivers_ = nullptr;
  BackwardCount* count_ = nullptr;
  std::vector<glm::vec3> normals_;  // of the facets, world; empty if there are many
  std::vector<Impact> impacts_;     // that have not yet contributed
  std::vector<float> value_;
  std::vector<double> sums_;  // by round, group of emitters and receiver
  // By the number of the photon:
  std::vector<std::uint32_t> emitter_;
  std::vector<StartOnFacet> from_;
  std::vector<float> ratio_;
  std::vector<Impact> left_;  // the surface that it survived last
  // Only if paths are kept:
  FlightPaths flight_paths_;
  const double* delay_m_;                 // of Room::emitters
  std::vector<ImpactPath> left_paths_;    // by the number of the photon
  std::vector<ImpactPath> impact_paths_;  // of impacts_
  std::vector<std::uint32_t> order_;
};

template <class Policy, class Reflectance, bool keeps_paths>
class PolicyNextEvent final : public NextEvent {
 public:
  PolicyNextEvent(const Room& room, const Scene& scene, const DirectLight& light, std::uint64_t seed,
                  const RoundPlan& plan, const ReceiverReach* reach, std::uint32_t max_flights,
                  const ForwardPathParts* paths, const EmitterGroups* groups)
      : plan_(plan),
        parts_(groups != nullptr ? groups->size() : 1),
        goal_(room, scene, light, Stream(seed), plan, reach, max_flights, paths, groups),
        kernel_(scene, Stream(seed), max_flights) {}

  std::uint32_t rounds_at_a_time() const override { return batch_histories / plan_.forward; }

  void simulate(const ReceiverLanes& receivers, std::uint64_t first, std::uint64_t rounds,
                std::vector<double>& irradiance, BackwardCount& count, const Abandon& abandon,
                ChannelScores* scores) override {
    for (std::uint64_t done = 0; done < rounds;) {
      const auto together = static_cast<std::uint32_t>(std::min<std::uint64_t>(rounds_at_a_time(), rounds - done));
      goal_.begin(receivers, first + done, together, count);
      kernel_.fly(together * plan_.forward, goal_, abandon);
      goal_.end(together, irradiance.data() + done * parts_ * receivers.size(), scores, done);
      done += together;
    }
  }

 private:
  RoundPlan plan_;
  std::uint32_t parts_;
  using Goal = NextEventGoal<Policy, keeps_paths>;
  Goal goal_;
  Kernel<Policy, Reflectance, Goal> kernel_;
};

template <bool keeps_paths>
std::unique_ptr<NextEvent> next_event_with(const Room& room, const Scene& scene, const DirectLight& light,
                                           const Settings& settings, const RoundPlan& plan, const ReceiverReach* reach,
                                           const ForwardPathParts* paths, const EmitterGroups* groups) {
  return choose_policy(settings.estimator, settings.max_bounces, scene.has_reflectance_maps(),
                       [&]<class Policy, class Reflectance>(std::uint32_t max_flights) -> std::unique_ptr<NextEvent> {
                         return std::make_unique<PolicyNextEvent<Policy, Reflectance, keeps_paths>>(
                             room, scene, light, settings.seed, plan, reach, max_flights, paths, groups);
                       });
}

}  // namespace lichtmc
