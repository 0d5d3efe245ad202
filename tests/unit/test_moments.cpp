#include <cmath>
#include <cstdint>

#include "chance/moments.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

TEST_CASE("equal batches have mean and error of their differences") {
  Moments moments;
  for (const std::uint64_t x : {1000U, 1100U, 900U, 1000U}) moments.add(x, batch_histories);
  const Estimate result = estimate(moments, 4 * batch_histories);
  CHECK(result.mean == 1000.0 / batch_histories);
  // Sample variance of the batch sums 20000/3, of their mean a quarter of that; per history divided by the batch's
  // size.
  const double expected = std::sqrt(20000.0 / 3.0 / 4.0) / batch_histories;
  CHECK(std::abs(result.standard_error / expected - 1.0) < 1e-14);
}

TEST_CASE("an incomplete last batch counts by its size") {
  // Scores in proportion to the histories: no variance at all.
  Moments moments;
  moments.add(2 * batch_histories, batch_histories);
  moments.add(2 * batch_histories, batch_histories);
  moments.add(2 * 100, 100);
  const Estimate result = estimate(moments, 2 * batch_histories + 100);
  CHECK(result.mean == 2.0);
  CHECK(result.standard_error < 1e-5);
  // A single hit in every batch, the last smaller by a few: its variance is not 0, which rounding would make of it.
  Moments hits;
  hits.add(1, batch_histories);
  hits.add(1, batch_histories);
  hits.add(1, 952);
  const double expected = std::sqrt((2.0 / 1024 + 1.0 / 952 - 9.0 / 3000) / 2.0 / 3000);
  // The last square is rounded by 0.04 %; of the small difference of squares that is 12 %, of its root 6 %.
  CHECK(estimate(hits, 3000).standard_error == Approx(expected).epsilon(0.07));
}

TEST_CASE("one batch gives no error") {
  Moments moments;
  moments.add(5, 10);
  CHECK(estimate(moments, 10).mean == 0.5);
  CHECK(std::isnan(estimate(moments, 10).standard_error));
  CHECK(std::isnan(estimate_binomial(1, 1).standard_error));
}

TEST_CASE("the binomial error is exact") {
  const Estimate result = estimate_binomial(25, 100);
  CHECK(result.mean == 0.25);
  CHECK(std::abs(result.standard_error - std::sqrt(0.25 * 0.75 / 99.0)) < 1e-16);
}

TEST_CASE("sums do not overflow at the limits of 32 and 64 bit counters") {
  Moments moments;
  const std::uint64_t large = std::uint64_t{1}
                              << 52;  // a batch of weighted scores in units of 2^-24, far more than exist
  for (int i = 0; i < 8192; ++i) moments.add(large, batch_histories);
  CHECK(moments.sum == static_cast<uint128>(large) * 8192);
  CHECK(moments.squares == static_cast<uint128>(large) * large * 8192 * 1024);
  CHECK(estimate(moments, std::uint64_t{8192} * batch_histories).standard_error == 0.0);
}

TEST_CASE("moments add up in any grouping") {
  Moments all;
  Moments left;
  Moments right;
  for (std::uint64_t x = 1; x < 50; ++x) {
    all.add(x * x, batch_histories);
    (x % 3 == 0 ? left : right).add(x * x, batch_histories);
  }
  right.add(left);
  CHECK(right.sum == all.sum);
  CHECK(right.squares == all.squares);
}
