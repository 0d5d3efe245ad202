#include "walk/walk.hpp"

#include <cassert>

#include "chance/directions.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

namespace {

constexpr std::uint32_t abandon_interval = 1024;  // flights between two questions whether to go on
constexpr std::uint32_t patience = 1'000'000;     // flights after which the answer counts

// ρ where a flight ended, as a policy of the kernel: of the surface as a whole,
struct SurfaceReflectance {
  static double at(const Scene& scene, const Rays& rays, std::size_t i) { return scene.surface_reflectance(rays, i); }
};

// or of the place, in rooms with maps.
struct MappedReflectance {
  static double at(const Scene& scene, const Rays& rays, std::size_t i) { return scene.reflectance(rays, i); }
};

template <class Policy, class Reflectance>
class PolicyWalk final : public Walk {
 public:
  PolicyWalk(const Scene& scene, std::uint64_t seed, std::uint32_t max_flights)
      : scene_(&scene), stream_(seed), max_flights_(max_flights) {}

  void simulate_batch(std::uint64_t first, std::uint32_t n, Tally& tally, const Abandon& abandon) override {
    first_ = first;
    launch(n);
    for (std::uint32_t flight = 0; wave_.rays.size > 0; ++flight) {
      scene_->tracer->depart(wave_.rays);
      scene_->tracer->trace(wave_.rays, scene_->misses, tally.totals().traced);
      lose_what_escaped(tally.totals());
      score_on_tiles(tally);
      draw(flight + 1);
      survive_or_be_absorbed(tally);
      const bool abandoned = (flight + 1) % abandon_interval == 0 && abandon() && flight >= patience;
      if (abandoned || flight + 1 == max_flights_) cut_off(tally.totals().ends);
      scatter();
    }
    tally.close_batch(n);
    assert(every_history_has_ended(tally));
  }

 private:
  // Photons start at the emitters, each with weight 1.
  void launch(std::uint32_t n) {
    for (std::uint32_t i = 0; i < n; ++i) {
      wave_.photon[i] = i;
      wave_.weight[i] = 1.0;
      scene_->launcher->launch(stream_, first_ + i, wave_.rays, i);
    }
    wave_.rays.size = n;
  }

  // A photon that meets no surface has left through an opening; where there is none it is lost to rounding.
  void lose_what_escaped(Totals& totals) {
    Rays& rays = wave_.rays;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rays.size; ++i) {
      if (rays.facet[i] != no_facet) {
        if (kept != i) wave_.move(i, kept);
        ++kept;
        continue;
      }
      const auto units = static_cast<int128>(Policy::units(wave_.weight[i]));
      if (scene_->misses == Misses::escape) {
        totals.ends.escaped += units;
      } else {
        totals.ends.lost += units;
        ++totals.ends.lost_histories;
      }
    }
    rays.size = kept;
    totals.impacts += kept;
  }

  // Every impact scores on the tile it falls on.
  void score_on_tiles(Tally& tally) {
    const Rays& rays = wave_.rays;
    const std::vector<Facet>& facets = scene_->tracer->facets();
    for (std::size_t i = 0; i < rays.size; ++i) {
      wave_.tile[i] = scene_->tile_at(facets[rays.facet[i]], rays.s[i], rays.t[i], rays.behind[i] != 0);
    }
    if constexpr (Policy::scores_every_impact) {
      for (std::size_t i = 0; i < rays.size; ++i) score(tally, i);
    }
  }

  void score(Tally& tally, std::size_t i) {
    const std::uint64_t units = Policy::units(wave_.weight[i]);
    tally.score(wave_.tile[i], units);
    if (wave_.rays.behind[i] != 0) tally.score_behind(wave_.tile[i], units);
  }

  void draw(std::uint32_t flight) {
    for (std::size_t i = 0; i < wave_.rays.size; ++i) {
      wave_.words[i] = stream_.draw(first_ + wave_.photon[i], flight, Purpose::flight);
    }
  }

  // The surface that was hit decides what becomes of the photon; survivors close ranks.
  void survive_or_be_absorbed(Tally& tally) {
    Rays& rays = wave_.rays;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rays.size; ++i) {
      const double reflectance = Reflectance::at(*scene_, rays, i);
      const double chance = unit_fine(wave_.words[i][2], wave_.words[i][3]);
      if (Policy::survive(reflectance, chance, wave_.weight[i], tally.totals().ends)) {
        if (kept != i) wave_.move(i, kept);
        ++kept;
      } else if constexpr (!Policy::scores_every_impact) {
        score(tally, i);
      }
    }
    rays.size = kept;
  }

  // The walk ends here for all that still fly; their power is reported, not forgotten.
  void cut_off(Ends& ends) {
    for (std::size_t i = 0; i < wave_.rays.size; ++i)
      ends.residual += static_cast<int128>(Policy::units(wave_.weight[i]));
    wave_.rays.size = 0;
  }

  // Diffuse reflection: Lambert's law about the normal, on the side that was hit.
  void scatter() {
    Rays& rays = wave_.rays;
    const std::vector<Facet>& facets = scene_->tracer->facets();
    for (std::size_t i = 0; i < rays.size; ++i) {
      const glm::vec3 local = sample_lambert(wave_.words[i][0], wave_.words[i][1]);
      rays.set_direction(i, direction_from(facets[rays.facet[i]], rays.behind[i] != 0, local));
    }
  }

  // Emitted = absorbed + escaped + residual + lost, in integers.
  static bool every_history_has_ended(const Tally& tally) {
    const Totals& totals = tally.totals();
    const Ends& ends = totals.ends;
    const auto emitted = static_cast<int128>(totals.histories) * static_cast<int128>(Policy::units(1.0));
    return ends.absorbed + ends.escaped + ends.residual + ends.lost == emitted;
  }

  const Scene* scene_;
  Stream stream_;
  std::uint32_t max_flights_;  // 0: no limit
  std::uint64_t first_ = 0;
  Wave wave_;
};

template <class Policy>
std::unique_ptr<Walk> walk_with(const Scene& scene, const Settings& settings, std::uint32_t max_flights) {
  if (scene.has_maps())
    return std::make_unique<PolicyWalk<Policy, MappedReflectance>>(scene, settings.seed, max_flights);
  return std::make_unique<PolicyWalk<Policy, SurfaceReflectance>>(scene, settings.seed, max_flights);
}

}  // namespace

std::unique_ptr<Walk> make_walk(const Scene& scene, const Settings& settings) {
  switch (settings.estimator) {
    case Estimator::collision:
      return walk_with<CollisionPolicy>(scene, settings, 0);
    case Estimator::absorption:
      if (scene.has_maps())
        return std::make_unique<PolicyWalk<MappedAbsorptionPolicy, MappedReflectance>>(scene, settings.seed, 0);
      return std::make_unique<PolicyWalk<AbsorptionPolicy, SurfaceReflectance>>(scene, settings.seed, 0);
    case Estimator::weight:
      break;
  }
  if (settings.max_bounces) return walk_with<TruncatedWeightPolicy>(scene, settings, *settings.max_bounces);
  return walk_with<RouletteWeightPolicy>(scene, settings, 0);
}

ScoreLaw score_law(Estimator estimator, bool has_maps) {
  switch (estimator) {
    case Estimator::collision:
      return {CollisionPolicy::hits, 1.0, false, false, false};
    case Estimator::absorption:
      if (has_maps) return {MappedAbsorptionPolicy::hits, 1.0 / weight_units, true, false, false};
      return {AbsorptionPolicy::hits, 1.0, true, true, true};
    case Estimator::weight:
      break;
  }
  return {WeightPolicy::hits, 1.0 / weight_units, false, false, false};
}

}  // namespace lichtmc
