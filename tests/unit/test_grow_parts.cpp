#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "room/grow_parts.hpp"
#include "room/mesh_links.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

namespace {

// A plane mesh of n × n squares of two triangles, without those for which `hole` holds; corners are moved at random by
// up to `noise` of a square.
template <class Hole>
Surface mesh_with(std::uint32_t n, double edge, double noise, const Hole& hole) {
  std::mt19937 bits(5);
  std::uniform_real_distribution<double> shift(-noise, noise);
  Surface surface;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x)
      surface.positions.emplace_back(edge * (x + shift(bits)), edge * (y + shift(bits)), 0.0);
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      if (hole(x, y)) continue;
      const std::uint32_t a = y * (n + 1) + x;
      surface.triangles.emplace_back(a, a + 1, a + n + 2);
      surface.triangles.emplace_back(a, a + n + 2, a + n + 1);
    }
  }
  return surface;
}

Patch as_patch(const Surface& surface) {
  Patch patch;
  for (std::uint32_t k = 0; k < surface.triangles.size(); ++k) {
    patch.triangles.push_back(k);
    const glm::uvec3 t = surface.triangles[k];
    patch.flat.push_back(
        {glm::dvec2(surface.positions[t.x]), glm::dvec2(surface.positions[t.y]), glm::dvec2(surface.positions[t.z])});
  }
  return patch;
}

// The rule itself: in every step all pairs are evaluated.
class PlainGrowth {
 public:
  PlainGrowth(const Patch& patch, const std::vector<bool>& counts, const MeshLinks& links, double edge_m)
      : edge_m_(edge_m), parts_(patch.triangles.size()) {
    for (std::size_t n = 0; n < parts_.size(); ++n) {
      parts_[n].triangles = {n};
      if (counts[n]) parts_[n].bounds.add(patch.flat[n]);
      for (std::size_t edge = 0; edge < 3; ++edge) {
        for (const std::uint32_t other : links.at_edge(n, edge)) {
          if (other != n) parts_[n].neighbours.insert(other);
        }
      }
    }
  }
  std::vector<std::vector<std::size_t>> grow() {
    while (join_best()) {
    }
    std::vector<std::vector<std::size_t>> grown;
    std::vector<std::size_t> without_bounds;
    for (const Part& part : parts_) {
      if (part.triangles.empty()) continue;
      if (part.bounds.empty()) {
        without_bounds.insert(without_bounds.end(), part.triangles.begin(), part.triangles.end());
      } else {
        grown.push_back(part.triangles);
      }
    }
    grown.front().insert(grown.front().end(), without_bounds.begin(), without_bounds.end());
    return grown;
  }

 private:
  struct Part {
    FlatRectangle bounds;
    std::vector<std::size_t> triangles;
    std::set<std::size_t> neighbours;
  };
  double cost(const FlatRectangle& bounds) const {
    if (bounds.empty()) return 0.0;
    const glm::dvec2 cells = glm::max((bounds.high - bounds.low) / edge_m_, glm::dvec2(1.0));
    return cells.x * cells.y;
  }
  bool join_best() {
    bool found = false;
    double best = 0.0;
    std::pair<std::size_t, std::size_t> which;
    for (std::size_t a = 0; a < parts_.size(); ++a) {
      for (const std::size_t b : parts_[a].neighbours) {
        if (b < a) continue;
        FlatRectangle both = parts_[a].bounds;
        both.add(parts_[b].bounds);
        const double gain = cost(parts_[a].bounds) + cost(parts_[b].bounds) - cost(both);
        if (!(gain >= -1e-9 * cost(both)) || (found && gain <= best)) continue;
        found = true;
        best = gain;
        which = {a, b};
      }
    }
    if (!found) return false;
    auto [a, b] = which;
    if (parts_[a].triangles.size() < parts_[b].triangles.size()) std::swap(a, b);
    parts_[a].bounds.add(parts_[b].bounds);
    parts_[a].triangles.insert(parts_[a].triangles.end(), parts_[b].triangles.begin(), parts_[b].triangles.end());
    for (const std::size_t other : parts_[b].neighbours) {
      parts_[other].neighbours.erase(b);
      if (other == a) continue;
      parts_[a].neighbours.insert(other);
      parts_[other].neighbours.insert(a);
    }
    parts_[b] = {};
    return true;
  }

  double edge_m_;
  std::vector<Part> parts_;
};

const auto frame = [](std::uint32_t n) {
  return [n](std::uint32_t x, std::uint32_t y) { return 4 * x >= n && 4 * x < 3 * n && 4 * y >= n && 4 * y < 3 * n; };
};

}  // namespace

TEST_CASE("parts grow as by the rule itself") {
  for (const double noise : {0.0, 0.3}) {
    for (const double cell : {0.3, 1.0, 2.7}) {  // in squares of the mesh
      for (const std::uint32_t n : {3U, 8U, 11U}) {
        CAPTURE(noise, cell, n);
        const Surface surface = mesh_with(n, 0.1, noise, frame(n));
        const Patch patch = as_patch(surface);
        const MeshLinks links(surface);
        std::vector<bool> counts(patch.triangles.size(), true);
        for (std::size_t k = 0; k < counts.size(); k += 7) counts[k] = noise == 0.0 || k % 2 == 0;
        const auto grown = grow_parts(patch, counts, links, 0.1 * cell);
        CHECK(grown == PlainGrowth(patch, counts, links, 0.1 * cell).grow());
      }
    }
  }
}

// Four times the triangles take little more than four times the pairs: n log n. With all neighbours of a part evaluated
// after every step, it would be eight times (n^1.5).
TEST_CASE("the work to grow parts is nearly proportional to the triangles") {
  for (const double noise : {0.0, 0.3}) {
    CAPTURE(noise);
    const auto pairs = [&](std::uint32_t n) {
      const Surface surface = mesh_with(n, 4.0 / n, noise, frame(n));
      const Patch patch = as_patch(surface);
      std::uint64_t evaluated = 0;
      grow_parts(patch, std::vector<bool>(patch.triangles.size(), true), MeshLinks(surface), 0.1, &evaluated);
      return static_cast<double>(evaluated) / static_cast<double>(patch.triangles.size());
    };
    const double few = pairs(80);
    const double many = pairs(320);
    CAPTURE(few, many);
    CHECK(many < 1.5 * few);
    CHECK(many < 40.0);
  }
}
