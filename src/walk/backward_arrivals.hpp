// The light that the photons of a backward wave collect, with the length and the order of its path.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "walk/channel_scores.hpp"
#include "walk/direct_light.hpp"
#include "walk/flight_paths.hpp"
#include "walk/point_lights.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

// The walks of a round start in one wave: then the order of its scores depends on the round alone.
class BackwardArrivals {
 public:
  // planes: null if paths are not kept; then nothing is called. every_impact: light scores where it is collected; else
  // only that at the surface that a photon survived last (score_last()).
  BackwardArrivals(const DirectLight& light, const FacetPlanes* planes, bool every_impact)
      : light_(&light), paths_(planes), every_impact_(every_impact) {
    if (planes == nullptr) return;
    walks_.resize(batch_histories);
    if (!every_impact) left_.resize(batch_histories);
  }

  // What follows is scored here. All its rounds have been begun.
  void begin(ChannelScores& scores) { scores_ = &scores; }

  // A photon starts at a point: a walk of a round from a receiver, both numbered as in ChannelScores. factor: of all
  // that it collects.
  void start(std::uint32_t photon, const glm::dvec3& point, std::size_t round, std::size_t receiver, double factor) {
    paths_.start(photon, point, 0.0);
    walks_[photon] = {static_cast<std::uint32_t>(round), static_cast<std::uint32_t>(receiver), factor};
    if (!every_impact_) left_[photon].clear();
  }
  void land(const Wave& wave) { paths_.land(wave); }
  // What a photon collects does not count.
  void drop(std::uint32_t photon) { walks_[photon].factor = 0.0; }

  // The photons have been reflected, and leave their surfaces.
  void leave(const Wave& wave) {
    if (every_impact_) return;
    for (std::size_t i = 0; i < wave.rays.size; ++i) left_[wave.photon[i]].clear();
  }
  // A light sample for every photon at the surface that it leaves. weights: of the photons, or null.
  void sample(const Wave& wave, std::uint32_t order, const LightSamples& samples, const double* weights) {
    for (std::size_t i = 0; i < wave.rays.size; ++i) {
      const double irradiance = samples.irradiance[i];
      if (!(irradiance > 0.0)) continue;
      const std::uint32_t photon = wave.photon[i];
      const PointLight* point = light_->point_light(samples.source[i]);
      const glm::dvec3& target = point != nullptr ? point->position() : samples.target[i];
      const double length = paths_.length_m(photon) + glm::length(target - paths_.point(photon));
      add(photon, samples.source[i], order, length, weights != nullptr ? weights[i] * irradiance : irradiance);
    }
  }
  // A photon has hit an emitter, `order` reflections from the receiver.
  void hit(std::uint32_t photon, std::size_t source, std::uint32_t order, double irradiance) {
    add(photon, source, order, paths_.length_m(photon), irradiance);
  }
  void score_last(std::uint32_t photon, double factor) {
    for (Arrival& one : left_[photon]) {
      one.irradiance *= factor;
      scores_->collect(walks_[photon].round, one);
    }
    left_[photon].clear();
  }

 private:
  struct Walk {
    std::uint32_t round = 0;
    std::uint32_t receiver = 0;
    double factor = 1.0;
  };

  void add(std::uint32_t photon, std::size_t source, std::uint32_t order, double length_m, double irradiance) {
    const Walk& walk = walks_[photon];
    if (walk.factor == 0.0) return;
    const auto emitter = static_cast<std::uint32_t>(light_->source(source).emitter);
    const Arrival arrival{walk.receiver, emitter, order, length_m, walk.factor * irradiance};
    if (every_impact_) {
      scores_->collect(walk.round, arrival);
    } else {
      left_[photon].push_back(arrival);
    }
  }

  const DirectLight* light_;
  FlightPaths paths_;
  bool every_impact_;
  ChannelScores* scores_ = nullptr;
  // By the number of the photon:
  std::vector<Walk> walks_;
  std::vector<std::vector<Arrival>> left_;  // at the surface that it left last
};

}  // namespace lichtmc
