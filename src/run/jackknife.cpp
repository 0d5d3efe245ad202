#include "run/jackknife.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "chance/significance.hpp"

namespace lichtmc {

double student_factor(double freedom) {
  constexpr double at = 3.0;
  return student_from_normal(at, freedom) / at;
}

std::vector<std::uint64_t> rounds_by_turns(const std::vector<HistoryRange>& ranges, std::uint32_t groups) {
  std::vector<std::uint64_t> rounds(groups, 0);
  for (const HistoryRange& range : ranges) {
    for (std::uint32_t j = 0; j < groups; ++j) {
      // Numbers below n that leave the remainder j.
      const auto below = [j, groups](std::uint64_t n) { return (n + groups - 1 - j) / groups; };
      rounds[j] += below(range.last) - below(range.first);
    }
  }
  return rounds;
}

Jackknife::Jackknife(std::vector<std::uint64_t> rounds) : rounds_(std::move(rounds)) {
  for (std::size_t j = 0; j < rounds_.size(); ++j) {
    all_ += rounds_[j];
    if (rounds_[j] > 0) groups_.push_back(j);
  }
  if (groups_.size() > 2) student_ = student_factor(static_cast<double>(groups_.size()) - 1.0);
}

Figure Jackknife::figure(double value, const std::vector<double>& without) const {
  if (groups_.size() < 3 || !std::isfinite(value)) return {value, std::numeric_limits<double>::quiet_NaN()};
  const auto g = static_cast<double>(groups_.size());
  const auto n = static_cast<double>(all_);
  double estimate = g * value;
  for (std::size_t k = 0; k < groups_.size(); ++k)
    estimate -= (1.0 - static_cast<double>(rounds_[groups_[k]]) / n) * without[k];
  double variance = 0.0;
  for (std::size_t k = 0; k < groups_.size(); ++k) {
    const double h = n / static_cast<double>(rounds_[groups_[k]]);
    const double pseudo = h * value - (h - 1.0) * without[k];
    variance += (pseudo - estimate) * (pseudo - estimate) / (h - 1.0) / g;
  }
  return {value, student_ * std::sqrt(variance)};
}

}  // namespace lichtmc
