#include "run/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lichtmc {

void Forecast::add(std::uint64_t histories, double error) {
  if (std::isfinite(error) && error > 0.0) points_.push_back({static_cast<double>(histories), error});
}

// −d ln R / d ln N over the last doubling of N; 1/2 if not known yet. The slope has a lower limit, so that the forecast
// is finite.
double Forecast::slope() const {
  constexpr double steepest = 0.5;
  constexpr double flattest = 0.05;
  const Point& last = points_.back();
  const auto earlier = std::find_if(points_.rbegin(), points_.rend(),
                                    [&](const Point& point) { return 2.0 * point.histories <= last.histories; });
  if (earlier == points_.rend()) return steepest;
  const double seen = std::log(earlier->error / last.error) / std::log(last.histories / earlier->histories);
  return std::clamp(seen, flattest, steepest);
}

double Forecast::histories_to(double target) const {
  if (points_.empty()) return std::numeric_limits<double>::quiet_NaN();
  const Point& last = points_.back();
  if (last.error <= target) return last.histories;
  constexpr double slow_factor = 100.0;
  const double more = std::pow(last.error / target, 1.0 / slope());
  if (more <= slow_factor) return last.histories * more;
  const double error_then = last.error * std::pow(slow_factor, -slope());
  return last.histories * slow_factor * std::pow(error_then / target, 2.0);
}

}  // namespace lichtmc
