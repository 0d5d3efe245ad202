// Groups of emitters whose light is kept apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc {

struct EmitterGroups {
  std::vector<std::string> names;         // of each group: that of its emitters, or "all"
  std::vector<std::uint32_t> of_emitter;  // the group of each of Room::emitters

  std::uint32_t size() const { return static_cast<std::uint32_t>(names.size()); }
};

// All emitters together.
EmitterGroups one_group(const Room& room);

// Emitters of the same name together, in the order of the room.
EmitterGroups groups_by_name(const Room& room);

// The groups that the parts of the irradiance at receivers are of: with Settings::per_emitter by name; where
// maintenance factors differ, also by these, because initial values follow from the parts. Groups may then have the
// same name.
EmitterGroups groups_of_parts(const Room& room, const Settings& settings);

// Whether the sums of parts are kept (part_sums.hpp): for areas, and with Settings::per_emitter.
bool wants_parts(const Room& room, const Settings& settings);

}  // namespace lichtmc
