#include "run/rough_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "chance/moments.hpp"
#include "lichtmc/settings.hpp"
#include "walk/tally.hpp"
#include "walk/walk.hpp"

namespace lichtmc {

std::vector<double> rough_irradiance(const Room& room, const Tiling& tiling, const Scene& scene) {
  constexpr std::uint64_t seed = 0x5851F42D4C957F2D;  // any
  constexpr std::uint64_t photons_per_tile = 8;       // with four flights: some 30 hits
  constexpr std::uint64_t fewest = 16 * batch_histories;
  constexpr std::uint64_t most = 4096 * batch_histories;  // some seconds of work
  Settings settings;
  settings.estimator = Estimator::weight;
  settings.max_bounces = 4;
  settings.seed = seed;
  const std::unique_ptr<Walk> walk = make_walk(scene, settings);
  const Absorption absorption = scene.has_reflectance_maps() ? Absorption::counted : Absorption::by_reflectance;
  Tally tally(scene.first_tile, Hits::apart, absorption);
  const std::uint64_t batches =
      batches_of(std::clamp<std::uint64_t>(photons_per_tile * tiling.tiles.size(), fewest, most));
  for (std::uint64_t k = 0; k < batches; ++k)
    walk->simulate_batch(k * batch_histories, batch_histories, tally, [] { return false; });
  Totals totals(tiling.tiles.size(), tiling.maps.size(), Hits::apart, absorption);
  tally.add_to(totals);
  const double unit = total_power(room) / weight_units / static_cast<double>(batches * batch_histories);
  std::vector<double> rough(tiling.tiles.size());
  for (std::size_t t = 0; t < rough.size(); ++t) {
    const auto hits = static_cast<double>(totals.hits[t]);
    if (hits < 2.0) continue;
    rough[t] =
        (1.0 - 1.0 / std::sqrt(hits)) * unit * static_cast<double>(totals.tiles[t].sum) / tiling.tiles[t].area_m2;
  }
  return rough;
}

}  // namespace lichtmc
