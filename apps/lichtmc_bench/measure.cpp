#include "measure.hpp"

#include <algorithm>
#include <chrono>

namespace lichtmc::bench {

namespace {

double speed_of(const Work& work) {
  double done = 0.0;
  const double seconds = seconds_of([&] { done = work(); });
  return done / seconds;
}

}  // namespace

double seconds_of(const std::function<void()>& work) {
  const auto began = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Ratio compare_speeds(const Work& first, const Work& second, int turns) {
  first();
  second();
  Ratio result;
  std::vector<double> speeds_first;
  std::vector<double> speeds_second;
  for (int turn = 0; turn < turns; ++turn) {
    // The order alternates from turn to turn.
    if (turn % 2 == 0) speeds_first.push_back(speed_of(first));
    speeds_second.push_back(speed_of(second));
    if (turn % 2 != 0) speeds_first.push_back(speed_of(first));
    result.ratios.push_back(speeds_first.back() / speeds_second.back());
  }
  result.value = median(result.ratios);
  result.first = median(speeds_first);
  result.second = median(speeds_second);
  return result;
}

}  // namespace lichtmc::bench
