// Rounds of backward walks, with the same number of walks from every origin: those of a run, or of a part of a run.
#pragma once

#include <cstdint>
#include <string>

#include "lichtmc/settings.hpp"
#include "run/state_data.hpp"

namespace lichtmc {

// The rounds of a run's histories; adjacent parts contain every round once. together: walks in a round of all origins.
HistoryRange rounds_of(const Settings& settings, std::uint64_t together);

// Throws InputError if no round belongs to the histories of a part. name: of the origins, for the message.
void check_rounds(const Settings& settings, std::uint64_t together, const std::string& name);

// Throws InputError if rounds are missing before or between those of the state, which then cannot be continued.
void check_whole(const Settings& settings, std::uint64_t together, const BackwardState& walks, const std::string& name);

}  // namespace lichtmc
