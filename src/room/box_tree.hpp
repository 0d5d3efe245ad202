// A tree of boxes: which of many boxes meet a given one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "room/bounds.hpp"

namespace lichtmc {

// Boxes that touch meet. Building takes O(n log n); a query O(log n) and the boxes found, if few boxes overlap each
// other (J. Goldsmith, J. Salmon: Automatic Creation of Object Hierarchies for Ray Tracing, 1987; here split at the
// median).
class BoxTree {
 public:
  BoxTree() = default;
  // Boxes are numbered 0 … n − 1; an empty box (low above high) meets none.
  // On up to `threads` (≥ 1) threads; the tree is the same for any number of them.
  explicit BoxTree(const std::vector<Bounds>& boxes, unsigned threads = 1);

  // Calls use(number) for every box that meets `box`, in an order that depends on the boxes only.
  template <class Use>
  void for_each_meeting(const Bounds& box, const Use& use) const {
    if (nodes_.empty()) return;
    std::uint32_t stack[64];  // the depth is the logarithm of the number of boxes
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const Node& node = nodes_[stack[--size]];
      if (!meet(node.box, box)) continue;
      if (node.count == 0) {
        stack[size++] = node.first + 1;
        stack[size++] = node.first;
        continue;
      }
      for (std::uint32_t n = node.first; n < node.first + node.count; ++n) {
        if (meet(boxes_[n], box)) use(number_[n]);
      }
    }
  }

 private:
  struct Node {
    Bounds box;
    std::uint32_t first = 0;  // of its boxes, in boxes_; or of its two children, in nodes_
    std::uint32_t count = 0;  // of its boxes; 0 for a node with children
  };

  static bool meet(const Bounds& a, const Bounds& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
           a.low.z <= b.high.z && b.low.z <= a.high.z;
  }
  // A part of the boxes, and the node that becomes the root of its tree; the nodes below follow from `below` on.
  struct Part {
    std::uint32_t node = 0;
    std::uint32_t below = 0;
    std::uint32_t first = 0;  // in number_
    std::uint32_t count = 0;
  };
  // Makes a node; of one with children, returns the two parts.
  std::optional<std::array<Part, 2>> divide(const Part& part, const std::vector<Bounds>& boxes);
  void divide_all(const Part& part, const std::vector<Bounds>& boxes);

  std::vector<Node> nodes_;
  std::vector<Bounds> boxes_;          // in the order of the leaves
  std::vector<std::uint32_t> number_;  // of each of boxes_
};

}  // namespace lichtmc
