// Cylindrical and semicylindrical illuminance: closed forms, means of planar receivers, all walks.
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "support/channel_rooms.hpp"
#include "support/luminaires.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"
#include "support/two_sided_wall.hpp"
#include "support/verdict.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;

Receiver cylinder(const glm::dvec3& position, const glm::dvec3& axis = {0, 1, 0}) {
  Receiver receiver{"cylinder", position, axis};
  receiver.law = ReceiverLaw::cylindrical;
  return receiver;
}

Receiver half_cylinder(const glm::dvec3& position, const glm::dvec3& facing, const glm::dvec3& axis = {0, 1, 0}) {
  Receiver receiver{"half cylinder", position, axis};
  receiver.law = ReceiverLaw::semicylindrical;
  receiver.facing = facing;
  return receiver;
}

Settings settings_for(ReceiverWalk walk, Estimator estimator, double histories, std::uint64_t seed) {
  Settings settings = settings_of(estimator, Engine::automatic, histories, seed);
  settings.measured = Measured::receivers;
  settings.receiver_walk = walk;
  return settings;
}

const std::vector<ReceiverWalk> walks{ReceiverWalk::backward, ReceiverWalk::next_event, ReceiverWalk::two_way};
const std::vector<Estimator> estimators{Estimator::weight, Estimator::collision, Estimator::absorption};

// sin ε/π or sin ε (1 + cos α)/π, written here from the angles.
double weight_of(const Receiver& receiver, const glm::dvec3& towards) {
  const glm::dvec3 axis = glm::normalize(receiver.normal);
  const double to_axis = std::acos(glm::dot(towards, axis));
  if (receiver.law == ReceiverLaw::cylindrical) return std::sin(to_axis) / pi;
  const glm::dvec3 level = towards - glm::dot(towards, axis) * axis;
  const glm::dvec3 facing = receiver.facing - glm::dot(receiver.facing, axis) * axis;
  const double cosine = glm::dot(level, facing) / (glm::length(level) * glm::length(facing));
  return std::sin(to_axis) * (1.0 + cosine) / pi;
}

std::vector<Receiver> around(const glm::dvec3& position) {
  return {cylinder(position), cylinder(position, {0.4, 1.0, -0.3}), half_cylinder(position, {1, 0, 0}),
          half_cylinder(position, {-1, 0.5, 0.2}), half_cylinder(position, {0.3, 0.1, -1}, {0.4, 1.0, -0.3})};
}

// The irradiance by a uniform Lambertian rectangle from corner, along a and b, of exitance 1, its front on the side of
// a × b: midpoints of n × n parts.
double by_panel(const Receiver& receiver, const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b, int n) {
  const glm::dvec3 cross = glm::cross(a, b);
  double sum = 0.0;
  for (int k = 0; k < n * n; ++k) {
    const glm::dvec3 way = corner + (k % n + 0.5) / n * a + (k / n + 0.5) / n * b - receiver.position;
    const double r = glm::length(way);
    const double cosine = -glm::dot(way, cross) / r;
    if (cosine > 0.0) sum += weight_of(receiver, way / r) * cosine / (pi * r * r);
  }
  return sum / (n * n);
}

// The room with a two-sided wall, with emitters of all laws.
Room furnished() {
  Room room = room_with_two_sided_wall();
  MeasuredEmitter luminaire;
  luminaire.photometry = skew_luminaire();
  luminaire.position = {1.0, 2.8, 1.0};
  luminaire.opening = LuminousOpening{};
  luminaire.opening->form = OpeningForm::rectangle;
  luminaire.opening->size_m = {0.3, 0.6, 0.0};
  room.emitters = {isotropic({3.0, 2.0, 1.0}, 100.0),
                   {"luminaire", 200.0, luminaire},
                   {"spot", 150.0, SpotEmitter{{2.0, 2.5, 3.0}, {0.2, -1, 0.1}, 0.2, 0.6}},
                   surface_emitter(room.surfaces.size() - 1, 300.0)};
  return room;
}

const std::vector<glm::dvec3> places{{1.2, 1.2, 1.1}, {3.4, 1.6, 3.6}, {0.7, 0.4, 4.2}};
constexpr int directions = 64;
constexpr double turn = 2.0 * pi / directions;

// The trapezoidal rule over n level directions has |cos| with the mean (2/n) cot(π/n) to (2/n)/sin(π/n): for n = 64 the
// cylinder's sin ε/π is met within 8·10⁻⁴ for each direction of the light, and therefore for all together. The weights
// of a half cylinder are up to 1 + 4/π times as large, and the light of the direction opposite can be nearly all.
constexpr double rule_of_cylinder = 8e-4;
constexpr double rule_of_half = 2.3 * rule_of_cylinder;

// Planar receivers in level directions about each place.
Room with_planes(Room room) {
  room.receivers.clear();
  for (const glm::dvec3& place : places) {
    for (int k = 0; k < directions; ++k)
      room.receivers.push_back({"plane", place, {std::cos(turn * k), 0.0, std::sin(turn * k)}});
  }
  return room;
}

// At each place a cylinder and half cylinders that face x, −x and between.
constexpr int of_place = 4;
const double facing_angles[of_place] = {0.0, 0.0, pi, 10 * turn};
Room with_cylinders(Room room) {
  room.receivers.clear();
  for (const glm::dvec3& place : places) {
    room.receivers.push_back(cylinder(place));
    for (int k = 1; k < of_place; ++k)
      room.receivers.push_back(half_cylinder(place, {std::cos(facing_angles[k]), 0.0, std::sin(facing_angles[k])}));
  }
  return room;
}

// What they have according to planar receivers: E_z is the mean of E_v(φ), and E_sc that of E_v(φ) (1 + (4/π) cos(φ −
// φ₀)), because ∫ max(0, cos(α − φ)) (1/2π + (2/π²) cos φ) dφ = (1 + cos α)/π. The errors of the planar receivers are
// correlated: their mean has at most the mean of their errors.
std::vector<Compared> expected_by_planes(const Result& planes) {
  std::vector<Compared> figures;
  for (std::size_t p = 0; p < places.size(); ++p) {
    for (int c = 0; c < of_place; ++c) {
      Compared one;
      double mean = 0.0;
      for (int k = 0; k < directions; ++k) {
        const ReceiverResult& plane = planes.receiver_results[p * directions + static_cast<std::size_t>(k)];
        const double factor = c == 0 ? 1.0 : 1.0 + 4.0 / pi * std::cos(turn * k - facing_angles[c]);
        one.expected += factor * plane.irradiance / directions;
        one.expected_error += std::abs(factor) * plane.standard_error / directions;
        mean += plane.irradiance / directions;
      }
      one.expected_error = std::hypot(one.expected_error, (c == 0 ? rule_of_cylinder : rule_of_half) * mean);
      figures.push_back(one);
    }
  }
  return figures;
}

void take_values(std::vector<Compared>& figures, const Result& result) {
  for (std::size_t k = 0; k < figures.size(); ++k) {
    figures[k].value = result.receiver_results[k].irradiance;
    figures[k].standard_error = result.receiver_results[k].standard_error;
  }
}

}  // namespace

TEST_CASE("receiver laws: one point emitter in closed form") {
  const glm::dvec3 lamp(0.3, 0.8, 0.6);
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    Room room = unit_cube(0.0, isotropic(lamp, 4.0 * pi));
    room.receivers = around({0.7, 0.35, 0.2});
    // Light from along the axis counts nothing, that from straight ahead most.
    room.receivers.push_back(cylinder({0.3, 0.2, 0.6}));
    room.receivers.push_back(half_cylinder({0.1, 0.8, 0.6}, {1, 0, 0}));
    room.receivers.push_back(half_cylinder({0.1, 0.8, 0.6}, {-1, 0, 0}));
    Settings settings = settings_for(ReceiverWalk::automatic, Estimator::weight, 100, 1);
    settings.engine = engine;
    const Result result = simulate(room, settings);
    for (std::size_t k = 0; k < room.receivers.size(); ++k) {
      const Receiver& receiver = room.receivers[k];
      const glm::dvec3 way = lamp - receiver.position;
      const double r = glm::length(way);
      const double exact = weight_of(receiver, way / r) / (r * r);
      CHECK_THAT(result.receiver_results[k].irradiance, Catch::Matchers::WithinAbs(exact, 1e-7 / (r * r)));
      CHECK(result.receiver_results[k].standard_error == 0.0);
    }
    CHECK_THAT(result.receiver_results[5].irradiance, Catch::Matchers::WithinAbs(0.0, 1e-6));
    CHECK_THAT(result.receiver_results[6].irradiance, Catch::Matchers::WithinRel(2.0 / pi / 0.04, 1e-9));
    CHECK_THAT(result.receiver_results[7].irradiance, Catch::Matchers::WithinAbs(0.0, 1e-12));
  }
}

TEST_CASE("receiver laws: an area light, also close by") {
  const glm::dvec3 corner(0.0, 2.0, 0.0);
  const glm::dvec3 a(1.2, 0.0, 0.0);
  const glm::dvec3 b(0.0, 0.0, 0.8);  // a × b points down
  const double exitance = 10.0;
  // 3 cm below it samples of its points are useless (near_area_light.hpp).
  const std::vector<double> heights{0.5, 1.7, 1.97};
  for (const bool shadows : {false, true}) {
    // The ceiling; with a screen in a corner, shadow rays are traced.
    Room room = make_cuboid({1.2, 2.0, 0.8}, uniform_reflectance(0.0));
    room.emitters = {surface_emitter(surface_number(room, "ceiling"), exitance * 1.2 * 0.8)};
    if (shadows) {
      Surface screen = make_floor(0.1, 0.1);
      screen.name = "screen";
      for (glm::dvec3& p : screen.positions) p.y = 0.05;
      room.surfaces.push_back(screen);
    }
    for (const double height : heights) {
      for (const Receiver& one : around({0.4, height, 0.5})) room.receivers.push_back(one);
    }
    const Result result = simulate(room, settings_for(ReceiverWalk::automatic, Estimator::weight, 100, 3));
    std::vector<Compared> figures;
    for (std::size_t k = 0; k < room.receivers.size(); ++k) {
      // 1000 parts along a side, of 1.2 mm: (1.2/30)²/24 of the irradiance at a distance of 3 cm.
      const double exact = exitance * by_panel(room.receivers[k], corner, a, b, 1000);
      const ReceiverResult& one = result.receiver_results[k];
      figures.push_back({one.irradiance, one.standard_error, exact, 7e-5 * exact});
    }
    check(shadows ? "area light, with shadows" : "area light", compare(figures));
    CHECK(compare(figures).smallest_bias < 0.01);
    // The same half cylinders facing the other way.
    for (std::size_t k = 0; k < figures.size(); ++k) {
      Receiver turned = room.receivers[k];
      turned.facing *= -1.0;
      figures[k].expected = exitance * by_panel(turned, corner, a, b, 200);
    }
    check("turned", compare(figures), false);
  }
}

// A closed room all of whose surfaces emit the exitance M and reflect ρ has the radiance L = M/(π (1 − ρ)) everywhere
// and in all directions; so has a screen in it that reflects everything. E_z = E_sc = π L. On the screen a cylinder has
// half of that, and a half cylinder that faces away from it ∫ (1 + cos α) dα/2π = ½ + 1/π, from −π/2 to π/2.
TEST_CASE("receiver laws: uniform radiance, also on a surface") {
  const double rho = 0.6;
  const double exitance = 2.0;
  Room room = make_cuboid({2.0, 1.0, 1.5}, uniform_reflectance(rho));
  for (std::size_t k = 0; k < room.surfaces.size(); ++k)
    room.emitters.push_back(surface_emitter(k, exitance * surface_area(room.surfaces[k])));
  Surface screen = make_floor(0.6, 0.5);
  for (glm::dvec3& p : screen.positions) p = {0.9, 0.2 + p.z, 0.4 + p.x};
  screen.name = "screen";
  screen.reflectance = 1.0;
  room.surfaces.push_back(screen);
  room.receivers = around({1.4, 0.6, 0.5});
  const std::size_t free = room.receivers.size();
  const glm::dvec3 on_screen(0.9, 0.45, 0.7);
  const glm::dvec3 front =
      glm::normalize(glm::cross(screen.positions[screen.triangles[0].y] - screen.positions[screen.triangles[0].x],
                                screen.positions[screen.triangles[0].z] - screen.positions[screen.triangles[0].x]));
  room.receivers.push_back(cylinder(on_screen));
  room.receivers.push_back(half_cylinder(on_screen, front));
  room.receivers.push_back(half_cylinder(on_screen, -front));
  const double uniform = exitance / (1.0 - rho);
  std::vector<double> exact(room.receivers.size(), uniform);
  exact[free] = 0.5 * uniform;
  exact[free + 1] = (0.5 + 1.0 / pi) * uniform;
  exact[free + 2] = (0.5 - 1.0 / pi) * uniform;
  for (const ReceiverWalk walk : walks) {
    // The absorption estimator cannot score on the screen.
    for (const Estimator estimator : {Estimator::weight, Estimator::collision}) {
      const Result result = simulate(room, settings_for(walk, estimator, 6e4, 5));
      std::vector<Compared> figures;
      std::vector<Compared> whole;
      for (std::size_t k = 0; k < exact.size(); ++k) {
        const ReceiverResult& one = result.receiver_results[k];
        figures.push_back({one.irradiance, one.standard_error, exact[k]});
        if (k >= free) whole.push_back({one.irradiance, one.standard_error, uniform});
      }
      const std::string what = std::string(to_string(walk)) + ", " + std::string(to_string(estimator));
      const Judgement verdict = compare(figures, Deviations::correlated);
      check(what, verdict);
      CHECK(verdict.smallest_bias < (estimator == Estimator::weight ? 0.04 : 0.09));
      check(what + ", as if the screen were seen", compare(whole, Deviations::correlated), false);
    }
  }
}

TEST_CASE("receiver laws: the means of planar receivers, by all walks in a furnished room") {
  const Result planes =
      simulate(with_planes(furnished()), settings_for(ReceiverWalk::backward, Estimator::weight, 3e6, 7));
  const Room room = with_cylinders(furnished());
  for (const ReceiverWalk walk : walks) {
    for (const Estimator estimator : estimators) {
      const Result result = simulate(room, settings_for(walk, estimator, 2e5, 8));
      CHECK(result.receiver_walk.receiver_walk == walk);
      std::vector<Compared> figures = expected_by_planes(planes);
      take_values(figures, result);
      const std::string what = std::string(to_string(walk)) + ", " + std::string(to_string(estimator));
      const Judgement verdict = compare(figures, Deviations::correlated);
      check(what, verdict);
      const double largest_bias = estimator == Estimator::weight ? 0.035 : 0.1;
      CHECK(verdict.smallest_bias < largest_bias);
      for (Compared& one : figures) one.expected *= 1.0 + 2.0 * largest_bias;
      check(what + ", biased", compare(figures, Deviations::correlated), false);
    }
  }
}

TEST_CASE("receiver laws: half cylinders that face opposite directions add to twice the cylinder") {
  // A run for each receiver: independent.
  Room room = furnished();
  std::vector<Compared> figures;
  std::uint64_t seed = 40;
  for (const ReceiverWalk walk : walks) {
    for (const glm::dvec3& place : places) {
      for (const glm::dvec3& facing : {glm::dvec3(1, 0, 0), glm::dvec3(0.3, 0, -1)}) {
        Compared one;
        for (const Receiver& receiver :
             {cylinder(place), half_cylinder(place, facing), half_cylinder(place, -facing)}) {
          room.receivers = {receiver};
          const ReceiverResult result =
              simulate(room, settings_for(walk, Estimator::weight, 1e4, ++seed)).receiver_results[0];
          if (receiver.law == ReceiverLaw::cylindrical) {
            one.expected = 2.0 * result.irradiance;
            one.expected_error = 2.0 * result.standard_error;
          } else {
            one.value += result.irradiance;
            one.standard_error = std::hypot(one.standard_error, result.standard_error);
          }
        }
        figures.push_back(one);
      }
    }
  }
  const Judgement verdict = compare(figures);
  check("opposite half cylinders", verdict);
  CHECK(verdict.smallest_bias < 0.02);
  for (Compared& one : figures) one.expected *= 1.04;
  check("biased", compare(figures), false);
}

TEST_CASE("receiver laws: impulse responses have the light of the receivers") {
  Room room = furnished();
  room.quantity = Quantity::radiometric;
  room.receivers = around(places[1]);
  // One on the partition, which receives nothing from it.
  room.receivers.push_back(cylinder({1.0, 1.1, 2.0}));
  for (const ReceiverWalk walk : walks) {
    const Result plain = simulate(room, settings_for(walk, Estimator::weight, 3e5, 9));
    Settings settings = channel_settings(0.5e-9, 100e-9, 3e5, 10);
    settings.receiver_walk = walk;
    const Result timed = simulate(room, settings);
    REQUIRE(timed.channels);
    std::vector<Compared> figures;
    const double power = total_power(room);
    for (std::size_t k = 0; k < room.receivers.size(); ++k) {
      const Figure& gain = timed.channels->channels[k].gain;
      const ReceiverResult& one = plain.receiver_results[k];
      figures.push_back({gain.value * power, gain.standard_error * power, one.irradiance, one.standard_error});
    }
    const Judgement verdict = compare(figures, Deviations::correlated);
    check(std::string(to_string(walk)) + ", impulse responses", verdict);
    CHECK(verdict.smallest_bias < 0.03);
  }
}
