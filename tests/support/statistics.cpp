#include "support/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "chance/significance.hpp"

namespace lichtmc::test {

double largest_z_allowed(std::size_t figures) {
  // Šidák: each figure may be beyond with 1 − (1 − α)^{1/K}, on two sides.
  const double each = -std::expm1(std::log1p(-false_alarm) / static_cast<double>(figures));
  return normal_quantile_above(0.5 * each);
}

Judgement compare(const std::vector<Compared>& figures, Deviations deviations) {
  Judgement verdict;
  verdict.agrees = !figures.empty();
  double information = 0.0;  // Σ (expected/error)²: a common relative bias b adds b² times this to Σ z²
  double sharpest = 0.0;     // largest expected/error
  for (const Compared& figure : figures) {
    const double error = std::hypot(figure.standard_error, figure.expected_error);
    const double difference = figure.value - figure.expected;
    if (!(error > 0.0) || !std::isfinite(error)) {
      if (difference != 0.0 || std::isnan(difference)) verdict.agrees = false;
      continue;
    }
    const double z = difference / error;
    ++verdict.figures;
    if (std::isnan(z)) verdict.agrees = false;
    verdict.largest_z = std::max(verdict.largest_z, std::abs(z));
    verdict.chi_square += z * z;
    information += (figure.expected / error) * (figure.expected / error);
    sharpest = std::max(sharpest, figure.expected / error);
  }
  const double allowed = largest_z_allowed(std::max<std::size_t>(1, verdict.figures));
  if (verdict.largest_z > allowed) verdict.agrees = false;
  double low = 0.0;
  double high = allowed * allowed;
  if (verdict.figures >= 3 && deviations == Deviations::independent) {
    high = chi_square_above(static_cast<double>(verdict.figures), false_alarm);
    low = chi_square_above(static_cast<double>(verdict.figures), 1.0 - false_alarm);
    if (verdict.chi_square > high || verdict.chi_square < low) verdict.agrees = false;
  }
  // With a common bias b the expectation of Σ z² grows by b² · information; from K it must reach the limit.
  const double room = std::max(high - static_cast<double>(verdict.figures), 0.0);
  verdict.smallest_bias = information > 0.0 ? std::sqrt(room / information) : 0.0;
  if (deviations == Deviations::correlated) {
    verdict.smallest_bias = sharpest > 0.0 ? allowed / sharpest : 0.0;
    high = std::numeric_limits<double>::infinity();
  }
  char text[240];
  std::snprintf(
      text, sizeof text,
      "%zu figures, largest |z| %.2f (allowed %.2f), chi-square %.1f (allowed %.1f to %.1f), bias found from %.2g",
      verdict.figures, verdict.largest_z, allowed, verdict.chi_square, low, high, verdict.smallest_bias);
  verdict.text = text;
  return verdict;
}

Judgement compare_counts(const std::vector<double>& counts, const std::vector<double>& expected) {
  Judgement verdict;
  std::size_t bins = 0;
  double count = 0.0;
  double expectation = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    count += counts[i];
    expectation += expected[i];
    total += expected[i];
    if (expectation < 10.0 && i + 1 < counts.size()) continue;
    if (expectation > 0.0) {
      verdict.chi_square += (count - expectation) * (count - expectation) / expectation;
      ++bins;
    } else if (count > 0.0) {
      verdict.text = "counts where none can be; ";
      return verdict;
    }
    count = expectation = 0.0;
  }
  verdict.figures = bins;
  const double allowed = chi_square_above(static_cast<double>(bins - 1), false_alarm);
  verdict.agrees = bins > 1 && verdict.chi_square <= allowed;
  verdict.smallest_bias = std::sqrt((allowed - static_cast<double>(bins)) / total);
  char text[160];
  std::snprintf(text, sizeof text, "%zu bins, chi-square %.1f (allowed %.1f)", bins, verdict.chi_square, allowed);
  verdict.text = text;
  return verdict;
}

}  // namespace lichtmc::test
