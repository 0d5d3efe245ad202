#include "run/rounds.hpp"

#include <algorithm>

#include "lichtmc/error.hpp"

namespace lichtmc {

HistoryRange rounds_of(const Settings& settings, std::uint64_t together) {
  const auto rounds = [together](std::uint64_t histories) {
    return histories / together + (histories % together != 0 ? 1 : 0);
  };
  HistoryRange range{rounds(settings.first_history), rounds(settings.first_history + settings.photons)};
  if (!settings.part) range.last = std::max<std::uint64_t>(2, range.last);
  return range;
}

void check_rounds(const Settings& settings, std::uint64_t together, const std::string& name) {
  const HistoryRange range = rounds_of(settings, together);
  if (range.first < range.last) return;
  throw InputError("No backward walk from " + name + " belongs to these histories (allowed: at least " +
                   std::to_string(together) +
                   " histories in a part, one round of all). Use larger parts, or --only tiles.");
}

void check_whole(const Settings& settings, std::uint64_t together, const BackwardState& walks,
                 const std::string& name) {
  const std::uint64_t first = rounds_of(settings, together).first;
  const HistoryRange& there = walks.ranges.front();
  if (there.first == first && walks.ranges.size() == 1) return;
  const std::uint64_t from = there.first == first ? there.last : first;
  const std::uint64_t to = there.first == first ? walks.ranges[1].first : there.first;
  throw InputError("The state has gaps: it has no backward walks from " + name + " of rounds " + std::to_string(from) +
                   " … " + std::to_string(to - 1) +
                   " (allowed: rounds without gaps). Resume the part that was stopped before them, and "
                   "merge again.");
}

}  // namespace lichtmc
