// Parts of a patch that are grown from single triangles, so that their rectangles have few cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "room/mesh_links.hpp"
#include "room/overlap.hpp"
#include "room/patches.hpp"

namespace lichtmc {

// A rectangle along the axes; in an empty one low is above high.
struct FlatRectangle {
  glm::dvec2 low{std::numeric_limits<double>::max()};
  glm::dvec2 high{std::numeric_limits<double>::lowest()};

  bool empty() const { return low.x > high.x; }
  void add(const FlatTriangle& triangle) {
    for (const glm::dvec2& corner : triangle) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  }
  void add(const FlatRectangle& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
};

// Of all pairs of parts with an edge in common, the pair whose common rectangle saves most cells is joined first, as
// long as one saves any; at first every triangle is a part. The cells of a rectangle count as a fraction, but no less
// than one each way; edge_m > 0: edge of a cell. `counts`: for every triangle of the patch whether it counts in the
// rectangle; at least one does, and those that do not join a neighbour.
//
// Returns the triangles of every part, as numbers in the patch. Takes O(n log n) for n triangles, and for every change
// of a rectangle a pass over the neighbours of its part: that is some √n for a compact part. `evaluated`, unless it is
// null, is raised by the number of pairs whose saving was computed.
std::vector<std::vector<std::size_t>> grow_parts(const Patch& patch, const std::vector<bool>& counts,
                                                 const MeshLinks& links, double edge_m,
                                                 std::uint64_t* evaluated = nullptr);

}  // namespace lichtmc
