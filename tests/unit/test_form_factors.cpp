// The form factors that the verification tests use: compared with printed values, with each other, and with laws
// (reciprocity, closed rooms, additivity).
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/form_factors.hpp"

using namespace lichtmc::test;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
// Of the closed forms for one element, one point or two like rectangles: about ten terms of a size up to 5, each
// rounded a few times.
constexpr double rounding = 200.0 * epsilon;
// Of the sums over corners: 16 terms of the size of the extent squared, about 30 here, each rounded four times; the
// area they are divided by is at least 1.
constexpr double corner_rounding = 16.0 * 30.0 * 4.0 * epsilon;

bool within(double value, double expected, double tolerance) {
  UNSCOPED_INFO("value " << value << ", expected " << expected << ", off by " << value - expected);
  return std::abs(value - expected) <= tolerance;
}

double area(const Rectangle& r) {
  return (r.first_high - r.first_low) * (r.second_high - r.second_low);
}

// Mean of f over a rectangle by n × n midpoints.
template <class Function>
double mean(const Rectangle& r, int n, Function f) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double first = r.first_low + (r.first_high - r.first_low) * (i + 0.5) / n;
      const double second = r.second_low + (r.second_high - r.second_low) * (j + 0.5) / n;
      sum += f(first, second);
    }
  }
  return sum / (static_cast<double>(n) * n);
}

struct Extrapolated {
  double value;
  double error;  // change by the last halving of the step; the remaining error is a small part of it
};

// Midpoint sums err by c/n² + d/n⁴ + …: of three of them the first two orders cancel (Richardson).
template <class Function>
Extrapolated extrapolated_mean(const Rectangle& r, Function f) {
  const double a = mean(r, 20, f);
  const double b = mean(r, 40, f);
  const double c = mean(r, 80, f);
  const double ab = b + (b - a) / 3.0;
  const double bc = c + (c - b) / 3.0;
  return {bc + (bc - ab) / 15.0, std::abs(bc - ab)};
}

}  // namespace

TEST_CASE("a diffuse floor illuminates wall and ceiling as in CIE 171 case 5.6") {
  // Floor 4 × 4 m; 100 E/M on a wall along its edge and on a ceiling 3 m above it, in the middle of the width. Printed
  // to 6 decimals: half of the last is the tolerance.
  const double printed = 0.5e-6;
  for (const auto& [height, value] : std::vector<std::pair<double, double>>{
           {0.75, 35.900505}, {1.25, 27.991624}, {1.75, 21.638511}, {2.25, 16.716315}, {2.75, 12.967372}}) {
    CHECK(within(100.0 * element_to_perpendicular_rectangle(height, 2.0, 2.0, 4.0), value, printed));
  }
  for (const auto& [y, value] : std::vector<std::pair<double, double>>{
           {0.25, 26.795188}, {0.75, 30.938711}, {1.25, 33.975719}, {1.75, 35.566592}}) {
    CHECK(within(100.0 * element_to_parallel_rectangle(3.0, 2.0, 2.0, y, 4.0 - y), value, printed));
  }
}

TEST_CASE("form factors of boxes have their printed values") {
  // 15 digits of the cube, 12 of the box 5 × 4 × 3 m; rounding of the terms beside half of the last digit.
  const double cube = 0.5e-15 + rounding;
  CHECK(within(opposite_rectangles(1.0, 1.0, 1.0), 0.199824895698387, cube));
  CHECK(within(rectangles_with_common_edge(1.0, 1.0, 1.0), 0.200043776075403, cube));
  const double box = 0.5e-12 + rounding;
  CHECK(within(opposite_rectangles(5.0, 4.0, 3.0), 0.316319794170, box));
  CHECK(within(rectangles_with_common_edge(4.0, 5.0, 3.0), 0.150839089205, box));
  CHECK(within(rectangles_with_common_edge(5.0, 4.0, 3.0), 0.191001013710, box));
  CHECK(within(opposite_rectangles(4.0, 3.0, 5.0), 0.116827664251, box));
  CHECK(within(opposite_rectangles(5.0, 3.0, 4.0), 0.186363666053, box));
  CHECK(within(rectangles_with_common_edge(3.0, 4.0, 5.0), 0.190187685866, box));
}

TEST_CASE("form factors of elements in a cube have their printed values") {
  const double printed = 0.5e-12 + rounding;
  CHECK(within(element_to_parallel_rectangle(1.0, 0.5, 0.5, 0.5, 0.5), 0.239456470461, printed));
  CHECK(within(element_to_perpendicular_rectangle(0.5, 0.5, 0.5, 1.0), 0.190135882385, printed));
  CHECK(within(element_to_parallel_rectangle(1.0, 0.0, 1.0, 0.0, 1.0), 0.138531605995, printed));
  // An element in the cube's centre: ceiling and the upper half of a wall.
  CHECK(within(element_to_parallel_rectangle(0.5, 0.5, 0.5, 0.5, 0.5), 0.554126423980, printed));
  CHECK(within(element_to_perpendicular_rectangle(0.5, 0.5, 0.5, 0.5), 0.111468394005, printed));
}

TEST_CASE("close plates exchange nearly all their light") {
  // 1 − F of unit squares a gap g apart, printed to 9 digits; F is near 1, so rounding counts in full.
  CHECK(within(1.0 - opposite_rectangles(1.0, 1.0, 1e-3), 0.00199436809, 0.5e-11 + rounding));
  CHECK(within(1.0 - opposite_rectangles(1.0, 1.0, 1e-6), 1.99998997e-6, 0.5e-14 + rounding));
}

TEST_CASE("form factors of general rectangles include the special cases") {
  const Rectangle unequal{0.0, 5.0, 0.0, 4.0};
  CHECK(within(parallel_rectangles(unequal, unequal, 3.0), opposite_rectangles(5.0, 4.0, 3.0), corner_rounding));
  const Rectangle wall{0.0, 5.0, 0.0, 3.0};
  CHECK(within(perpendicular_rectangles(unequal, wall), rectangles_with_common_edge(5.0, 4.0, 3.0), corner_rounding));
}

TEST_CASE("form factors from every side of a closed box add up to 1") {
  for (const auto& [a, b, c] : std::vector<std::tuple<double, double, double>>{{5.0, 4.0, 3.0}, {1.0, 7.0, 2.0}}) {
    const double sum = opposite_rectangles(a, b, c) + 2.0 * rectangles_with_common_edge(a, b, c) +
                       2.0 * rectangles_with_common_edge(b, a, c);
    CHECK(within(sum, 1.0, rounding));
  }
  // From an element on the floor, 1 m and 1.5 m from two of its sides.
  const double element =
      element_to_parallel_rectangle(3.0, 1.0, 4.0, 1.5, 2.5) + element_to_perpendicular_rectangle(1.0, 1.5, 2.5, 3.0) +
      element_to_perpendicular_rectangle(4.0, 1.5, 2.5, 3.0) + element_to_perpendicular_rectangle(1.5, 1.0, 4.0, 3.0) +
      element_to_perpendicular_rectangle(2.5, 1.0, 4.0, 3.0);
  CHECK(within(element, 1.0, rounding));
}

TEST_CASE("form factors are reciprocal") {
  const Rectangle one{0.5, 2.0, 1.0, 4.0};
  const Rectangle other{-1.0, 3.0, 0.25, 1.5};
  CHECK(within(area(one) * parallel_rectangles(one, other, 0.7), area(other) * parallel_rectangles(other, one, 0.7),
               corner_rounding));
  CHECK(within(area(one) * perpendicular_rectangles(one, other), area(other) * perpendicular_rectangles(other, one),
               corner_rounding));
  // A 5 × 4 floor and a 5 × 3 wall; disks of radii 2 and 0.5.
  CHECK(within(20.0 * rectangles_with_common_edge(5.0, 4.0, 3.0), 15.0 * rectangles_with_common_edge(5.0, 3.0, 4.0),
               20.0 * rounding));
  CHECK(within(4.0 * coaxial_disks(2.0, 0.5, 1.5), 0.25 * coaxial_disks(0.5, 2.0, 1.5), 4.0 * rounding));
}

TEST_CASE("the form factor of a rectangle is the mean of those of its elements") {
  // Rectangles that do not touch, offset both ways: the mean over the elements is smooth.
  const Rectangle one{0.5, 2.0, 1.0, 4.0};
  const Rectangle other{-1.0, 3.0, 0.25, 1.5};
  const Extrapolated parallel = extrapolated_mean(one, [&](double u, double v) {
    return element_to_parallel_rectangle(0.7, u - other.first_low, other.first_high - u, v - other.second_low,
                                         other.second_high - v);
  });
  CHECK(parallel.error < 1e-7);
  CHECK(within(parallel_rectangles(one, other, 0.7), parallel.value, parallel.error + corner_rounding));
  const Extrapolated perpendicular = extrapolated_mean(one, [&](double along, double from_line) {
    return element_to_perpendicular_rectangle(from_line, along - other.first_low, other.first_high - along,
                                              other.second_high, other.second_low);
  });
  CHECK(perpendicular.error < 1e-7);
  CHECK(within(perpendicular_rectangles(one, other), perpendicular.value, perpendicular.error + corner_rounding));
}

TEST_CASE("form factors onto the parts of a rectangle add up") {
  const double whole = element_to_parallel_rectangle(2.0, 1.0, 3.0, 0.5, 1.0);
  const double beside = element_to_parallel_rectangle(2.0, -1.0, 3.0, 0.5, 1.0);
  const double below = element_to_parallel_rectangle(2.0, 1.0, 1.0, 0.5, 1.0);
  CHECK(within(beside + below, whole, rounding));
  CHECK(beside > 0.0);
  const double tall = element_to_perpendicular_rectangle(1.0, 1.0, 2.0, 4.0);
  const double upper = element_to_perpendicular_rectangle(1.0, 1.0, 2.0, 4.0, 1.5);
  const double lower = element_to_perpendicular_rectangle(1.0, 1.0, 2.0, 1.5);
  CHECK(within(upper + lower, tall, rounding));
  CHECK(upper > 0.0);
}

TEST_CASE("shares of point emitters onto a disk have their printed values") {
  // Radius over distance 0.5; the values for small m are short decimals or printed to 9 digits.
  CHECK(within(point_to_coaxial_disk(0.0, 0.5, 1.0), 0.105572809, 0.5e-9));
  CHECK(within(point_to_coaxial_disk(1.0, 0.5, 1.0), 0.2, rounding));
  CHECK(within(point_to_coaxial_disk(5.0, 0.5, 1.0), 0.488, rounding));
  CHECK(within(point_to_coaxial_disk(100.0, 0.5, 1.0), 0.999987234309, 0.5e-12));
  // A disk of radius 1e-6 becomes an element; F of disks then differs by about its radius squared.
  CHECK(within(coaxial_disks(1e-6, 0.5, 1.0), point_to_coaxial_disk(1.0, 0.5, 1.0), 2e-12));
  // Equal disks one radius apart: (3 − √5)/2.
  CHECK(within(coaxial_disks(1.0, 1.0, 1.0), (3.0 - std::sqrt(5.0)) / 2.0, rounding));
}

TEST_CASE("the flux of an isotropic point emitter divides among the sides of a box") {
  CHECK(within(isotropic_point_to_rectangle(0.5, 0.5, 0.5, 0.5, 0.5), 1.0 / 6.0, rounding));
  // Box 5 × 4 × 3 m, the point 1, 1.5 and 0.5 m from three of its sides.
  const double sum =
      isotropic_point_to_rectangle(1.0, 1.5, 2.5, 0.5, 2.5) + isotropic_point_to_rectangle(4.0, 1.5, 2.5, 0.5, 2.5) +
      isotropic_point_to_rectangle(1.5, 1.0, 4.0, 0.5, 2.5) + isotropic_point_to_rectangle(2.5, 1.0, 4.0, 0.5, 2.5) +
      isotropic_point_to_rectangle(0.5, 1.0, 4.0, 1.5, 2.5) + isotropic_point_to_rectangle(2.5, 1.0, 4.0, 1.5, 2.5);
  CHECK(within(sum, 1.0, rounding));
}
