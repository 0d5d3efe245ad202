#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "lichtmc/cuboid.hpp"
#include "lichtmc/error.hpp"
#include "room/cuboid_shape.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

namespace {

const glm::dvec3 edges(4.0, 3.0, 5.0);

Room cuboid(const glm::dvec3& size = edges) {
  return make_cuboid(size, uniform_reflectance(0.5));
}

struct Pose {
  glm::dvec3 x{1.0, 0.0, 0.0};
  glm::dvec3 y{0.0, 1.0, 0.0};
  glm::dvec3 z{0.0, 0.0, 1.0};
  glm::dvec3 origin{0.0};
};

Pose some_pose(std::mt19937& words, double distance) {
  std::normal_distribution<double> normal;
  const auto vector = [&] { return glm::dvec3(normal(words), normal(words), normal(words)); };
  Pose pose;
  pose.x = glm::normalize(vector());
  pose.y = glm::normalize(glm::cross(pose.x, vector()));
  pose.z = glm::cross(pose.x, pose.y);
  pose.origin = distance * glm::normalize(vector());
  return pose;
}

// The room rotated and moved, its coordinates rounded to float as in a file.
Room placed(Room room, const Pose& pose) {
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& p : surface.positions)
      p = glm::dvec3(glm::vec3(p.x * pose.x + p.y * pose.y + p.z * pose.z + pose.origin));
  }
  return room;
}

// The floor as n × n squares; the walls beside it stay whole.
Room with_fine_floor(std::uint32_t n) {
  Room room = cuboid();
  Surface& floor = room.surfaces[0];
  floor.positions.clear();
  floor.uvs.clear();
  floor.triangles.clear();
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) floor.positions.emplace_back(edges.x * i / n, 0.0, edges.z * j / n);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j;
      floor.triangles.emplace_back(a, a + 1, a + n + 2);
      floor.triangles.emplace_back(a, a + n + 2, a + n + 1);
    }
  }
  return room;
}

// Largest distance of a triangle's corners from the face assigned to it, and of the faces from the room.
double misfit_m(const Room& room, const CuboidShape& shape) {
  double worst = 0.0;
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    const Surface& surface = room.surfaces[k];
    REQUIRE(shape.face_of_triangle[k].size() == surface.triangles.size());
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
      const std::uint8_t face = shape.face_of_triangle[k][n];
      REQUIRE(face < 6);
      const glm::dvec3& edge = shape.edges[face / 2];
      for (int c = 0; c < 3; ++c) {
        const glm::dvec3 from_corner = surface.positions[surface.triangles[n][c]] - shape.corner;
        const double along = glm::dot(from_corner, edge) / glm::length(edge);
        worst = std::max(worst, std::abs(along - (face % 2 == 0 ? 0.0 : glm::length(edge))));
      }
    }
  }
  return worst;
}

double volume(const CuboidShape& shape) {
  return glm::dot(glm::cross(shape.edges[0], shape.edges[1]), shape.edges[2]);
}

void add_quad(Surface& surface, const glm::dvec3& corner, const glm::dvec3& s, const glm::dvec3& t) {
  const auto first = static_cast<std::uint32_t>(surface.positions.size());
  for (const glm::dvec3& p : {corner, corner + s, corner + s + t, corner + t}) surface.positions.push_back(p);
  surface.triangles.emplace_back(first, first + 1, first + 2);
  surface.triangles.emplace_back(first, first + 2, first + 3);
}

}  // namespace

TEST_CASE("a cuboid has six walls in order with their reflectances") {
  const Room room = make_cuboid(edges, {0.125, 0.25, 0.375, 0.5, 0.625, 0.75});
  const std::vector<std::string> names{"floor", "ceiling", "wall_x0", "wall_x1", "wall_z0", "wall_z1"};
  // Constant axis, its value, and the two axes that u and v run along.
  const int axis[] = {1, 1, 0, 0, 2, 2};
  const double place[] = {0.0, 3.0, 0.0, 4.0, 0.0, 5.0};
  const int u_axis[] = {0, 0, 1, 1, 0, 0};
  const int v_axis[] = {2, 2, 2, 2, 1, 1};
  REQUIRE(room.surfaces.size() == 6);
  CHECK(room.emitters.empty());
  for (std::size_t k = 0; k < 6; ++k) {
    const Surface& wall = room.surfaces[k];
    CAPTURE(wall.name);
    CHECK(wall.name == names[k]);
    CHECK(wall.reflectance == 0.125 * static_cast<double>(k + 1));
    REQUIRE(wall.triangles.size() == 2);
    REQUIRE(wall.uvs.size() == wall.positions.size());
    for (std::size_t i = 0; i < wall.positions.size(); ++i) {
      CHECK(wall.positions[i][axis[k]] == place[k]);
      CHECK(wall.positions[i][u_axis[k]] == wall.uvs[i].x * edges[u_axis[k]]);
      CHECK(wall.positions[i][v_axis[k]] == wall.uvs[i].y * edges[v_axis[k]]);
    }
    // Products of small integers: exact.
    CHECK(surface_area(wall) == edges[u_axis[k]] * edges[v_axis[k]]);
    for (const glm::uvec3& t : wall.triangles) {
      const glm::dvec3 a = wall.positions[t.x];
      const glm::dvec3 front = glm::cross(wall.positions[t.y] - a, wall.positions[t.z] - a);
      CHECK(glm::dot(front, 0.5 * edges - a) > 0.0);
    }
  }
}

TEST_CASE("a cuboid requires edges above 0 and reflectances from 0 to 1") {
  const double wrong_edges[] = {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity()};
  for (const double edge : wrong_edges) {
    CHECK_THROWS_AS(cuboid({edge, 1.0, 1.0}), InputError);
    CHECK_THROWS_AS(cuboid({1.0, edge, 1.0}), InputError);
    CHECK_THROWS_AS(cuboid({1.0, 1.0, edge}), InputError);
  }
  CHECK_THROWS_WITH(cuboid({1.0, -2.5, 1.0}), ContainsSubstring("Y") && ContainsSubstring("-2.5"));
  CuboidReflectances reflectances;
  reflectances.z1 = 1.5;
  CHECK_THROWS_AS(make_cuboid(edges, reflectances), InputError);
  CHECK_THROWS_WITH(make_cuboid(edges, reflectances), ContainsSubstring("wall_z1") && ContainsSubstring("1.5"));
  CHECK_NOTHROW(make_cuboid(edges, uniform_reflectance(0.0)));
  CHECK_NOTHROW(make_cuboid(edges, uniform_reflectance(1.0)));
}

TEST_CASE("a cuboid along the axes is recognised exactly from a micrometre to a thousand kilometres") {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    CAPTURE(scale);
    const Room room = cuboid(scale * edges);
    const auto shape = recognise_cuboid(room);
    REQUIRE(shape.has_value());
    CHECK(shape->corner == glm::dvec3(0.0));
    for (int k = 0; k < 3; ++k) {
      glm::dvec3 edge(0.0);
      edge[k] = (scale * edges)[k];
      CHECK(shape->edges[static_cast<std::size_t>(k)] == edge);
    }
    // Edges times edges over their length: 4 ulp of the longest.
    CHECK(misfit_m(room, *shape) <= 4.0 * std::numeric_limits<double>::epsilon() * scale * edges.z);
  }
}

TEST_CASE("a rotated and moved cuboid with coordinates in float is recognised") {
  std::mt19937 words(1);
  for (const double distance_m : {0.0, 10.0, 1000.0}) {
    for (int repeat = 0; repeat < 50; ++repeat) {
      CAPTURE(distance_m, repeat);
      const Room room = placed(repeat % 2 == 0 ? cuboid() : with_fine_floor(12), some_pose(words, distance_m));
      const auto shape = recognise_cuboid(room);
      REQUIRE(shape.has_value());
      // Coordinates up to distance + √50 m round by 2⁻²⁴ of it each; a wall is 3 to 7 m wide, so that the error of its
      // plane is a few of these at its far corners. 2⁻²⁰ is sixteen.
      const double noise_m = 0x1p-20 * (distance_m + std::sqrt(50.0));
      CHECK(misfit_m(room, *shape) < noise_m);
      // Each edge has the error of both ends: dV = V Σ da/a, Σ 1/a = 47/60.
      CHECK(std::abs(volume(*shape) - 60.0) < 60.0 * 2.0 * noise_m * (47.0 / 60.0));
      for (std::size_t k = 0; k < 3; ++k) {
        // Unit vectors that are perpendicular to rounding, 8 ulp of 1.
        const glm::dvec3 a = glm::normalize(shape->edges[k]);
        const glm::dvec3 b = glm::normalize(shape->edges[(k + 1) % 3]);
        CHECK(std::abs(glm::dot(a, b)) < 8.0 * std::numeric_limits<double>::epsilon());
      }
    }
  }
}

TEST_CASE("a cuboid is recognised with any division of its walls into triangles and surfaces") {
  SECTION("any winding") {
    Room room = cuboid();
    std::swap(room.surfaces[0].triangles[0].x, room.surfaces[0].triangles[0].y);
    std::swap(room.surfaces[5].triangles[1].x, room.surfaces[5].triangles[1].z);
    CHECK(recognise_cuboid(room).has_value());
  }
  SECTION("one surface for all walls") {
    Room room;
    room.surfaces.emplace_back();
    for (const Surface& wall : cuboid().surfaces) {
      const auto first = static_cast<std::uint32_t>(room.surfaces[0].positions.size());
      for (const glm::dvec3& p : wall.positions) room.surfaces[0].positions.push_back(p);
      for (const glm::uvec3& t : wall.triangles) room.surfaces[0].triangles.push_back(t + glm::uvec3(first));
    }
    const auto shape = recognise_cuboid(room);
    REQUIRE(shape.has_value());
    CHECK(misfit_m(room, *shape) == 0.0);
  }
  SECTION("a surface for every triangle") {
    Room room;
    for (const Surface& wall : cuboid().surfaces) {
      for (const glm::uvec3& t : wall.triangles) {
        room.surfaces.push_back(wall);
        room.surfaces.back().triangles = {t};
      }
    }
    CHECK(recognise_cuboid(room).has_value());
  }
  SECTION("a wall of many triangles with T-junctions at its neighbours") {
    const Room room = with_fine_floor(40);
    const auto shape = recognise_cuboid(room);
    REQUIRE(shape.has_value());
    CHECK(volume(*shape) == 60.0);
  }
  SECTION("triangles without area beside the walls") {
    Room room = cuboid();
    room.surfaces[0].triangles.emplace_back(0, 1, 1);
    room.surfaces.emplace_back();
    CHECK(recognise_cuboid(room).has_value());
  }
  SECTION("a wall displaced by less than the rounding of its coordinates") {
    Room room = cuboid();
    room.surfaces[1].positions[0].y += 1e-7;
    CHECK(recognise_cuboid(room).has_value());
  }
}

TEST_CASE("rooms that are not one empty closed cuboid are not recognised") {
  Room room = cuboid();
  REQUIRE(recognise_cuboid(room).has_value());
  SECTION("nothing") {
    room.surfaces.clear();
  }
  SECTION("a wall is missing") {
    room.surfaces.erase(room.surfaces.begin() + 2);
  }
  SECTION("a triangle is missing") {
    room.surfaces[4].triangles.pop_back();
  }
  SECTION("a small triangle is missing") {
    room = with_fine_floor(12);
    room.surfaces[0].triangles.pop_back();
  }
  SECTION("a triangle is there twice") {
    room.surfaces[4].triangles.push_back(room.surfaces[4].triangles[0]);
  }
  SECTION("a triangle lies on another and leaves a hole of its size") {
    room.surfaces[4].triangles[1] = room.surfaces[4].triangles[0];
  }
  SECTION("a small triangle lies on another and leaves a hole of its size") {
    room = with_fine_floor(12);
    room.surfaces[0].triangles[200] = room.surfaces[0].triangles[0];
  }
  SECTION("a box stands in it") {
    for (Surface wall : cuboid(0.25 * edges).surfaces) {
      for (glm::dvec3& p : wall.positions) p += glm::dvec3(1.0, 0.0, 1.0);
      room.surfaces.push_back(wall);
    }
  }
  SECTION("a plate hangs in it") {
    Surface plate;
    add_quad(plate, {1.0, 1.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
    room.surfaces.push_back(plate);
  }
  SECTION("a wall leans by a tenth of a millimetre") {
    for (Surface& wall : room.surfaces) {
      for (glm::dvec3& p : wall.positions) {
        if (p.x == edges.x && p.y == edges.y) p.x += 1e-4;
      }
    }
  }
  SECTION("it is sheared") {
    for (Surface& wall : room.surfaces) {
      for (glm::dvec3& p : wall.positions) p.x += 0.01 * p.y;
    }
  }
  SECTION("it has no height") {
    for (Surface& wall : room.surfaces) {
      for (glm::dvec3& p : wall.positions) p.y = 0.0;
    }
  }
  SECTION("its height is only rounding") {
    for (Surface& wall : room.surfaces) {
      for (glm::dvec3& p : wall.positions) p.y = 1000.0 + 1e-5 * p.y;
    }
  }
  CHECK_FALSE(recognise_cuboid(room).has_value());
}
