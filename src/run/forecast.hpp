// Forecast of the number of histories that a target error requires, from the errors so far.
//
// Once every tile has been hit some times, the relative error R falls with the square root of the histories N: FOM =
// 1/(R² T) is constant. Before that it falls more slowly, because tiles hit for the first time are added with
// errors near 100 %. The forecast therefore uses the slope over the last doubling of N, at most as steep as −1/2, for a
// hundred times as many histories; after that most tiles have been hit, and the slope is −1/2.
#pragma once

#include <cstdint>
#include <vector>

namespace lichtmc {

class Forecast {
 public:
  // Adds the error (> 0) after this number of histories, which increases from call to call.
  void add(std::uint64_t histories, double error);

  // Histories from the start to the target error (> 0); NaN before the first error. If the last error is above the
  // target, at least its number of histories.
  double histories_to(double target) const;

 private:
  struct Point {
    double histories;
    double error;
  };
  double slope() const;

  std::vector<Point> points_;
};

}  // namespace lichtmc
