// All triangles of a room as one mesh, in which corners at the same position are one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// An edge of a triangle, from the corner of the smaller number to the other.
struct WeldedEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::size_t triangle = 0;

  bool same_place(const WeldedEdge& other) const { return from == other.from && to == other.to; }
};

// Corners within a millionth of the room's size of each other are one: exporters round them. Triangles with the same
// corners count once, whatever their winding: some exporters write a wall twice, once for each side, but it blocks
// light once.
class WeldedMesh {
 public:
  using Triangle = std::array<std::uint32_t, 3>;  // numbers of its corners' positions
  using Corners = std::array<glm::dvec3, 3>;      // m

  // The room must outlive the mesh. The work is done on up to `threads` (≥ 1) threads where it can be divided.
  explicit WeldedMesh(const Room& room, unsigned threads = 1);
  explicit WeldedMesh(Room&& room) = delete;

  const Room& room() const { return *room_; }

  // The room's triangles, surface by surface. Copies of another, and those without three corners, have equal numbers.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  // The edges of those with three corners, sorted so that equal edges are adjacent.
  const std::vector<WeldedEdge>& edges() const { return edges_; }
  // Triangles that are copies of another, in ascending order.
  const std::vector<std::size_t>& copies() const { return copies_; }
  const std::vector<glm::dvec3>& places() const { return places_; }
  // A triangle's own corners, not the merged positions.
  Corners corners(std::size_t triangle) const;

 private:
  const Room* room_;
  std::vector<std::size_t> first_;  // triangle of each surface
  std::vector<Triangle> triangles_;
  std::vector<WeldedEdge> edges_;
  std::vector<std::size_t> copies_;
  std::vector<glm::dvec3> places_;
};

// Calls use(first, end) for every run of equal edges.
template <class Use>
void for_each_edge(const std::vector<WeldedEdge>& edges, const Use& use) {
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    while (end < edges.size() && edges[end].same_place(edges[first])) ++end;
    use(first, end);
  }
}

}  // namespace lichtmc
