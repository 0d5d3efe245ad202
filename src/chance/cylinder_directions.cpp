#include "chance/cylinder_directions.hpp"

#include <cmath>
#include <numbers>

namespace lichtmc {

namespace {

constexpr double pi = std::numbers::pi;

// The density of ε is 2 sin²ε/π: its integral is (2ε − sin 2ε)/(2π).
double angle_to_axis(double u) {
  return 0.5 * cycloid_angle(2.0 * pi * u);
}

CylinderDirection direction_at(double to_axis, double about) {
  const double sine = std::sin(to_axis);
  return {{sine * std::cos(about), sine * std::sin(about), std::cos(to_axis)}, 0.0};
}

}  // namespace

// A series in s = (6m)^(1/3), which is exact to rounding up to s = 0.1, then Newton's method: from s = 2.66, at m = π,
// its first value is within 0.04 and the third within 10⁻¹².
double cycloid_angle(double m) {
  if (m > pi) return 2.0 * pi - cycloid_angle(2.0 * pi - m);
  const double s = std::cbrt(6.0 * m);
  const double squared = s * s;
  double x = s * (1.0 + squared * (1.0 / 60.0 + squared * (1.0 / 1400.0 + squared * (1.0 / 25200.0))));
  if (s < 0.1) return x;
  for (int step = 0; step < 3; ++step) x -= (x - std::sin(x) - m) / (1.0 - std::cos(x));
  return x;
}

CylinderDirection cylinder_direction(double u, double v) {
  const double to_axis = angle_to_axis(u);
  CylinderDirection found = direction_at(to_axis, 2.0 * pi * v);
  found.weight = std::sin(to_axis) / pi;
  return found;
}

// The density of α is (1 + cos α)/2π: its integral from −π is (α + π + sin α)/2π, and x = α + π.
CylinderDirection half_cylinder_direction(double u, double v) {
  const double to_axis = angle_to_axis(u);
  const double x = cycloid_angle(2.0 * pi * v);
  CylinderDirection found = direction_at(to_axis, x - pi);
  const double half = std::sin(0.5 * x);
  found.weight = std::sin(to_axis) * 2.0 * half * half / pi;  // 1 + cos α = 2 sin²(x/2)
  return found;
}

}  // namespace lichtmc
