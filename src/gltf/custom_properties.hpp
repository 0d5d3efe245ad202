// Custom properties (extras) that lichtmc does not read although they look like those that it reads.
#pragma once

#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gltf/document.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// The property that a name means: the name itself, in another spelling ("Reflectance", "reflectence"), or another word
// for the same ("albedo", "lumens"). Empty if it means none.
std::string_view meant_property(std::string_view name);

// Looks at the custom properties of all nodes, meshes, materials, lights, cameras and scenes. Returns those that look
// like a property of lichtmc but have another name or are at an object where they are not read, and empty nodes that
// are named like a light. Throws InputError naming the object if a property has the value null, or a receiver is not an
// object.
// Gives an empty object 'receiver' its default area, and 'ies' its default opening, because the parser drops empty
// objects; sets `changed` then.
std::vector<Ignored> check_custom_properties(const Document& document, nlohmann::json& json, bool& changed);

}  // namespace lichtmc
