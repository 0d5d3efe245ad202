// Calculation areas of nodes with extras.calculation_area.
#pragma once

#include <optional>

#include <glm/mat4x4.hpp>

#include "gltf/document.hpp"
#include "gltf/nodes.hpp"
#include "lichtmc/area.hpp"

namespace lichtmc {

bool is_calculation_area(const tinygltf::Node& node);

// The properties of such a node, without a name. `to_world`: from the axes of the file to those of the room. Throws
// InputError naming the node if it has no mesh, or a property is of a wrong type or out of its range.
AreaProperties read_area_properties(const Document& document, const PlacedNode& placed, const glm::dmat4& to_world);

}  // namespace lichtmc
