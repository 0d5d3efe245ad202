// Points of a room's surfaces that photons mark: sample points for what is learned about a room before its walks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "walk/kernel.hpp"
#include "walk/never_absorbed.hpp"
#include "walk/place_tree.hpp"
#include "walk/scene.hpp"
#include "walk/visibility.hpp"

namespace lichtmc {

struct MarkedPoints {
  std::vector<Place> places;
  std::vector<glm::vec3> starts;  // of rays from them: off the surface, in the tracer's coordinates

  // Adds the points where the photons of a wave have been reflected.
  void mark(const Wave& wave, const Tracer& tracer) {
    for (std::size_t i = 0; i < wave.rays.size; ++i) {
      const glm::vec3 start = wave.rays.start(i);
      places.push_back({tracer.world_point(glm::dvec3(start)), hit_normal(tracer, wave.rays, i)});
      starts.push_back(start);
    }
  }
};

// Photons 0 … n − 1 make this number of flights each; nothing absorbs them. The goal has begin(first photon).
template <WalkGoal Goal>
void fly_unabsorbed(const Scene& scene, const Stream& stream, std::uint32_t flights, std::uint64_t n, Goal& goal) {
  Kernel<NeverAbsorbedPolicy, SurfaceReflectance, Goal> kernel(scene, stream, flights);
  for (std::uint64_t first = 0; first < n; first += batch_histories) {
    goal.begin(first);
    kernel.fly(static_cast<std::uint32_t>(std::min<std::uint64_t>(batch_histories, n - first)), goal,
               [] { return false; });
  }
}

}  // namespace lichtmc
