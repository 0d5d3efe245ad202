// Names of nodes and of what they place, told apart by the parents of the nodes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gltf/document.hpp"
#include "gltf/nodes.hpp"

namespace lichtmc {

// Something that a node places, with the name that it has by itself.
struct PlacedThing {
  std::string name;
  std::size_t node = 0;  // position in the list of placed nodes
};

// The names of things. One that no other has stays as it is. Equal names of several nodes get the names of parents
// before them, as few as tell the nodes apart: "desk_1/top", "desk_2/top". Parents without a name are left out. Names
// that no parents tell apart (children of one node) stay equal.
std::vector<std::string> names_by_parents(const Document& document, const std::vector<PlacedNode>& nodes,
                                          const std::vector<PlacedThing>& things);

// The names of all that a scene places, with parents where that is needed.
struct SceneNames {
  std::vector<std::string> nodes;                    // of each placed node, as emitter or receiver
  std::vector<std::vector<std::string>> primitives;  // of the primitives of each placed node's mesh, as surfaces
};

// Emitters and receivers have the name of their node; surfaces that of their node or mesh, with the material if the
// mesh has several primitives. Nodes that are left out on request count, so that their absence changes no other name;
// hidden ones do not.
SceneNames name_scene(const Document& document, const std::vector<PlacedNode>& nodes);

}  // namespace lichtmc
