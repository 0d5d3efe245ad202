#include "room/box_tree.hpp"

#include <algorithm>
#include <utility>

#include "base/parallel.hpp"

namespace lichtmc {

namespace {

constexpr std::uint32_t most_in_leaf = 4;

// Parts of the boxes that a thread divides: the larger ones are divided before.
constexpr std::uint32_t most_of_a_thread = 32768;

// The nodes of a tree of so many boxes: its size does not depend on them.
std::uint32_t nodes_of(std::uint32_t count) {
  return count <= most_in_leaf ? 1 : 1 + nodes_of(count / 2) + nodes_of(count - count / 2);
}

}  // namespace

BoxTree::BoxTree(const std::vector<Bounds>& boxes, unsigned threads) {
  for (std::uint32_t n = 0; n < boxes.size(); ++n) {
    if (boxes[n].low.x <= boxes[n].high.x) number_.push_back(n);
  }
  if (number_.empty()) return;
  const auto count = static_cast<std::uint32_t>(number_.size());
  nodes_.resize(nodes_of(count));
  // Level by level. The first part is the smallest, and none has more than one box more for each level.
  std::vector<Part> parts{{0, 1, 0, count}};
  while (parts.front().count > most_of_a_thread) {
    std::vector<Part> halves(2 * parts.size());
    for_each_on_threads(threads, parts.size(), [&](std::size_t k) {
      const auto both = divide(parts[k], boxes);
      halves[2 * k] = (*both)[0];
      halves[2 * k + 1] = (*both)[1];
    });
    parts = std::move(halves);
  }
  for_each_on_threads(threads, parts.size(), [&](std::size_t k) { divide_all(parts[k], boxes); });
  boxes_.resize(number_.size());
  for_each_range(threads, number_.size(), most_of_a_thread, [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) boxes_[n] = boxes[number_[n]];
  });
}

void BoxTree::divide_all(const Part& part, const std::vector<Bounds>& boxes) {
  if (const auto halves = divide(part, boxes)) {
    for (const Part& half : *halves) divide_all(half, boxes);
  }
}

std::optional<std::array<BoxTree::Part, 2>> BoxTree::divide(const Part& part, const std::vector<Bounds>& boxes) {
  Bounds all;
  Bounds middles;
  for (std::uint32_t n = part.first; n < part.first + part.count; ++n) {
    const Bounds& box = boxes[number_[n]];
    all.add(box.low);
    all.add(box.high);
    middles.add(box.low + box.high);
  }
  nodes_[part.node] = {all, part.first, part.count};
  if (part.count <= most_in_leaf) return std::nullopt;
  const glm::dvec3 spread = middles.high - middles.low;
  const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : (spread.y >= spread.z ? 1 : 2);
  const std::uint32_t half = part.count / 2;
  const auto begin = number_.begin() + part.first;
  // Equal middles are ordered by their numbers: the tree depends on the boxes only.
  std::nth_element(begin, begin + half, begin + part.count, [&](std::uint32_t a, std::uint32_t b) {
    const double place_a = boxes[a].low[axis] + boxes[a].high[axis];
    const double place_b = boxes[b].low[axis] + boxes[b].high[axis];
    return place_a < place_b || (place_a == place_b && a < b);
  });
  const std::uint32_t child = part.below;
  nodes_[part.node].first = child;
  nodes_[part.node].count = 0;
  const Part low{child, child + 2, part.first, half};
  return std::array{low, Part{child + 1, child + 1 + nodes_of(half), part.first + half, part.count - half}};
}

}  // namespace lichtmc
