// Choosing one of several by their shares.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace lichtmc {

// Turns shares (≥ 0, at least one above 0) into their running sum, scaled to end at exactly 1.
inline std::vector<double> cumulative(const std::vector<double>& shares) {
  std::vector<double> sums(shares.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i) sums[i] = sum += shares[i];
  for (double& value : sums) value /= sum;
  sums.back() = 1.0;
  return sums;
}

// Index of the share that 0 ≤ u < 1 falls into; shares of 0 are never chosen.
inline std::size_t choose(const std::vector<double>& sums, double u) {
  const auto chosen = std::upper_bound(sums.begin(), sums.end(), u);
  assert(chosen != sums.end());  // the last sum is 1
  return static_cast<std::size_t>(chosen - sums.begin());
}

// The position of u within the share k that it falls into: uniform in [0, 1] if u is.
inline double share_within(const std::vector<double>& sums, std::size_t k, double u) {
  const double before = k > 0 ? sums[k - 1] : 0.0;
  return std::min((u - before) / (sums[k] - before), 1.0);
}

}  // namespace lichtmc
