// The grid of EN 12464-1: number of points of calculation areas.
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "lichtmc/lichtmc.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

namespace {

struct Row {
  double length_m;
  std::uint32_t in_table;
  std::uint32_t by_formula;
};

}  // namespace

// EN 12464-1:2011, Table A.1. At 0.4, 0.6, 25 and 50 m the table, which rounds the greatest cell, has one point less or
// more than the standard's formula.
TEST_CASE("areas: the rows of the standard's table") {
  for (const Row row : {Row{0.4, 3, 4}, Row{0.6, 3, 4}, Row{1.0, 5, 5}, Row{2.0, 6, 6}, Row{5.0, 8, 8},
                        Row{10.0, 10, 10}, Row{25.0, 12, 13}, Row{50.0, 17, 16}, Row{100.0, 20, 20}}) {
    const GridSize grid = grid_of_en_12464(row.length_m, row.length_m);
    CHECK(grid.columns == row.by_formula);
    CHECK(grid.rows == row.by_formula);
    const int difference = static_cast<int>(row.in_table) - static_cast<int>(row.by_formula);
    CHECK(std::abs(difference) <= 1);
  }
}

TEST_CASE("areas: the other side follows the spacing, and a ratio of 2 counts from the shorter side") {
  const auto size = [](double width, double height) {
    const GridSize grid = grid_of_en_12464(width, height);
    return std::pair(grid.columns, grid.rows);
  };
  CHECK(size(6.0, 5.0) == std::pair(9U, 8U));  // p = 0.70 m
  CHECK(size(5.0, 6.0) == std::pair(8U, 9U));
  CHECK(size(5.0, 4.0) == std::pair(8U, 6U));          // p = 0.62 m
  CHECK(size(10.0, 5.0) == std::pair(16U, 8U));        // a ratio of 2: p of 5 m
  CHECK(size(1.6, 0.80000001) == std::pair(10U, 5U));  // the same for floats
  CHECK(size(9.99, 5.0) == std::pair(10U, 5U));        // below: p of 10 m
  CHECK(size(12.0, 5.0) == std::pair(19U, 8U));
  CHECK(size(1.6, 0.8) == std::pair(10U, 5U));  // a desk
}

TEST_CASE("areas: tiny and huge sides; cells are between 1 : 2 and 2 : 1") {
  CHECK(grid_of_en_12464(1e-3, 1e-3).columns == 1);
  CHECK(grid_of_en_12464(5000.0, 4000.0).columns == 500);  // p is 10 m at most
  for (const double height : {0.001, 0.03, 0.4, 1.0, 1.9, 3.0, 4.999, 7.0, 31.0}) {
    for (const double ratio : {1.0, 1.2, 1.49, 1.5, 1.99, 2.0, 2.7, 9.0, 50.0}) {
      const double width = ratio * height;
      const GridSize grid = grid_of_en_12464(width, height);
      const double shape = (width / grid.columns) / (height / grid.rows);
      CHECK(shape >= 0.5 - 1e-9);
      CHECK(shape <= 2.0 + 1e-9);
    }
  }
  CHECK_THROWS_WITH(grid_of_en_12464(1e6, 1e6), ContainsSubstring("up to 1e6"));
  CHECK_THROWS_AS(grid_with_spacing(10.0, 10.0, 1e-9), InputError);
}

TEST_CASE("areas: no cell is longer than a spacing that is given, but for rounding") {
  CHECK(grid_with_spacing(5.0, 4.0, 0.5).columns == 10);
  CHECK(grid_with_spacing(5.0, 4.0, 0.5).rows == 8);
  CHECK(grid_with_spacing(5.00001, 3.99999, 0.5).columns == 10);  // floats of 5 m and 4 m
  CHECK(grid_with_spacing(5.9999, 3.99999, 0.5).columns == 12);
  CHECK(grid_with_spacing(5.01, 4.0, 0.5).columns == 11);
  CHECK(grid_with_spacing(0.3, 0.3, 0.5).columns == 1);
  // A strip: its cells are divided to 2 : 1.
  const GridSize strip = grid_with_spacing(6.0, 0.1, 0.5);
  CHECK(strip.rows == 1);
  CHECK(strip.columns == 30);
}
