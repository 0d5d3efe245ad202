// Ratios of speeds, measured so that a shared and noisy machine does little harm: both sides take turns, and the median
// of the ratios of neighbouring turns counts.
#pragma once

#include <functional>
#include <vector>

namespace lichtmc::bench {

// Does some work and says how much it was (impacts, rays …).
using Work = std::function<double()>;

struct Ratio {
  double value = 0.0;  // median over the turns of first/second
  double first = 0.0;  // median speed, work per second
  double second = 0.0;
  std::vector<double> ratios;  // of every turn
};

// Speed of `first` over that of `second`, in `turns` (≥ 1) turns of both. Each is warmed up once.
Ratio compare_speeds(const Work& first, const Work& second, int turns);

// Seconds that something takes.
double seconds_of(const std::function<void()>& work);

double median(std::vector<double> values);

}  // namespace lichtmc::bench
