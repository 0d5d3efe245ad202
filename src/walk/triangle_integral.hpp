// The integral of a smooth function over triangles in space, by subdivision until two rules agree.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lichtmc {

using Triangle = std::array<glm::dvec3, 3>;

inline double area_of(const Triangle& t) {
  return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
}

inline glm::dvec3 centroid_of(const Triangle& t) {
  return (t[0] + t[1] + t[2]) / 3.0;
}

// The greatest distance of a corner from the centroid.
inline double radius_of(const Triangle& t) {
  const glm::dvec3 c = centroid_of(t);
  return std::sqrt(
      std::fmax(glm::dot(t[0] - c, t[0] - c), std::fmax(glm::dot(t[1] - c, t[1] - c), glm::dot(t[2] - c, t[2] - c))));
}

// A triangle that was not divided further.
struct IntegratedTriangle {
  Triangle triangle{};
  double integral = 0.0;
  double error = 0.0;    // the difference of the two rules: above the error of the better one
  std::size_t part = 0;  // which of several integrated triangles this belongs to; set by the caller
};

// Seven points, exact for polynomials of degree 5 (J. Radon, Zur mechanischen Kubatur, Monatshefte für Mathematik 52,
// 1948); four of them with other weights are exact for degree 2, which gives an error estimate.
template <class Function>
IntegratedTriangle integrate_once(const Triangle& t, const Function& f) {
  const double root = std::sqrt(15.0);
  const double near_corner = (6.0 - root) / 21.0;
  const double near_side = (6.0 + root) / 21.0;
  const double weight_corner = (155.0 - root) / 1200.0;
  const double weight_side = (155.0 + root) / 1200.0;
  constexpr double weight_centre = 9.0 / 40.0;
  // Degree 2 from the centre and the points near the corners: Σ w λ² = 1/6.
  const double opposite = 1.0 - 2.0 * near_corner;
  const double weight_low = (1.0 / 18.0) / (2.0 * near_corner * near_corner + opposite * opposite - 1.0 / 3.0);
  const auto three = [&](double a) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += f((1.0 - 2.0 * a) * t[k] + a * t[(k + 1) % 3] + a * t[(k + 2) % 3]);
    return sum;
  };
  const double centre = f(centroid_of(t));
  const double corners = three(near_corner);
  const double high = weight_centre * centre + weight_corner * corners + weight_side * three(near_side);
  const double low = (1.0 - 3.0 * weight_low) * centre + weight_low * corners;
  const double area = area_of(t);
  return {t, area * high, area * std::abs(high - low), 0};
}

// Divides a triangle into four until the error of each part is at most `relative` of its integral or `absolute` times
// its area; appends the parts to `leaves`.
// coarse(triangle, depth): whether the function may vary between the points without an effect on them, so that the
// triangle, which comes from `depth` divisions, must be divided; is_zero(triangle): whether the function is 0 on all of
// it.
template <class Function, class Coarse, class IsZero>
void integrate(const Triangle& t, const Function& f, const Coarse& coarse, const IsZero& is_zero, double relative,
               double absolute, std::vector<IntegratedTriangle>& leaves, int depth = 0) {
  constexpr int deepest = 40;         // a triangle of 10⁻¹² of the size of the first
  constexpr int deepest_smooth = 10;  // few triangles of 10⁻³ of the size contain kinks: the remaining error is small
  if (is_zero(t)) return;
  const bool divide = depth < deepest && coarse(t, depth);
  if (!divide) {
    const IntegratedTriangle leaf = integrate_once(t, f);
    const double allowed = std::fmax(relative * leaf.integral, absolute * area_of(t));
    if (leaf.error <= allowed || depth >= deepest_smooth) {
      if (leaf.integral > 0.0) leaves.push_back(leaf);
      return;
    }
  }
  const glm::dvec3 ab = 0.5 * (t[0] + t[1]);
  const glm::dvec3 bc = 0.5 * (t[1] + t[2]);
  const glm::dvec3 ca = 0.5 * (t[2] + t[0]);
  const Triangle parts[] = {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}};
  for (const Triangle& part : parts) integrate(part, f, coarse, is_zero, relative, absolute, leaves, depth + 1);
}

}  // namespace lichtmc
