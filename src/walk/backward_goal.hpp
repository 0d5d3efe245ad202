// The goal of backward walks and the walks for each estimator: templates, which make_backward.cpp and
// make_backward_paths.cpp compile without and with the paths of light.
#pragma once

#include <algorithm>
#include <cassert>
#include <concepts>
#include <utility>

#include "walk/backward.hpp"
#include "walk/backward_arrivals.hpp"
#include "walk/backward_parts.hpp"
#include "walk/channel_scores.hpp"
#include "walk/choose_policy.hpp"
#include "walk/first_flights.hpp"
#include "walk/roulette.hpp"
#include "walk/surface_light.hpp"
#include "walk/visibility.hpp"

namespace lichtmc {

// Goal of the backward walk: photons collect direct light at every surface.
// keeps_paths: it also records the path of the light that they collect (channel_scores.hpp).
// groups: of emitters whose parts of the light are kept apart; null: none.
template <class Policy, class Origins, bool keeps_paths>
class BackwardGoal : public GoalBase {
 public:
  BackwardGoal(const Scene& scene, const DirectLight& light, const Origins& origins, const Stream& stream,
               const RoundPlan& plan, double threshold, std::uint32_t max_flights, const FacetPlanes* planes,
               const EmitterGroups* groups)
      : scene_(&scene),
        light_(&light),
        origins_(&origins),
        stream_(stream),
        group_(plan.backward),
        forward_per_walk_(plan.forward_per_walk()),
        threshold_(threshold),
        max_flights_(max_flights),
        parts_(light, groups, Policy::scores_every_impact),
        points_(plan.backward, Origins::is_extended),
        first_flights_(batch_histories),
        surface_light_(light, *scene.tracer, stream),
        ids_(batch_histories),
        origin_(batch_histories),
        round_(batch_histories),
        number_(batch_histories),
        found_(batch_histories),
        forward_ratio_(batch_histories),
        factor_(batch_histories),
        least_height_m_(batch_histories),
        direct_(batch_histories),
        cosine_(whole_lanes(batch_histories)),
        cell_(batch_histories),
        arrivals_(light, planes, Policy::scores_every_impact) {}

  // Photon i will start from an origin, as walk `number` of a round.
  void prepare(std::size_t i, std::uint64_t origin, std::uint64_t round, std::uint32_t number) {
    origin_[i] = origin;
    round_[i] = round;
    number_[i] = number;
    ids_[i] = (round * group_ + number) * origins_->size() + origin;
  }
  void begin(BackwardCount& count) { count_ = &count; }

  // What photon i, which has ended, contributes to its origin, W/m² or lx: all, or the light of a group of emitters.
  double irradiance(std::uint32_t i, std::uint32_t part = 0) const {
    return (parts_.kept() ? parts_.found(i, part) : found_[i]) * factor_[i];
  }
  std::uint32_t parts() const { return parts_.size(); }
  std::uint64_t origin(std::uint32_t i) const { return origin_[i]; }
  std::uint64_t round(std::uint32_t i) const { return round_[i]; }
  // The light that photons collect is scored here, as rounds from first_round on and of origins from first_origin on.
  void begin_paths(ChannelScores& scores, std::uint64_t first_round, std::uint64_t first_origin) {
    arrivals_.begin(scores);
    first_round_ = first_round;
    first_origin_ = first_origin;
  }

  // The first flight leaves with a density proportional to the weight that the receiver gives to radiance: by Lambert's
  // law within the field of view, unless it is a cylinder.
  void start(Wave& wave, std::uint32_t n) {
    flight_ = 0;
    lies_on_surface_ = false;
    std::uint64_t last_set = 0;
    ways_out_.clear();
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint64_t set = round_[i] * origins_->size() + origin_[i];
      if (i == 0 || set != last_set) points_.begin(stream_, last_set = set);
      const OriginView view = leave_origin(i, wave.rays);
      first_flights_.set(i, view, points_.polar(number_[i]), points_.azimuth(number_[i]));
      if (view.way_out) ways_out_.push_back({i, *view.way_out});
      factor_[i] = view.squared_sine() * origins_->uncovered_share(origin_[i]);
      least_height_m_[i] = view.least_height_m;
      lies_on_surface_ = lies_on_surface_ || view.least_height_m > 0.0;
      forward_ratio_[i] = 0.0;
      found_[i] = 0.0;
      direct_[i] = 0.0;
      if constexpr (keeps_paths) {
        arrivals_.start(i, origins_->point(origin_[i]), round_[i] - first_round_, origin_[i] - first_origin_,
                        factor_[i] / group_);
      }
    }
    if (parts_.kept()) parts_.start(n);
    first_flights_.aim(n, scene_->tracer->directions(), wave.rays, cosine_.data());
    for (const auto& [i, direction] : ways_out_) wave.rays.set_direction(i, direction);
  }
  void number_histories(Wave& wave) const {
    for (std::size_t i = 0; i < wave.rays.size; ++i) wave.history[i] = ids_[wave.photon[i]];
  }
  TraceCount& traced() { return count_->traced; }

  // Escape through an opening counts as absorption by ρ = 0, also if the opening is due to rounding.
  void escape(const Wave& wave, std::size_t i) {
    if constexpr (!Policy::scores_every_impact) {
      score_last(wave.photon[i], i, 1.0);
    }
  }

  // A flight that hits an area light adds its weighted emission to the direct light at the surface that it left. The
  // direct light at the receiver itself is computed elsewhere.
  void land(Wave& wave) {
    ++flight_;
    count_->impacts += wave.rays.size;
    find_surfaces(wave);
    if constexpr (keeps_paths) arrivals_.land(wave);
    if (flight_ == 1 && lies_on_surface_) drop_flights_to_own_surface(wave);
    if (flight_ == 1 && forward_per_walk_ > 0.0) weigh_first_impacts(wave);
    if (flight_ == 1 || !light_->has_area_lights()) return;
    const Rays& rays = wave.rays;
    const Tracer& tracer = *scene_->tracer;
    for (std::size_t i = 0; i < rays.size; ++i) {
      if (rays.behind[i] != 0 || !light_->is_area_light(wave.surface[i])) continue;
      const FlightGeometry flight = flight_geometry(tracer, rays, i);
      if (flight.degenerate()) continue;
      const std::uint32_t photon = wave.photon[i];
      double irradiance = 0.0;
      const auto add = [&](std::size_t source, double part) {
        if (parts_.kept()) {
          parts_.add(photon, i, source, weight(wave, i), part);
        } else {
          irradiance += part;
        }
        if constexpr (keeps_paths) arrivals_.hit(photon, source, flight_ - 1, weight(wave, i) * part);
      };
      light_->mis_weighted_emission(rays, i, cell_[i], double{cosine_[i]}, flight, forward_ratio_[photon], add);
      if constexpr (Policy::scores_every_impact) {
        found_[photon] += weight(wave, i) * irradiance;
      } else {
        direct_[i] += irradiance;
      }
    }
  }

  static constexpr bool in_lanes = Policy::chooses_in_lanes;
  static constexpr bool watches_absorption = !Policy::scores_every_impact;
  // Variant 3: only the direct light at the last surface that the photon survived scores.
  void absorb(const Wave& wave, std::size_t i, double reflectance) {
    if constexpr (!Policy::scores_every_impact) {
      score_last(wave.photon[i], i, 1.0 - reflectance);
    }
  }
  void absorb_all(const Wave& wave, const std::uint32_t* at, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) absorb(wave, at[k], scene_->reflectance_of[wave.surface[at[k]]]);
  }

  // Light sampling at every surface that a photon survived. To the end of the last flight that is allowed, light comes
  // by one flight more.
  void reflect(Wave& wave, std::uint32_t flight) {
    if (flight == max_flights_) return;
    if (!light_->takes_all() || light_->has_extended_lights()) number_histories(wave);
    const double* forward_ratio = forward_per_walk_ > 0.0 ? forward_ratio_.data() : nullptr;
    if (parts_.kept()) {
      sample_parts(wave, flight, forward_ratio);
      copy_cells(wave);
      return;
    }
    if constexpr (keeps_paths) {
      arrivals_.leave(wave);
      surface_light_.sample(wave, flight, forward_ratio, count_->traced, [&](const LightSamples& samples) {
        arrivals_.sample(wave, flight, samples, weights(wave));
      });
    } else {
      surface_light_.sample(wave, flight, forward_ratio, count_->traced);
    }
    const std::vector<double>& irradiance = surface_light_.irradiance();
    for (std::size_t i = 0; i < wave.rays.size; ++i) {
      if constexpr (Policy::scores_every_impact) {
        found_[wave.photon[i]] += weight(wave, i) * irradiance[i];
      } else {
        direct_[i] = irradiance[i];
      }
    }
    copy_cells(wave);
  }

  void play(Wave& wave, std::uint8_t* marks) const requires std::same_as<Policy, RouletteBeforeFlightPolicy> {
    play_roulette(wave.rays.size, wave.chance.data(), threshold_, threshold_, wave.weight.data(), marks);
  }

  float* cosines() { return cosine_.data(); }
  void move(Wave& wave, std::size_t from, std::size_t to) {
    // land() needs the geometry of each flight; paths also where it starts.
    if constexpr (keeps_paths) wave.rays.set_start(to, wave.rays.start(from));
    wave.rays.set_direction(to, wave.rays.direction(from));
    wave.rays.length[to] = wave.rays.length[from];
    if constexpr (!Policy::scores_every_impact) direct_[to] = direct_[from];
    if (parts_.kept()) parts_.move(from, to);
    cosine_[to] = cosine_[from];
    cell_[to] = cell_[from];
  }

 private:
  static const double* weights(const Wave& wave) { return Policy::carries_weight ? wave.weight.data() : nullptr; }
  // Light samples of which each belongs to the part of its emitter.
  void sample_parts(const Wave& wave, std::uint32_t flight, const double* forward_ratio) {
    parts_.leave(wave.rays.size);
    surface_light_.sample(wave, flight, forward_ratio, count_->traced, [&](const LightSamples& samples) {
      for (std::size_t i = 0; i < wave.rays.size; ++i) {
        if (samples.irradiance[i] > 0.0)
          parts_.add(wave.photon[i], i, samples.source[i], weight(wave, i), samples.irradiance[i]);
      }
    });
  }
  void copy_cells(const Wave& wave) {
    if (!light_->takes_all() && light_->has_area_lights())
      std::copy_n(surface_light_.cells().begin(), wave.rays.size, cell_.begin());
  }
  // Variant 3: the direct light at the surface that a photon, i of the wave, survived last, over its absorptance.
  void score_last(std::uint32_t photon, std::size_t i, double absorptance) {
    if (parts_.kept()) {
      parts_.score_last(photon, i, absorptance);
    } else {
      found_[photon] += direct_[i] / absorptance;
    }
    if constexpr (keeps_paths) arrivals_.score_last(photon, 1.0 / absorptance);
  }
  static double weight(const Wave& wave, std::size_t i) { return Policy::carries_weight ? wave.weight[i] : 1.0; }

  OriginView leave_origin(std::size_t i, Rays& rays) const {
    if constexpr (Origins::is_extended) {
      const std::uint32_t number = number_[i];
      return origins_->start(origin_[i], unit_open(points_.place(number, 0)), unit_open(points_.place(number, 1)), rays,
                             i);
    } else {
      return origins_->start(origin_[i], rays, i);
    }
  }

  void find_surfaces(Wave& wave) const {
    const std::uint32_t* surface_of = scene_->surface_of.data();
    for (std::size_t i = 0; i < wave.rays.size; ++i) wave.surface[i] = surface_of[wave.rays.facet[i]];
  }

  // A cylinder on a surface receives nothing from there.
  void drop_flights_to_own_surface(const Wave& wave) {
    for (std::size_t i = 0; i < wave.rays.size; ++i) {
      const std::uint32_t photon = wave.photon[i];
      if (!(least_height_m_[photon] > 0.0)) continue;
      const FlightGeometry flight = flight_geometry(*scene_->tracer, wave.rays, i);
      if (!flight.degenerate() && flight.length_m * flight.cosine_there > least_height_m_[photon]) continue;
      factor_[photon] = 0.0;
      if constexpr (keeps_paths) arrivals_.drop(photon);
    }
  }

  // forward_ratio of DirectLight::sample_light(), from the density of the first impact; factor_ is the share of
  // Lambert's law within the field of view. A flight without length or along its surface is not found from the other
  // side.
  void weigh_first_impacts(const Wave& wave) {
    for (std::size_t i = 0; i < wave.rays.size; ++i) {
      const FlightGeometry flight = flight_geometry(*scene_->tracer, wave.rays, i);
      if (flight.degenerate()) continue;
      const std::uint32_t photon = wave.photon[i];
      forward_ratio_[photon] = forward_per_walk_ * factor_[photon] / flight.pdf_bsdf(double{cosine_[i]});
    }
  }

  const Scene* scene_;
  const DirectLight* light_;
  const Origins* origins_;
  Stream stream_;
  std::uint32_t group_;        // walks in a round
  double forward_per_walk_;    // histories from the emitters for each walk, whose contributions are weighted together
  double threshold_;           // of the roulette, see roulette.hpp
  std::uint32_t max_flights_;  // of a path from an emitter to an origin; 0: no limit
  BackwardParts parts_;        // light of groups of emitters, if it is kept apart
  RoundPoints points_;
  FirstFlights first_flights_;
  SurfaceLight surface_light_;
  std::vector<std::pair<std::uint32_t, glm::vec3>> ways_out_;
  // By the number of the photon:
  std::vector<std::uint64_t> ids_;
  std::vector<std::uint64_t> origin_;
  std::vector<std::uint64_t> round_;
  std::vector<std::uint32_t> number_;  // of the walk in its round
  std::vector<double> found_;          // score so far, W/m² or lx, unless it is in parts_
  std::vector<double> forward_ratio_;  // m², of its first impact, see DirectLight::sample_light()
  std::vector<double> factor_;         // squared sine of the half angle of the field of view (the fraction of a uniform
                                       // hemisphere), times the uncovered share of the origin
  std::vector<double> least_height_m_;  // of its origin, see ReferencePoint
  // By the position in the wave:
  std::vector<double> direct_;       // direct irradiance at the surface that was left last
  std::vector<float> cosine_;        // of the angle at which that surface was left
  std::vector<std::uint32_t> cell_;  // of light samples there, see DirectLight::cell_of()
  std::uint32_t flight_ = 0;
  bool lies_on_surface_ = false;  // whether some of the origins are cylinders on surfaces
  BackwardCount* count_ = nullptr;
  // Only if paths are kept:
  BackwardArrivals arrivals_;
  std::uint64_t first_round_ = 0;
  std::uint64_t first_origin_ = 0;
};

template <class Policy, class Reflectance, class Origins, bool keeps_paths>
class PolicyBackwardWalk final : public BackwardWalk {
 public:
  PolicyBackwardWalk(const Scene& scene, const DirectLight& light, const Origins& origins, const BackwardScale& scale,
                     const RoundPlan& plan, std::uint64_t seed, std::uint32_t max_flights, const FacetPlanes* planes,
                     const EmitterGroups* groups)
      : scale_(scale),
        group_(plan.backward),
        goal_(scene, light, origins, Stream(seed, WalkDirection::backward), plan, threshold_of(scene, light, scale),
              max_flights, planes, groups),
        kernel_(scene, Stream(seed, WalkDirection::backward), max_flights) {}

  void simulate(const WalkBlock& work, std::vector<BackwardSums>& sums, BackwardCount& count,
                const Abandon& abandon) override {
    std::uint64_t sum = 0;
    std::uint32_t done = 0;  // walks of the round
    walk(work, count, abandon, [&](std::uint32_t i) {
      sum += scale_.score(goal_.irradiance(i));
      if (++done < group_) return;
      sums[goal_.origin(i) - work.first].add(std::min(sum, BackwardScale::largest_sum));
      sum = 0;
      done = 0;
    });
  }

  void collect(const WalkBlock& work, std::vector<double>& irradiance, BackwardCount& count, const Abandon& abandon,
               ChannelScores* scores) override {
    const std::uint64_t origins = work.last - work.first;
    const std::uint64_t first_round = work.first_sample / group_;
    assert((scores != nullptr) == keeps_paths);
    if constexpr (keeps_paths) goal_.begin_paths(*scores, first_round, work.first);
    walk(work, count, abandon, [&](std::uint32_t i) {
      const std::uint64_t round = goal_.round(i) - first_round;
      for (std::uint32_t part = 0; part < goal_.parts(); ++part)
        irradiance[(round * goal_.parts() + part) * origins + (goal_.origin(i) - work.first)] +=
            goal_.irradiance(i, part) / group_;
    });
  }

 private:
  static double threshold_of(const Scene& scene, const DirectLight& light, const BackwardScale& scale) {
    if constexpr (!std::same_as<Policy, RouletteBeforeFlightPolicy>) return 0.0;
    return roulette_threshold(scene, light, scale.mean_irradiance());
  }

  // Calls record(photon) for every walk when it has ended, in the order of origins, rounds and walks in a round.
  template <class Record>
  void walk(const WalkBlock& work, BackwardCount& count, const Abandon& abandon, const Record& record) {
    assert(work.first_sample % group_ == 0 && work.last_sample % group_ == 0);  // no round is divided
    goal_.begin(count);
    std::uint32_t n = 0;
    const auto fly = [&] {
      kernel_.fly(n, goal_, abandon);
      for (std::uint32_t i = 0; i < n; ++i) record(i);
      n = 0;
    };
    const std::uint64_t last_round = work.last_sample / group_;
    for (std::uint64_t origin = work.first; origin < work.last; ++origin) {
      for (std::uint64_t round = work.first_sample / group_; round < last_round; ++round) {
        // The walks of a round start together, see BackwardArrivals.
        if (keeps_paths && n + group_ > batch_histories) fly();
        for (std::uint32_t number = 0; number < group_; ++number) {
          goal_.prepare(n++, origin, round, number);
          if (n == batch_histories) fly();
        }
      }
    }
    if (n > 0) fly();
  }

  BackwardScale scale_;
  std::uint32_t group_;  // walks in a round
  using Goal = BackwardGoal<Policy, Origins, keeps_paths>;
  Goal goal_;
  Kernel<Policy, Reflectance, Goal> kernel_;
};

// planes: of the facets, if paths are kept; else null.
template <bool keeps_paths, class Origins>
std::unique_ptr<BackwardWalk> walk_from(const Scene& scene, const DirectLight& light, const Origins& origins,
                                        const BackwardScale& scale, const Settings& settings, const RoundPlan& plan,
                                        const FacetPlanes* planes = nullptr, const EmitterGroups* groups = nullptr) {
  return choose_policy(
      settings.estimator, settings.max_bounces, scene.has_reflectance_maps(),
      [&]<class Policy, class Reflectance>(std::uint32_t max_flights) -> std::unique_ptr<BackwardWalk> {
        using Own =
            std::conditional_t<std::is_same_v<Policy, RouletteWeightPolicy>, RouletteBeforeFlightPolicy, Policy>;
        return std::make_unique<PolicyBackwardWalk<Own, Reflectance, Origins, keeps_paths>>(
            scene, light, origins, scale, plan, settings.seed, max_flights, planes, groups);
      });
}

}  // namespace lichtmc
