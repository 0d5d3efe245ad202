#include "lichtmc/luminous_opening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

namespace lichtmc {

namespace {

constexpr double pi = std::numbers::pi;

// A point of the ellipse of these half axes, uniform over its area; equal parts of the unit square are equal areas.
std::pair<double, double> in_ellipse(double a, double b, double u, double v) {
  const double radius = std::sqrt(u);
  return {a * radius * std::cos(2.0 * pi * v), b * radius * std::sin(2.0 * pi * v)};
}

double circumference(double a, double b) {
  // S. Ramanujan, Modular Equations and Approximations to π, 1914: below 10⁻⁴ for any axes, exact for circles.
  const double h = (a + b) > 0.0 ? (a - b) * (a - b) / ((a + b) * (a + b)) : 0.0;
  return pi * (a + b) * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));
}

// Of an elliptic cylinder along the third axis: its side and its two ends in proportion to their areas.
glm::dvec3 on_cylinder(double a, double b, double half_length, double u, double v) {
  const double side = circumference(a, b) * 2.0 * half_length;
  const double end = pi * a * b;
  const double share = side / (side + 2.0 * end);
  if (u < share) {
    const double angle = 2.0 * pi * v;
    return {a * std::cos(angle), b * std::sin(angle), half_length * (2.0 * (u / share) - 1.0)};
  }
  const double rest = (u - share) / (1.0 - share) * 2.0;
  const bool upper = rest >= 1.0;
  const auto [x, y] = in_ellipse(a, b, upper ? rest - 1.0 : rest, v);
  return {x, y, upper ? half_length : -half_length};
}

glm::dvec3 on_box(const glm::dvec3& half, double u, double v) {
  const std::array<double, 3> faces{half.y * half.z, half.z * half.x, half.x * half.y};
  double at = u * 2.0 * (faces[0] + faces[1] + faces[2]);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const double area = faces[static_cast<std::size_t>(axis)];
      const bool last = axis == 2 && side > 0.0;
      if (at >= area && !last) {
        at -= area;
        continue;
      }
      if (!(area > 0.0)) continue;
      glm::dvec3 place(0.0);
      place[axis] = side * half[axis];
      place[(axis + 1) % 3] = half[(axis + 1) % 3] * (2.0 * std::min(at / area, 1.0) - 1.0);
      place[(axis + 2) % 3] = half[(axis + 2) % 3] * (2.0 * v - 1.0);
      return place;
    }
  }
  return glm::dvec3(0.0);
}

}  // namespace

std::string_view name_of(OpeningForm form) {
  switch (form) {
    case OpeningForm::point:
      return "point";
    case OpeningForm::rectangle:
      return "rectangle";
    case OpeningForm::ellipse:
      return "ellipse";
    case OpeningForm::box:
      return "box";
    case OpeningForm::cylinder:
      return "cylinder";
    case OpeningForm::cylinder_c0:
      return "cylinder along C0";
    case OpeningForm::cylinder_c90:
      return "cylinder along C90";
    case OpeningForm::ellipsoid:
      return "ellipsoid";
  }
  return "";
}

double LuminousOpening::largest_m() const {
  return std::max({size_m.x, size_m.y, size_m.z});
}

double LuminousOpening::half_diagonal_m() const {
  return 0.5 * glm::length(size_m);
}

glm::dvec3 LuminousOpening::place(double u, double v) const {
  const glm::dvec3 half = 0.5 * size_m;
  switch (form) {
    case OpeningForm::point:
      break;
    case OpeningForm::rectangle:
      return {half.x * (2.0 * u - 1.0), half.y * (2.0 * v - 1.0), 0.0};
    case OpeningForm::ellipse: {
      const auto [x, y] = in_ellipse(half.x, half.y, u, v);
      return {x, y, 0.0};
    }
    case OpeningForm::box:
      return on_box(half, u, v);
    case OpeningForm::cylinder:
      return on_cylinder(half.x, half.y, half.z, u, v);
    case OpeningForm::cylinder_c0: {
      const glm::dvec3 p = on_cylinder(half.y, half.z, half.x, u, v);
      return {p.z, p.x, p.y};
    }
    case OpeningForm::cylinder_c90: {
      const glm::dvec3 p = on_cylinder(half.z, half.x, half.y, u, v);
      return {p.y, p.z, p.x};
    }
    case OpeningForm::ellipsoid: {
      const double z = 1.0 - 2.0 * u;
      const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
      return {half.x * radius * std::cos(2.0 * pi * v), half.y * radius * std::sin(2.0 * pi * v), half.z * z};
    }
  }
  return glm::dvec3(0.0);
}

}  // namespace lichtmc
