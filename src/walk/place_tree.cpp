#include "walk/place_tree.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/common.hpp>

namespace lichtmc {

namespace {

std::uint32_t main_direction(const glm::dvec3& normal) {
  const glm::dvec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return static_cast<std::uint32_t>(2 * axis + (normal[axis] < 0.0 ? 1 : 0));
}

// A plane that has some of the points, by their coordinates along an axis, on either side.
double plane_between(double below, double above) {
  const double middle = below + (above - below) / 2.0;
  return middle > below ? middle : above;
}

// The middle of the widest gap between coordinates (ascending) in their middle half, or, if these are all equal, of the
// gap that is nearest to it. None if all coordinates are equal.
std::optional<double> plane_in_gap(const std::vector<double>& sorted) {
  const std::size_t n = sorted.size();
  std::size_t best = 0;
  double widest = 0.0;
  for (std::size_t k = std::max<std::size_t>(n / 4, 1); k <= n - std::max<std::size_t>(n / 4, 1); ++k) {
    const double gap = sorted[k] - sorted[k - 1];
    if (gap > widest) {
      widest = gap;
      best = k;
    }
  }
  if (widest > 0.0) return plane_between(sorted[best - 1], sorted[best]);
  const double middle = sorted[n / 2];
  const auto from = std::lower_bound(sorted.begin(), sorted.end(), middle);
  const auto to = std::upper_bound(sorted.begin(), sorted.end(), middle);
  if (from != sorted.begin()) return plane_between(*(from - 1), *from);
  if (to != sorted.end()) return plane_between(*(to - 1), *to);
  return std::nullopt;
}

// The plane that divides points, across the axis along which they extend farthest. None if they are one point.
struct Cut {
  int axis = 0;
  std::optional<double> plane;
};

Cut cut_of(const std::vector<Place>& places, std::span<const std::uint32_t> points) {
  glm::dvec3 low = places[points.front()].point;
  glm::dvec3 high = low;
  for (const std::uint32_t k : points) {
    low = glm::min(low, places[k].point);
    high = glm::max(high, places[k].point);
  }
  const glm::dvec3 size = high - low;
  Cut cut;
  cut.axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::vector<double> coordinates;
  coordinates.reserve(points.size());
  for (const std::uint32_t k : points) coordinates.push_back(places[k].point[cut.axis]);
  std::sort(coordinates.begin(), coordinates.end());
  cut.plane = plane_in_gap(coordinates);
  return cut;
}

}  // namespace

// A part of the tree that is to be divided.
struct PlaceTree::Branch {
  std::uint32_t node = 0;
  std::uint32_t root = 0;
  std::span<std::uint32_t> points;
  Bounds box;
  bool in_region = false;  // it belongs to a region that is complete
};

PlaceTree::PlaceTree(const std::vector<Place>& places, std::size_t most, std::size_t region)
    : most_(most), region_(region) {
  std::array<std::vector<std::uint32_t>, 6> by_direction;
  for (std::uint32_t k = 0; k < places.size(); ++k) by_direction[main_direction(places[k].normal)].push_back(k);
  order_.reserve(places.size());
  for (std::size_t d = 0; d < by_direction.size(); ++d) {
    roots_[d] = no_node;
    if (by_direction[d].empty()) continue;
    roots_[d] = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Bounds box;
    for (const std::uint32_t k : by_direction[d]) box.add(places[k].point);
    divide(places, {roots_[d], roots_[d], by_direction[d], box, false});
  }
  first_.push_back(static_cast<std::uint32_t>(order_.size()));
}

// Parts of at most three quarters of the points, unless points coincide: the recursion is not deep.
void PlaceTree::divide(const std::vector<Place>& places, const Branch& branch) {
  const std::span<std::uint32_t> points = branch.points;
  const std::uint32_t first_cell = static_cast<std::uint32_t>(first_.size());
  const Cut cut = points.size() > most_ ? cut_of(places, points) : Cut{};
  // A region is the last part on the way down that has enough points: its halves have not.
  Branch below = branch;
  Branch above = branch;
  if (cut.plane) {
    const auto middle = std::stable_partition(points.begin(), points.end(),
                                              [&](std::uint32_t k) { return places[k].point[cut.axis] < *cut.plane; });
    const auto count = static_cast<std::size_t>(middle - points.begin());
    below.points = points.first(count);
    above.points = points.subspan(count);
    below.box.high[cut.axis] = above.box.low[cut.axis] = *cut.plane;
  }
  const bool is_region =
      !branch.in_region && (!cut.plane || std::min(below.points.size(), above.points.size()) < region_);
  if (cut.plane) {
    below.in_region = above.in_region = branch.in_region || is_region;
    below.node = static_cast<std::uint32_t>(nodes_.size());
    above.node = below.node + 1;
    nodes_[branch.node] = {*cut.plane, static_cast<std::uint32_t>(cut.axis), below.node};
    nodes_.resize(nodes_.size() + 2);
    divide(places, below);
    divide(places, above);
  } else {
    nodes_[branch.node] = {0.0, leaf, first_cell};
    first_.push_back(static_cast<std::uint32_t>(order_.size()));
    order_.insert(order_.end(), points.begin(), points.end());
  }
  if (!is_region) return;
  region_of_.resize(first_.size(), static_cast<std::uint32_t>(regions_.size()));
  regions_.push_back({{first_cell, static_cast<std::uint32_t>(first_.size())}, branch.box, branch.root});
}

std::uint32_t PlaceTree::descend(std::uint32_t node, const glm::dvec3& point) const {
  while (nodes_[node].axis != leaf) {
    const Node& here = nodes_[node];
    node = here.next + (point[static_cast<int>(here.axis)] >= here.plane ? 1U : 0U);
  }
  return nodes_[node].next;
}

std::uint32_t PlaceTree::cell_of(const glm::dvec3& point, const glm::dvec3& normal) const {
  const std::uint32_t root = roots_[main_direction(normal)];
  return root == no_node ? static_cast<std::uint32_t>(size()) : descend(root, point);
}

// Points just outside the centres of the faces; outside of the tree's box they fall into the region itself.
std::vector<std::uint32_t> PlaceTree::neighbours(std::uint32_t region) const {
  constexpr double outside = 1e-3;  // of its size
  const Region& here = regions_[region];
  const glm::dvec3 centre = 0.5 * (here.box.low + here.box.high);
  const glm::dvec3 half = (0.5 + outside) * (here.box.high - here.box.low);
  std::vector<std::uint32_t> found;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 point = centre;
      point[axis] += side * half[axis];
      const std::uint32_t there = region_of_[descend(here.root, point)];
      if (there != region && std::find(found.begin(), found.end(), there) == found.end()) found.push_back(there);
    }
  }
  return found;
}

}  // namespace lichtmc
