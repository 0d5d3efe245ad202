// Mean and standard error from exact integer sums.
//
// Hits of one history are correlated, those of different histories are not. So the error comes from differences between
// batches of histories: with x_b the score of batch b of n_b histories, X = Σ x_b and N = Σ n_b, the variance of one
// history is estimated without bias by σ² = (Σ x_b²/n_b − X²/N)/(B − 1), and the variance of the mean X/N is σ²/N. Sums
// of integers do not depend on the order of the batches: any number of threads and any way of splitting a run gives the
// same bits.
#pragma once

#include <cstdint>

#include "base/fields.hpp"
#include "base/wide.hpp"

namespace lichtmc {

// Histories in a full batch. Large enough that its start and end cost little, small enough that a run of 10⁵ histories
// has about a hundred batches.
inline constexpr std::uint32_t batch_histories = 1024;

// Number of batches for a number of histories; the last batch may be incomplete.
constexpr std::uint64_t batches_of(std::uint64_t histories) {
  return histories / batch_histories + (histories % batch_histories != 0 ? 1 : 0);
}

// Fine enough that squares of single hits, divided by the histories of any batch, keep three digits.
inline constexpr std::uint64_t square_units = std::uint64_t{1024} * batch_histories;

struct Moments {
  uint128 sum = 0;      // Σ x_b
  uint128 squares = 0;  // Σ x_b²/n_b in units of 1/square_units

  // Adds a batch of n histories (1 … batch_histories) with score x.
  void add(std::uint64_t x, std::uint32_t n) {
    sum += x;
    const uint128 square = static_cast<uint128>(x) * x;
    constexpr std::uint64_t for_full = square_units / batch_histories;
    // Only the square of an incomplete last batch is rounded, by less than a thousandth of the smallest square.
    squares += n == batch_histories ? square * for_full : (square * square_units + n / 2) / n;
  }

  // Adds full batches; given are the sums of their scores and of the squares of their scores.
  void add_sums(std::uint64_t scores, std::uint64_t squared) {
    sum += scores;
    squares += static_cast<uint128>(squared) * (square_units / batch_histories);
  }
  // Adds full batches that scored x (≤ 2³¹) each.
  void add_full_batches(std::uint64_t batches, std::uint32_t x) {
    sum += static_cast<uint128>(batches) * x;
    squares += static_cast<uint128>(batches) * x * x * (square_units / batch_histories);
  }

  void add(const Moments& other) { add_fields(*this, other); }
};

template <class F, AllOf<Moments>... Things>
void visit_fields(const F& f, Things&... moments) {
  f(Field{"sum"}, moments.sum...);
  f(Field{"squares"}, moments.squares...);
}
template <>
inline constexpr bool is_row<Moments> = true;

struct Estimate {
  double mean = 0.0;            // score per history
  double standard_error = 0.0;  // of the mean; NaN for fewer than two batches
};

// Mean and error of the score per history, in units of the integers, from moments over `histories` histories (≥ 1).
Estimate estimate(const Moments& moments, std::uint64_t histories);

// The same for scores that are 0 or 1 once per history: the binomial law, exact, no batches needed.
// The standard error is NaN for a single history.
Estimate estimate_binomial(std::uint64_t count, std::uint64_t histories);

}  // namespace lichtmc
