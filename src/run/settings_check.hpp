// Checks whether settings are valid, and valid for a room.
#pragma once

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/tiles.hpp"

namespace lichtmc {

// Throws InputError naming the setting, its value, the legal range and what to do.
void check_settings(const Settings& settings);

// Throws InputError if the settings do not suit the room, such as absorption with a surface of ρ = 1. The room must
// have passed check_room().
void check_settings_for(const Room& room, const Settings& settings);

// The first surface that has ρ = 1 and an area, or null.
const Surface* surface_that_absorbs_nothing(const Room& room);

// Throws InputError if the run needs more memory than there is, for the tallies of `threads` threads in each of
// `processes` processes and its other data.
void check_memory(const Room& room, const Tiling& tiling, const Settings& settings, unsigned threads,
                  unsigned processes, bool has_reflectance_maps);

}  // namespace lichtmc
