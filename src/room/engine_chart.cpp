#include "room/engine_chart.hpp"

#include <utility>

#include <glm/common.hpp>

#include "room/bounding_rectangle.hpp"
#include "room/pack.hpp"
#include "room/patches.hpp"

namespace lichtmc {

namespace {

struct Bounds {
  glm::dvec2 low{0.0};
  glm::dvec2 high{0.0};
};

bool thicker(const TriangleShape& shape, double noise_m) {
  return shape.thickness_m > noise_m;
}

// Turns the patch so that its rectangle is smallest, and returns that rectangle. Slivers have no say in it: a spike may
// reach far out.
Bounds straighten(Patch& patch, const std::vector<TriangleShape>& shapes, double noise_m) {
  std::vector<glm::dvec2> points;
  for (std::size_t n = 0; n < patch.triangles.size(); ++n) {
    if (!thicker(shapes[patch.triangles[n]], noise_m)) continue;
    points.insert(points.end(), patch.flat[n].begin(), patch.flat[n].end());
  }
  const glm::dvec2 along = smallest_rectangle(points);
  const auto turned = [&along](const glm::dvec2& p) {
    return glm::dvec2(along.x * p.x + along.y * p.y, along.x * p.y - along.y * p.x);
  };
  Bounds bounds{turned(points.front()), turned(points.front())};
  for (const glm::dvec2& point : points) {
    bounds.low = glm::min(bounds.low, turned(point));
    bounds.high = glm::max(bounds.high, turned(point));
  }
  for (FlatTriangle& triangle : patch.flat) {
    for (glm::dvec2& corner : triangle) corner = turned(corner);
  }
  return bounds;
}

bool any_area(const std::vector<std::uint32_t>& triangles, const std::vector<TriangleShape>& shapes) {
  for (const std::uint32_t k : triangles) {
    if (shapes[k].area_m2 > 0.0) return true;
  }
  return false;
}

}  // namespace

Chart make_engine_chart(const Surface& surface, const std::vector<TriangleShape>& shapes, double edge_m,
                        std::string reason) {
  const double noise_m = float_noise * largest_extent_m(surface);
  Patches cut = cut_into_patches(surface, shapes, noise_m);
  std::vector<Bounds> bounds;
  std::vector<glm::dvec2> sizes;
  for (Patch& patch : cut.patches) {
    bounds.push_back(straighten(patch, shapes, noise_m));
    const glm::dvec2 length_m = bounds.back().high - bounds.back().low;
    sizes.emplace_back(cells_along(length_m.x, edge_m), cells_along(length_m.y, edge_m));
  }
  if (any_area(cut.slivers, shapes)) sizes.emplace_back(1.0, 1.0);
  const Packing packing = pack(sizes);

  Chart chart;
  chart.source = ChartSource::engine;
  chart.reason = std::move(reason);
  chart.cells = packing.size;
  // Slivers lie in the middle of their cell; those without area need no cell of their own.
  const glm::dvec2 sliver_cell = sizes.size() > cut.patches.size() ? packing.corners.back() : glm::dvec2(0.0);
  chart.corners.resize(shapes.size());
  for (const std::uint32_t k : cut.slivers) chart.corners[k].fill(sliver_cell + 0.5);
  for (std::size_t p = 0; p < cut.patches.size(); ++p) {
    const GridMap grid(bounds[p].low, bounds[p].high, sizes[p], noise_m);
    for (std::size_t n = 0; n < cut.patches[p].triangles.size(); ++n) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        chart.corners[cut.patches[p].triangles[n]][corner] = packing.corners[p] + grid(cut.patches[p].flat[n][corner]);
      }
    }
  }
  return chart;
}

}  // namespace lichtmc
