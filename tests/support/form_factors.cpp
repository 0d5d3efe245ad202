#include "support/form_factors.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace lichtmc::test {
namespace {

constexpr double pi = std::numbers::pi;

// x ln y, continued to x = y = 0, which it approaches where corners of two rectangles meet.
double x_log_y(double x, double y) {
  return y > 0.0 ? x * std::log(y) : 0.0;
}

// y r atan(y/r), continued to r = 0, where the arctangent stays finite.
double y_r_atan(double y, double r) {
  return r > 0.0 ? y * r * std::atan(y / r) : 0.0;
}

// H. C. Hottel, Radiant heat transmission between surfaces separated by non-absorbing media, Transactions of the ASME
// 53 (1931) 265: element → rectangle with one corner on the perpendicular from the element; odd in a and b.
double element_to_corner_parallel(double distance, double a, double b) {
  const double to_a = std::hypot(distance, a);
  const double to_b = std::hypot(distance, b);
  return (a / to_a * std::atan(b / to_a) + b / to_b * std::atan(a / to_b)) / (2.0 * pi);
}

// Element → the part of a perpendicular plane between 0 and `width` sideways and beyond `near`: the integral of d z /
// (π r⁴) over it; odd in width.
double element_to_strip_perpendicular(double distance, double width, double near) {
  const double reach = std::hypot(distance, near);
  return distance / reach * std::atan(width / reach) / (2.0 * pi);
}

// Solid angle of a rectangle with one corner on the perpendicular from the point; odd in a and b.
double corner_solid_angle(double distance, double a, double b) {
  return std::atan(a * b / (distance * std::sqrt(distance * distance + a * a + b * b)));
}

// J. R. Ehlert and T. F. Smith, View factors for perpendicular and parallel rectangular plates, Journal of
// Thermophysics and Heat Transfer 7 (1993) 173: A₁F₁₂ is the sum over all corner pairs of ±G, with the sign (−1) to the
// number of upper corners. Here u and v are the differences of the two corners' coordinates.
double parallel_corners(double u, double v, double distance) {
  const double z2 = distance * distance;
  const double along_u = y_r_atan(u, std::sqrt(v * v + z2));
  const double along_v = y_r_atan(v, std::sqrt(u * u + z2));
  return (along_u + along_v - 0.5 * z2 * std::log(u * u + v * v + z2)) / (2.0 * pi);
}

// The same paper; u the difference along the line where the planes meet, a and b the distances from it.
double perpendicular_corners(double u, double a, double b) {
  const double r2 = a * a + b * b;
  return (y_r_atan(u, std::sqrt(r2)) - 0.25 * x_log_y(r2 - u * u, r2 + u * u)) / (2.0 * pi);
}

// Σ ± corners(i, j, k, l) over the corners (i, j) of one rectangle and (k, l) of the other.
template <class Corners>
double signed_sum(const Rectangle& one, const Rectangle& other, Corners corners) {
  const std::array<double, 2> i{one.first_low, one.first_high};
  const std::array<double, 2> j{one.second_low, one.second_high};
  const std::array<double, 2> k{other.first_low, other.first_high};
  const std::array<double, 2> l{other.second_low, other.second_high};
  double sum = 0.0;
  for (unsigned n = 0; n < 16; ++n) {
    const unsigned uppers = (n & 1U) + (n >> 1U & 1U) + (n >> 2U & 1U) + (n >> 3U & 1U);
    const double term = corners(i[n & 1U], j[n >> 1U & 1U], k[n >> 2U & 1U], l[n >> 3U & 1U]);
    sum += uppers % 2 == 0 ? term : -term;
  }
  return sum;
}

double area(const Rectangle& rectangle) {
  return (rectangle.first_high - rectangle.first_low) * (rectangle.second_high - rectangle.second_low);
}

}  // namespace

double element_to_parallel_rectangle(double distance, double left, double right, double front, double back) {
  return element_to_corner_parallel(distance, left, front) + element_to_corner_parallel(distance, right, front) +
         element_to_corner_parallel(distance, left, back) + element_to_corner_parallel(distance, right, back);
}

double element_to_perpendicular_rectangle(double distance, double left, double right, double far, double near) {
  return element_to_strip_perpendicular(distance, left, near) + element_to_strip_perpendicular(distance, right, near) -
         element_to_strip_perpendicular(distance, left, far) - element_to_strip_perpendicular(distance, right, far);
}

double opposite_rectangles(double a, double b, double distance) {
  // D. C. Hamilton and W. R. Morgan, Radiant-interchange configuration factors, NACA TN 2836, 1952 (Howell C-11);
  // x and y are the edges over the distance.
  const double x = a / distance;
  const double y = b / distance;
  const double x1 = std::sqrt(1.0 + x * x);
  const double y1 = std::sqrt(1.0 + y * y);
  const double logarithm = std::log(x1 * y1 / std::sqrt(1.0 + x * x + y * y));
  const double arctangents =
      x * y1 * std::atan(x / y1) + y * x1 * std::atan(y / x1) - x * std::atan(x) - y * std::atan(y);
  return 2.0 / (pi * x * y) * (logarithm + arctangents);
}

double rectangles_with_common_edge(double common, double from, double to) {
  // Hamilton and Morgan, as above (Howell C-14); h and w are the other edges over the common one.
  const double h = to / common;
  const double w = from / common;
  const double h2 = h * h;
  const double w2 = w * w;
  const double s2 = h2 + w2;
  const double s = std::sqrt(s2);
  const double arctangents = w * std::atan(1.0 / w) + h * std::atan(1.0 / h) - s * std::atan(1.0 / s);
  const double logarithms = std::log((1.0 + w2) * (1.0 + h2) / (1.0 + s2)) +
                            w2 * std::log(w2 * (1.0 + s2) / ((1.0 + w2) * s2)) +
                            h2 * std::log(h2 * (1.0 + s2) / ((1.0 + h2) * s2));
  return (arctangents + 0.25 * logarithms) / (pi * w);
}

double parallel_rectangles(const Rectangle& from, const Rectangle& to, double distance) {
  const auto corners = [distance](double u1, double v1, double u2, double v2) {
    return parallel_corners(u1 - u2, v1 - v2, distance);
  };
  return signed_sum(from, to, corners) / area(from);
}

double perpendicular_rectangles(const Rectangle& from, const Rectangle& to) {
  const auto corners = [](double u1, double a, double u2, double b) { return perpendicular_corners(u1 - u2, a, b); };
  return signed_sum(from, to, corners) / area(from);
}

double coaxial_disks(double r1, double r2, double distance) {
  // Hamilton and Morgan, as above (Howell C-41). The smaller solution of F² − X F + (r₂/r₁)² = 0, X = 1 + (1 +
  // R₂²)/R₁², in the form without cancellation.
  const double ratio2 = r2 / r1 * (r2 / r1);
  const double x = 1.0 + distance * distance / (r1 * r1) + ratio2;
  return 2.0 * ratio2 / (x + std::sqrt(x * x - 4.0 * ratio2));
}

double point_to_coaxial_disk(double exponent, double radius, double distance) {
  // 1 − cos^{m+1} of the half angle of the disk: the integral of (m+1) cos^m θ sin θ.
  const double tangent = radius / distance;
  return -std::expm1(-0.5 * (exponent + 1.0) * std::log1p(tangent * tangent));
}

double isotropic_point_to_rectangle(double distance, double left, double right, double front, double back) {
  return (corner_solid_angle(distance, left, front) + corner_solid_angle(distance, right, front) +
          corner_solid_angle(distance, left, back) + corner_solid_angle(distance, right, back)) /
         (4.0 * pi);
}

}  // namespace lichtmc::test
