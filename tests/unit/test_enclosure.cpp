#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "lichtmc/cuboid.hpp"
#include "room/enclosure.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

namespace {

Room cube(double edge = 1.0, const glm::dvec3& corner = glm::dvec3(0.0)) {
  Room room = make_cuboid(glm::dvec3(edge), uniform_reflectance(0.5));
  for (Surface& wall : room.surfaces) {
    for (glm::dvec3& p : wall.positions) p += corner;
  }
  return room;
}

Room together(Room a, const Room& b) {
  a.surfaces.insert(a.surfaces.end(), b.surfaces.begin(), b.surfaces.end());
  return a;
}

// A sphere of radius 1 with 2n meridians and n parallels.
Room sphere(std::uint32_t n) {
  Room room;
  Surface& surface = room.surfaces.emplace_back();
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      const double theta = std::numbers::pi * i / n;
      const double phi = std::numbers::pi * j / n;
      // Every meridian has its own copy of the poles, at the same position: they are welded.
      const double r = i == 0 || i == n ? 0.0 : std::sin(theta);
      surface.positions.emplace_back(r * std::cos(phi), std::cos(theta), r * std::sin(phi));
    }
  }
  const auto id = [n](std::uint32_t i, std::uint32_t j) { return i * 2 * n + j % (2 * n); };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      surface.triangles.emplace_back(id(i, j), id(i, j + 1), id(i + 1, j));
      surface.triangles.emplace_back(id(i, j + 1), id(i + 1, j + 1), id(i + 1, j));
    }
  }
  return room;
}

// The walls of the plan [0, 2]² less [1, 2]², height 1, as prism of the polygon: not convex.
Room l_room() {
  const std::vector<glm::dvec2> plan{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 1}};
  Room room;
  Surface& surface = room.surfaces.emplace_back();
  const auto at = [](const glm::dvec2& p, double y) { return glm::dvec3(p.x, y, p.y); };
  const auto quad = [&surface](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    for (const glm::dvec3& p : {a, b, c, d}) surface.positions.push_back(p);
    surface.triangles.emplace_back(first, first + 1, first + 2);
    surface.triangles.emplace_back(first, first + 2, first + 3);
  };
  for (std::size_t k = 0; k < plan.size(); ++k) {
    const glm::dvec2 p = plan[k];
    const glm::dvec2 q = plan[(k + 1) % plan.size()];
    quad(at(p, 0.0), at(q, 0.0), at(q, 1.0), at(p, 1.0));
  }
  for (const glm::dvec2 p : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
    for (const double y : {0.0, 1.0})
      quad(at(p, y), at(p + glm::dvec2(1, 0), y), at(p + glm::dvec2(1, 1), y), at(p + glm::dvec2(0, 1), y));
  }
  return room;
}

}  // namespace

TEST_CASE("a room without triangles has no shell and encloses nothing") {
  const Room empty = Room{};
  const Enclosure nothing(empty);
  CHECK_FALSE(nothing.has_closed_shell());
  CHECK_FALSE(nothing.encloses({0.0, 0.0, 0.0}));
}

TEST_CASE("a cube encloses the points inside it and no others") {
  for (const double edge : {1e-6, 1.0, 1e6}) {
    for (const double away : {0.0, 1000.0}) {
      CAPTURE(edge, away);
      const glm::dvec3 corner = away * edge * glm::dvec3(0.6, -0.5, 0.62);
      const Room whole = cube(edge, corner);
      const Enclosure enclosure(whole);
      REQUIRE(enclosure.has_closed_shell());
      std::mt19937 words(7);
      std::uniform_real_distribution<double> uniform(-1.0, 2.0);
      for (int k = 0; k < 1000; ++k) {
        const glm::dvec3 p(uniform(words), uniform(words), uniform(words));
        const bool inside = p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1 && p.z > 0 && p.z < 1;
        REQUIRE(enclosure.encloses(corner + edge * p) == inside);
      }
      // The centre, from which rays in simple directions meet edges and corners, and points just inside a wall, an
      // edge, a corner.
      for (const glm::dvec3 p : {glm::dvec3(0.5), glm::dvec3(0.5, 1e-6, 0.5), glm::dvec3(1e-6, 1e-6, 0.5),
                                 glm::dvec3(1.0 - 1e-6), glm::dvec3(1e-6)}) {
        CHECK(enclosure.encloses(corner + edge * p));
      }
      CHECK_FALSE(enclosure.encloses(corner + edge * glm::dvec3(0.5, -1e-6, 0.5)));
    }
  }
}

TEST_CASE("if a ray meets an edge or a corner, the point is tested again in another direction") {
  const Room whole = cube();
  const Enclosure enclosure(whole);
  // The first direction of encloses(), traced back from the diagonals and edges of the walls that it leads to.
  const glm::dvec3 direction(0.57735, 0.21132, 0.78868);
  int asked = 0;
  for (int k = 0; k <= 32; ++k) {
    const double s = k / 32.0;
    for (const glm::dvec3 target : {glm::dvec3(s, s, 1.0), glm::dvec3(1.0 - s, s, 1.0), glm::dvec3(1.0, s, s),
                                    glm::dvec3(1.0, s, 1.0 - s), glm::dvec3(1.0, s, 1.0), glm::dvec3(s, 1.0, 1.0)}) {
      const glm::dvec3 start = target - 0.125 * direction;
      if (std::min({start.x, start.y, start.z}) <= 0.0 || std::max({start.x, start.y, start.z}) >= 1.0) continue;
      ++asked;
      CAPTURE(target.x, target.y, target.z);
      CHECK(enclosure.encloses(start));
    }
  }
  CHECK(asked > 100);
}

TEST_CASE("a shell is closed with any winding and any division into surfaces") {
  Room room = cube();
  for (Surface& wall : room.surfaces) std::swap(wall.triangles[0].x, wall.triangles[0].y);
  const Enclosure enclosure(room);
  CHECK(enclosure.has_closed_shell());
  CHECK(enclosure.encloses({0.3, 0.6, 0.4}));
}

TEST_CASE("a shell with a hole is not closed") {
  Room room = cube();
  SECTION("no ceiling") {
    room.surfaces.erase(room.surfaces.begin() + 1);
  }
  SECTION("no second half of a wall") {
    room.surfaces[3].triangles.pop_back();
  }
  SECTION("a wall lies a thousandth of the room away") {
    for (glm::dvec3& p : room.surfaces[1].positions) p.y += 1e-3;
  }
  const Enclosure enclosure(room);
  CHECK_FALSE(enclosure.has_closed_shell());
  CHECK_FALSE(enclosure.encloses({0.5, 0.5, 0.5}));
}

TEST_CASE("corners that differ by rounding count as one") {
  Room room = cube();
  SECTION("minus zero") {
    for (Surface& wall : room.surfaces) {
      for (glm::dvec3& p : wall.positions) p.z = p.z == 0.0 && wall.name == "floor" ? -0.0 : p.z;
    }
  }
  SECTION("a float's last place") {
    for (glm::dvec3& p : room.surfaces[1].positions) p += glm::dvec3(6e-8, -6e-8, 6e-8);
  }
  SECTION("triangles that welding leaves without area are left out") {
    Surface& floor = room.surfaces[0];
    const auto first = static_cast<std::uint32_t>(floor.positions.size());
    floor.positions.push_back(floor.positions[0] + glm::dvec3(1e-8, 0.0, 0.0));
    floor.triangles.emplace_back(0, 1, first);
    floor.triangles.emplace_back(0, 1, 1);
  }
  const Enclosure enclosure(room);
  CHECK(enclosure.has_closed_shell());
  CHECK(enclosure.encloses({0.5, 0.5, 0.5}));
  CHECK_FALSE(enclosure.encloses({0.5, 1.5, 0.5}));
}

TEST_CASE("a room with open and closed objects in it is enclosed by its own shell") {
  Room room = together(cube(), cube(0.25, {0.5, 0.0, 0.5}));
  room.surfaces.push_back(cube(0.5, {0.25, 0.25, 0.25}).surfaces[0]);  // a plate
  const Enclosure enclosure(room);
  CHECK(enclosure.has_closed_shell());
  CHECK(enclosure.encloses({0.1, 0.9, 0.2}));
  CHECK(enclosure.encloses({0.6, 0.1, 0.6}));  // in the box in the room
  CHECK_FALSE(enclosure.encloses({1.1, 0.9, 0.2}));
}

TEST_CASE("a box outside does not enclose points beside it") {
  Room room = cube();
  room.surfaces.pop_back();
  const Room whole = together(room, cube(1.0, {3.0, 0.0, 0.0}));
  const Enclosure enclosure(whole);
  CHECK(enclosure.has_closed_shell());
  CHECK_FALSE(enclosure.encloses({0.5, 0.5, 0.5}));
  CHECK(enclosure.encloses({3.5, 0.5, 0.5}));
}

TEST_CASE("duplicate walls enclose like single walls") {
  Room room = cube();
  const auto turned = [](Surface wall) {
    for (glm::uvec3& t : wall.triangles) std::swap(t.x, t.z);
    return wall;
  };
  SECTION("all") {
    for (const Surface& wall : cube().surfaces) room.surfaces.push_back(turned(wall));
  }
  SECTION("one") {
    room.surfaces.push_back(turned(room.surfaces[2]));
  }
  const Enclosure enclosure(room);
  CHECK(enclosure.has_closed_shell());
  CHECK(enclosure.encloses({0.5, 0.5, 0.5}));

  Room plate;
  plate.surfaces = {cube().surfaces[0], turned(cube().surfaces[0])};
  CHECK_FALSE(Enclosure(plate).has_closed_shell());
}

TEST_CASE("an L-shaped room encloses points in both its arms and none in its notch") {
  const Room whole = l_room();
  const Enclosure enclosure(whole);
  REQUIRE(enclosure.has_closed_shell());
  CHECK(enclosure.encloses({0.5, 0.5, 0.5}));
  CHECK(enclosure.encloses({1.5, 0.5, 0.5}));
  CHECK(enclosure.encloses({0.5, 0.5, 1.5}));
  CHECK_FALSE(enclosure.encloses({1.5, 0.5, 1.5}));
  CHECK(enclosure.encloses({1.0 - 1e-6, 0.5, 1.0 - 1e-6}));
  CHECK_FALSE(enclosure.encloses({1.0 + 1e-6, 0.5, 1.0 + 1e-6}));
}

TEST_CASE("a fine sphere encloses its inside") {
  constexpr std::uint32_t n = 60;
  const Room whole = sphere(n);
  const Enclosure enclosure(whole);
  REQUIRE(enclosure.has_closed_shell());
  std::mt19937 words(3);
  std::normal_distribution<double> normal;
  // The centres of its facets lie between cos²(π/2n) times the radius, minus a part for the diagonals, and the radius:
  // 1 − (π/n)² is inside.
  const double inside = 1.0 - std::pow(std::numbers::pi / n, 2.0);
  for (int k = 0; k < 300; ++k) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(normal(words), normal(words), normal(words)));
    REQUIRE(enclosure.encloses(inside * direction));
    REQUIRE_FALSE(enclosure.encloses((1.0 + 1e-9) * direction));
  }
  CHECK(enclosure.encloses({0.0, 0.0, 0.0}));
}

TEST_CASE("many points are tested as one by one") {
  for (const Room& room : {l_room(), sphere(20), together(cube(), cube(0.5, {0.2, 0.3, 0.1}))}) {
    const Enclosure enclosure(room);
    std::mt19937 words(7);
    std::uniform_real_distribution<double> coordinate(-1.5, 2.5);
    std::vector<glm::dvec3> points{{0.5, 0.5, 0.5}, {1.0, 1.0, 1.0}, {0.25, 0.5, 0.5}};
    for (int k = 0; k < 2000; ++k) points.emplace_back(coordinate(words), coordinate(words), coordinate(words));
    const auto around = enclosure.shells_around_each(points);
    std::size_t inside = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      REQUIRE(around[k] == enclosure.shells_around(points[k]));
      inside += around[k].empty() ? 0U : 1U;
    }
    CHECK(inside > 20);
  }
}
