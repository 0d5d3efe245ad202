#include "walk/non_absorbing_enclosure.hpp"

#include <algorithm>
#include <cstddef>

#include "walk/kernel.hpp"

namespace lichtmc {

namespace {

constexpr std::uint32_t max_flights = 1'000'000;
constexpr std::uint32_t flights_of_all = 1000;  // after these, a few photons represent all that remain
constexpr std::size_t few = 8;

// A photon survives at reflectance 1 and ends at any other surface.
struct PerfectReflectionPolicy {
  static bool survive(double reflectance, double /*chance*/, double& /*weight*/, Ends& /*ends*/) {
    return reflectance == 1.0;
  }
};

// Goal: whether a photon remains after the last flight.
class LastingFlight : public GoalBase {
 public:
  LastingFlight(const Scene& scene, const Stream& stream) : scene_(scene), stream_(stream) {}

  void start(Wave& wave, std::uint32_t n) {
    for (std::uint32_t i = 0; i < n; ++i) scene_.launcher->launch(stream_, i, wave.rays, i);
  }
  Misses misses() const { return scene_.misses; }
  void reflect(Wave& wave, std::uint32_t flight) {
    if (flight > flights_of_all) wave.rays.size = std::min(wave.rays.size, few);
  }
  void cut_off(const Wave& /*wave*/, std::size_t /*i*/) { found_ = true; }

  bool found() const { return found_; }

 private:
  const Scene& scene_;
  const Stream& stream_;
  bool found_ = false;
};

}  // namespace

bool has_non_absorbing_enclosure(const Scene& scene, std::uint64_t seed) {
  if (!scene.reflects_all_somewhere) return false;
  const Stream stream(seed);
  LastingFlight goal(scene, stream);
  const auto go_on = [] { return false; };
  if (scene.has_reflectance_maps()) {
    Kernel<PerfectReflectionPolicy, MappedReflectance, LastingFlight>(scene, stream, max_flights)
        .fly(batch_histories, goal, go_on);
  } else {
    Kernel<PerfectReflectionPolicy, SurfaceReflectance, LastingFlight>(scene, stream, max_flights)
        .fly(batch_histories, goal, go_on);
  }
  return goal.found();
}

}  // namespace lichtmc
