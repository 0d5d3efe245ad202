// Deformation of meshes: morph targets and skins, in the pose that the file states. Animations are not applied.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "gltf/document.hpp"
#include "gltf/nodes.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// The weights of a mesh's morph targets: those of the node, else those of the mesh; none: all 0.
const std::vector<double>& morph_weights(const tinygltf::Node& node, const tinygltf::Mesh& mesh);

// Moves positions by the morph targets of their primitive. Targets of texture coordinates and colours are not applied:
// those with a weight are added to `ignored`. Throws InputError if the number of weights or of displacements is wrong.
void apply_morph_targets(const Document& document, const tinygltf::Primitive& primitive,
                         const std::vector<double>& weights, const std::string& where,
                         std::vector<glm::dvec3>& positions, std::vector<Ignored>& ignored);

// The skins of the file. The transforms of a skinned mesh are those of its joints; that of its own node does not count
// (glTF 2.0 specification, section 3.7.3.3).
class Skins {
 public:
  // nodes: all nodes of the scene.
  Skins(const Document& document, const std::vector<PlacedNode>& nodes);

  // The transform to world coordinates of each vertex of a primitive: the mean of (world transform of the joint × its
  // inverse bind matrix), weighted by the weights of the vertex. None if the node has no skin, or if the primitive has
  // no weights (then `ignored` says so). Throws InputError if joints or weights are damaged, if a joint is not in the
  // scene, or if the weights of a vertex do not add up to 1 within the rounding of bytes.
  std::optional<std::vector<glm::dmat4>> vertex_transforms(const tinygltf::Node& node,
                                                           const tinygltf::Primitive& primitive, std::size_t vertices,
                                                           const std::string& where,
                                                           std::vector<Ignored>& ignored) const;

 private:
  std::vector<glm::dmat4> joint_transforms(std::size_t skin) const;

  const Document* document_;
  std::vector<std::optional<glm::dmat4>> worlds_;  // of all nodes; none if not in the scene
};

}  // namespace lichtmc
