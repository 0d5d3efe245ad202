// Rounds of walks back, in which every origin is walked from as often: which of them belong to a run or a part of one.
#pragma once

#include <cstdint>
#include <string>

#include "lichtmc/settings.hpp"
#include "run/state_data.hpp"

namespace lichtmc {

// The rounds of a run's histories, such that parts side by side have every round once. together: walks in a round of
// all origins.
HistoryRange rounds_of(const Settings& settings, std::uint64_t together);

// Throws InputError where no round belongs to the histories of a part. together: walks in a round of all origins, which
// are called `name`.
void check_rounds(const Settings& settings, std::uint64_t together, const std::string& name);

// Throws InputError where rounds are missing before those that there are, or between them: to go on is not possible
// then. together, name: as above.
void check_whole(const Settings& settings, std::uint64_t together, const BackwardState& walks, const std::string& name);

}  // namespace lichtmc
