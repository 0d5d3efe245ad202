// Calculation areas of nodes with extras.calculation_area.
#pragma once

#include <vector>

#include <glm/mat4x4.hpp>

#include "gltf/document.hpp"
#include "gltf/nodes.hpp"
#include "lichtmc/area.hpp"

namespace lichtmc {

bool is_calculation_area(const tinygltf::Node& node);

// The area of such a node, without a name. `to_world`: from the axes of the file to those of the room. What of its mesh
// is not read goes to `ignored`. Throws InputError naming the node if it has no mesh or no face with an area, or a
// property is of a wrong type or out of its range.
AreaRequest read_area(const Document& document, const PlacedNode& placed, const glm::dmat4& to_world,
                      std::vector<Ignored>& ignored);

}  // namespace lichtmc
