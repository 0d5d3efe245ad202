// Cylinders and half cylinders as receivers: their directions, and what is refused.
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/geometric.hpp>

#include "chance/cylinder_directions.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "walk/reference_point.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;

ReferencePoint reference(ReceiverLaw law, const glm::dvec3& axis, const glm::dvec3& facing) {
  Receiver receiver{"at", {0, 0, 0}, axis};
  receiver.law = law;
  receiver.facing = facing;
  return reference_point_of(receiver);
}

Room with_cylinder() {
  Room room = unit_cube(0.5, paper_emitter());
  Receiver receiver{"face", {0.5, 0.2, 0.5}, {0, 1, 0}};
  receiver.law = ReceiverLaw::semicylindrical;
  receiver.facing = {1, 0, 0};
  room.receivers = {receiver};
  return room;
}

}  // namespace

TEST_CASE("receiver laws: x - sin x = m is solved to rounding") {
  for (int k = 1; k < 1000; ++k) {
    const double x = 2.0 * pi * k / 1000.0;
    // m has the rounding of numbers up to 2π, and dx/dm is 1/(1 − cos x).
    CHECK_THAT(cycloid_angle(x - std::sin(x)), Catch::Matchers::WithinAbs(x, 1e-12 + 2e-15 / (1.0 - std::cos(x))));
  }
  // x³/6 for small x: the solution keeps its relative accuracy.
  for (const double x : {1e-4, 1e-3, 1e-2, 0.05, 0.0999})
    CHECK_THAT(cycloid_angle(x * x * x / 6.0 * (1.0 - x * x / 20.0 * (1.0 - x * x / 42.0))),
               Catch::Matchers::WithinRel(x, 1e-10));
  CHECK(cycloid_angle(0.0) == 0.0);
}

// The mean of f over the directions is ∫ f w dω/π. Midpoints of n × n parts of the unit square: an error of some 1/n².
TEST_CASE("receiver laws: directions have the density of the weight") {
  constexpr int n = 400;
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.8, 0.5));
  const glm::dvec3 aside(1.0, 0.2, -0.4);
  for (const ReceiverLaw law : {ReceiverLaw::cylindrical, ReceiverLaw::semicylindrical}) {
    const bool is_half = law == ReceiverLaw::semicylindrical;
    const ReferencePoint at = reference(law, axis, aside);
    const glm::dvec3 facing = glm::normalize(aside - glm::dot(aside, axis) * axis);
    double along = 0.0;
    double along_squared = 0.0;
    double forward = 0.0;
    double forward_squared = 0.0;
    double across = 0.0;
    double inverse = 0.0;
    for (int k = 0; k < n * n; ++k) {
      const FirstFlight flight = first_flight(at, (k % n + 0.5) / n, (k / n + 0.5) / n);
      REQUIRE_THAT(glm::length(flight.direction), Catch::Matchers::WithinAbs(1.0, 1e-12));
      REQUIRE_THAT(flight.weight, Catch::Matchers::WithinAbs(at.weight(flight.direction), 1e-12));
      const double part = 1.0 / (n * n);
      along += part * glm::dot(flight.direction, axis);
      along_squared += part * std::pow(glm::dot(flight.direction, axis), 2);
      forward += part * glm::dot(flight.direction, facing);
      forward_squared += part * std::pow(glm::dot(flight.direction, facing), 2);
      across += part * glm::dot(flight.direction, glm::cross(axis, facing));
      // The weight of the cylinder over that of the half cylinder, 1/(1 + cos α), has no finite mean; its inverse has.
      inverse += part * flight.weight;
    }
    CHECK_THAT(along, Catch::Matchers::WithinAbs(0.0, 1e-4));
    CHECK_THAT(along_squared, Catch::Matchers::WithinAbs(0.25, 1e-4));  // of the coordinate of a point of a disc
    CHECK_THAT(across, Catch::Matchers::WithinAbs(0.0, 1e-4));
    CHECK_THAT(forward,
               Catch::Matchers::WithinAbs(is_half ? 4.0 / (3.0 * pi) : 0.0, 1e-4));  // ∫ sin³ε dε ∫ cos²α dα/π²
    CHECK_THAT(forward_squared, Catch::Matchers::WithinAbs(0.375, 1e-4));
    // ∫ w² dω/π = ∫ sin³ε dε ∫ (1 or 1 + cos α)² dα/π³ = 4/3 · (2π or 3π)/π³.
    CHECK_THAT(inverse, Catch::Matchers::WithinAbs(4.0 / 3.0 * (is_half ? 3.0 : 2.0) / (pi * pi), 1e-4));
  }
}

TEST_CASE("receiver laws: the weights by angle") {
  const ReferencePoint cylinder = reference(ReceiverLaw::cylindrical, {0, 2, 0}, {1, 0, 0});
  const ReferencePoint half = reference(ReceiverLaw::semicylindrical, {0, 2, 0}, {3, 7, 0});  // its level part counts
  const ReferencePoint plane = reference(ReceiverLaw::planar, {0, 2, 0}, {1, 0, 0});
  for (const double to_axis : {0.1, 1.0, 2.0, 3.0}) {
    for (const double about : {0.0, 1.0, 2.5, pi}) {
      const glm::dvec3 towards(std::sin(to_axis) * std::cos(about), std::cos(to_axis),
                               std::sin(to_axis) * std::sin(about));
      CHECK_THAT(cylinder.weight(towards), Catch::Matchers::WithinAbs(std::sin(to_axis) / pi, 1e-15));
      CHECK_THAT(half.weight(towards),
                 Catch::Matchers::WithinAbs(std::sin(to_axis) * (1.0 + std::cos(about)) / pi, 1e-15));
      CHECK_THAT(plane.weight(towards), Catch::Matchers::WithinAbs(std::max(0.0, std::cos(to_axis)), 1e-15));
    }
  }
}

TEST_CASE("receiver laws: what is refused") {
  CHECK_NOTHROW(check_room(with_cylinder()));
  Room room = with_cylinder();
  room.receivers[0].half_angle_deg = 60.0;
  CHECK_THROWS_WITH(check_room(room), ContainsSubstring("semicylindrical receiver 'face'") && ContainsSubstring("90"));
  room = with_cylinder();
  room.receivers[0].cell_u = {0.1, 0.0, 0.0};
  room.receivers[0].cell_v = {0.0, 0.0, 0.1};
  CHECK_THROWS_WITH(check_room(room), ContainsSubstring("cell") && ContainsSubstring("at points"));
  room = with_cylinder();
  room.receivers[0].concentrator_index = 1.5;
  CHECK_THROWS_WITH(check_room(room), ContainsSubstring("concentrator"));
  room = with_cylinder();
  room.receivers[0].facing = {0.0, -3.0, 0.0};
  CHECK_THROWS_WITH(check_room(room), ContainsSubstring("direction faced"));
  room.receivers[0].law = ReceiverLaw::cylindrical;
  CHECK_NOTHROW(check_room(room));
}

TEST_CASE("receiver laws: two rooms that differ in them have different fingerprints") {
  Room room = with_cylinder();
  const Fingerprint half = fingerprint(room);
  room.receivers[0].facing = {0, 0, 1};
  CHECK(fingerprint(room) != half);
  room.receivers[0].law = ReceiverLaw::cylindrical;
  const Fingerprint whole = fingerprint(room);
  CHECK(whole != half);
  room.receivers[0].facing = {1, 0, 0};  // of no meaning
  CHECK(fingerprint(room) == whole);
  room.receivers[0].law = ReceiverLaw::planar;
  CHECK(fingerprint(room) != whole);
}
