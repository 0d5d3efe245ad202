// Rooms with more emitters than are sampled at every surface: learned probabilities, and results that do not depend on
// them.
//
// Light is additive: E by eight emitters is the sum of E by four of them and by the other four. With up to four
// emitters all of them are sampled at every surface, so that the two parts are free of any selection.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "chance/stream.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"
#include "support/verdict.hpp"
#include "walk/direct_light.hpp"
#include "walk/scene.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double width = 3.0;
constexpr double gap = 0.1;  // between the rooms

// Two closed rooms of 3 m × 2.5 m × 3 m, one beside the other along x; in the second nothing but the light differs.
// Each has four lamps under its ceiling, of very different power, or four panels.
Room two_rooms(bool panels) {
  Room room;
  for (int k = 0; k < 2; ++k) {
    const glm::dvec3 corner(k * (width + gap), 0.0, 0.0);
    for (Surface surface : make_cuboid({width, 2.5, width}, {0.3, 0.7, 0.5, 0.5, 0.5, 0.5}).surfaces) {
      surface.name += std::to_string(k);
      for (glm::dvec3& p : surface.positions) p += corner;
      room.surfaces.push_back(surface);
    }
    for (int lamp = 0; lamp < 4; ++lamp) {
      const glm::dvec3 at = corner + glm::dvec3(lamp % 2 == 0 ? 0.6 : 2.4, 2.4, lamp < 2 ? 0.6 : 2.4);
      const double power = k == 0 ? 100.0 : 1000.0 * (1 + lamp);
      if (panels) {
        Surface panel;
        panel.name = "panel" + std::to_string(4 * k + lamp);
        panel.reflectance = 0.5;
        add_quad(panel, at, {0.4, 0, 0}, {0, 0, 0.4});
        room.surfaces.push_back(panel);
        room.emitters.push_back(surface_emitter(room.surfaces.size() - 1, power));
      } else {
        room.emitters.push_back(lambert(at, {0, -1, 0}, 1.0, power));
      }
      room.emitters.back().name = "lamp" + std::to_string(4 * k + lamp);
    }
    for (const double x : {0.05, 1.2, 2.95}) {
      for (const double z : {0.3, 1.5}) {
        room.receivers.push_back({"up", corner + glm::dvec3(x, 0.7, z), {0, 1, 0}, 90.0, 1.0});
        room.receivers.push_back({"down", corner + glm::dvec3(x, 1.2, z), {0, -1, 0}, 90.0, 1.0});
      }
    }
  }
  return room;
}

Room with_emitters(Room room, std::size_t first, std::size_t last) {
  room.emitters = std::vector<Emitter>(room.emitters.begin() + static_cast<std::ptrdiff_t>(first),
                                       room.emitters.begin() + static_cast<std::ptrdiff_t>(last));
  return room;
}

std::vector<ReceiverResult> measured(const Room& room, ReceiverWalk walk, std::uint64_t seed) {
  Settings settings = settings_of(Estimator::weight, Engine::embree, 8000.0 * 24, seed);
  settings.measured = Measured::receivers;
  settings.receiver_walk = walk;
  return simulate(room, settings).receiver_results;
}

void check_additive(const Room& room, ReceiverWalk walk) {
  const auto all = measured(room, walk, 1);
  const auto first = measured(with_emitters(room, 0, 4), ReceiverWalk::backward, 2);
  const auto last = measured(with_emitters(room, 4, 8), ReceiverWalk::backward, 3);
  std::vector<Compared> figures;
  for (std::size_t k = 0; k < all.size(); ++k)
    figures.push_back({all[k].irradiance, all[k].standard_error, first[k].irradiance + last[k].irradiance,
                       std::hypot(first[k].standard_error, last[k].standard_error)});
  const bool shared = walk == ReceiverWalk::two_way;  // photons serve all receivers
  check("irradiance", compare(figures, shared ? Deviations::correlated : Deviations::independent));
}

// A lamp's chance at points of one room, with the learned probabilities.
class Chances {
 public:
  explicit Chances(const Room& room)
      : room_(room),
        tiling_(make_tiling(room_, 1.0)),
        scene_(room_, tiling_, Engine::embree),
        light_(room_, *scene_.tracer) {
    light_.learn_selection(scene_);
  }

  const DirectLight& light() const { return light_; }
  // Of all lamps of the room k.
  double of_room(int k, const ReferencePoint& reference) const {
    double sum = 0.0;
    for (std::size_t lamp = 0; lamp < 4; ++lamp)
      sum += light_.selection_probability(light_.source_of(4 * static_cast<std::size_t>(k) + lamp), reference);
    return sum;
  }

 private:
  Room room_;
  Tiling tiling_;
  Scene scene_;
  DirectLight light_;
};

// Points on the floors and on the walls that the rooms face each other with, up to 2 cm from the edges.
std::vector<ReferencePoint> places(int k) {
  std::vector<ReferencePoint> places;
  const double left = k * (width + gap);
  const double wall = k == 0 ? width : width + gap;
  for (double a = 0.02; a < width; a += 0.08) {
    for (double b = 0.02; b < width; b += 0.08) {
      places.push_back({{left + a, 0.0, b}, {0, 1, 0}});
      if (b < 2.3) places.push_back({{wall, b, a}, {k == 0 ? -1.0 : 1.0, 0, 0}});
    }
  }
  return places;
}

}  // namespace

TEST_CASE("many lamps: results are those of four and four") {
  check_additive(two_rooms(false), ReceiverWalk::backward);
}

TEST_CASE("many lamps: two-way walks with learned probabilities") {
  check_additive(two_rooms(false), ReceiverWalk::two_way);
}

TEST_CASE("many lamps: area lights, sampled and hit by flights") {
  check_additive(two_rooms(true), ReceiverWalk::backward);
  check_additive(two_rooms(true), ReceiverWalk::two_way);
}

TEST_CASE("many lamps: lamps behind a wall are hardly ever chosen, however strong") {
  for (const bool panels : {false, true}) {
    const Chances chances(two_rooms(panels));
    for (int k = 0; k < 2; ++k) {
      for (const ReferencePoint& reference : places(k)) {
        const double own = chances.of_room(k, reference);
        const double other = chances.of_room(1 - k, reference);
        CHECK(own + other == Approx(1.0).epsilon(1e-13));
        // 0.9 are chosen by the table of the cell, except the weakest 0.5 % of its light; the rest by flux and by the
        // light of the region, which may extend through the wall.
        CHECK(own >= 0.9 * 0.995);
        CHECK(other > 0.0);
      }
    }
  }
}

TEST_CASE("many lamps: light samples with the probability of their own cell, not of another") {
  // Means of light samples against the sum over all lamps, at points of the floor of the first room. The mutation
  // divides by the probability that a point on the second room's floor has.
  const Room room = two_rooms(false);
  const Chances chances(room);
  const DirectLight& light = chances.light();
  const Stream stream(5);
  std::vector<Compared> right;
  std::vector<Compared> wrong;
  for (int point = 0; point < 20; ++point) {
    const ReferencePoint reference{{0.1 + 0.14 * point, 0.0, 0.3 + 0.1 * point}, {0, 1, 0}};
    const ReferencePoint other{{reference.point.x + width + gap, 0.0, reference.point.z}, {0, 1, 0}};
    double expected = 0.0;
    for (const PointLight& one : light.points()) expected += one.sample_light(reference).irradiance;
    constexpr std::uint32_t samples = 2000;
    double sums[2] = {};
    double squares[2] = {};
    for (std::uint32_t k = 0; k < samples; ++k) {
      const Words which = stream.draw(static_cast<std::uint64_t>(point), k, Purpose::light);
      const LightSample sample = light.sample_light(0, light.cell_of(reference), reference, which, {});
      std::size_t lamp = 0;
      while (light.points()[lamp].position() != sample.target) ++lamp;
      const LightSource& source = light.source_of(light.points()[lamp].number());
      const double mutation =
          light.selection_probability(source, reference) / light.selection_probability(source, other);
      for (int m = 0; m < 2; ++m) {
        const double value = sample.irradiance * (m == 0 ? 1.0 : mutation);
        sums[m] += value;
        squares[m] += value * value;
      }
    }
    for (int m = 0; m < 2; ++m) {
      const double mean = sums[m] / samples;
      const double error = std::sqrt((squares[m] / samples - mean * mean) / (samples - 1));
      (m == 0 ? right : wrong).push_back({mean, error, expected, 0.0});
    }
  }
  check("own cell", compare(right));
  CHECK_FALSE(compare(wrong).agrees);
}
