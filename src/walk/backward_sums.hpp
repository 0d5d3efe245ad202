// Sums of the scores of rounds, and of their squares: integers, so that the order does not matter.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/fields.hpp"
#include "base/wide.hpp"

namespace lichtmc {

struct BackwardSums {
  uint128 sum = 0;
  uint128 squares = 0;

  void add(std::uint64_t score) {
    sum += score;
    squares += static_cast<uint128>(score) * score;
  }

  // The standard error of the mean over this number of rounds, ≥ 2, which are independent: from their sample variance.
  double error_of_mean(std::uint64_t rounds) const {
    const auto n = static_cast<long double>(rounds);
    const auto total = static_cast<long double>(sum);
    const long double between = static_cast<long double>(squares) - total / n * total;
    return static_cast<double>(std::sqrt(std::max(between, 0.0L) / (n - 1) / n));
  }
};

template <class F, AllOf<BackwardSums>... Things>
void visit_fields(const F& f, Things&... sums) {
  f(Field{"sum"}, sums.sum...);
  f(Field{"squares"}, sums.squares...);
}
template <>
inline constexpr bool is_row<BackwardSums> = true;

}  // namespace lichtmc
