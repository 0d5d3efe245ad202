// The mean of a function over the unit cube of four dimensions, by two random points in each of equal strata.
//
// The cube is divided into boxes by powers of two along each dimension. The two points of a box are independent and
// uniform in it: the mean over all of them is unbiased, and the differences within the boxes give its variance without
// bias, whatever the function (W. G. Cochran, Sampling Techniques, 1977, ch. 5).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "chance/stream.hpp"

namespace lichtmc {

using UnitPoint = std::array<double, 4>;

class PairedStrata {
 public:
  // 2^doublings boxes, at most 2³¹: the dimensions of `order` (0 to 3) are halved in turn.
  PairedStrata(std::uint32_t doublings, std::span<const std::uint8_t> order) {
    for (std::uint32_t k = 0; k < doublings; ++k) ++shifts_[order[k % order.size()]];
    boxes_ = std::uint32_t{1} << doublings;
  }

  std::uint32_t boxes() const { return boxes_; }

  // The point of box `box` (below boxes()) that four random words choose.
  UnitPoint point(std::uint32_t box, const Words& words) const {
    UnitPoint at{};
    for (std::size_t k = 0; k < at.size(); ++k) {
      const std::uint32_t along = std::uint32_t{1} << shifts_[k];
      at[k] = ((box & (along - 1)) + unit_open(words[k])) / along;
      box >>= shifts_[k];
    }
    return at;
  }

 private:
  std::array<std::uint32_t, 4> shifts_{};  // number of divisions: binary logarithms
  std::uint32_t boxes_ = 1;
};

// Sums over pairs of points of two functions v and w at once, so that the mean of v − βw and its error follow for any
// β.
struct PairSums {
  double v = 0.0;
  double w = 0.0;
  double vv = 0.0;  // of products of differences within pairs
  double vw = 0.0;
  double ww = 0.0;
  std::uint32_t points = 0;

  void add(const std::array<double, 2>& v_of, const std::array<double, 2>& w_of) {
    v += v_of[0] + v_of[1];
    w += w_of[0] + w_of[1];
    const double dv = v_of[0] - v_of[1];
    const double dw = w_of[0] - w_of[1];
    vv += dv * dv;
    vw += dv * dw;
    ww += dw * dw;
    points += 2;
  }

  // With at least one pair.
  double mean(double beta) const { return (v - beta * w) / static_cast<double>(points); }
  double mean_w() const { return w / static_cast<double>(points); }
  // Of the mean. A box of which two points are taken contributes the square of their difference, over four, on average.
  double variance(double beta) const {
    return std::max(0.0, vv - 2.0 * beta * vw + beta * beta * ww) /
           (static_cast<double>(points) * static_cast<double>(points));
  }
};

}  // namespace lichtmc
