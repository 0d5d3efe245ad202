#include "storey.hpp"

#include <string>
#include <utility>

#include "lichtmc/cuboid.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/simulate.hpp"

namespace lichtmc::bench {

namespace {

const glm::dvec3 size{6.0, 3.0, 5.0};
constexpr double wall = 0.2;

// Surfaces need names of their own.
void add_room(Room& storey, const glm::dvec3& corner) {
  const std::string number = std::to_string(storey.surfaces.size() / 6);
  for (Surface surface : make_cuboid(size, {0.2, 0.7, 0.5, 0.5, 0.5, 0.5}).surfaces) {
    surface.name += " of room " + number;
    for (glm::dvec3& p : surface.positions) p += corner;
    storey.surfaces.push_back(std::move(surface));
  }
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 3; ++b) {
      const glm::dvec3 at = corner + glm::dvec3(0.75 + 1.5 * a, size.y - 0.05, 0.83 + 1.67 * b);
      storey.emitters.push_back({"lamp", 1500.0, LambertEmitter{at, {0, -1, 0}, 1.0}});
    }
  }
  for (int a = 0; a < 12; ++a) {
    for (int b = 0; b < 10; ++b) {
      const glm::dvec3 at = corner + glm::dvec3(0.25 + 0.5 * a, 0.75, 0.25 + 0.5 * b);
      storey.receivers.push_back({"point", at, {0, 1, 0}, 90.0, 1.0});
    }
  }
}

}  // namespace

Room storey_of_rooms(int nx, int nz) {
  Room storey;
  for (int i = 0; i < nx; ++i) {
    for (int k = 0; k < nz; ++k) add_room(storey, {i * (size.x + wall), 0.0, k * (size.z + wall)});
  }
  return storey;
}

double points_to_one_percent(const Room& room) {
  constexpr double target = 0.01;
  Settings settings;
  settings.estimator = Estimator::weight;
  settings.engine = Engine::embree;
  settings.measured = lichtmc::Measured::receivers;
  settings.threads = 1;
  settings.target_error = target;
  const double ratio = simulate(room, settings).receiver_walk.rms_relative_error / target;
  return static_cast<double>(room.receivers.size()) / (ratio * ratio);
}

}  // namespace lichtmc::bench
