#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "room/bounding_rectangle.hpp"
#include "room/pack.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

namespace {

void check_packing(const std::vector<glm::dvec2>& sizes, const Packing& packing) {
  std::set<std::pair<int, int>> used;
  for (std::size_t n = 0; n < sizes.size(); ++n) {
    const glm::dvec2 size = packing.turned[n] ? glm::dvec2(sizes[n].y, sizes[n].x) : sizes[n];
    for (double x = 0.0; x < size.x; ++x) {
      for (double y = 0.0; y < size.y; ++y) {
        const glm::dvec2 cell = packing.corners[n] + glm::dvec2(x, y);
        REQUIRE(cell.x < packing.size.x);
        REQUIRE(cell.y < packing.size.y);
        REQUIRE(used.emplace(static_cast<int>(cell.x), static_cast<int>(cell.y)).second);
      }
    }
  }
}

}  // namespace

TEST_CASE("the smallest rectangle around a rotated rectangle has its direction") {
  for (const double degrees : {-40.0, -10.0, 0.0, 5.0, 44.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const glm::dvec2 u(std::cos(angle), std::sin(angle));
    const glm::dvec2 v(-u.y, u.x);
    const std::vector<glm::dvec2> points{glm::dvec2(0.0), 3.0 * u, 3.0 * u + v, v, 1.5 * u + 0.5 * v, 1.5 * u};
    const glm::dvec2 found = smallest_rectangle(points);
    CHECK(glm::length(found - u) < 1e-15);
  }
}

TEST_CASE("the smallest rectangle is no larger than any along a side") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  const auto area = [](const std::vector<glm::dvec2>& points, const glm::dvec2& u) {
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (const glm::dvec2& p : points) {
      const glm::dvec2 q(glm::dot(u, p), glm::dot(glm::dvec2(-u.y, u.x), p));
      low = glm::min(low, q);
      high = glm::max(high, q);
    }
    return (high.x - low.x) * (high.y - low.y);
  };
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<glm::dvec2> points(static_cast<std::size_t>(3 + trial));
    for (glm::dvec2& point : points) point = {place(random), 0.3 * place(random)};
    const double found = area(points, smallest_rectangle(points));
    for (const glm::dvec2& a : points) {
      for (const glm::dvec2& b : points) {
        if (a != b) REQUIRE(found <= area(points, glm::normalize(b - a)) * (1.0 + 2e-6));
      }
    }
  }
}

TEST_CASE("the axes are kept if no rectangle is smaller") {
  CHECK(smallest_rectangle({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) == glm::dvec2(1.0, 0.0));
  // Half a square: the rectangle along its diagonal is just as large.
  CHECK(smallest_rectangle({{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}) == glm::dvec2(1.0, 0.0));
  CHECK(smallest_rectangle({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}) == glm::dvec2(1.0, 0.0));
  CHECK(smallest_rectangle({{0.0, 0.0}, {1.0, 1.0}}) == glm::dvec2(1.0, 0.0));
}

TEST_CASE("packed rectangles do not overlap and waste little area") {
  std::mt19937 random(4);
  std::geometric_distribution<int> side(0.1);
  for (const std::size_t count : {1U, 2U, 7U, 300U}) {
    std::vector<glm::dvec2> sizes(count);
    double total = 0.0;
    for (glm::dvec2& size : sizes) {
      size = {1.0 + side(random), 1.0 + side(random)};
      total += size.x * size.y;
    }
    const Packing packing = pack(sizes);
    check_packing(sizes, packing);
    if (count == 1) CHECK(packing.size == sizes[0]);
    if (count == 300) CHECK(packing.size.x * packing.size.y < 1.25 * total);
  }
  // A wide low rectangle after a narrow one, on which it would fit by its height.
  std::vector<glm::dvec2> sizes{{1.0, 4.0}, {2.0, 2.0}, {10.0, 1.0}};
  sizes.insert(sizes.end(), 6, glm::dvec2(1.0));
  check_packing(sizes, pack(sizes));
}
