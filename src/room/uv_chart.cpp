#include "room/uv_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "room/overlap.hpp"

namespace lichtmc {

namespace {

// Largest rounding error of a texture coordinate that should be 0 or 1: a decoded normalized integer or a
// KHR_texture_transform in floats has an error of some 2⁻²³.
constexpr double wrap_tolerance = 1e-6;

// Triangles whose UVs have no area may be this share of a surface: float coordinates do not determine an area more
// precisely.
constexpr double collapsed_share = 1e-6;

FlatTriangle uv_corners(const Surface& surface, std::size_t triangle) {
  const glm::uvec3 corner = surface.triangles[triangle];
  return {surface.uvs[corner.x], surface.uvs[corner.y], surface.uvs[corner.z]};
}

struct Rectangle {
  glm::dvec2 low{std::numeric_limits<double>::max()};
  glm::dvec2 high{std::numeric_limits<double>::lowest()};
};

Rectangle uv_bounds(const Surface& surface, const std::vector<TriangleShape>& shapes) {
  Rectangle bounds;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (!(shapes[k].area_m2 > 0.0)) continue;
    for (const glm::dvec2& uv : uv_corners(surface, k)) {
      bounds.low = glm::min(bounds.low, uv);
      bounds.high = glm::max(bounds.high, uv);
    }
  }
  return bounds;
}

// The largest distance by which float rounding moves UVs within these bounds relative to each other.
double uv_noise(const Rectangle& bounds) {
  const glm::dvec2 largest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  return float_noise * std::max(largest.x, largest.y);
}

std::string wrapping(const Surface& surface, const std::vector<TriangleShape>& shapes) {
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (!(shapes[k].area_m2 > 0.0)) continue;
    for (const glm::dvec2& uv : uv_corners(surface, k)) {
      for (int n = 0; n < 2; ++n) {
        if (uv[n] >= -wrap_tolerance && uv[n] <= 1.0 + wrap_tolerance) continue;
        const std::string place =
            "(triangle " + std::to_string(k) + " has " + (n == 0 ? "u = " : "v = ") + to_text(uv[n]);
        if (!std::isfinite(uv[n])) return "its UVs are degenerate " + place + ")";
        return "its UVs wrap " + place + "; without wrapping they lie from 0 to 1)";
      }
    }
  }
  return {};
}

std::string collapsed(const Surface& surface, const std::vector<TriangleShape>& shapes, double noise) {
  double area = 0.0;
  double collapsed_area = 0.0;
  std::size_t worst = 0;
  double worst_area = 0.0;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    area += shapes[k].area_m2;
    if (thickness(uv_corners(surface, k)) > noise) continue;
    collapsed_area += shapes[k].area_m2;
    if (shapes[k].area_m2 <= worst_area) continue;
    worst = k;
    worst_area = shapes[k].area_m2;
  }
  if (collapsed_area <= collapsed_share * area) return {};
  return "its UVs are degenerate (triangle " + std::to_string(worst) + " has an area of " + to_text(worst_area) +
         " m^2, but none in its UVs)";
}

std::string overlapping(const Surface& surface, const std::vector<TriangleShape>& shapes, double noise) {
  std::vector<FlatTriangle> triangles(shapes.size());
  std::vector<double> sizes(shapes.size());
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (!(shapes[k].area_m2 > 0.0)) continue;
    triangles[k] = uv_corners(surface, k);
    const auto& t = triangles[k];
    const glm::dvec2 size = glm::max(glm::max(t[0], t[1]), t[2]) - glm::min(glm::min(t[0], t[1]), t[2]);
    sizes[k] = std::max(size.x, size.y);
    order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  OverlapIndex index(noise);
  for (const std::size_t k : order) {
    const std::optional<std::size_t> other = index.add(triangles[k], k);
    if (!other) continue;
    return "its UVs overlap (triangles " + std::to_string(std::min(k, *other)) + " and " +
           std::to_string(std::max(k, *other)) + " cover the same place)";
  }
  return {};
}

// Area-weighted mean squares of |∂P/∂u| and |∂P/∂v|, in m². On a triangle P(u, v) is affine: its derivatives solve
// B − A = ∂P/∂u Δu₁ + ∂P/∂v Δv₁, C − A = ∂P/∂u Δu₂ + ∂P/∂v Δv₂.
glm::dvec2 mean_square_stretch(const Surface& surface, const std::vector<TriangleShape>& shapes, double noise) {
  glm::dvec2 sum(0.0);
  double area = 0.0;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const FlatTriangle uv = uv_corners(surface, k);
    if (!(shapes[k].area_m2 > 0.0) || !(thickness(uv) > noise)) continue;
    const glm::uvec3 corner = surface.triangles[k];
    const glm::dvec3 b = surface.positions[corner.y] - surface.positions[corner.x];
    const glm::dvec3 c = surface.positions[corner.z] - surface.positions[corner.x];
    const glm::dvec2 uv_b = uv[1] - uv[0];
    const glm::dvec2 uv_c = uv[2] - uv[0];
    const double determinant = uv_b.x * uv_c.y - uv_b.y * uv_c.x;
    const glm::dvec3 by_u = (b * uv_c.y - c * uv_b.y) / determinant;
    const glm::dvec3 by_v = (c * uv_b.x - b * uv_c.x) / determinant;
    sum += shapes[k].area_m2 * glm::dvec2(glm::dot(by_u, by_u), glm::dot(by_v, by_v));
    area += shapes[k].area_m2;
  }
  return sum / area;
}

}  // namespace

std::string uv_fault(const Surface& surface, const std::vector<TriangleShape>& shapes) {
  if (surface.uvs.empty() || surface.uvs.size() != surface.positions.size()) return "it has no UVs";
  if (std::string fault = wrapping(surface, shapes); !fault.empty()) return fault;
  const double noise = uv_noise(uv_bounds(surface, shapes));
  if (std::string fault = collapsed(surface, shapes, noise); !fault.empty()) return fault;
  return overlapping(surface, shapes, noise);
}

Chart make_uv_chart(const Surface& surface, const std::vector<TriangleShape>& shapes, double edge_m) {
  const Rectangle bounds = uv_bounds(surface, shapes);
  const double noise = uv_noise(bounds);
  const glm::dvec2 length_m = (bounds.high - bounds.low) * glm::sqrt(mean_square_stretch(surface, shapes, noise));
  Chart chart;
  chart.cells = {cells_along(length_m.x, edge_m), cells_along(length_m.y, edge_m)};
  chart.uv_min = bounds.low;
  chart.uv_max = bounds.high;
  const GridTransform grid(bounds.low, bounds.high, chart.cells, noise);
  chart.corners.resize(shapes.size());
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const FlatTriangle uv = uv_corners(surface, k);
    for (std::size_t n = 0; n < 3; ++n) {
      const bool known = std::isfinite(uv[n].x) &&
                         std::isfinite(uv[n].y);  // only triangles without area may have UVs that are not finite
      chart.corners[k][n] = known ? grid(uv[n]) : glm::dvec2(0.0);
    }
  }
  return chart;
}

}  // namespace lichtmc
