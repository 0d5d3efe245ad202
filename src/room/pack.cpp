#include "room/pack.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace lichtmc {

namespace {

// On shelves, from the highest rectangle to the lowest (E. G. Coffman, M. R. Garey, D. S. Johnson, R. E. Tarjan:
// Performance bounds for level-oriented two-dimensional packing algorithms. SIAM Journal on Computing 9(4), 1980:
// next-fit decreasing height). A rectangle is placed on top of the previous one if the shelf is high enough for both.
Packing pack_on_shelves(const std::vector<glm::dvec2>& sizes, const std::vector<std::size_t>& order, double width) {
  Packing packing{glm::dvec2(0.0), std::vector<glm::dvec2>(sizes.size()), {}};
  double shelf = 0.0;     // first row of the shelf
  double height = 0.0;    // of the shelf
  glm::dvec2 stack(0.0);  // first column of the stack, and its height
  double stack_width = 0.0;
  for (const std::size_t n : order) {
    const glm::dvec2 size = sizes[n];
    if (stack.y + size.y > height || size.x > stack_width) {
      stack = {stack.x + stack_width, 0.0};
      stack_width = size.x;
      if (stack.x + size.x > width || height == 0.0) {
        shelf += height;
        height = size.y;
        stack.x = 0.0;
      }
    }
    packing.corners[n] = {stack.x, shelf + stack.y};
    stack.y += size.y;
    packing.size.x = std::max(packing.size.x, stack.x + size.x);
  }
  packing.size.y = shelf + height;
  return packing;
}

Packing pack_without_turning(const std::vector<glm::dvec2>& sizes) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&sizes](std::size_t a, std::size_t b) {
    return std::tuple(-sizes[a].y, -sizes[a].x, a) < std::tuple(-sizes[b].y, -sizes[b].x, b);
  });
  double total = 0.0;
  double widest = 1.0;
  for (const glm::dvec2& size : sizes) {
    total += size.x * size.y;
    widest = std::max(widest, size.x);
  }
  // Shelves from half to twice the side of a square, in steps of a few percent: the waste at their ends differs.
  constexpr int trials = 33;
  Packing best;
  for (int n = 0; n < trials; ++n) {
    const double width = std::max(widest, std::ceil(std::sqrt(total) * std::exp2(2.0 * n / (trials - 1) - 1.0)));
    Packing packing = pack_on_shelves(sizes, order, width);
    if (n > 0 && packing.size.x * packing.size.y >= best.size.x * best.size.y) continue;
    best = std::move(packing);
  }
  best.turned.assign(sizes.size(), false);
  return best;
}

double area(const Packing& packing) {
  return packing.size.x * packing.size.y;
}

}  // namespace

// Upright and horizontal strips together waste much area; horizontal strips alone do not.
Packing pack(const std::vector<glm::dvec2>& sizes) {
  Packing best = pack_without_turning(sizes);
  std::vector<glm::dvec2> horizontal = sizes;
  std::vector<bool> turned(sizes.size(), false);
  for (std::size_t n = 0; n < sizes.size(); ++n) {
    turned[n] = sizes[n].y > sizes[n].x;
    if (turned[n]) horizontal[n] = {sizes[n].y, sizes[n].x};
  }
  Packing packing = pack_without_turning(horizontal);
  if (area(packing) >= area(best)) return best;
  packing.turned = std::move(turned);
  return packing;
}

}  // namespace lichtmc
