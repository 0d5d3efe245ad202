#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "lichtmc/cuboid.hpp"
#include "lichtmc/gltf.hpp"
#include "room/convexity.hpp"
#include "support/catch.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

bool convex(const Room& room) {
  return is_convex(WeldedMesh(room));
}

Room box(const glm::dvec3& size, const glm::dvec3& corner = glm::dvec3(0.0)) {
  Room room = make_cuboid(size, uniform_reflectance(0.5));
  for (Surface& wall : room.surfaces) {
    for (glm::dvec3& p : wall.positions) p += corner;
  }
  return room;
}

void add(Room& room, const Surface& surface) {
  room.surfaces.push_back(surface);
}

}  // namespace

TEST_CASE("cuboids and spheres are convex at any position and rotation") {
  CHECK(convex(box({5, 3, 4})));
  CHECK(convex(box({1e-4, 1, 1})));
  CHECK(convex(box({5, 3, 4}, {1e6, -1e6, 1e6})));
  Room turned = box({5, 3, 4});
  const glm::dquat turn = glm::normalize(glm::dquat(0.3, 0.5, -0.2, 0.7));
  for (Surface& wall : turned.surfaces) {
    for (glm::dvec3& p : wall.positions) p = glm::dvec3(glm::vec3(turn * p));  // rounded to float as in files
  }
  CHECK(convex(turned));
  Room sphere;
  add(sphere, make_sphere(32));
  CHECK(convex(sphere));
}

TEST_CASE("rooms with an object or a hole are not convex") {
  CHECK_FALSE(convex(read_gltf(std::string(LICHTMC_SCENES) + "/l_room.gltf")));
  CHECK_FALSE(convex(read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb")));
  // A box in a room, a box beside a room, a plate in a room, a room without its ceiling.
  Room room = box({5, 3, 4});
  for (const Surface& side : box({1, 1, 1}, {2, 1, 2}).surfaces) add(room, side);
  CHECK_FALSE(convex(room));
  room = box({5, 3, 4});
  for (const Surface& side : box({1, 1, 1}, {7, 1, 2}).surfaces) add(room, side);
  CHECK_FALSE(convex(room));
  room = box({5, 3, 4});
  Surface plate;
  add_quad(plate, {1, 1, 1}, {0, 0, 1}, {1, 0, 0});
  add(room, plate);
  CHECK_FALSE(convex(room));
  room = box({5, 3, 4});
  room.surfaces.erase(room.surfaces.begin() + 1);
  CHECK_FALSE(convex(room));
  CHECK_FALSE(convex(Room{}));
}

TEST_CASE("a dent makes a room not convex, one within rounding does not") {
  Room sphere;
  add(sphere, make_sphere(32));
  Room dented = sphere;
  // A corner of the middle band, with all its copies.
  const glm::dvec3 place = dented.surfaces[0].positions[dented.surfaces[0].triangles[1000].x];
  const auto pushed = [&](double depth) {
    Room room = sphere;
    for (glm::dvec3& p : room.surfaces[0].positions) {
      if (glm::length(p - place) < 1e-9) p *= 1.0 - depth;
    }
    return room;
  };
  CHECK(convex(pushed(1e-9)));
  CHECK_FALSE(convex(pushed(2e-2)));
}
