// Which triangles of a surface meet at an edge.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Triangles are linked if they have an edge in common: the same two positions, whatever the indices. A triangle with
// two corners at the same position has no links. An edge that more than eight triangles share is no link: these are
// stacked copies, among which the neighbour is ambiguous.
class MeshLinks {
 public:
  explicit MeshLinks(const Surface& surface);

  // The triangles at an edge (0 … 2: from that corner to the next) of a triangle, itself included, in ascending order;
  // empty if it has no link there.
  std::span<const std::uint32_t> at_edge(std::size_t triangle, std::size_t edge) const {
    const Range range = edges_[triangle][edge];
    return {members_.data() + range.first, range.count};
  }

 private:
  struct Range {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  std::vector<std::uint32_t> members_;
  std::vector<std::array<Range, 3>> edges_;
};

}  // namespace lichtmc
