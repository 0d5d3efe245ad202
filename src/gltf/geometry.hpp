// Reads the triangles of a primitive and transforms them to world coordinates.
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

// A primitive in its local coordinates: read once, placed once per use.
struct Primitive {
  std::string where;  // for messages: "mesh 'table', primitive 1"
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;
  std::vector<glm::dvec2> uvs;              // for the tiles, decoded; may be empty
  std::vector<glm::dvec2> reflectance_uvs;  // for the base colour texture, decoded; may be empty
  std::vector<glm::dvec2> emission_uvs;     // for the emissive texture, decoded; may be empty
  std::vector<glm::dvec3> vertex_colours;   // red, green, blue, 0 … 1; may be empty
};

// Reads a primitive. Returns none if it has no triangles, and notes that in `ignored`. `uv_set`: the n of TEXCOORD_n
// for the tiles; none: 1 if present, else 0. The first texture of the material that uses the set determines its
// transform. morph_weights: see apply_morph_targets().
std::optional<Primitive> read_primitive(const Document& document, const tinygltf::Primitive& primitive,
                                        const Material& material, std::optional<int> uv_set,
                                        const std::vector<double>& morph_weights, const std::string& where,
                                        std::vector<Ignored>& ignored);

// The distance between neighbouring floats at the largest coordinate of a primitive, in its local unit of length, if its
// positions are floats and this distance is more than a thousandth of its largest extent; else 0.
double coarse_rounding(const Document& document, const tinygltf::Primitive& primitive, const Primitive& stored);

// The primitive as a surface in world coordinates. The caller sets name, material and optical properties. If the
// transform mirrors (determinant < 0), the winding is reversed: the front face stays the front face. Triangles without
// area are left out and counted.
Surface place_primitive(const Primitive& primitive, const glm::dmat4& world);

// The same with a transform for each vertex. A triangle is reversed if the mean transform of its vertices mirrors.
Surface place_primitive(const Primitive& primitive, const std::vector<glm::dmat4>& worlds);

}  // namespace lichtmc
