// A grid of points above the floor: inside the room, not outside it and not inside furniture.
#include <cmath>
#include <limits>
#include <string>

#include "lichtmc/error.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

TEST_CASE("grid: an empty room has a point at the centre of every square") {
  const Room room = make_cuboid({3.0, 2.5, 2.0}, uniform_reflectance(0.5));
  const std::vector<Receiver> points = receiver_grid(room, 0.85, 0.5);
  REQUIRE(points.size() == 24);
  for (const Receiver& point : points) {
    CHECK(point.position.y == Approx(0.85));
    CHECK(point.normal == glm::dvec3(0.0, 1.0, 0.0));
    CHECK(point.position.x > 0.2);
    CHECK(point.position.x < 2.8);
  }
  CHECK(points[0].position.x == Approx(0.25));
  CHECK(points[0].position.z == Approx(0.25));
  CHECK(points[0].name == "grid_0_0");
}

TEST_CASE("grid: an L-shaped room has no points in its notch") {
  const Room room = read_gltf(std::string(LICHTMC_SCENES) + "/l_room.gltf");
  const std::vector<Receiver> points = receiver_grid(room, 0.5, 0.25);
  CHECK(points.size() == 48);  // three of four squares of 1 m, 16 points each
  for (const Receiver& point : points) CHECK_FALSE((point.position.x > 1.0 && point.position.z > 1.0));
}

TEST_CASE("grid: no points inside a closed piece of furniture, but on top of it") {
  Room room = make_cuboid({2.0, 2.0, 2.0}, uniform_reflectance(0.5));
  Surface box = make_box(glm::dvec3(0.5, 0.8, 0.5));
  for (glm::dvec3& p : box.positions) p += glm::dvec3(1.0, 0.0, 1.0);
  box.name = "cupboard";
  room.surfaces.push_back(box);
  const std::vector<Receiver> low = receiver_grid(room, 0.5, 0.25);
  CHECK(low.size() == 60);
  for (const Receiver& point : low) {
    const glm::dvec3& p = point.position;
    CHECK_FALSE((p.x > 1.0 && p.x < 1.5 && p.z > 1.0 && p.z < 1.5));
  }
  CHECK(receiver_grid(room, 1.0, 0.25).size() == 64);
}

TEST_CASE("grid: invalid heights and spacings are refused") {
  const Room room = make_cuboid({2.0, 2.0, 2.0}, uniform_reflectance(0.5));
  CHECK_THROWS_WITH(receiver_grid(room, 0.5, 0.0), ContainsSubstring("--grid-spacing"));
  CHECK_THROWS_WITH(receiver_grid(room, std::numeric_limits<double>::quiet_NaN(), 0.5), ContainsSubstring("--grid"));
  CHECK_THROWS_WITH(receiver_grid(room, 0.5, 1e-6), ContainsSubstring("1e7"));
  CHECK_THROWS_WITH(receiver_grid(room, -1.0, 0.5), ContainsSubstring("No point"));
}
