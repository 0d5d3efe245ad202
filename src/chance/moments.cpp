#include "chance/moments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lichtmc {

Estimate estimate(const Moments& moments, std::uint64_t histories) {
  // Long double: Σ x_b²/n and X²/N agree in their first digits if the variance is small compared with the mean.
  const auto n = static_cast<long double>(histories);
  const auto sum = static_cast<long double>(moments.sum);
  const auto batches = static_cast<long double>(batches_of(histories));
  Estimate result;
  result.mean = static_cast<double>(sum / n);
  if (batches < 2) {
    result.standard_error = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  const long double between = static_cast<long double>(moments.squares) / square_units - sum / n * sum;
  const long double variance = std::max(between, 0.0L) / (batches - 1);
  result.standard_error = static_cast<double>(std::sqrt(variance / n));
  return result;
}

Estimate estimate_binomial(std::uint64_t count, std::uint64_t histories) {
  const double n = static_cast<double>(histories);
  const double p = static_cast<double>(count) / n;
  if (histories < 2) return {p, std::numeric_limits<double>::quiet_NaN()};
  return {p, std::sqrt(p * (static_cast<double>(histories - count) / n) / (n - 1.0))};
}

}  // namespace lichtmc
