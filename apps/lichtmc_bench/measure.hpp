// Ratios of speeds, robust against other load on the machine: both sides alternate, and the result is the median of the
// ratios of adjacent turns.
#pragma once

#include <functional>
#include <vector>

namespace lichtmc::bench {

// Does some work and returns its amount (impacts, rays …).
using Work = std::function<double()>;

struct Ratio {
  double value = 0.0;  // median over the turns of first/second
  double first = 0.0;  // median speed, work per second
  double second = 0.0;
  std::vector<double> ratios;  // of every turn
};

// Speed of `first` over that of `second`, in `turns` (≥ 1) turns of both. Each is warmed up once.
Ratio compare_speeds(const Work& first, const Work& second, int turns);

// Wall-clock time of a function, s.
double seconds_of(const std::function<void()>& work);

double median(std::vector<double> values);

}  // namespace lichtmc::bench
