// The nodes of a scene with their world transforms.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "gltf/document.hpp"

namespace lichtmc {

struct PlacedNode {
  std::size_t index = 0;  // in the file
  std::string label;      // for messages: "node 'lamp'"
  glm::dmat4 world{1.0};
  std::optional<std::size_t> parent;  // position in the list of placed nodes; none for a root
  bool hidden = false;                // KHR_node_visibility: the node or an ancestor is not visible

  glm::dvec3 position() const { return glm::dvec3(world[3]); }
  // The direction of the node's −Z axis. Not normalized; 0 if the scale of the node is 0.
  glm::dvec3 forward() const { return -glm::dvec3(world[2]); }
};

// All nodes of the scene with this name, parents before their children. Empty name: the default scene, else the first
// scene; all nodes if the file has no scenes. `root_transform` is the parent transform of the root nodes. Throws
// InputError if the scene does not exist, if a node has two parents or is its own ancestor, or if a transform is not
// finite.
std::vector<PlacedNode> place_nodes(const Document& document, const std::string& scene,
                                    const glm::dmat4& root_transform);

// The world transforms of a node's mesh: one, or one per instance (EXT_mesh_gpu_instancing).
std::vector<glm::dmat4> mesh_transforms(const Document& document, const PlacedNode& placed);

}  // namespace lichtmc
