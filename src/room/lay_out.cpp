#include "room/lay_out.hpp"

#include <cstddef>
#include <utility>

#include "room/bounding_rectangle.hpp"
#include "room/chart.hpp"
#include "room/grow_parts.hpp"

namespace lichtmc {

namespace {

// Dividing a patch must save this share of the cells: it adds boundaries, along which tiles are parts of cells.
constexpr double least_saving = 0.15;

class PatchLayout {
 public:
  PatchLayout(const std::vector<TriangleShape>& shapes, const MeshLinks& links, double edge_m, double noise_m)
      : shapes_(shapes), links_(links), edge_m_(edge_m), noise_m_(noise_m) {}

  std::vector<LaidPatch> lay(Patch patch) const;

 private:
  // Slivers do not count in the rectangle: a spike may extend far.
  std::vector<bool> counts(const Patch& patch) const;
  LaidPatch straightened(Patch patch) const;
  double filled(const LaidPatch& laid) const;

  const std::vector<TriangleShape>& shapes_;
  const MeshLinks& links_;
  double edge_m_;
  double noise_m_;
};

std::vector<bool> PatchLayout::counts(const Patch& patch) const {
  std::vector<bool> counts;
  for (const std::uint32_t k : patch.triangles) counts.push_back(shapes_[k].thickness_m > noise_m_);
  return counts;
}

LaidPatch PatchLayout::straightened(Patch patch) const {
  const std::vector<bool> counts = this->counts(patch);
  std::vector<glm::dvec2> points;
  for (std::size_t n = 0; n < patch.triangles.size(); ++n) {
    if (counts[n]) points.insert(points.end(), patch.flat[n].begin(), patch.flat[n].end());
  }
  const glm::dvec2 along = smallest_rectangle(points);
  const auto turned = [&along](const glm::dvec2& p) {
    return glm::dvec2(along.x * p.x + along.y * p.y, along.x * p.y - along.y * p.x);
  };
  FlatRectangle bounds;
  for (std::size_t n = 0; n < patch.flat.size(); ++n) {
    for (glm::dvec2& corner : patch.flat[n]) corner = turned(corner);
    if (counts[n]) bounds.add(patch.flat[n]);
  }
  const glm::dvec2 length_m = bounds.high - bounds.low;
  return {
      std::move(patch), bounds.low, bounds.high, {cells_along(length_m.x, edge_m_), cells_along(length_m.y, edge_m_)}};
}

// The area of the surface as a share of the area of the rectangle's cells.
double PatchLayout::filled(const LaidPatch& laid) const {
  double area = 0.0;
  for (const std::uint32_t k : laid.patch.triangles) area += shapes_[k].area_m2;
  return area / (laid.cells.x * laid.cells.y * edge_m_ * edge_m_);
}

std::vector<LaidPatch> PatchLayout::lay(Patch patch) const {
  std::vector<LaidPatch> whole;
  whole.push_back(straightened(std::move(patch)));
  const Patch& straight = whole.front().patch;
  const double cells = whole.front().cells.x * whole.front().cells.y;
  if (cells <= 1.0 || straight.triangles.size() < 3 || filled(whole.front()) > 1.0 - least_saving) return whole;

  std::vector<LaidPatch> parts;
  double cells_of_parts = 0.0;
  for (const std::vector<std::size_t>& numbers : grow_parts(straight, counts(straight), links_, edge_m_)) {
    Patch part;
    for (const std::size_t n : numbers) {
      part.triangles.push_back(straight.triangles[n]);
      part.flat.push_back(straight.flat[n]);
    }
    parts.push_back(straightened(std::move(part)));
    cells_of_parts += parts.back().cells.x * parts.back().cells.y;
  }
  return cells_of_parts <= (1.0 - least_saving) * cells ? parts : whole;
}

}  // namespace

std::vector<LaidPatch> lay_out(Patch patch, const std::vector<TriangleShape>& shapes, const MeshLinks& links,
                               double edge_m, double noise_m) {
  return PatchLayout(shapes, links, edge_m, noise_m).lay(std::move(patch));
}

}  // namespace lichtmc
