#include "view/side_patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "room/bounds.hpp"
#include "room/mesh_links.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

namespace {

constexpr double least_share = 1e-3;     // of the mean impacts per area that makes a side lit
constexpr double few_impacts = 20.0;     // expected on a piece, for it to be judged: none comes by chance once in 5e8
constexpr double bend_cosine = 0.866;    // cos 30°
constexpr double flat_cosine = 0.99985;  // cos 1°
constexpr double patch_impacts = 50.0;   // expected on a patch: fewer patches to look at
constexpr double most_patches = 20'000;  // patches get larger instead: limits the time in rooms with much dark area
// Surroundings of this many expected impacts decide in any case: a side with the least share gets 5 on average there.
constexpr double decisive_impacts = 5.0 / least_share;
constexpr double enough_hits = 4.0;  // in smaller surroundings: not one stray photon alone
// Of the mean near a small piece with few hits that makes it lit: in darker places it would be seen by its outline
// only.
constexpr double near_share = 1e-2;
constexpr int grid_cells = 16;  // along the longest side of the room, for small pieces

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// Nodes with links to each other; the links of a node are consecutive.
class Graph {
 public:
  using Link = std::array<std::uint32_t, 2>;
  Graph(std::size_t nodes, const std::vector<Link>& links) : first_(nodes + 1), others_(2 * links.size()) {
    for (const Link& link : links) {
      for (const std::uint32_t end : link) ++first_[end + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const Link& link : links) {
      others_[next[link[0]]++] = link[1];
      others_[next[link[1]]++] = link[0];
    }
  }
  std::size_t size() const { return first_.size() - 1; }
  std::span<const std::uint32_t> links(std::size_t node) const {
    return {others_.data() + first_[node], first_[node + 1] - first_[node]};
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> others_;
};

// Visits the surroundings of nodes, the nearest first.
class Surroundings {
 public:
  explicit Surroundings(const Graph& graph) : graph_(&graph), visited_(graph.size(), none) {}

  // Calls visit(node), also for `start`, until it returns false or all connected nodes have been visited. Nodes for
  // which may_enter(node) is false are not entered. Returns whether visit() has ended it.
  template <class Visit, class MayEnter>
  bool visit(std::uint32_t start, const Visit& visit, const MayEnter& may_enter) {
    queue_.assign(1, start);
    visited_[start] = start;
    for (std::size_t at = 0; at < queue_.size(); ++at) {
      if (!visit(queue_[at])) return true;
      for (const std::uint32_t other : graph_->links(queue_[at])) {
        if (visited_[other] == start || !may_enter(other)) continue;
        visited_[other] = start;
        queue_.push_back(other);
      }
    }
    return false;
  }

 private:
  const Graph* graph_;
  std::vector<std::uint32_t> visited_;  // the last start from which a node was visited
  std::vector<std::uint32_t> queue_;
};

// Triangles joined to flat pieces: neighbours whose normals are within 1° of that of the piece's first triangle. Half
// of a floor is lit if the other half is, however dark it is.
class FlatSides {
 public:
  explicit FlatSides(const Room& room) {
    for (const Surface& surface : room.surfaces) add(surface);
  }

  std::size_t size() const { return 2 * area_m2.size(); }

  std::vector<std::uint32_t> side_of;  // of side 2 n + (0 front, 1 back) of triangle n: 2 · piece + (0 or 1)
  std::vector<double> area_m2;         // of the pieces
  std::vector<Graph::Link> links;      // between sides of neighbours that face the same way within 30°

 private:
  void add(const Surface& surface) {
    const std::size_t first = side_of.size();
    const std::vector<TriangleShape> shapes = triangle_shapes(surface);
    const MeshLinks mesh(surface);
    side_of.resize(first + 2 * shapes.size(), none);
    for (std::size_t n = 0; n < shapes.size(); ++n) {
      if (side_of[first + 2 * n] == none) grow(n, first, shapes, mesh);
    }
    for (std::size_t n = 0; n < shapes.size(); ++n) {
      for_each_neighbour(n, mesh, [&](std::uint32_t other) {
        const double cosine = glm::dot(shapes[n].normal, shapes[other].normal);
        if (other < n || std::abs(cosine) < bend_cosine) return;
        const std::size_t turned = cosine < 0.0 ? 1 : 0;  // one of them is wound the other way
        for (std::size_t side = 0; side < 2; ++side) {
          const Graph::Link link{side_of[first + 2 * n + side], side_of[first + 2 * other + (side ^ turned)]};
          if (link[0] != link[1]) links.push_back(link);
        }
      });
    }
  }

  template <class F>
  static void for_each_neighbour(std::size_t n, const MeshLinks& mesh, const F& f) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      for (const std::uint32_t other : mesh.at_edge(n, edge)) {
        if (other != n) f(other);
      }
    }
  }

  void grow(std::size_t seed, std::size_t first, const std::vector<TriangleShape>& shapes, const MeshLinks& mesh) {
    const auto piece = static_cast<std::uint32_t>(area_m2.size());
    area_m2.push_back(0.0);
    std::vector<std::size_t> queue;
    const auto add_triangle = [&](std::size_t n, std::uint32_t turned) {
      side_of[first + 2 * n] = 2 * piece + turned;
      side_of[first + 2 * n + 1] = 2 * piece + 1 - turned;
      area_m2.back() += shapes[n].area_m2;
      queue.push_back(n);
    };
    add_triangle(seed, 0);
    for (std::size_t at = 0; at < queue.size(); ++at) {
      for_each_neighbour(queue[at], mesh, [&](std::uint32_t other) {
        const double cosine = glm::dot(shapes[seed].normal, shapes[other].normal);
        if (side_of[first + 2 * other] == none && std::abs(cosine) > flat_cosine)
          add_triangle(other, cosine < 0.0 ? 1 : 0);
      });
    }
  }
};

// Impacts of a part of the surfaces: found, and expected there at the mean of all lit sides.
struct Count {
  double hits = 0.0;
  double expected = 0.0;

  void add(const Count& other) {
    hits += other.hits;
    expected += other.expected;
  }
  bool has_share() const { return hits > least_share * expected; }
};

class Judge {
 public:
  Judge(const Room& room, const std::vector<std::uint32_t>& impacts)
      : room_(&room), flat_(room), sides_(flat_.size(), flat_.links), side_(flat_.size()) {
    for (std::size_t k = 0; k < impacts.size(); ++k) side_[flat_.side_of[k]].hits += impacts[k];
    set_expected();
    make_patches();
    judge_patches();
    judge_small_pieces();
  }

  // side: 2 n + (0 front, 1 back) of triangle n.
  bool is_lit(std::size_t side) const { return lit_[patch_[flat_.side_of[side]]] != 0; }

 private:
  void set_expected() {
    // The mean over the connected pieces that are hit.
    Surroundings surroundings(sides_);
    std::vector<bool> seen(sides_.size());
    double lit_area = 0.0;
    double hits = 0.0;
    for (std::uint32_t side = 0; side < sides_.size(); ++side) {
      if (seen[side]) continue;
      double piece_area = 0.0;
      double piece_hits = 0.0;
      surroundings.visit(
          side,
          [&](std::uint32_t k) {
            seen[k] = true;
            piece_area += flat_.area_m2[k / 2];
            piece_hits += side_[k].hits;
            return true;
          },
          [](std::uint32_t) { return true; });
      lit_area += piece_hits > 0.0 ? piece_area : 0.0;
      hits += piece_hits;
    }
    const double mean = lit_area > 0.0 ? hits / lit_area : 0.0;  // impacts per m²; 0: nothing is hit
    for (std::size_t k = 0; k < sides_.size(); ++k) side_[k].expected = mean * flat_.area_m2[k / 2];
  }

  void make_patches() {
    double all = 0.0;
    for (const Count& side : side_) all += side.expected;
    const double enough = std::max(patch_impacts, all / most_patches);
    patch_.assign(sides_.size(), none);
    Surroundings surroundings(sides_);
    for (std::uint32_t side = 0; side < sides_.size(); ++side) {
      if (patch_[side] != none) continue;
      const auto own = static_cast<std::uint32_t>(patches_.size());
      patches_.emplace_back();
      surroundings.visit(
          side,
          [&](std::uint32_t k) {
            patch_[k] = own;
            patches_.back().add(side_[k]);
            return patches_.back().expected < enough;
          },
          [&](std::uint32_t k) { return patch_[k] == none; });
    }
  }

  Graph links_of_patches() const {
    std::vector<Graph::Link> links;
    for (std::uint32_t side = 0; side < sides_.size(); ++side) {
      for (const std::uint32_t other : sides_.links(side)) {
        if (patch_[side] < patch_[other]) links.push_back({patch_[side], patch_[other]});
      }
    }
    std::sort(links.begin(), links.end());
    links.erase(std::unique(links.begin(), links.end()), links.end());
    return {patches_.size(), links};
  }

  void judge_patches() {
    const Graph graph = links_of_patches();
    Surroundings surroundings(graph);
    lit_.assign(patches_.size(), 1);
    small_.assign(patches_.size(), 0);
    for (std::uint32_t patch = 0; patch < patches_.size(); ++patch) {
      Count count;
      surroundings.visit(
          patch,
          [&](std::uint32_t k) {
            count.add(patches_[k]);
            return count.expected < decisive_impacts && !(count.hits >= enough_hits && count.has_share());
          },
          [](std::uint32_t) { return true; });
      lit_[patch] = count.has_share() ? 1 : 0;
      small_[patch] = count.hits < enough_hits && count.expected < few_impacts ? 1 : 0;
    }
  }

  // Small pieces have few hits or none by chance: they are lit if what is near them is. A grid of cells counts that.
  void judge_small_pieces() {
    if (std::find(small_.begin(), small_.end(), 1) == small_.end()) return;
    const Bounds box = bounds_of(*room_);
    const glm::dvec3 size = box.high - box.low;
    const double cell = std::max({size.x, size.y, size.z}) / grid_cells;
    const auto cell_of = [&](const glm::dvec3& place) {
      return glm::clamp(glm::ivec3((place - box.low) / cell), glm::ivec3(0), glm::ivec3(grid_cells - 1));
    };
    const auto index = [](const glm::ivec3& at) {
      return static_cast<std::size_t>((at.z * grid_cells + at.y) * grid_cells + at.x);
    };
    // A flat piece counts in the cells of its triangles, by equal parts: small pieces have small triangles.
    std::vector<double> triangles_of(flat_.area_m2.size());
    for (std::size_t k = 0; k < flat_.side_of.size(); k += 2) triangles_of[flat_.side_of[k] / 2] += 1.0;
    std::vector<Count> cells(grid_cells * grid_cells * grid_cells);
    const std::vector<glm::dvec3> middles = middles_of_triangles();
    for (std::size_t k = 0; k < flat_.side_of.size(); ++k) {
      const std::uint32_t side = flat_.side_of[k];
      const double part = 1.0 / triangles_of[side / 2];
      cells[index(cell_of(middles[k / 2]))].add({part * side_[side].hits, part * side_[side].expected});
    }
    for (std::size_t k = 0; k < flat_.side_of.size(); ++k) {
      const std::uint32_t patch = patch_[flat_.side_of[k]];
      if (small_[patch] != 1) continue;
      small_[patch] = 2;  // each patch once
      const glm::ivec3 own = cell_of(middles[k / 2]);
      const glm::ivec3 low = glm::max(own - 1, glm::ivec3(0));
      const glm::ivec3 high = glm::min(own + 1, glm::ivec3(grid_cells - 1));
      Count near;
      for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
          for (int x = low.x; x <= high.x; ++x) near.add(cells[index({x, y, z})]);
        }
      }
      lit_[patch] = near.hits > near_share * near.expected ? 1 : 0;
    }
  }

  std::vector<glm::dvec3> middles_of_triangles() const {
    std::vector<glm::dvec3> middles;
    for (const Surface& surface : room_->surfaces) {
      for (const glm::uvec3& t : surface.triangles)
        middles.push_back((surface.positions[t.x] + surface.positions[t.y] + surface.positions[t.z]) / 3.0);
    }
    return middles;
  }

  const Room* room_;
  FlatSides flat_;
  Graph sides_;  // of flat pieces
  std::vector<Count> side_;
  std::vector<std::uint32_t> patch_;  // of each side
  std::vector<Count> patches_;
  std::vector<std::uint8_t> lit_;    // of the patches
  std::vector<std::uint8_t> small_;  // 1: a separate piece too small to be judged by its own impacts; 2: judged
};

}  // namespace

LitSides judge_sides(const Room& room, const std::vector<std::uint32_t>& impacts) {
  LitSides lit(room.surfaces.size());
  const bool nothing_is_hit = std::all_of(impacts.begin(), impacts.end(), [](std::uint32_t hits) { return hits == 0; });
  if (nothing_is_hit) {  // then all is drawn
    for (std::size_t s = 0; s < lit.size(); ++s) lit[s].resize(room.surfaces[s].triangles.size());
    return lit;
  }
  const Judge judge(room, impacts);
  std::size_t side = 0;
  for (std::size_t s = 0; s < lit.size(); ++s) {
    for (std::size_t n = 0; n < room.surfaces[s].triangles.size(); ++n, side += 2)
      lit[s].push_back({judge.is_lit(side), judge.is_lit(side + 1)});
  }
  return lit;
}

}  // namespace lichtmc
