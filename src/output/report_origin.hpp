// The origin of the figures as sections of the page. Each function returns HTML; empty without content.
#pragma once

#include <string>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Tables of the settings and the emitters; automatic choices, and input overrides.
std::string settings_section(const Room& room, const Result& result, bool tile_images);

// The content of the room file that is not modelled.
std::string left_out_section(const Result& result);

// How to reproduce the result bit by bit. `command`: the command of the run; may be empty.
std::string reproduction_section(const Result& result, const std::string& command);

}  // namespace lichtmc
