#include "walk/roulette.hpp"

#include <algorithm>

#include "walk/kernel.hpp"
#include "walk/never_absorbed.hpp"
#include "walk/surface_light.hpp"

namespace lichtmc {

namespace {

constexpr std::uint64_t seed = 20211;  // any: the same room gives the same threshold
constexpr double least = 0.15;
constexpr double most = 0.6;
constexpr double moment_per_weight = 16.0;

// Goal: the sum of the direct irradiances at the first impacts.
class FirstImpacts : public GoalBase {
 public:
  FirstImpacts(const Scene& scene, const DirectLight& light, const Stream& stream)
      : scene_(scene), stream_(stream), light_(light, *scene.tracer, stream) {}

  void start(Wave& wave, std::uint32_t n) {
    for (std::uint32_t i = 0; i < n; ++i) scene_.launcher->launch(stream_, i, wave.rays, i);
  }
  void reflect(Wave& wave, std::uint32_t flight) {
    number_histories(wave);
    light_.sample(wave, flight, nullptr, traced());
    for (std::size_t i = 0; i < wave.rays.size; ++i) sum_ += light_.irradiance()[i];
  }
  double sum() const { return sum_; }

 private:
  const Scene& scene_;
  const Stream& stream_;
  SurfaceLight light_;
  double sum_ = 0.0;
};

}  // namespace

double roulette_threshold(const Scene& scene, const DirectLight& light, double mean_irradiance) {
  if (light.sources() == 0) return most;
  const Stream stream(seed);
  FirstImpacts goal(scene, light, stream);
  Kernel<NeverAbsorbedPolicy, SurfaceReflectance, FirstImpacts> kernel(scene, stream, 1);
  kernel.fly(batch_histories, goal, [] { return false; });
  const double moment = goal.sum() / batch_histories / mean_irradiance;
  return std::clamp(moment / moment_per_weight, least, most);
}

}  // namespace lichtmc
