// The kernel: a wave of photons flies from surface to surface until the last has ended.
//
// One kernel for all estimators, both tracers and both ways. What differs is passed in as policies and resolved at
// compile time: what becomes of a photon at a surface (Policy, see estimators.hpp), where ρ comes from (Reflectance),
// and what it is all for (Goal): where photons start and what is scored. A Goal has
//
//   start(wave, n)            sets the first n photons and how they start
//   history(photon)           the number of a photon's history, which selects its random numbers
//   misses(), traced(), ends()
//   escape(wave, i)           photon i met no surface
//   land(wave)                all photons have landed
//   absorb(wave, i, ρ)        photon i ends on its surface
//   reflect(wave, flight)     all photons left stand on their surfaces, about to fly on
//   cut_off(wave, i)          the walk ends for photon i
//   scatter(i, cosine)        photon i flies off at this angle to the normal
//   move(wave, from, to)      photon `from` takes place `to` of the wave, which itself has moved what flying on needs
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "chance/directions.hpp"
#include "chance/stream.hpp"
#include "walk/scene.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

// Asked every thousand flights of a wave. When it says true and the wave has flown a million times, the wave ends and
// what still flies is cut off: only a room that keeps its light for ever, or nearly so, gets there.
using Abandon = std::function<bool()>;

// ρ where a flight ended: of the surface as a whole,
struct SurfaceReflectance {
  static double at(const Scene& scene, const Rays& rays, std::size_t i) { return scene.surface_reflectance(rays, i); }
};

// or of the place, in rooms with maps.
struct MappedReflectance {
  static double at(const Scene& scene, const Rays& rays, std::size_t i) { return scene.reflectance(rays, i); }
};

template <class Policy, class Reflectance, class Goal>
class Kernel {
 public:
  // max_flights 0: no limit. The scene must outlive the kernel.
  Kernel(const Scene& scene, const Stream& stream, std::uint32_t max_flights)
      : scene_(&scene), stream_(stream), max_flights_(max_flights) {}

  // n photons (1 … batch_histories) start and fly.
  void fly(std::uint32_t n, Goal& goal, const Abandon& abandon) {
    launch(n, goal);
    for (std::uint32_t flight = 1; wave_.rays.size > 0; ++flight) {
      scene_->tracer->trace(wave_.rays, goal.misses(), goal.traced());
      lose_what_escaped(goal);
      goal.land(wave_);
      draw(flight, goal);
      survive_or_be_absorbed(goal);
      scene_->tracer->depart(wave_.rays);
      goal.reflect(wave_, flight);
      const bool abandoned = flight % abandon_interval == 0 && abandon() && flight > patience;
      if (abandoned || flight == max_flights_) cut_off(goal);
      scatter(goal);
    }
  }

 private:
  static constexpr std::uint32_t abandon_interval = 1024;  // flights between two questions whether to go on
  static constexpr std::uint32_t patience = 1'000'000;     // flights after which the answer counts

  // Photons start, each with weight 1.
  void launch(std::uint32_t n, Goal& goal) {
    wave_.rays.size = n;
    for (std::uint32_t i = 0; i < n; ++i) {
      wave_.photon[i] = i;
      wave_.weight[i] = 1.0;
    }
    goal.start(wave_, n);
    scene_->tracer->depart(wave_.rays);
  }

  // A photon that meets no surface has left through an opening; where there is none it is lost to rounding.
  void lose_what_escaped(Goal& goal) {
    Rays& rays = wave_.rays;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rays.size; ++i) {
      if (rays.facet[i] == no_facet) {
        goal.escape(wave_, i);
        continue;
      }
      keep(i, kept, goal);
    }
    rays.size = kept;
  }

  void draw(std::uint32_t flight, const Goal& goal) {
    for (std::size_t i = 0; i < wave_.rays.size; ++i) {
      wave_.words[i] = stream_.draw(goal.history(wave_.photon[i]), flight, Purpose::flight);
    }
  }

  // The surface that was hit decides what becomes of the photon; survivors close ranks.
  void survive_or_be_absorbed(Goal& goal) {
    Rays& rays = wave_.rays;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rays.size; ++i) {
      const double reflectance = Reflectance::at(*scene_, rays, i);
      const double chance = unit_fine(wave_.words[i][2], wave_.words[i][3]);
      if (!Policy::survive(reflectance, chance, wave_.weight[i], goal.ends())) {
        goal.absorb(wave_, i, reflectance);
        continue;
      }
      keep(i, kept, goal);
    }
    rays.size = kept;
  }

  void keep(std::size_t i, std::size_t& kept, Goal& goal) {
    if (kept != i) {
      wave_.move(i, kept);
      goal.move(wave_, i, kept);
    }
    ++kept;
  }

  // The walk ends here for all that still fly.
  void cut_off(Goal& goal) {
    for (std::size_t i = 0; i < wave_.rays.size; ++i) goal.cut_off(wave_, i);
    wave_.rays.size = 0;
  }

  // Diffuse reflection: Lambert's law about the normal, on the side that was hit.
  void scatter(Goal& goal) {
    Rays& rays = wave_.rays;
    const std::vector<Facet>& facets = scene_->tracer->facets();
    for (std::size_t i = 0; i < rays.size; ++i) {
      const glm::vec3 local = sample_lambert(wave_.words[i][0], wave_.words[i][1]);
      rays.set_direction(i, direction_from(facets[rays.facet[i]], rays.behind[i] != 0, local));
      goal.scatter(i, local.z);
    }
  }

  const Scene* scene_;
  Stream stream_;
  std::uint32_t max_flights_;
  Wave wave_;
};

}  // namespace lichtmc
