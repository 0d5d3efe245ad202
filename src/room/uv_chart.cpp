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

// A grid on the file's UVs may have this many times the cells that the surface's area needs. Blender's default cube,
// scaled to a board, needs 6 (two faces of 1/16 each of a rectangle of 12/16); good unwraps need 1.1 to 4. Charts made
// by lichtmc need 1 to 2.3, so a layout that needs more than this wastes most of its cells, or makes most of its tiles
// far smaller than was asked for.
constexpr double most_cells_over_area = 10.0;

FlatTriangle uv_corners(const Surface& surface, std::size_t triangle) {
  const glm::uvec3 corner = surface.triangles[triangle];
  return {surface.uvs[corner.x], surface.uvs[corner.y], surface.uvs[corner.z]};
}

double doubled_area(const FlatTriangle& t) {
  const glm::dvec2 b = t[1] - t[0];
  const glm::dvec2 c = t[2] - t[0];
  return b.x * c.y - b.y * c.x;
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

// The chart's lengths along u and v, in metres.
glm::dvec2 lengths_m(const Surface& surface, const std::vector<TriangleShape>& shapes, const Rectangle& bounds,
                     double noise) {
  return (bounds.high - bounds.low) * glm::sqrt(mean_square_stretch(surface, shapes, noise));
}

// Whether a grid on the UVs would need far more cells than the area does: where the scale is uneven, because the mean
// square of the stretch belongs to the coarse parts and the fine ones get tiles far smaller than asked for; where the
// UVs fill little of their rectangle, because most cells are empty. It does not depend on the edge of a tile.
std::string spread(const Surface& surface, const std::vector<TriangleShape>& shapes, const Rectangle& bounds,
                   double noise) {
  double area_m2 = 0.0;
  double uv_area = 0.0;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (!(shapes[k].area_m2 > 0.0)) continue;
    area_m2 += shapes[k].area_m2;
    uv_area += 0.5 * std::abs(doubled_area(uv_corners(surface, k)));
  }
  const glm::dvec2 length_m = lengths_m(surface, shapes, bounds, noise);
  const double cells_over_area = length_m.x * length_m.y / area_m2;
  if (!(cells_over_area > most_cells_over_area)) return {};
  const glm::dvec2 size = bounds.high - bounds.low;
  const double empty = size.x * size.y / uv_area;  // the factor that empty cells contribute; the scale has the rest
  const std::string needs = "a grid on them would have " + short_number(cells_over_area) +
                            " times the cells of its area; allowed: " + short_number(most_cells_over_area) + ")";
  if (empty * empty > cells_over_area) return "its UVs fill little of their rectangle (" + needs;
  return "the scale of its UVs is uneven (" + needs;
}

}  // namespace

std::string uv_fault(const Surface& surface, const std::vector<TriangleShape>& shapes) {
  if (surface.uvs.empty() || surface.uvs.size() != surface.positions.size()) return "it has no UVs";
  if (std::string fault = wrapping(surface, shapes); !fault.empty()) return fault;
  const Rectangle bounds = uv_bounds(surface, shapes);
  const double noise = uv_noise(bounds);
  if (std::string fault = collapsed(surface, shapes, noise); !fault.empty()) return fault;
  if (std::string fault = spread(surface, shapes, bounds, noise); !fault.empty()) return fault;
  return overlapping(surface, shapes, noise);
}

Chart make_uv_chart(const Surface& surface, const std::vector<TriangleShape>& shapes, double edge_m) {
  const Rectangle bounds = uv_bounds(surface, shapes);
  const double noise = uv_noise(bounds);
  const glm::dvec2 length_m = lengths_m(surface, shapes, bounds, noise);
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
