#include "walk/non_absorbing_enclosure.hpp"

#include <algorithm>
#include <cstddef>

#include "walk/kernel.hpp"

namespace lichtmc {

namespace {

// Flights of the photons that remain, together, without an absorption or an escape: then nothing absorbs them. Where
// each flight ends with a probability p, this happens once in exp(2²⁰ p): once in 10⁶ for p = 1.3·10⁻⁵, at which a
// photon would fly 76 000 times.
constexpr std::uint64_t enough = std::uint64_t{1} << 20U;
// If photons still end after these flights, few represent all that remain: light that is absorbed at all has become
// rare among them.
constexpr std::uint32_t flights_of_all = 1000;
constexpr std::size_t few = 8;
constexpr std::uint32_t no_limit = 0;

// A photon survives at reflectance 1 and ends at any other surface.
struct PerfectReflectionPolicy {
  static bool survive(double reflectance, double /*chance*/, double& /*weight*/, Ends& /*ends*/) {
    return reflectance == 1.0;
  }
};

// Goal: whether photons remain that nothing absorbs.
class LastingFlight : public GoalBase {
 public:
  LastingFlight(const Scene& scene, const Stream& stream) : scene_(scene), stream_(stream) {}

  void start(Wave& wave, std::uint32_t n) {
    for (std::uint32_t i = 0; i < n; ++i) scene_.launcher->launch(stream_, i, wave.rays, i);
    remain_ = n;
  }
  Misses misses() const { return scene_.misses; }
  void reflect(Wave& wave, std::uint32_t flight) {
    const bool some_ended = wave.rays.size < remain_;
    if (some_ended && flight > flights_of_all) wave.rays.size = std::min(wave.rays.size, few);
    remain_ = wave.rays.size;
    without_end_ = some_ended ? 0 : without_end_ + remain_;
    if (without_end_ < enough) return;
    found_ = NonAbsorbingEnclosure{scene_.launcher->emitter_of(stream_, wave.photon[0]),
                                   scene_.surface_of[wave.rays.facet[0]]};
    wave.rays.size = 0;
  }

  std::optional<NonAbsorbingEnclosure> found() const { return found_; }

 private:
  const Scene& scene_;
  const Stream& stream_;
  std::size_t remain_ = 0;
  std::uint64_t without_end_ = 0;  // flights since the last end of a photon
  std::optional<NonAbsorbingEnclosure> found_;
};

}  // namespace

std::optional<NonAbsorbingEnclosure> find_non_absorbing_enclosure(const Scene& scene, std::uint64_t seed) {
  if (!scene.reflects_all_somewhere) return std::nullopt;
  const Stream stream(seed);
  LastingFlight goal(scene, stream);
  const auto go_on = [] { return false; };
  if (scene.has_reflectance_maps()) {
    Kernel<PerfectReflectionPolicy, MappedReflectance, LastingFlight>(scene, stream, no_limit)
        .fly(batch_histories, goal, go_on);
  } else {
    Kernel<PerfectReflectionPolicy, SurfaceReflectance, LastingFlight>(scene, stream, no_limit)
        .fly(batch_histories, goal, go_on);
  }
  return goal.found();
}

}  // namespace lichtmc
