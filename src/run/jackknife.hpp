// The standard error of a figure that is derived from sums over rounds: delete-a-group jackknife.
//
// Rounds are divided into groups; the figure is computed once from all of them and once without each group in turn.
// Groups may differ in size (F. Busing, E. Meijer, R. van der Leeden, Delete-m Jackknife for Unequal m, Statistics and
// Computing 9 (1999) 3). An error from few groups is often too small: it is enlarged so that three of it contain the
// true value as often as three of a normal distribution (Student's law).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lichtmc/channel.hpp"
#include "lichtmc/state.hpp"

namespace lichtmc {

// By which a standard error from this many degrees of freedom (> 1) is enlarged.
double student_factor(double freedom);

// The number of rounds of each group, if round r belongs to group r mod `groups`. ranges: of all rounds.
std::vector<std::uint64_t> rounds_by_turns(const std::vector<HistoryRange>& ranges, std::uint32_t groups);

class Jackknife {
 public:
  // rounds: of each group.
  explicit Jackknife(std::vector<std::uint64_t> rounds);

  // Groups that have rounds.
  const std::vector<std::size_t>& groups() const { return groups_; }
  std::uint64_t all() const { return all_; }
  std::uint64_t rounds_of(std::size_t group) const { return rounds_[group]; }

  // without[k]: the figure without group groups()[k]. The error is NaN if one of them does not exist, or with fewer
  // than two groups.
  Figure figure(double value, const std::vector<double>& without) const;

 private:
  std::vector<std::uint64_t> rounds_;
  std::vector<std::size_t> groups_;
  std::uint64_t all_ = 0;
  double student_ = 1.0;
};

}  // namespace lichtmc
