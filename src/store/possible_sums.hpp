// Whether sums of scores and of their squares can belong together.
#pragma once

#include <cstdint>
#include <limits>

#include "base/wide.hpp"

namespace lichtmc {

// Whether n whole numbers x ≥ 0 (batches, or rounds) can have Σ x = sum and Σ x² = squares. What must hold: x² is even
// where x is, and so is the sum of the squares; x ≤ x²; (Σ x)²/n ≤ Σ x² (Cauchy and Schwarz); Σ x² ≤ (Σ x)².
inline bool are_possible(uint128 sum, uint128 squares, std::uint64_t n) {
  if (sum == 0 || squares == 0 || n == 0) return sum == 0 && squares == 0;
  if (squares < sum || (squares - sum) % 2 != 0) return false;
  // Five roundings are between the two sides of each.
  constexpr long double rounded = 1.0L + 8.0L * std::numeric_limits<long double>::epsilon();
  const auto s = static_cast<long double>(sum);
  const auto q = static_cast<long double>(squares);
  return s / static_cast<long double>(n) * s <= q * rounded && q <= s * s * rounded;
}

}  // namespace lichtmc
