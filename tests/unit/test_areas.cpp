// The points of calculation areas: working planes, drawn areas, areas on surfaces.
#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "lichtmc/lichtmc.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

AreaProperties named(const std::string& name) {
  AreaProperties properties;
  properties.name = name;
  return properties;
}

AreaProperties with_spacing(const std::string& name, double spacing_m) {
  AreaProperties properties = named(name);
  properties.spacing_m = spacing_m;
  return properties;
}

Surface box_at(const char* name, const glm::dvec3& corner, const glm::dvec3& size) {
  Surface box = make_box(size);
  for (glm::dvec3& p : box.positions) p += corner;
  box.name = name;
  return box;
}

// A face with a corner and two edges, counter-clockwise seen from u × v.
AreaRequest request(AreaProperties properties, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
  return {std::move(properties), {{corner, corner + u, corner + u + v}, {corner, corner + u + v, corner + v}}};
}

// 5 m × 4 m (x, z), 3 m high.
Room office() {
  Room room = make_cuboid({5.0, 3.0, 4.0}, uniform_reflectance(0.5));
  room.emitters = {isotropic({2.5, 2.8, 2.0})};
  return room;
}

std::uint64_t left_out(const Area& area, const std::string& why) {
  for (const AreaLeftOut& one : area.left_out) {
    if (one.why == why) return one.points;
  }
  return 0;
}

// Rooms of 4 m × 3 m (x, z), 2.5 m high, in solid walls of 0.2 m: a door of 0.9 m × 2 m, whose lintel is a body, joins
// them.
Room two_rooms_with_a_door() {
  Room room;
  room.source = "flat";
  room.surfaces = {box_at("slab", {0, 0, 0}, {8.6, 0.3, 3.4}),
                   box_at("ceiling", {0, 2.8, 0}, {8.6, 0.2, 3.4}),
                   box_at("wall x0", {0, 0.3, 0}, {0.2, 2.5, 3.4}),
                   box_at("wall between a", {4.2, 0.3, 0.2}, {0.2, 2.5, 1.0}),
                   box_at("wall between b", {4.2, 0.3, 2.1}, {0.2, 2.5, 1.1}),
                   box_at("lintel", {4.2, 2.3, 1.2}, {0.2, 0.5, 0.9}),
                   box_at("wall x1", {8.4, 0.3, 0}, {0.2, 2.5, 3.4}),
                   box_at("wall z0", {0.2, 0.3, 0}, {8.2, 2.5, 0.2}),
                   box_at("wall z1", {0.2, 0.3, 3.2}, {8.2, 2.5, 0.2})};
  room.emitters = {isotropic({2.2, 2.6, 1.7}, 1000.0)};
  return room;
}

}  // namespace

TEST_CASE("areas: a working plane covers a cuboid room less its margin") {
  Room room = office();
  lay_working_planes(room, 0.75, with_spacing("plane", 0.5));
  REQUIRE(room.areas.size() == 1);
  const Area& area = room.areas[0];
  CHECK(area.columns == 8);
  CHECK(area.rows == 6);
  CHECK(area.cells.size() == 48);
  CHECK(area.left_out.empty());
  CHECK(area.quantity == AreaQuantity::horizontal);
  CHECK(area.above_floor_m == Approx(0.75));
  CHECK(glm::length(area.corner - glm::dvec3(0.5, 0.75, 0.5)) < 1e-5);
  CHECK(glm::length(area.u - glm::dvec3(0.5, 0.0, 0.0)) < 1e-5);
  CHECK(glm::length(area.v - glm::dvec3(0.0, 0.0, 0.5)) < 1e-5);
  REQUIRE(room.receivers.size() == 48);
  CHECK(room.receivers[0].name == "plane_0_0");
  CHECK(room.receivers[47].name == "plane_7_5");
  CHECK(glm::length(room.receivers[9].position - area.centre(9)) < 1e-9);
  CHECK(area.outline.size() == 4);
  CHECK_THAT(description_of(area),
             ContainsSubstring("48 points of 8 × 6, spacing 0.5 m × 0.5 m, 0.75 m above the floor at y = 0 m."));
  check_room(room);
  // The grid of the standard: 4 m × 3 m, p = 0.527 m.
  lay_working_planes(room, 0.75, named("standard"));
  CHECK(room.areas[1].columns == 8);
  CHECK(room.areas[1].rows == 6);
  CHECK(room.areas[1].first_receiver == 48);
  CHECK_THROWS_WITH(lay_working_planes(room, 0.75, named("standard")), ContainsSubstring("two calculation areas"));
}

TEST_CASE("areas: the grid of a rotated room is turned with it") {
  Room room = office();
  const double angle = 0.4;
  const auto turned = [angle](const glm::dvec3& p) {
    return glm::dvec3(std::cos(angle) * p.x - std::sin(angle) * p.z, p.y,
                      std::sin(angle) * p.x + std::cos(angle) * p.z);
  };
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& p : surface.positions) p = turned(p);
  }
  room.emitters = {isotropic(turned({2.5, 2.8, 2.0}))};
  lay_working_planes(room, 0.75, with_spacing("plane", 0.5));
  REQUIRE(room.areas.size() == 1);
  const Area& area = room.areas[0];
  CHECK(area.cells.size() == 48);
  CHECK(area.outline.size() == 4);
  // A direction within 45° of x: u may be the shorter or the longer side.
  CHECK(std::max(area.columns, area.rows) == 8);
  CHECK(glm::length(area.u) == Approx(0.5).margin(1e-4));
  CHECK(std::abs(glm::dot(area.u, area.v)) < 1e-9);
  std::vector<Receiver> points = room.receivers;
  for (const Receiver& point : points) {
    const glm::dvec3& p = point.position;
    const double x = std::cos(angle) * p.x + std::sin(angle) * p.z;
    CHECK(std::abs(x * 4.0 - std::round(x * 4.0)) < 1e-3);  // 0.75, 1.25 …
  }
}

TEST_CASE("areas: a furnished office with a window and a door in solid walls, in any direction") {
  const Room office_of_file = read_gltf(std::string(LICHTMC_TEST_DATA) + "/office.glb");  // 6 m × 5 m
  for (const double angle : {0.0, 0.127, 0.52}) {
    INFO(angle);
    const auto turned = [angle](const glm::dvec3& p) {
      return glm::dvec3(std::cos(angle) * p.x - std::sin(angle) * p.z, p.y,
                        std::sin(angle) * p.x + std::cos(angle) * p.z);
    };
    Room room = office_of_file;
    for (Surface& surface : room.surfaces) {
      for (glm::dvec3& p : surface.positions) p = turned(p);
    }
    room.emitters = {isotropic(turned({3.0, 2.0, -2.5}))};
    room.receivers.clear();
    lay_working_planes(room, 0.75, with_spacing("plane", 0.5));
    REQUIRE(room.areas.size() == 1);
    const Area& area = room.areas[0];
    CHECK(area.cells.size() == 80);
    CHECK(area.outline.size() == 4);
    CHECK(area.notes.size() == 1);  // points on table tops
    const glm::dvec3 middle = area.corner + 0.5 * (1.0 * area.columns * area.u + 1.0 * area.rows * area.v);
    CHECK(glm::length(middle - turned({3.0, 0.75, -2.5})) < 1e-3);
  }
}

TEST_CASE("areas: a working plane follows an L-shaped room, and its margin the notch") {
  const Room l_room = read_gltf(std::string(LICHTMC_SCENES) + "/l_room.gltf");  // three of four squares of 1 m
  Room room = l_room;
  AreaProperties properties = with_spacing("plane", 0.25);
  properties.margin_m = 0.0;
  lay_working_planes(room, 0.5, properties);
  REQUIRE(room.areas.size() == 1);
  CHECK(room.areas[0].cells.size() == 48);
  CHECK(left_out(room.areas[0], "outside its outline") == 16);
  CHECK(room.areas[0].outline.size() == 6);
  room = l_room;
  properties.margin_m = 0.25;
  lay_working_planes(room, 0.5, properties);
  // 6 × 6 points, 0.375 … 1.625; outside: 9; near the notch's walls: 0.875 beside them.
  CHECK(room.areas[0].columns == 6);
  CHECK(left_out(room.areas[0], "outside its outline") == 9);
  CHECK(left_out(room.areas[0], "within 0.25 m of a wall") == 7);
}

TEST_CASE("areas: closed rooms, and rooms with a door between them, have working planes of their own") {
  Room room = two_rooms_with_a_door();
  lay_working_planes(room, 0.75, with_spacing("plane", 0.5));
  REQUIRE(room.areas.size() == 2);
  for (const Area& area : room.areas) {
    CHECK(area.columns == 6);
    CHECK(area.rows == 4);
    CHECK(area.cells.size() == 24);
    CHECK(area.corner.y == Approx(1.05));
  }
  CHECK(room.areas[0].properties.name == "plane_1");
  CHECK(room.areas[0].corner.x == Approx(0.7).margin(1e-5));
  CHECK(room.areas[1].properties.name == "plane_2");
  CHECK(room.areas[1].corner.x == Approx(4.9).margin(1e-5));
  CHECK(room.areas[1].corner.z == Approx(0.7).margin(1e-5));
}

TEST_CASE("areas: storeys, podiums and galleries have working planes of their own, a ramp is followed") {
  Room room = make_cuboid({6.0, 3.0, 5.0}, uniform_reflectance(0.5));
  room.surfaces.push_back(box_at("podium", {0.0, 0.0, 0.0}, {6.0, 0.5, 2.0}));
  Room above = make_cuboid({6.0, 3.0, 5.0}, uniform_reflectance(0.5));
  for (Surface& surface : above.surfaces) {
    for (glm::dvec3& p : surface.positions) p.y += 3.2;
    surface.name += " above";
    room.surfaces.push_back(surface);
  }
  room.emitters = {isotropic({3.0, 2.8, 2.5}), isotropic({3.0, 6.0, 2.5})};
  lay_working_planes(room, 0.75, with_spacing("plane", 0.5));
  REQUIRE(room.areas.size() == 3);
  CHECK(room.areas[0].corner.y == Approx(0.75));
  CHECK(room.areas[0].corner.z == Approx(2.5));
  CHECK(room.areas[0].cells.size() == 10 * 4);
  CHECK(room.areas[1].corner.y == Approx(1.25));
  CHECK(room.areas[1].cells.size() == 10 * 2);
  CHECK(room.areas[2].corner.y == Approx(3.95));
  CHECK(room.areas[2].cells.size() == 10 * 8);

  Room ramp = make_cuboid({6.0, 4.0, 3.0}, uniform_reflectance(0.5));
  ramp.emitters = {isotropic({3.0, 3.8, 1.5})};
  for (glm::dvec3& p : ramp.surfaces[surface_number(ramp, "floor")].positions) p.y = p.x / 6.0;
  lay_working_planes(ramp, 0.5, with_spacing("plane", 0.5));
  REQUIRE(ramp.areas.size() == 1);
  CHECK(ramp.areas[0].cells.size() == 10 * 4);
  for (const Receiver& point : ramp.receivers)
    CHECK(point.position.y == Approx(0.5 + point.position.x / 6.0).margin(1e-6));
  CHECK_THAT(description_of(ramp.areas[0]), ContainsSubstring("Its floor lies between y = "));
}

TEST_CASE("areas: what the usual margin cuts off an area that is drawn is told") {
  Room room = office();
  AreaProperties properties = named("desk");
  room.area_requests = {request(properties, {0, 0.75, 0}, {1.6, 0, 0}, {0, 0, 0.8})};
  properties.name = "inner";
  room.area_requests.push_back(request(properties, {1, 0.75, 1}, {1.6, 0, 0}, {0, 0, 0.8}));
  properties.name = "asked for";
  properties.margin_m = 0.5;
  room.area_requests.push_back(request(properties, {0, 0.75, 0}, {1.6, 0, 0}, {0, 0, 0.8}));
  lay_areas(room);
  lay_working_planes(room, 0.75, named("plane"));
  const Area& desk = room.areas.at(0);
  CHECK(desk.left_out.empty());  // the grid is smaller
  CHECK(is_cut_by_usual_margin(desk));
  CHECK(misplaced_points(desk) == 0);
  CHECK(desk.notes ==
        std::vector<std::string>{"The usual margin of 0.5 m from walls leaves 1.1 m × 0.3 m of its 1.6 m × 0.8 m."});
  for (const std::size_t k : {1U, 2U, 3U}) CHECK(room.areas.at(k).notes.empty());
  CHECK_FALSE(is_cut_by_usual_margin(room.areas.at(1)));
  CHECK_FALSE(is_cut_by_usual_margin(room.areas.at(2)));
  // Drawn askew, 1 m of it outside the room.
  properties = with_spacing("askew", 0.25);
  room.area_requests = {request(properties, {-0.7, 0.75, 2.0}, {1, 0, 1}, {1, 0, -1})};
  lay_areas(room);
  CHECK(is_cut_by_usual_margin(room.areas.back()));
  properties.name = "task";
  properties.role = "task";
  room.area_requests = {request(properties, {-0.7, 0.75, 2.0}, {1, 0, 1}, {1, 0, -1})};
  lay_areas(room);
  CHECK_FALSE(is_cut_by_usual_margin(room.areas.back()));
  CHECK(misplaced_points(room.areas.back()) > 0);
}

TEST_CASE("areas: furniture is no wall, and points in it are left out and told") {
  Room room = office();
  room.surfaces.push_back(box_at("table", {1.0, 0.71, 1.0}, {1.0, 0.04000001, 0.5}));
  room.surfaces.push_back(box_at("cupboard", {0.0, 0.0, 3.5}, {2.0, 2.0, 0.5}));
  AreaProperties properties = with_spacing("plane", 0.25);
  properties.margin_m = 0.0;
  lay_working_planes(room, 0.75, properties);
  REQUIRE(room.areas.size() == 1);
  const Area& area = room.areas[0];
  CHECK(area.columns == 20);
  CHECK(area.rows == 16);
  CHECK(left_out(area, "inside furniture, walls or other bodies") == 16);
  CHECK(area.cells.size() == 320 - 16);
  CHECK_THAT(description_of(area),
             ContainsSubstring("8 of its points lie on table tops or the like.") &&
                 ContainsSubstring("Left out: 16 points inside furniture, walls or other bodies."));
  CHECK(area.outline.size() == 4);
}

TEST_CASE("areas: pendants, beams and low partitions are no walls; pillars and thin walls are") {
  Room room = office();
  room.surfaces.push_back(box_at("pendant", {2.7, 2.5, 1.5}, {1.2, 0.4, 0.6}));
  room.surfaces.push_back(box_at("beam", {0.0, 2.6, 3.0}, {5.0, 0.4, 0.3}));
  room.surfaces.push_back(box_at("screen", {2.5, 0.0, 0.0}, {0.04, 1.4, 1.5}));
  AreaProperties properties = with_spacing("plane", 0.5);
  lay_working_planes(room, 0.75, properties);
  REQUIRE(room.areas.size() == 1);
  CHECK(room.areas[0].columns == 8);
  CHECK(room.areas[0].rows == 6);
  CHECK(left_out(room.areas[0], "within 0.5 m of a wall") == 0);
  CHECK(room.areas[0].outline.size() == 4);
  Room divided = office();
  divided.surfaces.push_back(box_at("thin wall", {1.96, 0.0, 0.0}, {0.08, 3.0, 2.5}));
  lay_working_planes(divided, 0.75, properties);
  REQUIRE(divided.areas.size() == 1);
  CHECK(divided.areas[0].columns == 8);
  CHECK(left_out(divided.areas[0], "within 0.5 m of a wall") > 4);
  for (const Receiver& point : divided.receivers) {
    const glm::dvec3& p = point.position;
    const glm::dvec2 from(std::max({1.96 - p.x, 0.0, p.x - 2.04}), std::max(p.z - 2.5, 0.0));
    CHECK(glm::length(from) > 0.4);
  }
}

TEST_CASE("areas: a room without a lamp is told, and that no light gets to an area in it") {
  const std::string note = " has no light and no working plane";
  Room open = two_rooms_with_a_door();
  lay_working_planes(open, 0.75, named("plane"));
  for (const Area& area : open.areas) CHECK_THAT(description_of(area), !ContainsSubstring("no working plane"));
  const auto with_fronts_outside = [](Room room) {
    for (Surface& surface : room.surfaces) {
      for (glm::uvec3& triangle : surface.triangles) std::swap(triangle.y, triangle.z);
    }
    return room;
  };
  Room closed = two_rooms_with_a_door();
  closed.surfaces.push_back(box_at("door", {4.25, 0.3, 1.2}, {0.1, 2.0, 0.9}));
  closed = with_fronts_outside(closed);
  Room with_area = closed;
  lay_working_planes(closed, 0.75, named("plane"));
  REQUIRE(closed.areas.size() == 1);
  CHECK_THAT(description_of(closed.areas[0]),
             ContainsSubstring("A room of about 11 m² around x = 6.4, y = 0.3, z = 1.7 m" + note));
  with_area.area_requests = {request(named("desk"), {6.0, 1.0, 1.5}, {0.0, 0.0, 0.5}, {1.0, 0.0, 0.0})};
  CHECK_THROWS_WITH(lay_areas(with_area),
                    ContainsSubstring("in a room where no light gets). Add a lamp there, or move the area."));
  // A canopy outside, and a solid core of a building.
  Room outside = two_rooms_with_a_door();
  outside.surfaces.push_back(box_at("canopy", {8.6, 2.8, 0.0}, {4.0, 0.2, 3.4}));
  outside.surfaces.push_back(box_at("terrace", {8.6, 0.0, 0.0}, {4.0, 0.3, 3.4}));
  outside = with_fronts_outside(outside);
  lay_working_planes(outside, 0.75, named("plane"));
  for (const Area& area : outside.areas) CHECK_THAT(description_of(area), !ContainsSubstring(note));
  Room around_core = office();
  Room core;
  core.surfaces = {box_at("core", {0.0, 0.0, 0.0}, {2.2, 3.0, 2.2})};
  around_core.surfaces.push_back(with_fronts_outside(core).surfaces[0]);
  lay_working_planes(around_core, 0.75, named("plane"));
  for (const Area& area : around_core.areas) CHECK_THAT(description_of(area), !ContainsSubstring(note));
}

TEST_CASE("areas: a thin wall with a door divides a room, one with a wide opening does not") {
  const auto divided = [](double thickness, double opening) {
    Room room = make_cuboid({8.0, 3.0, 6.0}, uniform_reflectance(0.5));
    room.emitters = {isotropic({2.0, 2.8, 3.0}), isotropic({6.0, 2.8, 3.0})};
    const double x = 4.0 - 0.5 * thickness;
    const double end = 1.0 + opening;
    room.surfaces.push_back(box_at("wall a", {x, 0.0, 0.0}, {thickness, 3.0, 1.0}));
    room.surfaces.push_back(box_at("wall b", {x, 0.0, end}, {thickness, 3.0, 6.0 - end}));
    room.surfaces.push_back(box_at("lintel", {x, 2.1, 1.0}, {thickness, 0.9, opening}));
    lay_working_planes(room, 0.75, with_spacing("plane", 0.5));
    return room;
  };
  for (const double thickness : {0.02, 0.1, 0.24, 0.3, 0.5}) {
    INFO(thickness);
    const Room rooms = divided(thickness, 0.9);
    REQUIRE(rooms.areas.size() == 2);
    const double width = 3.0 - 0.5 * thickness;
    for (const Area& area : rooms.areas) {
      CHECK(area.u.x * area.columns == Approx(width).margin(1e-4));
      CHECK(area.cells.size() == std::size_t{area.columns} * area.rows);
      CHECK(area.outline.size() == 4);
    }
    CHECK(rooms.areas[1].corner.x == Approx(4.5 + 0.5 * thickness).margin(1e-4));
    const Room open = divided(thickness, 3.5);
    REQUIRE(open.areas.size() == 1);
    CHECK(open.areas[0].columns == 14);
    CHECK(left_out(open.areas[0], "within 0.5 m of a wall") > 0);
  }
}

TEST_CASE("areas: a drawn area keeps a band along walls, a task area does not") {
  Room room = office();
  AreaProperties whole = with_spacing("surrounding", 0.5);
  whole.role = "surrounding";
  AreaProperties task = with_spacing("task", 0.5);
  task.role = "task";
  task.target_lx = 500.0;
  room.area_requests = {request(whole, {0.0, 0.75, 0.0}, {5.0, 0.0, 0.0}, {0.0, 0.0, 4.0}),
                        request(task, {0.0, 0.75, 0.0}, {5.0, 0.0, 0.0}, {0.0, 0.0, 4.0})};
  lay_areas(room);
  CHECK(room.area_requests.empty());
  REQUIRE(room.areas.size() == 2);
  CHECK(room.areas[0].columns == 8);
  CHECK(room.areas[0].rows == 6);
  CHECK(room.areas[0].margin_m == 0.5);
  CHECK(room.areas[1].columns == 10);
  CHECK(room.areas[1].rows == 8);
  CHECK(room.areas[1].properties.target_lx == 500.0);
  // Its face looks down: what is measured is the light from above.
  CHECK(room.areas[0].normal == glm::dvec3(0.0, 1.0, 0.0));
  CHECK(room.receivers[0].normal == glm::dvec3(0.0, 1.0, 0.0));
  CHECK(room.areas[0].above_floor_m == Approx(0.75));
}

TEST_CASE("areas: cells outside a drawn outline are left out") {
  Room room = office();
  AreaRequest drawn;
  drawn.properties = with_spacing("triangle", 0.25);
  drawn.properties.role = "task";
  drawn.triangles = {{glm::dvec3(1.0, 0.8, 1.0), glm::dvec3(2.0, 0.8, 1.0), glm::dvec3(1.0, 0.8, 2.0)}};
  room.area_requests = {drawn};
  lay_areas(room);
  REQUIRE(room.areas.size() == 1);
  CHECK(room.areas[0].columns == 4);
  CHECK(room.areas[0].cells.size() + left_out(room.areas[0], "outside its outline") == 16);
  CHECK(room.areas[0].cells.size() == 10);  // the points on its long side belong to it
  CHECK(room.areas[0].outline.size() == 3);
}

TEST_CASE("areas: a drawn area of many faces has the points of one of two") {
  Room room = office();
  AreaRequest fine;
  fine.properties = with_spacing("fine", 0.25);
  fine.properties.role = "task";
  constexpr int n = 20;
  const double edge = 2.0 / n;
  for (int k = 0; k < n * n; ++k) {
    const glm::dvec3 corner(1.0 + k % n * edge, 0.8, 1.0 + k / n * edge);
    const AreaRequest cell = request({}, corner, {edge, 0.0, 0.0}, {0.0, 0.0, edge});
    fine.triangles.insert(fine.triangles.end(), cell.triangles.begin(), cell.triangles.end());
  }
  room.area_requests = {fine};
  lay_areas(room);
  CHECK(room.areas[0].columns == 8);
  CHECK(room.areas[0].cells.size() == 64);
  CHECK(room.areas[0].outline.size() == 4 * n);
}

TEST_CASE("areas: vertical and ceiling areas measure on the side of their normals, which must look into the room") {
  Room room = office();
  AreaProperties wall = with_spacing("wall", 0.5);
  wall.role = "wall";
  AreaProperties ceiling = with_spacing("ceiling", 0.5);
  ceiling.role = "ceiling";
  ceiling.margin_m = 0.0;
  room.area_requests = {request(wall, {0.0, 0.5, 1.0}, {0.0, 2.0, 0.0}, {0.0, 0.0, 2.0}),
                        request(ceiling, {1.0, 3.0, 1.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, 2.0})};
  const Room requested = room;
  lay_areas(room);
  REQUIRE(room.areas.size() == 2);
  CHECK(room.areas[0].normal == glm::dvec3(1.0, 0.0, 0.0));
  CHECK(room.areas[0].quantity == AreaQuantity::normal);
  CHECK(room.areas[0].cells.size() == 16);
  // Rows go down.
  CHECK(room.areas[0].v.y == Approx(-0.5));
  CHECK(room.receivers[0].normal == glm::dvec3(1.0, 0.0, 0.0));
  CHECK(room.areas[1].normal == glm::dvec3(0.0, -1.0, 0.0));
  CHECK(room.areas[1].cells.size() == 16);
  for (const Area& area : room.areas) {
    const glm::dvec3 across = glm::cross(area.u, area.v);
    CHECK(glm::dot(across, area.normal) == Approx(-glm::length(across)));
  }
  for (const std::size_t turned : {std::size_t{0}, std::size_t{1}}) {
    room = requested;
    for (auto& triangle : room.area_requests[turned].triangles) std::swap(triangle[1], triangle[2]);
    CHECK_THROWS_WITH(lay_areas(room), ContainsSubstring("the room is behind it") && ContainsSubstring("Flip"));
  }
}

TEST_CASE("areas: on a surface, less a margin along its edges; covered parts are left out") {
  Room room = office();
  room.surfaces.push_back(box_at("cupboard", {0.0, 0.0, 3.0}, {2.0, 2.0, 1.0}));
  AreaProperties properties = with_spacing("", 0.5);
  lay_area_on(room, "floor", properties);
  REQUIRE(room.areas.size() == 1);
  CHECK(room.areas[0].properties.name == "floor");
  CHECK(room.areas[0].columns == 10);
  CHECK(room.areas[0].cells.size() == 80 - 8);
  CHECK(left_out(room.areas[0], "covered, or where no light gets") == 8);
  properties.margin_m = 0.5;
  properties.name = "by the window";
  lay_area_on(room, "wall_x1", properties);
  REQUIRE(room.areas.size() == 2);
  CHECK(room.areas[1].normal == glm::dvec3(-1.0, 0.0, 0.0));
  CHECK(room.areas[1].columns == 6);
  CHECK(room.areas[1].rows == 4);
  CHECK(room.areas[1].cells.size() == 24);
  properties = with_spacing("top", 0.5);
  lay_area_on(room, "ceiling", properties);
  CHECK(room.areas[2].normal == glm::dvec3(0.0, -1.0, 0.0));
  CHECK(room.areas[2].quantity == AreaQuantity::normal);
  CHECK_THROWS_WITH(lay_area_on(room, "cupboard", with_spacing("box", 0.5)), ContainsSubstring("is not flat"));
  CHECK_THROWS_WITH(lay_area_on(room, "wal", properties), ContainsSubstring("'wall_x0'"));
  check_room(room);
}

TEST_CASE("areas: of a table top, the upper side") {
  Room room = office();
  room.surfaces.push_back(box_at("table", {1.0, 0.71, 1.0}, {1.6, 0.04, 0.8}));
  lay_area_on(room, "table", named("table"));
  CHECK(room.areas[0].normal == glm::dvec3(0.0, 1.0, 0.0));
  CHECK(room.areas[0].corner.y == Approx(0.75));
  CHECK(room.areas[0].columns == 10);
  CHECK(room.areas[0].rows == 5);
}

TEST_CASE("areas: the quantity decides on the law of the receivers") {
  Room room = office();
  const auto lay = [&room](AreaProperties properties) {
    room.area_requests = {request(std::move(properties), {1.0, 1.2, 1.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0})};
    lay_areas(room);
    return room.receivers[room.areas.back().first_receiver];
  };
  AreaProperties properties = with_spacing("cylindrical", 0.5);
  properties.quantity = AreaQuantity::cylindrical;
  CHECK(lay(properties).law == ReceiverLaw::cylindrical);
  properties.name = "half";
  properties.quantity = AreaQuantity::semicylindrical;
  room.area_requests.clear();
  CHECK_THROWS_WITH(lay(properties), ContainsSubstring("The direction of the calculation area 'half'"));
  properties.direction = glm::dvec3(0.0, 3.0, -2.0);
  const Receiver half = lay(properties);
  CHECK(half.law == ReceiverLaw::semicylindrical);
  CHECK(half.facing == glm::dvec3(0.0, 0.0, -1.0));
  CHECK(half.normal == glm::dvec3(0.0, 1.0, 0.0));
  properties.name = "cells of half";
  properties.cells = true;
  CHECK_THROWS_WITH(lay(properties), ContainsSubstring("means over its cells"));
  properties.name = "cells";
  properties.direction.reset();
  properties.quantity.reset();
  const Receiver cell = lay(properties);
  CHECK(cell.cell_u == room.areas.back().u);
  CHECK(cell.cell_v == room.areas.back().v);
}

TEST_CASE("areas: bad areas are refused with their names") {
  const Room plain = office();
  const auto refused = [&plain](AreaRequest bad, const std::string& says) {
    Room room = plain;
    room.area_requests = {std::move(bad)};
    CHECK_THROWS_WITH(lay_areas(room), ContainsSubstring(says));
  };
  const glm::dvec3 x(1.0, 0.0, 0.0);
  const glm::dvec3 z(0.0, 0.0, 1.0);
  refused(request(named(""), {1, 1, 1}, x, z), "has no name");
  refused(request(named("flat"), {1, 1, 1}, x, x), "area in m² of the calculation area 'flat' is 0");
  refused(request(named("outside"), {11, 1, 1}, x, z), "No point of the calculation area 'outside'");
  refused(request(named("below"), {1, -1, 1}, x, z), "No point of the calculation area 'below'");
  refused(request(with_spacing("fine", -1.0), {1, 1, 1}, x, z),
          "The spacing in m of the calculation area 'fine' is -1");
  AreaProperties properties = named("asks");
  properties.target_uniformity = 1.5;
  refused(request(properties, {1, 1, 1}, x, z), "target_uniformity");
  properties = named("wide");
  properties.margin_m = 3.0;
  refused(request(properties, {1, 1, 1}, x, z), "inside its margin of 3 m");
  AreaRequest folded = request(named("folded"), {1, 1, 1}, x, z);
  folded.triangles[1][2].y += 0.1;
  refused(folded, "do not lie in one plane");
  folded = request(named("mixed"), {1, 1, 1}, x, z);
  std::swap(folded.triangles[0][1], folded.triangles[0][2]);
  refused(folded, "do not look in one direction");
  Room room = plain;
  CHECK_THROWS_WITH(lay_working_planes(room, 9.0, named("plane")), ContainsSubstring("No point of the working plane"));
  CHECK_THROWS_AS(lay_working_planes(room, std::nan(""), named("plane")), InputError);
  room.area_requests = {request(named("desk"), {1, 1, 1}, x, z)};
  CHECK_THROWS_WITH(simulate(room, Settings{}), ContainsSubstring("Call lay_areas()"));
}
