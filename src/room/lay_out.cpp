#include "room/lay_out.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <queue>
#include <set>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>

#include "room/bounding_rectangle.hpp"
#include "room/chart.hpp"

namespace lichtmc {

namespace {

// Dividing a patch must save this share of the cells: it adds boundaries, along which tiles are parts of cells.
constexpr double least_saving = 0.15;

struct Rectangle {
  glm::dvec2 low{std::numeric_limits<double>::max()};
  glm::dvec2 high{std::numeric_limits<double>::lowest()};

  bool empty() const { return low.x > high.x; }
  void add(const FlatTriangle& triangle) {
    for (const glm::dvec2& corner : triangle) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  }
  void add(const Rectangle& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
};

// The parts of a patch, grown from single triangles: of all pairs of parts with an edge in common, the pair whose
// common rectangle saves most cells is joined first, as long as it saves any.
class Parts {
 public:
  // Triangles that do not count in the bounds join a neighbour.
  Parts(const Patch& patch, const std::vector<bool>& counts, const MeshLinks& links, double edge_m);

  // The triangles of every part, as numbers in the patch.
  std::vector<std::vector<std::size_t>> grow();

 private:
  struct Part {
    Rectangle bounds;
    std::vector<std::size_t> triangles;
    std::set<std::size_t> neighbours;
    std::size_t joined_into = none;
    std::size_t version = 0;  // increases with every change
  };
  // Two parts in the versions for which the gain was computed.
  struct Merge {
    double gain = 0.0;
    std::size_t a = 0;
    std::size_t b = 0;
    std::size_t version_a = 0;
    std::size_t version_b = 0;
    bool operator<(const Merge& other) const {
      if (gain != other.gain) return gain < other.gain;
      return std::pair(a, b) > std::pair(other.a, other.b);
    }
  };
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  double cost(const Rectangle& bounds) const;
  void consider(std::size_t a, std::size_t b);
  void join(std::size_t a, std::size_t b);

  double edge_m_;
  std::vector<Part> parts_;
  std::priority_queue<Merge> merges_;
};

Parts::Parts(const Patch& patch, const std::vector<bool>& counts, const MeshLinks& links, double edge_m)
    : edge_m_(edge_m), parts_(patch.triangles.size()) {
  std::unordered_map<std::uint32_t, std::size_t> number;
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    number.emplace(patch.triangles[n], n);
    if (counts[n]) parts_[n].bounds.add(patch.flat[n]);
    parts_[n].triangles = {n};
  }
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      for (const std::uint32_t triangle : links.at_edge(patch.triangles[n], edge)) {
        const auto neighbour = number.find(triangle);
        if (neighbour != number.end() && neighbour->second != n) parts_[n].neighbours.insert(neighbour->second);
      }
    }
  }
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    for (const std::size_t other : parts_[n].neighbours) {
      if (other > n) consider(n, other);
    }
  }
}

// Cells, not rounded, but no less than one each way.
double Parts::cost(const Rectangle& bounds) const {
  if (bounds.empty()) return 0.0;
  const glm::dvec2 cells = glm::max((bounds.high - bounds.low) / edge_m_, glm::dvec2(1.0));
  return cells.x * cells.y;
}

void Parts::consider(std::size_t a, std::size_t b) {
  Rectangle both = parts_[a].bounds;
  both.add(parts_[b].bounds);
  // A loss within rounding is allowed, so that slivers and strips in line are joined.
  constexpr double rounding = 1e-9;
  const double together = cost(both);
  const double gain = cost(parts_[a].bounds) + cost(parts_[b].bounds) - together;
  if (gain >= -rounding * together) merges_.push({gain, a, b, parts_[a].version, parts_[b].version});
}

void Parts::join(std::size_t a, std::size_t b) {
  if (parts_[a].triangles.size() < parts_[b].triangles.size()) std::swap(a, b);
  Part& large = parts_[a];
  Part& small = parts_[b];
  large.bounds.add(small.bounds);
  large.triangles.insert(large.triangles.end(), small.triangles.begin(), small.triangles.end());
  small.joined_into = a;
  ++large.version;
  ++small.version;
  large.neighbours.erase(b);
  for (const std::size_t other : small.neighbours) {
    if (other == a) continue;
    large.neighbours.insert(other);
    parts_[other].neighbours.erase(b);
    parts_[other].neighbours.insert(a);
  }
  small.neighbours.clear();
  small.triangles.clear();
  for (const std::size_t other : large.neighbours) consider(std::min(a, other), std::max(a, other));
}

std::vector<std::vector<std::size_t>> Parts::grow() {
  while (!merges_.empty()) {
    const Merge best = merges_.top();
    merges_.pop();
    if (best.version_a != parts_[best.a].version || best.version_b != parts_[best.b].version) continue;
    join(best.a, best.b);
  }
  std::vector<std::vector<std::size_t>> grown;
  std::vector<std::size_t> without_bounds;
  for (const Part& part : parts_) {
    if (part.joined_into != none) continue;
    if (part.bounds.empty()) {
      without_bounds.insert(without_bounds.end(), part.triangles.begin(), part.triangles.end());
    } else {
      grown.push_back(part.triangles);
    }
  }
  grown.front().insert(grown.front().end(), without_bounds.begin(), without_bounds.end());
  return grown;
}

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
  Rectangle bounds;
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
  for (const std::vector<std::size_t>& numbers : Parts(straight, counts(straight), links_, edge_m_).grow()) {
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
