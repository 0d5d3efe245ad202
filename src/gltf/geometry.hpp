// Meshes: triangles of a primitive, placed in the world.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "gltf/document.hpp"
#include "gltf/materials.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// A primitive as it is stored, read once and placed as often as it is used.
struct Primitive {
  std::string where;  // for messages: "mesh 'table', primitive 1"
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;
  std::vector<glm::dvec2> uvs;              // for the tiles, decoded; may be missing
  std::vector<glm::dvec2> reflectance_uvs;  // for the base colour texture, decoded; may be missing
};

// Reads a primitive; none where it has no triangles, which is noted in `ignored`. `uv_set`: n of the TEXCOORD_n for the
// tiles, or none for 1 where present, else 0; they are decoded as the first texture of the material that uses them
// says.
std::optional<Primitive> read_primitive(const Document& document, const tinygltf::Primitive& primitive,
                                        const Material& material, std::optional<int> uv_set, const std::string& where,
                                        std::vector<Ignored>& ignored);

// The primitive as a surface in the world: name, material and optics are left to the caller. A transform that mirrors
// has its winding turned back, so that the front stays the front. Triangles without area are left out and counted.
Surface place_primitive(const Primitive& primitive, const glm::dmat4& world);

}  // namespace lichtmc
