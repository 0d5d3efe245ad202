#include "room/box_tree.hpp"

#include <algorithm>

namespace lichtmc {

namespace {

constexpr std::uint32_t most_in_leaf = 4;

}  // namespace

BoxTree::BoxTree(const std::vector<Bounds>& boxes) {
  for (std::uint32_t n = 0; n < boxes.size(); ++n) {
    if (boxes[n].low.x <= boxes[n].high.x) number_.push_back(n);
  }
  if (number_.empty()) return;
  nodes_.reserve(number_.size());
  nodes_.emplace_back();
  divide(0, 0, static_cast<std::uint32_t>(number_.size()), boxes);
  boxes_.reserve(number_.size());
  for (const std::uint32_t n : number_) boxes_.push_back(boxes[n]);
}

void BoxTree::divide(std::uint32_t node, std::uint32_t first, std::uint32_t count, const std::vector<Bounds>& boxes) {
  Bounds all;
  Bounds middles;
  for (std::uint32_t n = first; n < first + count; ++n) {
    const Bounds& box = boxes[number_[n]];
    all.add(box.low);
    all.add(box.high);
    middles.add(box.low + box.high);
  }
  nodes_[node] = {all, first, count};
  if (count <= most_in_leaf) return;
  const glm::dvec3 spread = middles.high - middles.low;
  const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : (spread.y >= spread.z ? 1 : 2);
  const std::uint32_t half = count / 2;
  const auto begin = number_.begin() + first;
  // Equal middles are ordered by their numbers: the tree depends on the boxes only.
  std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    const double place_a = boxes[a].low[axis] + boxes[a].high[axis];
    const double place_b = boxes[b].low[axis] + boxes[b].high[axis];
    return place_a < place_b || (place_a == place_b && a < b);
  });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_[node].count = 0;
  nodes_.emplace_back();
  nodes_.emplace_back();
  divide(child, first, half, boxes);
  divide(child + 1, first + half, count - half, boxes);
}

}  // namespace lichtmc
