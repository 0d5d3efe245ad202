// Which sides of surfaces get light, in words.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Of each tile map: "facing up", "facing down", "facing +x" (the axes of glTF; slanting ones "facing up and −z"), "both
// sides" of a flat surface, "several sides", or "none".
std::vector<std::string> lit_side_words(const Room& room, const Result& result, const LitSides& lit);

}  // namespace lichtmc
