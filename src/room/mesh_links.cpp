#include "room/mesh_links.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

#include "room/sort_in_groups.hpp"

namespace lichtmc {

namespace {

// Enough for two walls that cross, each modelled twice.
constexpr std::size_t most_at_an_edge = 8;

struct Edge {
  std::uint32_t low = 0;  // numbers of its end positions
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  std::uint32_t number = 0;  // 0 … 2
};

using Bits = std::array<std::uint64_t, 3>;

// −0 becomes +0, so that equal coordinates have equal bits.
Bits bits_of(const glm::dvec3& position) {
  const glm::dvec3 p = position + 0.0;
  return {std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y), std::bit_cast<std::uint64_t>(p.z)};
}

// A number for every position: equal coordinates give equal numbers.
std::vector<std::uint32_t> places(const Surface& surface) {
  constexpr std::uint32_t none = 0xFFFFFFFF;
  const std::size_t count = surface.positions.size();
  std::vector<std::uint32_t> table(std::bit_ceil(2 * count + 1), none);  // by hash: the first position with its bits
  std::vector<std::uint32_t> place(count);
  for (std::uint32_t n = 0; n < count; ++n) {
    const Bits bits = bits_of(surface.positions[n]);
    std::uint64_t hash = 0;
    for (const std::uint64_t part : bits) {
      hash = (hash ^ part) * 0x9E3779B97F4A7C15U;  // 2⁶⁴ over the golden ratio
      hash ^= hash >> 32U;
    }
    std::size_t at = hash & (table.size() - 1);
    while (table[at] != none && bits_of(surface.positions[table[at]]) != bits) at = (at + 1) & (table.size() - 1);
    if (table[at] == none) table[at] = n;
    place[n] = table[at];
  }
  return place;
}

std::vector<Edge> sorted_edges(const Surface& surface) {
  const std::vector<std::uint32_t> place = places(surface);
  std::vector<Edge> edges;
  edges.reserve(3 * surface.triangles.size());
  for (std::uint32_t k = 0; k < surface.triangles.size(); ++k) {
    const glm::uvec3 corner = surface.triangles[k];
    const std::array<std::uint32_t, 3> at{place[corner.x], place[corner.y], place[corner.z]};
    if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) continue;
    for (std::uint32_t n = 0; n < 3; ++n) {
      const auto [low, high] = std::minmax(at[n], at[(n + 1) % 3]);
      edges.push_back({low, high, k, n});
    }
  }
  sort_in_groups(
      edges, place.size(), [](const Edge& edge) { return edge.low; },
      [](const Edge& a, const Edge& b) { return std::tie(a.high, a.triangle) < std::tie(b.high, b.triangle); });
  return edges;
}

}  // namespace

MeshLinks::MeshLinks(const Surface& surface) : edges_(surface.triangles.size()) {
  const std::vector<Edge> edges = sorted_edges(surface);
  members_.reserve(edges.size());
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    while (end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high) ++end;
    const Range range{static_cast<std::uint32_t>(members_.size()), static_cast<std::uint32_t>(end - first)};
    for (std::size_t n = first; n < end; ++n) {
      members_.push_back(edges[n].triangle);
      if (end - first <= most_at_an_edge) edges_[edges[n].triangle][edges[n].number] = range;
    }
  }
}

}  // namespace lichtmc
