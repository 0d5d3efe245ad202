// Sums of the scores of rounds, and of their squares: integers, so that the order does not matter.
#pragma once

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
};

template <class F, AllOf<BackwardSums>... Things>
void visit_fields(const F& f, Things&... sums) {
  f(Field{"sum"}, sums.sum...);
  f(Field{"squares"}, sums.squares...);
}
template <>
inline constexpr bool is_row<BackwardSums> = true;

}  // namespace lichtmc
