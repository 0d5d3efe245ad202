#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "room/engine_chart.hpp"
#include "room/lay_out.hpp"
#include "room/mesh_links.hpp"
#include "room/overlap.hpp"
#include "room/patches.hpp"
#include "room/uv_chart.hpp"
#include "support/catch.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

std::string fault_of(const Surface& surface) {
  return uv_fault(surface, triangle_shapes(surface));
}

Patches patches_of(const Surface& surface) {
  return cut_into_patches(surface, triangle_shapes(surface), float_noise * largest_extent_m(surface));
}

Chart engine_chart_of(const Surface& surface, double edge_m) {
  return make_engine_chart(surface, triangle_shapes(surface), edge_m, "test");
}

// Every triangle is in one patch or among the slivers; the triangles of a patch do not overlap.
void check_partition(const Surface& surface, const Patches& cut, double tolerance) {
  std::multiset<std::uint32_t> all(cut.slivers.begin(), cut.slivers.end());
  for (const Patch& patch : cut.patches) {
    REQUIRE(patch.flat.size() == patch.triangles.size());
    all.insert(patch.triangles.begin(), patch.triangles.end());
    for (std::size_t a = 0; a < patch.flat.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) REQUIRE(penetration_depth(patch.flat[a], patch.flat[b]) <= tolerance);
    }
  }
  REQUIRE(all.size() == surface.triangles.size());
  for (std::uint32_t k = 0; k < surface.triangles.size(); ++k) REQUIRE(all.count(k) == 1);
}

}  // namespace

TEST_CASE("valid UVs have no fault") {
  CHECK(fault_of(make_floor(4.0, 3.0)).empty());
  CHECK(fault_of(make_floor(4.0, 3.0, 20, 0.001)).empty());
  SECTION("rounded to float") {
    Surface surface = make_floor(4.0, 3.0, 30);
    for (glm::dvec2& uv : surface.uvs) uv = glm::dvec2(glm::vec2(uv));
    CHECK(fault_of(surface).empty());
  }
  SECTION("mirrored") {
    Surface surface = make_floor(4.0, 3.0, 5);
    for (glm::dvec2& uv : surface.uvs) uv.x = 1.0 - uv.x;
    CHECK(fault_of(surface).empty());
  }
  SECTION("off by rounding at 0 and 1") {
    Surface surface = make_floor(4.0, 3.0);
    for (glm::dvec2& uv : surface.uvs) uv = uv * (1.0 + 4e-7) - 2e-7;
    CHECK(fault_of(surface).empty());
  }
}

TEST_CASE("UVs that cannot be used are refused with the reason") {
  Surface surface = make_floor(4.0, 3.0, 4);
  SECTION("absent") {
    surface.uvs.clear();
    CHECK(fault_of(surface) == "it has no UVs");
  }
  SECTION("wrapping above") {
    for (glm::dvec2& uv : surface.uvs) uv *= 3.5;
    CHECK_THAT(fault_of(surface), ContainsSubstring("its UVs wrap (triangle"));
  }
  SECTION("wrapping below by little more than rounding") {
    surface.uvs[3].y = -2e-6;
    CHECK_THAT(fault_of(surface), ContainsSubstring("v = -2e-06"));
  }
  SECTION("not a number") {
    surface.uvs[surface.triangles[7].y].x = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(fault_of(surface), ContainsSubstring("its UVs are degenerate (triangle 7 has u = nan"));
  }
  SECTION("all the same") {
    for (glm::dvec2& uv : surface.uvs) uv = {0.25, 0.5};
    CHECK_THAT(fault_of(surface), ContainsSubstring("its UVs are degenerate"));
  }
  SECTION("on a line") {
    for (glm::dvec2& uv : surface.uvs) uv.y = uv.x;
    CHECK_THAT(fault_of(surface), ContainsSubstring("its UVs are degenerate"));
  }
  SECTION("one triangle without UV area") {
    const glm::uvec3 corner = surface.triangles[5];
    surface.uvs[corner.z] = 0.5 * (surface.uvs[corner.x] + surface.uvs[corner.y]);
    CHECK_THAT(fault_of(surface), ContainsSubstring("degenerate (triangle 5 has an area of 0.375 m^2"));
  }
  SECTION("overlapping") {
    for (std::size_t n = 0; n < 3; ++n) surface.uvs[3 + n] = surface.uvs[n];
    CHECK_THAT(fault_of(surface), ContainsSubstring("its UVs overlap (triangles 0 and 1 cover the same place)"));
  }
  SECTION("overlapping by a little more than float rounding") {
    for (std::size_t n = 0; n < 6; ++n) surface.uvs[n].y += 1e-6;
    CHECK_THAT(fault_of(surface), ContainsSubstring("overlap"));
  }
  SECTION("one count of UVs and another of positions") {
    surface.uvs.pop_back();
    CHECK(fault_of(surface) == "it has no UVs");
  }
}

namespace {

// Squares of these edges (m) in a row, each with the square of texture coordinates from `low` to `high`.
struct SquareInUv {
  double edge_m = 1.0;
  glm::dvec2 low{0.0};
  glm::dvec2 high{1.0};
};

Surface squares(const std::vector<SquareInUv>& list) {
  Surface surface;
  double x = 0.0;
  for (const SquareInUv& one : list) {
    const std::size_t first = surface.positions.size();
    add_quad(surface, {x, 0.0, 0.0}, {one.edge_m, 0.0, 0.0}, {0.0, 0.0, one.edge_m});
    for (std::size_t n = first; n < surface.positions.size(); ++n) {
      const glm::dvec2 share((surface.positions[n].x - x) / one.edge_m, surface.positions[n].z / one.edge_m);
      surface.uvs.push_back(one.low + share * (one.high - one.low));
    }
    x += 2.0 * one.edge_m;
  }
  return surface;
}

}  // namespace

TEST_CASE("UVs that would need more than ten times the cells of the area are refused with the reason") {
  // A wall of 3 m at 15 m for each unit of u and v, a poster of 0.1 m that takes half of the square: 15² = 225 m² of
  // cells for 9.01 m².
  CHECK_THAT(fault_of(squares({{3.0, {0.0, 0.0}, {0.2, 0.2}}, {0.1, {0.3, 0.3}, {1.0, 1.0}}})),
             ContainsSubstring("the scale of its UVs is uneven (a grid on them would have 24.9 times the cells"));
  // The other way round, the scale of the wall is that of nearly all area: (3/0.7)² m² over the square of 0.7 + 0.3.
  CHECK(fault_of(squares({{3.0, {0.3, 0.3}, {1.0, 1.0}}, {0.1, {0.0, 0.0}, {0.02, 0.02}}})).empty());
  // Two squares in opposite corners of the square: 10² m² for 2 m², at an even scale.
  CHECK_THAT(fault_of(squares({{1.0, {0.0, 0.0}, {0.1, 0.1}}, {1.0, {0.9, 0.9}, {1.0, 1.0}}})),
             ContainsSubstring("its UVs fill little of their rectangle (a grid on them would have 50 times the cells"));
  // A board with the unwrap of Blender's default cube: 12 m² for 2 m².
  CHECK(fault_of(squares({{1.0, {0.0, 0.0}, {0.25, 0.25}}, {1.0, {0.5, 0.75}, {0.75, 1.0}}})).empty());
}

TEST_CASE("triangles without area do not count in the test of the UVs") {
  Surface surface = make_floor(4.0, 3.0, 2);
  add_triangle(surface, {1.0, 0.0, 1.0}, {2.0, 0.0, 2.0}, {3.0, 0.0, 3.0});
  surface.uvs.insert(surface.uvs.end(), {{7.0, -3.0}, {std::numeric_limits<double>::infinity(), 0.0}, {0.5, 0.5}});
  CHECK(fault_of(surface).empty());
  const Chart chart = make_uv_chart(surface, triangle_shapes(surface), 0.1);
  for (const auto& corners : chart.corners) {
    for (const glm::dvec2& corner : corners) {
      CHECK(corner.x >= 0.0);
      CHECK(corner.x <= chart.cells.x);
      CHECK(corner.y >= 0.0);
      CHECK(corner.y <= chart.cells.y);
    }
  }
}

TEST_CASE("the number of cells of a file chart follows from its length") {
  const Surface surface = make_floor(4.0, 3.0, 3, 0.5);
  const Chart chart = make_uv_chart(surface, triangle_shapes(surface), 0.1);
  CHECK(chart.source == ChartSource::file);
  CHECK(chart.cells == glm::dvec2(40.0, 30.0));
  CHECK(chart.uv_min == glm::dvec2(0.0));
  CHECK(chart.uv_max == glm::dvec2(0.5));
  CHECK(make_uv_chart(surface, triangle_shapes(surface), 100.0).cells == glm::dvec2(1.0));
}

TEST_CASE("the length of a chart is the rms of its stretch over the area") {
  // Two floors of 1 m and 3 m by 1 m share u evenly: stretch 2 m on area 1 m², 6 m on 3 m²: √((4 + 3·36)/4) = √28 m.
  Surface surface;
  add_quad(surface, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  add_quad(surface, {1.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  for (const glm::dvec3& p : surface.positions) {
    surface.uvs.emplace_back(p.x <= 1.0 ? 0.5 * p.x : 0.5 + (p.x - 1.0) / 6.0, p.z);
  }
  CHECK(make_uv_chart(surface, triangle_shapes(surface), 0.01).cells == glm::dvec2(529.0, 100.0));  // √28 = 5.2915
}

TEST_CASE("penetration depth is the shortest separating shift") {
  const FlatTriangle a{{{0.0, 0.0}, {2.0, 0.0}, {0.0, 2.0}}};
  CHECK(penetration_depth(a, {{{-1.0, -1.0}, {0.0, -1.0}, {0.0, 0.0}}}) <= 0.0);  // a corner in common
  CHECK(penetration_depth(a, {{{0.0, 0.0}, {0.0, 2.0}, {-2.0, 0.0}}}) <= 0.0);    // a side in common
  CHECK(std::abs(penetration_depth(a, {{{-3.0, 1.0}, {0.25, 0.5}, {-3.0, 0.0}}}) - 0.25) < 1e-15);  // a tip inside
  CHECK(std::abs(penetration_depth(a, a) - std::sqrt(2.0)) < 1e-15);                                // its height
  const FlatTriangle clockwise{a[0], a[2], a[1]};
  CHECK(penetration_depth(a, clockwise) == penetration_depth(a, a));
}

TEST_CASE("the overlap index gives the same results as a test of all pairs") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (const double size : {0.3, 0.03, 0.005}) {
    OverlapIndex index(1e-7);
    std::vector<FlatTriangle> kept;
    std::size_t refused = 0;
    for (std::size_t n = 0; n < 1500; ++n) {
      const glm::dvec2 at(place(random), place(random));
      const double mine = n % 50 == 0 ? 10.0 * size : size;  // some large ones among the small ones
      FlatTriangle triangle;
      for (glm::dvec2& corner : triangle) corner = at + mine * glm::dvec2(place(random), place(random));
      const bool expected = std::any_of(kept.begin(), kept.end(), [&](const FlatTriangle& other) {
        return thickness(triangle) > 1e-7 && penetration_depth(triangle, other) > 1e-7;
      });
      REQUIRE(index.add(triangle, n).has_value() == expected);
      if (expected) ++refused;
      if (!expected) kept.push_back(triangle);
    }
    CHECK(refused > 10);
    CHECK(kept.size() > 10);
  }
}

TEST_CASE("large meshes and stacked copies are tested for overlap in a short time") {
  CHECK(fault_of(make_floor(4.0, 3.0, 180)).empty());  // 64 800 triangles
  Surface stack;
  for (int n = 0; n < 20000; ++n) add_quad(stack, {0.0, 0.001 * n, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  for (const glm::dvec3& p : stack.positions) stack.uvs.emplace_back(p.x, p.z);
  CHECK_THAT(fault_of(stack), ContainsSubstring("overlap"));
}

TEST_CASE("triangles are linked by the positions of their edges") {
  Surface surface = make_floor(2.0, 1.0);  // triangles 0 and 1 share their diagonal: edge 2 of one, edge 0 of the other
  for (glm::dvec3& p : surface.positions) p.y = p.x > 1.0 ? -0.0 : 0.0;
  const MeshLinks links(surface);
  REQUIRE(links.at_edge(0, 2).size() == 2);
  CHECK(links.at_edge(0, 2)[0] == 0);
  CHECK(links.at_edge(0, 2)[1] == 1);
  CHECK(links.at_edge(1, 0).size() == 2);
  CHECK(links.at_edge(0, 0).size() == 1);
}

TEST_CASE("stacked copies are not linked") {
  Surface surface;
  for (int n = 0; n < 9; ++n) add_quad(surface, glm::dvec3(0.0), {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  const MeshLinks links(surface);
  CHECK(links.at_edge(0, 2).empty());
}

TEST_CASE("a box has a patch for each of its sides") {
  const Surface box = make_box({2.0, 1.0, 3.0});
  const Patches cut = patches_of(box);
  CHECK(cut.patches.size() == 6);
  CHECK(cut.slivers.empty());
  check_partition(box, cut, 1e-6);
}

TEST_CASE("a sphere has few patches") {
  const Surface sphere = make_sphere(24);
  const Patches cut = patches_of(sphere);
  check_partition(sphere, cut, 1e-6);
  // Caps of 50° cover (1 − cos 50°)/2 = 0.18 of it: at least 6; they overlap, so some more are needed.
  CHECK(cut.patches.size() >= 6);
  CHECK(cut.patches.size() <= 24);
  CHECK(cut.slivers.size() == 48);  // at each pole 24 triangles without area
}

TEST_CASE("a spiral ramp is cut where it overlaps itself") {
  const Surface ramp = make_ramp(5, 24);
  const Patches cut = patches_of(ramp);
  check_partition(ramp, cut, float_noise * largest_extent_m(ramp));
  CHECK(cut.patches.size() >= 5);
  CHECK(cut.patches.size() <= 10);
}

TEST_CASE("surfaces that are modelled twice or folded have patches without overlap") {
  Surface twice = make_box({1.0, 1.0, 1.0});
  const Surface overrides = twice;
  for (const glm::uvec3& corner : overrides.triangles) {
    add_triangle(twice, overrides.positions[corner.x], overrides.positions[corner.y], overrides.positions[corner.z]);
  }
  const Patches cut = patches_of(twice);
  check_partition(twice, cut, 1e-6);
  CHECK(cut.patches.size() == 12);

  Surface card;  // front and back at the same position
  add_quad(card, glm::dvec3(0.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  add_quad(card, glm::dvec3(0.0), {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0});
  check_partition(card, patches_of(card), 1e-6);
}

TEST_CASE("a thousand copies at the same position are cut in a short time") {
  Surface stack;
  for (int n = 0; n < 5000; ++n) add_quad(stack, glm::dvec3(0.0), {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  CHECK(patches_of(stack).patches.size() == 10000);
}

TEST_CASE("an engine chart of a floor has the axes of the world") {
  Surface floor = make_floor(4.0, 3.0);
  const Chart chart = engine_chart_of(floor, 0.1);
  CHECK(chart.source == ChartSource::engine);
  CHECK(chart.reason == "test");
  CHECK(chart.cells == glm::dvec2(40.0, 30.0));
  CHECK(chart.uv_min == glm::dvec2(0.0));
  CHECK(chart.uv_max == glm::dvec2(1.0));
  for (std::size_t k = 0; k < 2; ++k) {
    for (int n = 0; n < 3; ++n) {
      const glm::dvec3 p = floor.positions[floor.triangles[k][n]];
      CHECK(chart.corners[k][static_cast<std::size_t>(n)] == glm::dvec2(p.x / 4.0 * 40.0, p.z / 3.0 * 30.0));
    }
  }
}

TEST_CASE("walls along the axes have u along the first axis in them and v along the second") {
  const Surface box = make_box({2.0, 1.0, 3.0});
  const Chart chart = engine_chart_of(box, 0.1);
  for (std::size_t k = 0; k < box.triangles.size(); ++k) {
    const glm::dvec3 origin = box.positions[box.triangles[k].x];
    glm::dvec3 normal = triangle_shapes(box)[k].normal;
    const int first = std::abs(normal.x) > 0.5 ? 1 : 0;
    const int second = std::abs(normal.z) > 0.5 ? 1 : 2;
    for (int n = 1; n < 3; ++n) {
      const glm::dvec3 step = box.positions[box.triangles[k][n]] - origin;
      const glm::dvec2 cells = chart.corners[k][static_cast<std::size_t>(n)] - chart.corners[k][0];
      CHECK(std::abs(cells.x - 10.0 * step[first]) < 1e-13);
      CHECK(std::abs(cells.y - 10.0 * step[second]) < 1e-13);
    }
  }
}

TEST_CASE("a frame is divided into bars") {
  // Bars 0.2 m wide around 2 m × 1.4 m, joined at their corners by common edges.
  Surface frame;
  frame.name = "frame";
  const std::array<double, 4> x{0.0, 0.2, 1.8, 2.0};
  const std::array<double, 4> z{0.0, 0.2, 1.2, 1.4};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (i == 1 && j == 1) continue;
      add_quad(frame, {x[i], 0, z[j]}, {0, 0, z[j + 1] - z[j]}, {x[i + 1] - x[i], 0, 0});
    }
  }
  REQUIRE(patches_of(frame).patches.size() == 1);
  const Chart chart = engine_chart_of(frame, 0.1);
  const double waste = chart.cells.x * chart.cells.y * 0.01 / area_of(frame);
  INFO(chart.cells.x << " x " << chart.cells.y << " cells, " << waste << " of the area");
  CHECK(waste < 1.2);  // one rectangle around the whole frame would have 2.3
  // Every tile's area is its share of the surface.
  Room room;
  room.surfaces.push_back(frame);
  double area = 0.0;
  for (const Tile& tile : make_tiling(room, 0.1).tiles) area += tile.area_m2;
  CHECK(std::abs(area - area_of(frame)) < 1e-12);
}

TEST_CASE("no cell of an engine chart contains two patches") {
  const Surface sphere = make_sphere(16);
  const std::vector<TriangleShape> shapes = triangle_shapes(sphere);
  const double noise_m = float_noise * largest_extent_m(sphere);
  std::vector<Patch> parts;
  for (const Patch& patch : patches_of(sphere).patches) {
    for (const LaidPatch& laid : lay_out(patch, shapes, MeshLinks(sphere), 0.2, noise_m)) parts.push_back(laid.patch);
  }
  const Chart chart = engine_chart_of(sphere, 0.2);
  std::set<std::pair<int, int>> used;
  double cells = 0.0;
  for (const Patch& patch : parts) {
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (const std::uint32_t k : patch.triangles) {
      for (const glm::dvec2& corner : chart.corners[k]) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
      }
    }
    // The patch fills a rectangle of whole cells.
    CHECK(low == glm::round(low));
    CHECK(high == glm::round(high));
    CHECK(high.x - low.x >= 1.0);
    CHECK(high.y - low.y >= 1.0);
    for (double x = low.x; x < high.x; ++x) {
      for (double y = low.y; y < high.y; ++y) REQUIRE(used.emplace(static_cast<int>(x), static_cast<int>(y)).second);
    }
    cells += (high.x - low.x) * (high.y - low.y);
  }
  CHECK(cells <= chart.cells.x * chart.cells.y);
}

TEST_CASE("coordinates within rounding of a grid line are moved to it") {
  const GridTransform grid(glm::dvec2(0.0), glm::dvec2(1.0), glm::dvec2(10.0, 10.0), float_noise);
  const double tenth = static_cast<double>(0.3F);
  REQUIRE(tenth * 10.0 != 3.0);
  CHECK(grid({tenth, 0.35}).x == 3.0);
  CHECK(grid({tenth, 0.35}).y == 0.35 * 10.0);
  CHECK(grid({0.3001, 0.0}).x == 0.3001 * 10.0);
  CHECK(grid({-1.0, 2.0}) == glm::dvec2(0.0, 10.0));
}
