// The nodes of a scene with their places in the world.
#pragma once

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

  glm::dvec3 position() const { return glm::dvec3(world[3]); }
  // The way it looks: its −Z. Not normalized, and 0 where the node is scaled to nothing.
  glm::dvec3 forward() const { return -glm::dvec3(world[2]); }
};

// All nodes of the scene with this name; of the default scene, or the first, where the name is empty; all nodes without
// a parent and theirs where the file has no scenes. Parents come before their children. `root` comes before every
// node's own transform. Throws InputError where there is no such scene, a node has two parents or is its own ancestor,
// or a transform is not finite.
std::vector<PlacedNode> place_nodes(const Document& document, const std::string& scene, const glm::dmat4& root);

// The places of a node's mesh: the node's own, or those of its instances (EXT_mesh_gpu_instancing).
std::vector<glm::dmat4> mesh_places(const Document& document, const PlacedNode& placed);

}  // namespace lichtmc
