#include "view/lit_sides.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "chance/stream.hpp"
#include "view/side_patches.hpp"
#include "walk/kernel.hpp"
#include "walk/never_absorbed.hpp"

namespace lichtmc {

namespace {

constexpr std::uint64_t seed = 20217;  // any: the same room is always drawn the same
constexpr std::uint64_t waves = 48;
constexpr std::uint32_t flights_each = 16;  // light that gets into a corner at all is there by then

// Goal: impacts on side 2·facet + behind.
class ImpactsOfSides : public GoalBase {
 public:
  ImpactsOfSides(const Scene& scene, const Stream& stream)
      : scene_(scene), stream_(stream), impacts_(2 * scene.tracer->facets().size()) {}

  void begin(std::uint64_t first_history) { first_history_ = first_history; }
  void start(Wave& wave, std::uint32_t n) {
    scene_.launcher->launch_all(stream_, first_history_, n, wave.rays, wave.photon.data());
  }
  Misses misses() const { return scene_.misses; }
  void land(const Wave& wave) {
    for (std::size_t i = 0; i < wave.rays.size; ++i)
      ++impacts_[2 * std::size_t{wave.rays.facet[i]} + wave.rays.behind[i]];
  }
  [[maybe_unused]] static constexpr bool in_lanes = true;

  const std::vector<std::uint32_t>& impacts() const { return impacts_; }

 private:
  const Scene& scene_;
  const Stream& stream_;
  std::vector<std::uint32_t> impacts_;
};

std::vector<std::uint32_t> impacts_of_sides(const Scene& scene) {
  const Stream stream(seed);
  ImpactsOfSides goal(scene, stream);
  Kernel<NeverAbsorbedPolicy, SurfaceReflectance, ImpactsOfSides> kernel(scene, stream, flights_each);
  for (std::uint64_t w = 0; w < waves; ++w) {
    goal.begin(w * batch_histories);
    kernel.fly(batch_histories, goal, [] { return false; });
  }
  return goal.impacts();
}

}  // namespace

LitSides find_lit_sides(const Room& room, const Scene& scene) {
  return judge_sides(room, impacts_of_sides(scene));
}

}  // namespace lichtmc
