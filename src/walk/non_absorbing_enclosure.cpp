#include "walk/non_absorbing_enclosure.hpp"

#include <algorithm>

#include "chance/directions.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

bool has_non_absorbing_enclosure(const Scene& scene, std::uint64_t seed) {
  if (!scene.reflects_all_somewhere) return false;

  constexpr std::uint32_t flights = 1'000'000;
  constexpr std::uint32_t flights_of_all = 1000;  // then a few stand for all that still fly
  constexpr std::size_t few = 8;
  const Stream stream(seed);
  const std::vector<Facet>& facets = scene.tracer->facets();
  Wave wave;
  Rays& rays = wave.rays;
  for (std::uint32_t i = 0; i < batch_histories; ++i) {
    wave.photon[i] = i;
    scene.launcher->launch(stream, i, rays, i);
  }
  rays.size = batch_histories;
  TraceCount count;
  for (std::uint32_t flight = 0; flight < flights && rays.size > 0; ++flight) {
    scene.tracer->depart(rays);
    scene.tracer->trace(rays, scene.misses, count);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rays.size; ++i) {
      if (rays.facet[i] == no_facet || scene.reflectance(rays, i) < 1.0) continue;
      wave.move(i, kept++);
    }
    rays.size = flight < flights_of_all ? kept : std::min(kept, few);
    for (std::size_t i = 0; i < rays.size; ++i) {
      const Words words = stream.draw(wave.photon[i], flight + 1, Purpose::flight);
      rays.set_direction(
          i, direction_from(facets[rays.facet[i]], rays.behind[i] != 0, sample_lambert(words[0], words[1])));
    }
  }
  return rays.size > 0;
}

}  // namespace lichtmc
