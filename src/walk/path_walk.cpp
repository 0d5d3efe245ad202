#include "walk/path_walk.hpp"

#include <algorithm>
#include <limits>

#include <glm/vec3.hpp>

#include "room/bounds.hpp"
#include "walk/choose_policy.hpp"
#include "walk/kernel.hpp"

namespace lichtmc {

namespace {

// The point where a ray that starts in a box, or close to it, leaves the box.
glm::dvec3 exit_from(const Bounds& box, const glm::dvec3& start, const glm::dvec3& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) continue;
    const double wall = direction[k] > 0.0 ? box.high[k] : box.low[k];
    nearest = std::min(nearest, std::max(0.0, (wall - start[k]) / direction[k]));
  }
  return start + (nearest < std::numeric_limits<double>::infinity() ? nearest : 0.0) * direction;
}

// Goal of `paths`: every flight is recorded.
class PathGoal : public GoalBase {
 public:
  PathGoal(const Room& room, const Scene& scene, const Stream& stream, std::uint64_t first)
      : GoalBase(first), scene_(&scene), stream_(stream), box_(bounds_of(room)) {}

  std::vector<PhotonPath> take() { return std::move(paths_); }

  void start(Wave& wave, std::uint32_t n) {
    paths_.resize(n);
    wave.rays.size = n;
    scene_->launcher->launch_all(stream_, first_history_, n, wave.rays, wave.photon.data());
    scene_->tracer->depart(wave.rays);
    for (std::size_t i = 0; i < n; ++i) {
      PhotonPath& path = paths_[wave.photon[i]];
      path.history = first_history_ + wave.photon[i];
      PathPoint& point = path.points.emplace_back();
      point.place = scene_->tracer->world_point(glm::dvec3(wave.rays.start(i)));
      const std::uint32_t facet = wave.rays.facet[i];
      if (facet != no_facet) point.surface = scene_->surface_of[facet];
    }
  }
  Misses misses() const { return scene_->misses; }

  void cover(const Wave& wave, std::size_t i) { paths_[wave.photon[i]].end = PathEnd::absorbed; }
  void escape(const Wave& wave, std::size_t i) {
    PhotonPath& path = paths_[wave.photon[i]];
    if (scene_->misses == Misses::retrace) {
      path.end = PathEnd::lost;
      return;
    }
    path.end = PathEnd::escaped;
    const glm::dvec3 start = scene_->tracer->world_point(glm::dvec3(wave.rays.start(i)));
    const glm::dvec3 direction = scene_->tracer->world_vector(glm::dvec3(wave.rays.direction(i)));
    path.points.push_back({exit_from(box_, start, direction), no_surface, wave.weight[i]});
  }
  void land(const Wave& wave) {
    const Rays& rays = wave.rays;
    for (std::size_t i = 0; i < rays.size; ++i) {
      const glm::dvec3 end = glm::dvec3(rays.start(i)) + double{rays.length[i]} * glm::dvec3(rays.direction(i));
      paths_[wave.photon[i]].points.push_back(
          {scene_->tracer->world_point(end), scene_->surface_of[rays.facet[i]], wave.weight[i]});
    }
  }
  // Used in constant expressions only, which clang 14 does not count as use.
  [[maybe_unused]] static constexpr bool watches_absorption = true;
  void absorb(const Wave& wave, std::size_t i, double /*reflectance*/) {
    paths_[wave.photon[i]].end = PathEnd::absorbed;
  }
  void cut_off(const Wave& wave, std::size_t i) { paths_[wave.photon[i]].end = PathEnd::cut_off; }
  // land() reads the flight that has ended; the next flight does not need it.
  static void move(Wave& wave, std::size_t from, std::size_t to) {
    Rays& rays = wave.rays;
    rays.set_start(to, rays.start(from));
    rays.set_direction(to, rays.direction(from));
    rays.length[to] = rays.length[from];
  }

 private:
  const Scene* scene_;
  Stream stream_;
  Bounds box_;
  std::vector<PhotonPath> paths_;
};

}  // namespace

std::vector<PhotonPath> walk_paths(const Room& room, const Scene& scene, const Settings& settings,
                                   std::uint32_t most_flights, std::uint64_t first, std::uint32_t n) {
  const Stream stream(settings.seed);
  PathGoal goal(room, scene, stream, first);
  // Settings::estimator automatic means collision: the estimators differ in their scores, not in the paths.
  const Estimator estimator = settings.estimator == Estimator::automatic ? Estimator::collision : settings.estimator;
  choose_policy(estimator, settings.max_bounces, scene.has_reflectance_maps(),
                [&]<class Policy, class Reflectance>(std::uint32_t /*max_flights*/) {
                  const auto go_on = [] { return false; };
                  return Kernel<Policy, Reflectance, PathGoal>(scene, stream, most_flights).fly(n, goal, go_on);
                });
  return goal.take();
}

}  // namespace lichtmc
