#include <algorithm>
#include <atomic>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

TEST_CASE("a loop on threads treats every number once") {
  for (const unsigned threads : {1U, 2U, 7U}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{1000}}) {
      CAPTURE(threads, count);
      std::vector<std::atomic<int>> visits(count);
      for_each_on_threads(threads, count, [&](std::size_t k) { ++visits[k]; });
      CHECK(std::all_of(visits.begin(), visits.end(), [](const std::atomic<int>& n) { return n == 1; }));
    }
  }
}

TEST_CASE("one thread treats the numbers in order") {
  std::vector<std::size_t> order;
  for_each_on_threads(1, 10, [&](std::size_t k) { order.push_back(k); });
  std::vector<std::size_t> expected(10);
  std::iota(expected.begin(), expected.end(), std::size_t{0});
  CHECK(order == expected);
}

TEST_CASE("ranges follow each other without a gap, the last one shorter") {
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
  for_each_range(1, 10, 4, [&](std::size_t first, std::size_t last) { ranges.emplace_back(first, last); });
  CHECK(ranges == std::vector<std::pair<std::size_t, std::size_t>>{{0, 4}, {4, 8}, {8, 10}});
}

TEST_CASE("an exception in a loop on threads ends it and is passed on, that of the smallest number") {
  for (const unsigned threads : {1U, 4U}) {
    CAPTURE(threads);
    std::atomic<std::size_t> begun{0};
    const auto fail = [&](std::size_t k) {
      ++begun;
      if (k >= 5) throw std::runtime_error(std::to_string(k));
    };
    CHECK_THROWS_WITH(for_each_on_threads(threads, 100'000, fail), "5");
    CHECK(begun <= 5 + threads);
  }
}

TEST_CASE("a process uses memory, and at most what it has and can get") {
  CHECK(usable_processors() >= 1);
  CHECK(memory_used() > 1e6);
  CHECK(memory_available() >= 0.0);
  CHECK(memory_available() <= memory_limit());
}
