#include "run/flight_points.hpp"

#include "walk/kernel.hpp"
#include "walk/never_absorbed.hpp"

namespace lichtmc {

namespace {

constexpr std::uint64_t seed = 20213;  // any: the same scene gives the same points
constexpr std::uint64_t waves = 16;
constexpr std::uint32_t flights_each = 8;

// Goal: a point of each flight.
class FlightPointsGoal : public GoalBase {
 public:
  FlightPointsGoal(const Scene& scene, const Stream& stream) : scene_(scene), stream_(stream) {}

  void begin(std::uint64_t first_history) { first_history_ = first_history; }
  void start(Wave& wave, std::uint32_t n) {
    for (std::uint32_t i = 0; i < n; ++i) scene_.launcher->launch(stream_, first_history_ + i, wave.rays, i);
  }
  void land(const Wave& wave) {
    ++flight_;
    const Rays& rays = wave.rays;
    for (std::size_t i = 0; i < rays.size; ++i) {
      const double share = unit_open(stream_.draw(first_history_ + wave.photon[i], flight_, Purpose::place)[0]);
      points_.push_back(scene_.tracer->world_point(glm::dvec3(rays.start(i)) +
                                                   share * double{rays.length[i]} * glm::dvec3(rays.direction(i))));
    }
  }
  // land() reads the flight that has ended; the next flight does not need it.
  static void move(Wave& wave, std::size_t from, std::size_t to) {
    Rays& rays = wave.rays;
    rays.set_start(to, rays.start(from));
    rays.set_direction(to, rays.direction(from));
    rays.length[to] = rays.length[from];
  }

  std::vector<glm::dvec3> take() { return std::move(points_); }

 private:
  const Scene& scene_;
  const Stream& stream_;
  std::uint32_t flight_ = 0;
  std::vector<glm::dvec3> points_;
};

}  // namespace

std::vector<glm::dvec3> flight_points(const Scene& scene) {
  const Stream stream(seed);
  FlightPointsGoal goal(scene, stream);
  Kernel<NeverAbsorbedPolicy, SurfaceReflectance, FlightPointsGoal> kernel(scene, stream, flights_each);
  for (std::uint64_t w = 0; w < waves; ++w) {
    goal.begin(w * batch_histories);
    kernel.fly(batch_histories, goal, [] { return false; });
  }
  return goal.take();
}

}  // namespace lichtmc
