// Points sorted along one axis, to find those in a box.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include <glm/vec3.hpp>

#include "room/bounds.hpp"

namespace lichtmc {

class SortedPoints {
 public:
  // The points must outlive this.
  explicit SortedPoints(const std::vector<glm::dvec3>& points) : points_(&points), order_(points.size()) {
    Bounds bounds;
    for (const glm::dvec3& point : points) bounds.add(point);
    // Along the axis of the largest extent a box contains the fewest.
    for (int k = 1; k < 3 && !points.empty(); ++k) {
      if (bounds.high[k] - bounds.low[k] > bounds.high[axis_] - bounds.low[axis_]) axis_ = k;
    }
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(),
              [&](std::size_t a, std::size_t b) { return points[a][axis_] < points[b][axis_]; });
  }

  // Calls use(number) for every point in the box, its boundary included.
  template <class Use>
  void for_each_in(const Bounds& box, const Use& use) const {
    auto at = std::lower_bound(order_.begin(), order_.end(), box.low[axis_],
                               [this](std::size_t number, double low) { return (*points_)[number][axis_] < low; });
    for (; at != order_.end() && (*points_)[*at][axis_] <= box.high[axis_]; ++at) {
      if (box.holds((*points_)[*at])) use(*at);
    }
  }

 private:
  const std::vector<glm::dvec3>* points_;
  std::vector<std::size_t> order_;
  int axis_ = 0;
};

}  // namespace lichtmc
