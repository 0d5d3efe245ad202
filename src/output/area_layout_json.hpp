// The layout of a calculation area as JSON, written and read again without loss.
#pragma once

#include "lichtmc/area.hpp"
#include "output/json.hpp"

namespace lichtmc {

Json layout_of(const Area& area);

// Throws nlohmann::json::exception, or InputError, if it is not such a layout.
Area area_from(const Json& layout);

}  // namespace lichtmc
