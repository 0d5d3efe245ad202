// How many histories a target error will take, from the errors on the way there.
//
// Once every tile has been hit some times, the relative error R falls with the square root of the histories N: FOM =
// 1/(R² T) is constant. Before that it falls more slowly, because tiles that were just hit for the first time come in
// with errors near 100 %. So the forecast goes on at the slope that was seen over the last doubling of N, never a
// steeper one than −1/2, for a hundred times as many histories; by then the tiles have been found, and −1/2 holds.
#pragma once

#include <cstdint>
#include <vector>

namespace lichtmc {

class Forecast {
 public:
  // The error (> 0) after so many histories; each call with more of them.
  void add(std::uint64_t histories, double error);

  // Histories from the start to the target error (> 0); NaN before the first error, at least those of the last error
  // where the target was not met by then.
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
