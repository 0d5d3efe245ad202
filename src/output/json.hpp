// Functions shared by all JSON output.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

using Json = nlohmann::ordered_json;

// A number; null if it is not finite, because JSON cannot represent NaN and infinity.
Json number(double value);
// The same; null also if there is none.
Json number_or_null(const std::optional<double>& value);
// An array of three numbers.
Json vector_of(const glm::dvec3& v);

// "isotropic", "lambert", "spot", "measured" or "surface".
std::string_view kind_of(const Emitter& emitter);

// Name, kind, photometric file and power of every emitter.
Json emitters_of(const Room& room);

// Adds "quantity", and of half cylinders "facing", to the object of a receiver of another law than the planar one.
void add_law(const Receiver& receiver, Json& object);

// The text of a file. Bytes of names that are not UTF-8 are replaced: an error at the end of a long run would lose the
// results.
std::string json_text(const Json& json);

}  // namespace lichtmc
