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

namespace {

Surface moved_box(const char* name, const glm::dvec3& corner, const glm::dvec3& size) {
  Surface box = make_box(size);
  for (glm::dvec3& p : box.positions) p += corner;
  box.name = name;
  return box;
}

// Two rooms of 4 m × 3 m (x, z), 2.5 m high, beside each other in solid walls, slab and ceiling; floor at y = 0.3.
Room two_rooms_in_solid_walls() {
  Room room;
  room.source = "building";
  room.surfaces = {moved_box("slab", {0, 0, 0}, {8.6, 0.3, 3.4}),
                   moved_box("ceiling", {0, 2.8, 0}, {8.6, 0.2, 3.4}),
                   moved_box("wall x0", {0, 0.3, 0}, {0.2, 2.5, 3.4}),
                   moved_box("wall between", {4.2, 0.3, 0.2}, {0.2, 2.5, 3.0}),
                   moved_box("wall x1", {8.4, 0.3, 0}, {0.2, 2.5, 3.4}),
                   moved_box("wall z0", {0.2, 0.3, 0}, {8.2, 2.5, 0.2}),
                   moved_box("wall z1", {0.2, 0.3, 3.2}, {8.2, 2.5, 0.2})};
  room.emitters = {{"left", 1000.0, IsotropicEmitter{{2.2, 2.6, 1.7}}},
                   {"right", 1000.0, IsotropicEmitter{{6.4, 2.6, 1.7}}}};
  return room;
}

}  // namespace

TEST_CASE("grid: heights count from the floor of each room of a building of solid walls") {
  Room room = two_rooms_in_solid_walls();
  ReceiverGrid grid = lay_receiver_grid(room, 0.75, 0.5);
  REQUIRE(grid.receivers.size() == 2 * 8 * 6);
  CHECK(grid.rooms == 2);
  REQUIRE(grid.floors_m.size() == 1);
  CHECK(grid.floors_m[0] == Approx(0.3));
  for (const Receiver& point : grid.receivers) CHECK(point.position.y == Approx(1.05));
  // Each grid is centred on its room.
  CHECK(grid.receivers[0].name == "grid1_0_0");
  CHECK(grid.receivers[0].position.x == Approx(0.45).margin(1e-5));
  CHECK(grid.receivers[0].position.z == Approx(0.45).margin(1e-5));
  CHECK(grid.receivers[48].name == "grid2_0_0");
  CHECK(grid.receivers[48].position.x == Approx(4.65).margin(1e-5));
  CHECK_THAT(description_of(grid, 0.75),
             ContainsSubstring("96 receivers of the grid 0.75 m above the floor at y = 0.3 m, in 2 rooms."));
  // Without its lamp, the second room is dark.
  room.emitters.pop_back();
  CHECK(lay_receiver_grid(room, 0.75, 0.5).receivers.size() == 48);
}

TEST_CASE("grid: points on a table top are lifted onto it, points in a cupboard are left out and counted") {
  Room room = make_cuboid({4.0, 2.5, 3.0}, uniform_reflectance(0.5));
  // A table top of 4 cm on nothing, its upper side as a float: 0.75 is not one exactly in most sums.
  room.surfaces.push_back(moved_box("table", {1.0, 0.71, 1.0}, {1.0, 0.04000001, 0.5}));
  room.surfaces.push_back(moved_box("cupboard", {0.0, 0.0, 2.5}, {2.0, 2.0, 0.5}));
  const ReceiverGrid grid = lay_receiver_grid(room, 0.75, 0.25);
  CHECK(grid.on_surfaces == 8);
  CHECK(grid.inside_furniture == 16);
  CHECK(grid.inside_walls == 0);
  CHECK(grid.receivers.size() == 16 * 12 - 16);
  for (const Receiver& point : grid.receivers) CHECK(point.position.y == Approx(0.75).margin(1e-6));
  CHECK_THAT(description_of(grid, 0.75),
             ContainsSubstring("8 of them on table tops or the like") &&
                 ContainsSubstring("Left out: 16 points inside furniture or other bodies."));
}

TEST_CASE("grid: storeys and podiums have floors of their own, beds have none") {
  Room room = make_cuboid({6.0, 3.0, 5.0}, uniform_reflectance(0.5));
  room.surfaces.push_back(moved_box("podium", {0.0, 0.0, 0.0}, {6.0, 0.5, 2.0}));
  room.surfaces.push_back(moved_box("bed", {4.0, 0.0, 3.0}, {1.0, 0.5, 2.0}));
  Room above = make_cuboid({6.0, 3.0, 5.0}, uniform_reflectance(0.5));
  for (Surface& surface : above.surfaces) {
    for (glm::dvec3& p : surface.positions) p.y += 3.2;
    surface.name += " above";
    room.surfaces.push_back(surface);
  }
  room.emitters = {{"below", 1000.0, IsotropicEmitter{{3.0, 2.8, 2.5}}},
                   {"above", 1000.0, IsotropicEmitter{{3.0, 6.0, 2.5}}}};
  const ReceiverGrid grid = lay_receiver_grid(room, 0.85, 0.5);
  CHECK(grid.rooms == 2);
  CHECK(grid.receivers.size() == 2 * 120);
  REQUIRE(grid.floors_m.size() == 3);
  CHECK(grid.floors_m[1] == Approx(0.5));
  std::size_t on_podium = 0;
  for (const Receiver& point : grid.receivers) {
    on_podium += std::size_t{point.position.y == Approx(1.35)};
    if (point.position.x > 4.0 && point.position.x < 5.0 && point.position.z > 3.0 && point.position.y < 3.0)
      CHECK(point.position.y == Approx(0.85));  // above the bed, from the floor
  }
  CHECK(on_podium == 12 * 4);
}

TEST_CASE("grid: a point above a ramp is at its height above the ramp") {
  Room room = make_cuboid({6.0, 4.0, 3.0}, uniform_reflectance(0.5));
  for (glm::dvec3& p : room.surfaces[surface_number(room, "floor")].positions) p.y = p.x / 6.0;
  const std::vector<Receiver> points = receiver_grid(room, 0.5, 0.5);
  CHECK(points.size() == 12 * 6);
  for (const Receiver& point : points) CHECK(point.position.y == Approx(0.5 + point.position.x / 6.0).margin(1e-6));
}

TEST_CASE("grid: invalid heights and spacings are refused") {
  const Room room = make_cuboid({2.0, 2.0, 2.0}, uniform_reflectance(0.5));
  CHECK_THROWS_WITH(receiver_grid(room, 0.5, 0.0), ContainsSubstring("--grid-spacing"));
  CHECK_THROWS_WITH(receiver_grid(room, std::numeric_limits<double>::quiet_NaN(), 0.5), ContainsSubstring("--grid"));
  CHECK_THROWS_WITH(receiver_grid(room, 0.5, 1e-6), ContainsSubstring("1e7"));
  CHECK_THROWS_WITH(receiver_grid(room, -1.0, 0.5), ContainsSubstring("No point"));
}
