#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "room/clip.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

namespace {

using Triangle = std::array<glm::dvec2, 3>;

// A share is a few products and differences of numbers up to 1 that come from one or two cuts of a few operations: some
// twenty roundings.
constexpr double rounding = 20.0 * std::numeric_limits<double>::epsilon() / 2.0;

std::vector<CellPiece> clip(const Triangle& triangle, std::uint32_t columns, std::uint32_t rows) {
  std::vector<CellPiece> pieces;
  clip_to_cells(triangle, columns, rows, pieces);
  return pieces;
}

double sum_of_shares(const std::vector<CellPiece>& pieces) {
  double sum = 0.0;
  for (const CellPiece& piece : pieces) sum += piece.share;
  return sum;
}

double share_in(const std::vector<CellPiece>& pieces, std::uint32_t column, std::uint32_t row) {
  double share = 0.0;
  for (const CellPiece& piece : pieces) {
    if (piece.column == column && piece.row == row) share += piece.share;
  }
  return share;
}

glm::dvec2 place_of(const CellPiece& piece, const Triangle& triangle) {
  return piece.centroid.x * triangle[0] + piece.centroid.y * triangle[1] + piece.centroid.z * triangle[2];
}

}  // namespace

TEST_CASE("a triangle inside one cell is one piece") {
  const auto pieces = clip({{{2.25, 1.25}, {2.75, 1.25}, {2.25, 1.75}}}, 4, 3);
  REQUIRE(pieces.size() == 1);
  CHECK(pieces[0].column == 2);
  CHECK(pieces[0].row == 1);
  CHECK(pieces[0].share == 1.0);
  // Three thirds: one rounding each.
  for (int n = 0; n < 3; ++n) CHECK(std::abs(pieces[0].centroid[n] - 1.0 / 3.0) <= 4e-16);
}

TEST_CASE("half a square is cut into whole and half cells") {
  for (const std::uint32_t n : {1U, 4U, 10U, 300U}) {
    const double side = n;
    const auto pieces = clip({{{0.0, 0.0}, {side, 0.0}, {0.0, side}}}, n, n);
    // n(n − 1)/2 cells below the diagonal and n halves on it; no tiny pieces where the diagonal goes through the
    // crossings of the lines.
    REQUIRE(pieces.size() == n * (n + 1) / 2);
    for (const CellPiece& piece : pieces) {
      REQUIRE(piece.column + piece.row < n);
      const double whole = 2.0 / (side * side);
      const double expected = piece.column + piece.row == n - 1 ? whole / 2.0 : whole;
      REQUIRE(std::abs(piece.share - expected) <= rounding);
    }
  }
}

TEST_CASE("a cut at a known position has the known shares") {
  // The triangle (0, 0), (3, 0), (0, 2): cell by cell from its line y = 2 − 2x/3, in units of its area 3.
  const auto pieces = clip({{{0.0, 0.0}, {3.0, 0.0}, {0.0, 2.0}}}, 3, 2);
  CHECK(std::abs(share_in(pieces, 0, 0) - 1.0 / 3.0) <= rounding);
  CHECK(std::abs(share_in(pieces, 1, 0) - (1.0 - 1.0 / 12.0) / 3.0) <= rounding);
  CHECK(std::abs(share_in(pieces, 2, 0) - (1.0 / 3.0) / 3.0) <= rounding);
  CHECK(std::abs(share_in(pieces, 0, 1) - (2.0 / 3.0) / 3.0) <= rounding);
  CHECK(std::abs(share_in(pieces, 1, 1) - (1.0 / 12.0) / 3.0) <= rounding);
  CHECK(share_in(pieces, 2, 1) == 0.0);
}

TEST_CASE("shares add up to one and centroids lie in their cells") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0.0, 40.0);
  for (int trial = 0; trial < 2000; ++trial) {
    Triangle triangle;
    for (glm::dvec2& corner : triangle) corner = {place(random), place(random)};
    if (trial % 4 == 1) triangle[2] = 0.5 * (triangle[0] + triangle[1]);  // collapsed to a line
    if (trial % 4 == 2) triangle[2].y = triangle[1].y = triangle[0].y;    // along a row
    if (trial % 4 == 3) triangle[2] = triangle[1] = triangle[0];          // to a point
    const auto pieces = clip(triangle, 40, 40);
    REQUIRE(std::abs(sum_of_shares(pieces) - 1.0) <= static_cast<double>(pieces.size()) * rounding);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> seen;
    for (const CellPiece& piece : pieces) {
      REQUIRE(piece.share > 0.0);
      REQUIRE(++seen[{piece.column, piece.row}] == 1);
      // The shares of thin pieces are rounded, and so are their centroids, by up to 1e-15 of 40 cells and more.
      const glm::dvec2 at = place_of(piece, triangle) - glm::dvec2(piece.column, piece.row);
      REQUIRE(std::min(at.x, at.y) >= -1e-9);
      REQUIRE(std::max(at.x, at.y) <= 1.0 + 1e-9);
    }
  }
}

TEST_CASE("shares agree with counted points") {
  // An independent answer: points spread evenly over a triangle fall into the cells by their shares. With 1e6 points of
  // a lattice the error of a share is no more than the points along the boundary of the piece: 4 sides of up to 1000
  // points.
  const Triangle triangle{{{0.3, 0.2}, {6.9, 1.7}, {2.1, 4.8}}};
  const auto pieces = clip(triangle, 7, 5);
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> counted;
  constexpr int steps = 1414;
  constexpr double total = steps * (steps + 1) / 2.0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; i + j < steps; ++j) {
      const double second = (i + 1.0 / 3.0) / steps;
      const double third = (j + 1.0 / 3.0) / steps;
      const glm::dvec2 at = (1.0 - second - third) * triangle[0] + second * triangle[1] + third * triangle[2];
      counted[{static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y)}] += 1.0 / total;
    }
  }
  CHECK(counted.size() == pieces.size());
  for (const CellPiece& piece : pieces) {
    CHECK(std::abs(piece.share - counted[{piece.column, piece.row}]) < 4.0 * 1000.0 / total);
  }
}

TEST_CASE("a triangle collapsed to a line keeps the areas of its slices") {
  // Apex at x = 0, base at x = 4: the slice between k and k + 1 has ((k + 1)² − k²)/16 of the area.
  const auto pieces = clip({{{0.0, 0.5}, {4.0, 0.5}, {4.0, 0.5}}}, 4, 1);
  REQUIRE(pieces.size() == 4);
  for (std::uint32_t k = 0; k < 4; ++k) CHECK(std::abs(share_in(pieces, k, 0) - (2.0 * k + 1.0) / 16.0) <= rounding);
}

TEST_CASE("a tip that is only rounding makes no piece and its share is kept") {
  // The tip has (5e-7)² = 2.5e-13 of the area: below the limit of 1e-12, and far above the rounding of the sum.
  const auto pieces = clip({{{0.0, 0.0}, {1.0 + 5e-7, 0.0}, {0.0, 1.0}}}, 2, 1);
  REQUIRE(pieces.size() == 1);
  CHECK(std::abs(pieces[0].share - 1.0) <= rounding);
  // The same at the beginning, before any piece exists.
  const auto first = clip({{{1.0 - 5e-7, 0.0}, {2.0, 0.0}, {2.0, 1.0}}}, 2, 1);
  REQUIRE(first.size() == 1);
  CHECK(first[0].column == 1);
  CHECK(std::abs(first[0].share - 1.0) <= rounding);
  // A tip above rounding is a piece: (1e-3)² of the area.
  const auto real_tip = clip({{{0.0, 0.0}, {1.0 + 1e-3, 0.0}, {0.0, 1.0}}}, 2, 1);
  REQUIRE(real_tip.size() == 2);
  CHECK(std::abs(real_tip[1].share - 1e-6 / (1.001 * 1.001)) <= rounding);
}

TEST_CASE("parts outside the grid count in its outermost cells") {
  const auto pieces = clip({{{-1.0, -1.0}, {3.0, -1.0}, {-1.0, 3.0}}}, 1, 1);
  REQUIRE(pieces.size() == 1);
  CHECK(pieces[0].share == 1.0);
  const auto two = clip({{{-1.0, 0.5}, {3.0, 0.25}, {3.0, 0.75}}}, 2, 1);
  CHECK(two.size() == 2);
  CHECK(std::abs(share_in(two, 0, 0) - 0.25) <= rounding);
  CHECK(std::abs(share_in(two, 1, 0) - 0.75) <= rounding);
}

TEST_CASE("a triangle on a grid line lies in one cell") {
  CHECK(clip({{{1.0, 0.0}, {1.0, 1.0}, {1.0, 0.5}}}, 3, 1).size() == 1);
  const auto at_end = clip({{{3.0, 1.0}, {3.0, 1.0}, {3.0, 1.0}}}, 3, 1);
  REQUIRE(at_end.size() == 1);
  CHECK(at_end[0].column == 2);
  CHECK(at_end[0].row == 0);
}
