// What JSON files have in common.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

using Json = nlohmann::ordered_json;

// A number, or null: JSON has no word for what is not a number.
Json number(double value);

// "isotropic", "lambert", "spot" or "surface".
std::string_view kind_of(const Emitter& emitter);

// Name, kind and power of every emitter.
Json emitters_of(const Room& room);

// The text of a file. Names may hold bytes that are no UTF-8; they are replaced, not refused at the end of a long run.
std::string json_text(const Json& json);

}  // namespace lichtmc
