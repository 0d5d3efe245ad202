// Whether the parts of emitters can be kept.
#pragma once

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc {

// Throws InputError if Settings::per_emitter is set without receivers or with impulse responses, or if there is too little
// memory for the sums of the parts.
void check_parts(const Room& room, const Settings& settings);

}  // namespace lichtmc
