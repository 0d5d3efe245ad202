// The kernel: a wave of photons flies from surface to surface until the last photon has ended.
//
//   launch → fly (tracer) → remove escaped → score on the tiles → survive or be absorbed → scatter → fly …
//
// One kernel for all estimators, both tracers and both directions of a walk, and for everything else that traces
// photons through a room. The differences are policies, resolved at compile time: survival at a surface (Policy, see
// estimators.hpp), the source of ρ (Reflectance), and the purpose of the walk (Goal, see goal.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "base/lanes.hpp"
#include "chance/draw_many.hpp"
#include "chance/stream.hpp"
#include "walk/goal.hpp"
#include "walk/scene.hpp"
#include "walk/survivors.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

// Called every 1024 flights of a wave. If it returns true after more than 10⁵ flights, the wave ends and the remaining
// photons are cut off. This happens only in rooms with almost no absorption.
using Abandon = std::function<bool()>;

// ρ where a flight ended: of the whole surface,
struct SurfaceReflectance {
  static constexpr bool of_facet = true;
  static double at(const Scene& scene, const Rays& rays, std::size_t i) { return scene.surface_reflectance(rays, i); }
};

// or of the point, in rooms with reflectance maps.
struct MappedReflectance {
  static constexpr bool of_facet = false;
  static double at(const Scene& scene, const Rays& rays, std::size_t i) { return scene.reflectance(rays, i); }
};

template <class Policy, class Reflectance, WalkGoal Goal>
class Kernel {
 public:
  // max_flights 0: no limit. The scene must outlive the kernel.
  Kernel(const Scene& scene, const Stream& stream, std::uint32_t max_flights)
      : scene_(&scene), stream_(stream), max_flights_(max_flights) {}

  // n photons (1 … batch_histories) start and fly. Returns false if they were abandoned before all had
  // ended.
  bool fly(std::uint32_t n, Goal& goal, const Abandon& abandon) {
    launch(n, goal);
    bool ended = true;
    for (std::uint32_t flight = 1; wave_.rays.size > 0; ++flight) {
      scene_->tracer->trace(wave_.rays, goal.misses(), goal.traced());
      remove_escaped(goal);
      goal.split(wave_);
      fill_up_lanes();
      goal.land(wave_);
      draw(flight, goal);
      goal.score(wave_);
      survive_or_be_absorbed(goal);
      scatter(goal);
      goal.reflect(wave_, flight);
      if constexpr (PlaysBeforeFlight<Goal>) play_before_flight(goal);
      const bool abandoned = flight % abandon_interval == 0 && abandon() && flight > abandon_after;
      if (abandoned || flight == max_flights_) cut_off(goal);
      if (abandoned) ended = false;
    }
    return ended;
  }

 private:
  static constexpr std::uint32_t abandon_interval = 1024;  // flights between two calls of Abandon
  static constexpr std::uint32_t abandon_after = 100'000;  // flights after which its result is used

  // Photons start, each with weight 1.
  void launch(std::uint32_t n, Goal& goal) {
    wave_.rays.size = n;
    for (std::uint32_t i = 0; i < n; ++i) {
      wave_.photon[i] = i;
      wave_.weight[i] = 1.0;
    }
    goal.start(wave_, n);
    if (scene_->tracer->faces_in_one_plane() != nullptr) remove_covered(goal);
    scene_->tracer->depart(wave_.rays);
  }

  // A photon that starts on a covered part of an area light ends there.
  void remove_covered(Goal& goal) {
    const FacesInOnePlane& planes = *scene_->tracer->faces_in_one_plane();
    Rays& rays = wave_.rays;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rays.size; ++i) {
      const bool on_surface = rays.facet[i] != no_facet;
      if (on_surface && !planes.counts({rays.facet[i], double{rays.s[i]}, double{rays.t[i]}, rays.behind[i] != 0})) {
        goal.cover(wave_, i);
        continue;
      }
      if (kept != i) {
        rays.set_start(kept, rays.start(i));
        rays.set_direction(kept, rays.direction(i));
      }
      keep(i, kept, goal);
    }
    rays.size = kept;
  }

  // A photon that hits no surface has left through an opening; in a closed room it is lost by rounding.
  void remove_escaped(Goal& goal) {
    Rays& rays = wave_.rays;
    if (none_escaped(rays)) return;
    if constexpr (Goal::in_lanes) {
      remove_escaped_in_lanes(goal);
      return;
    }
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

  // The same result, several photons at a time.
  void remove_escaped_in_lanes(Goal& goal) {
    const std::size_t n = wave_.rays.size;
    std::array<std::uint8_t, batch_histories> marks{};
    for (std::size_t i = 0; i < n; ++i) marks[i] = wave_.rays.facet[i] != no_facet ? 1 : 0;
    choose_marked(marks.data(), n, survivors_);
    list_ended(n, survivors_);
    for (std::size_t k = 0; k < n - survivors_.count; ++k) goal.escape(wave_, survivors_.ended_at[k]);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (marks[i] == 0) continue;
      wave_.weight[kept] = wave_.weight[i];
      goal.move(wave_, i, kept++);
    }
    compact_wave(wave_, survivors_);
    wave_.rays.size = survivors_.count;
  }

  static bool none_escaped(const Rays& rays) {
    std::uint32_t escaped = 0;
    const std::uint32_t* facet = rays.facet.data();
    for (std::size_t i = 0; i < rays.size; ++i) escaped += facet[i] == no_facet ? 1U : 0U;
    return escaped == 0;
  }

  // Loops in lanes read some elements beyond the last: these are set to a valid facet.
  void fill_up_lanes() {
    for (std::size_t i = wave_.rays.size; i < whole_lanes(wave_.rays.size); ++i) wave_.rays.facet[i] = 0;
  }

  void draw(std::uint32_t flight, Goal& goal) {
    goal.number_histories(wave_);
    draw_many(stream_, wave_.rays.size, wave_.history.data(), flight, Purpose::flight, wave_.polar.data(),
              wave_.azimuth.data(), wave_.chance.data());
  }

  // Absorption or survival at the surface that was hit; then the wave is compacted.
  void survive_or_be_absorbed(Goal& goal) {
    if constexpr (Goal::in_lanes && Reflectance::of_facet) {
      survive_in_lanes(goal);
    } else {
      survive_one_by_one(goal);
    }
  }

  // The same result as survive_one_by_one(), several photons at a time.
  void survive_in_lanes(Goal& goal) {
    const std::size_t n = wave_.rays.size;
    Policy::choose(*scene_, wave_, goal.ends(), survivors_);
    if (survivors_.count == n) return;
    if constexpr (Goal::watches_absorption) {
      list_ended(n, survivors_);
      goal.absorb_all(wave_, survivors_.ended_at.data(), n - survivors_.count);
    }
    compact_wave(wave_, survivors_);
    if constexpr (Policy::carries_weight) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < n; ++i) {
        wave_.weight[kept] = wave_.weight[i];
        kept += std::size_t{survivors_.sets[i / 8]} >> (i % 8) & 1;
      }
    }
    wave_.rays.size = survivors_.count;
  }

  void survive_one_by_one(Goal& goal) {
    Rays& rays = wave_.rays;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rays.size; ++i) {
      const double reflectance = Reflectance::at(*scene_, rays, i);
      const double chance = static_cast<double>(wave_.chance[i] >> 11) * 0x1p-53;
      if (!survives(i, reflectance, chance, goal)) {
        goal.absorb(wave_, i, reflectance);
        continue;
      }
      keep(i, kept, goal);
    }
    rays.size = kept;
  }

  bool survives(std::size_t i, double reflectance, double chance, Goal& goal) {
    if constexpr (Goal::counts_absorption && !Reflectance::of_facet) {
      const int128 before = goal.ends().absorbed;
      const bool result = Policy::survive(reflectance, chance, wave_.weight[i], goal.ends());
      goal.count_absorbed(i, goal.ends().absorbed - before);
      return result;
    } else {
      return Policy::survive(reflectance, chance, wave_.weight[i], goal.ends());
    }
  }

  void keep(std::size_t i, std::size_t& kept, Goal& goal) {
    if (kept != i) {
      wave_.move(i, kept);
      wave_.weight[kept] = wave_.weight[i];
      goal.move(wave_, i, kept);
    }
    ++kept;
  }

  // Roulette after the light of a surface has been collected: a photon that ends saves its next flight.
  void play_before_flight(Goal& goal) {
    Rays& rays = wave_.rays;
    const std::size_t n = rays.size;
    std::array<std::uint8_t, batch_histories> marks{};
    goal.play(wave_, marks.data());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (marks[i] == 0) continue;
      if (kept != i) {
        wave_.photon[kept] = wave_.photon[i];
        wave_.weight[kept] = wave_.weight[i];
        rays.set_start(kept, rays.start(i));
        goal.move(wave_, i, kept);
      }
      ++kept;
    }
    rays.size = kept;
  }

  // The walk ends for all remaining photons.
  void cut_off(Goal& goal) {
    for (std::size_t i = 0; i < wave_.rays.size; ++i) goal.cut_off(wave_, i);
    wave_.rays.size = 0;
  }

  // Diffuse reflection: Lambert's law about the normal, on the side that was hit.
  void scatter(Goal& goal) {
    scene_->tracer->scatter(wave_.rays, wave_.polar.data(), wave_.azimuth.data(), goal.cosines());
  }

  const Scene* scene_;
  Stream stream_;
  std::uint32_t max_flights_;
  Wave wave_;
  Survivors survivors_;
};

}  // namespace lichtmc
