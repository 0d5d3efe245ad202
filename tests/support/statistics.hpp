// The only comparison of simulated figures with exact ones.
//
// A comparison of K figures fails when the largest of their z-scores is beyond what K normal variables exceed with
// probability 10⁻⁶ (Šidák), or when Σ z² is beyond what χ² with K degrees of freedom exceeds, or falls short of, with
// that probability. So a correct program fails one comparison in a few hundred thousand; no comparison is loosened,
// repeated or skipped.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lichtmc::test {

inline constexpr double false_alarm = 1e-6;

// A simulated figure, its standard error, and the expected value (with its own error if that was simulated too).
struct Compared {
  double value = 0.0;
  double standard_error = 0.0;
  double expected = 0.0;
  double expected_error = 0.0;
};

struct Judgement {
  bool agrees = false;
  std::size_t figures = 0;
  double largest_z = 0.0;
  double chi_square = 0.0;     // Σ z²
  double smallest_bias = 0.0;  // approximate relative bias of all figures together that would have made it fail
  std::string text;            // all of this in one line
};

// Whether the deviations of figures are independent. Those of receivers are not if the same photons serve all of them:
// then Σ z² does not follow χ², and the largest z-score alone decides, for which Šidák's limit holds all the more.
enum class Deviations { independent, correlated };

// Compares figure by figure. Figures whose standard error is not a number above 0 count as disagreement unless value
// and expectation are equal.
Judgement compare(const std::vector<Compared>& figures, Deviations deviations = Deviations::independent);

// z-score that the largest absolute value of K standard normal variables exceeds with probability false_alarm.
double largest_z_allowed(std::size_t figures);

// χ² of counts against expected counts, bins of less than 10 expected pooled with their neighbours; agrees if not
// beyond false_alarm on the upper side.
Judgement compare_counts(const std::vector<double>& counts, const std::vector<double>& expected);

}  // namespace lichtmc::test
