#include "room/mesh_links.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

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

// A number for every position: equal coordinates give equal numbers. The bits of the coordinates are compared, after −0
// has become +0, because they order all values.
std::vector<std::uint32_t> places(const Surface& surface) {
  const auto key = [&surface](std::uint32_t n) {
    const glm::dvec3 p = surface.positions[n] + 0.0;
    return std::tuple(std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y),
                      std::bit_cast<std::uint64_t>(p.z));
  };
  std::vector<std::uint32_t> order(surface.positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&key](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> place(order.size());
  std::uint32_t number = 0;
  for (std::size_t n = 0; n < order.size(); ++n) {
    if (n > 0 && key(order[n]) != key(order[n - 1])) ++number;
    place[order[n]] = number;
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
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
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
