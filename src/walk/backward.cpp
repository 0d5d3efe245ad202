#include "walk/backward.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "chance/places.hpp"
#include "walk/choose_policy.hpp"

namespace lichtmc {

namespace {

// Goal of the backward walk: photons collect direct light at every surface.
template <class Policy, class Origins>
class BackwardGoal : public GoalBase {
 public:
  BackwardGoal(const Scene& scene, const DirectLight& light, const Origins& origins, const Stream& stream,
               double forward_per_walk)
      : scene_(&scene),
        light_(&light),
        origins_(&origins),
        stream_(stream),
        forward_per_walk_(forward_per_walk),
        ids_(batch_histories),
        origin_(batch_histories),
        sample_(batch_histories),
        irradiance_(batch_histories),
        forward_ratio_(batch_histories),
        factor_(batch_histories),
        found_(batch_histories),
        direct_(batch_histories),
        cosine_(batch_histories),
        cell_(batch_histories),
        pending_irradiance_(batch_histories) {}

  // Photon i will start from an origin, as its sample `sample`.
  void prepare(std::size_t i, std::uint64_t origin, std::uint64_t sample) {
    origin_[i] = origin;
    sample_[i] = sample;
    ids_[i] = sample * origins_->size() + origin;
  }
  void begin(BackwardCount& count) { count_ = &count; }

  // What photon i, which has ended, contributes to its origin, W/m² or lx.
  double irradiance(std::uint32_t i) const { return irradiance_[i]; }
  std::uint64_t origin(std::uint32_t i) const { return origin_[i]; }
  std::uint64_t sample(std::uint32_t i) const { return sample_[i]; }

  // The first flight leaves by Lambert's law within the field of view: the receiver weights radiance by the cosine.
  void start(Wave& wave, std::uint32_t n) {
    flight_ = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const ReferencePoint reference = origins_->start(origin_[i], sample_[i], ids_[i], stream_, wave.rays, i);
      const Words words = stream_.draw(ids_[i], 0, Purpose::emission);
      const double view = reference.squared_sine();
      factor_[i] = view * origins_->uncovered_share(origin_[i]);
      const ConeDirection flight =
          sample_cosine_cone(frame_about(reference.normal), view, unit_open(words[0]), unit_open(words[1]));
      wave.rays.set_direction(i,
                              glm::vec3(reference.way_out.value_or(scene_->tracer->directions() * flight.direction)));
      cosine_[i] = static_cast<float>(flight.cosine);
      forward_ratio_[i] = 0.0;
      found_[i] = 0.0;
      direct_[i] = 0.0;
    }
  }
  void number_histories(Wave& wave) const {
    for (std::size_t i = 0; i < wave.rays.size; ++i) wave.history[i] = ids_[wave.photon[i]];
  }
  TraceCount& traced() { return count_->traced; }

  // Walks from tiles start on uncovered parts only, except by rounding.
  void cover(const Wave& wave, std::size_t i) { finish(wave, i); }
  // Escape through an opening counts as absorption by ρ = 0, also if the opening is due to rounding.
  void escape(const Wave& wave, std::size_t i) {
    if constexpr (!Policy::scores_every_impact) found_[i] += direct_[i];
    finish(wave, i);
  }

  // A flight that hits an area light adds its weighted emission to the direct light at the surface that it left. The
  // direct light at the receiver itself is computed elsewhere.
  void land(const Wave& wave) {
    ++flight_;
    count_->impacts += wave.rays.size;
    if (flight_ == 1 && forward_per_walk_ > 0.0) weigh_first_impacts(wave);
    if (flight_ == 1 || !light_->has_area_lights()) return;
    const Rays& rays = wave.rays;
    const Tracer& tracer = *scene_->tracer;
    for (std::size_t i = 0; i < rays.size; ++i) {
      const Facet& facet = tracer.facets()[rays.facet[i]];
      if (rays.behind[i] != 0 || !light_->is_area_light(facet.surface)) continue;
      const FlightGeometry flight = flight_geometry(tracer, rays, i);
      if (flight.degenerate()) continue;
      const double irradiance =
          light_->mis_weighted_emission(rays, i, cell_[i], double{cosine_[i]}, flight, forward_ratio_[wave.photon[i]]);
      if constexpr (Policy::scores_every_impact) {
        found_[i] += (Policy::carries_weight ? wave.weight[i] : 1.0) * irradiance;
      } else {
        direct_[i] += irradiance;
      }
    }
  }

  static constexpr bool watches_absorption = true;
  // Variant 3: only the direct light at the last surface that the photon survived scores.
  void absorb(const Wave& wave, std::size_t i, double reflectance) {
    if constexpr (!Policy::scores_every_impact) found_[i] += direct_[i] / (1.0 - reflectance);
    finish(wave, i);
  }

  // Light sampling at every surface that a photon survived.
  void reflect(const Wave& wave, std::uint32_t flight) {
    const Rays& rays = wave.rays;
    for (std::size_t i = 0; i < rays.size; ++i) direct_[i] = 0.0;
    for (std::size_t k = 0; k < light_->light_samples_per_point(); ++k) {
      shadow_rays_.clear();
      pending_.clear();
      for (std::size_t i = 0; i < rays.size; ++i) add_light_sample(wave, flight, i, k);
      if (shadow_rays_.size == 0) continue;
      scene_->tracer->find_blocked(shadow_rays_, count_->traced);
      for (std::size_t n = 0; n < pending_.size(); ++n) {
        if (shadow_rays_.blocked[n] == 0) direct_[pending_[n]] += pending_irradiance_[pending_[n]];
      }
    }
    if constexpr (Policy::scores_every_impact) {
      for (std::size_t i = 0; i < rays.size; ++i)
        found_[i] += (Policy::carries_weight ? wave.weight[i] : 1.0) * direct_[i];
    }
  }

  void cut_off(const Wave& wave, std::size_t i) { finish(wave, i); }
  float* cosines() { return cosine_.data(); }
  void move(Wave& wave, std::size_t from, std::size_t to) {
    // land() needs the geometry of each flight.
    wave.rays.set_direction(to, wave.rays.direction(from));
    wave.rays.length[to] = wave.rays.length[from];
    found_[to] = found_[from];
    direct_[to] = direct_[from];
    cosine_[to] = cosine_[from];
    cell_[to] = cell_[from];
  }

 private:
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

  // Draws light sample k for photon i; if something may cast a shadow, adds a shadow ray to their wave.
  void add_light_sample(const Wave& wave, std::uint32_t flight, std::size_t i, std::size_t k) {
    const Rays& rays = wave.rays;
    const Tracer& tracer = *scene_->tracer;
    const glm::dvec3 start(rays.start(i));
    const glm::dvec3 normal = world_normal(tracer, tracer.facets()[rays.facet[i]]);
    const ReferencePoint reference{tracer.world_point(start), rays.behind[i] != 0 ? -normal : normal, 0.0};
    const std::uint64_t id = ids_[wave.photon[i]];
    // Separate random words for each emitter at each surface.
    const auto number = static_cast<std::uint32_t>(flight * light_->light_samples_per_point() + k);
    const Words which = stream_.draw(id, number, Purpose::light);
    const Words where = light_->has_area_lights() ? stream_.draw(id, number, Purpose::on_light) : Words{};
    if (k == 0) cell_[i] = light_->cell_of(reference);
    const LightSample sample =
        light_->sample_light(k, cell_[i], reference, which, where, forward_ratio_[wave.photon[i]]);
    if (!(sample.irradiance > 0.0)) return;
    const auto segment = tracer.casts_shadows() ? shadow_segment(tracer, start, sample.target) : std::nullopt;
    if (!segment) {
      direct_[i] += sample.irradiance;
      return;
    }
    pending_irradiance_[i] = sample.irradiance;
    pending_.push_back(i);
    shadow_rays_.add(rays.start(i), *segment);
  }

  void finish(const Wave& wave, std::size_t i) {
    const std::uint32_t photon = wave.photon[i];
    irradiance_[photon] = found_[i] * factor_[photon];
  }

  const Scene* scene_;
  const DirectLight* light_;
  const Origins* origins_;
  Stream stream_;
  double forward_per_walk_;  // histories from the emitters for each walk, whose contributions are weighted together
  // By the number of the photon:
  std::vector<std::uint64_t> ids_;
  std::vector<std::uint64_t> origin_;
  std::vector<std::uint64_t> sample_;
  std::vector<double> irradiance_;     // when it has ended
  std::vector<double> forward_ratio_;  // m², of its first impact, see DirectLight::sample_light()
  std::vector<double> factor_;         // squared sine of the half angle of the field of view (the fraction of a uniform
                                       // hemisphere), times the uncovered share of the origin
  // By the position in the wave:
  std::vector<double> found_;               // score so far, W/m² or lx
  std::vector<double> direct_;              // direct irradiance at the surface that was left last
  std::vector<float> cosine_;               // of the angle at which that surface was left
  std::vector<std::uint32_t> cell_;         // of light samples there, see DirectLight::cell_of()
  std::vector<double> pending_irradiance_;  // of the light samples whose shadow rays are being traced
  std::vector<std::size_t> pending_;
  ShadowRays shadow_rays_;
  std::uint32_t flight_ = 0;
  BackwardCount* count_ = nullptr;
};

template <class Policy, class Reflectance, class Origins>
class PolicyBackwardWalk final : public BackwardWalk {
 public:
  PolicyBackwardWalk(const Scene& scene, const DirectLight& light, const Origins& origins, const BackwardScale& scale,
                     const RoundPlan& plan, std::uint64_t seed, std::uint32_t max_flights)
      : scale_(scale),
        group_(plan.backward),
        goal_(scene, light, origins, Stream(seed, WalkDirection::backward), plan.forward_per_walk()),
        kernel_(scene, Stream(seed, WalkDirection::backward), max_flights) {}

  void simulate(const WalkBlock& work, std::vector<BackwardSums>& sums, BackwardCount& count,
                const Abandon& abandon) override {
    std::uint64_t round = 0;
    walk(work, count, abandon, [&](std::uint64_t origin, std::uint64_t sample, double irradiance) {
      round += scale_.score(irradiance);
      if ((sample + 1) % group_ != 0) return;
      sums[origin - work.first].add(std::min(round, BackwardScale::largest_sum));
      round = 0;
    });
  }

  void collect(const WalkBlock& work, std::vector<double>& irradiance, BackwardCount& count,
               const Abandon& abandon) override {
    const std::uint64_t origins = work.last - work.first;
    walk(work, count, abandon, [&](std::uint64_t origin, std::uint64_t sample, double found) {
      const std::uint64_t round = (sample - work.first_sample) / group_;
      irradiance[round * origins + (origin - work.first)] += found / group_;
    });
  }

 private:
  // Calls record(origin, sample, irradiance) for every walk, in the order of origins and samples.
  template <class Record>
  void walk(const WalkBlock& work, BackwardCount& count, const Abandon& abandon, const Record& record) {
    assert(work.first_sample % group_ == 0 && work.last_sample % group_ == 0);  // no round is divided
    goal_.begin(count);
    std::uint32_t n = 0;
    const auto fly = [&] {
      kernel_.fly(n, goal_, abandon);
      for (std::uint32_t i = 0; i < n; ++i) record(goal_.origin(i), goal_.sample(i), goal_.irradiance(i));
      n = 0;
    };
    for (std::uint64_t origin = work.first; origin < work.last; ++origin) {
      for (std::uint64_t sample = work.first_sample; sample < work.last_sample; ++sample) {
        goal_.prepare(n++, origin, sample);
        if (n == batch_histories) fly();
      }
    }
    if (n > 0) fly();
  }

  BackwardScale scale_;
  std::uint32_t group_;  // walks in a round
  BackwardGoal<Policy, Origins> goal_;
  Kernel<Policy, Reflectance, BackwardGoal<Policy, Origins>> kernel_;
};

template <class Origins>
std::unique_ptr<BackwardWalk> walk_from(const Scene& scene, const DirectLight& light, const Origins& origins,
                                        const BackwardScale& scale, const Settings& settings, const RoundPlan& plan) {
  return choose_policy(
      settings.estimator, settings.max_bounces, scene.has_reflectance_maps(),
      [&]<class Policy, class Reflectance>(std::uint32_t max_flights) -> std::unique_ptr<BackwardWalk> {
        return std::make_unique<PolicyBackwardWalk<Policy, Reflectance, Origins>>(scene, light, origins, scale, plan,
                                                                                  settings.seed, max_flights);
      });
}

}  // namespace

BackwardScale::BackwardScale(const Room& room) {
  double area = 0.0;
  for (const Surface& surface : room.surfaces) area += surface_area(surface);
  unit = total_power(room) / area * 0x1p-24;
}

std::uint64_t BackwardScale::score(double irradiance) const {
  const double units = irradiance / unit;
  return units < static_cast<double>(largest_score) ? static_cast<std::uint64_t>(units + 0.5) : largest_score;
}

ReferencePoint ReceiverOrigins::start(std::uint64_t receiver, std::uint64_t /*sample*/, std::uint64_t /*id*/,
                                      const Stream& /*stream*/, Rays& rays, std::size_t i) const {
  const ReferencePoint& reference = (*receivers_)[receiver];
  rays.facet[i] = no_facet;
  rays.set_start(i, glm::vec3(start_of(reference, *tracer_)));
  return reference;
}

std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light,
                                                 const ReceiverOrigins& origins, const BackwardScale& scale,
                                                 const Settings& settings, const RoundPlan& plan) {
  assert(plan.backward > 0);
  return walk_from(scene, light, origins, scale, settings, plan);
}

std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light, const TileFaces& origins,
                                                 const BackwardScale& scale, const Settings& settings) {
  return walk_from(scene, light, origins, scale, settings, {.forward = 0, .backward = TileFaces::group});
}

}  // namespace lichtmc
