// Meshes: triangles of a primitive, placed in the world.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "gltf/document.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// A primitive as a surface: positions, texture coordinates and triangles; name, material and optics are left to the
// caller. None where it has no triangle with an area; what was left out is noted in `ignored`. `uv_set`: n of
// TEXCOORD_n, or none for 1 where present, else 0. A transform that mirrors has its winding turned back, so that the
// front stays the front.
std::optional<Surface> read_primitive(const Document& document, const tinygltf::Primitive& primitive,
                                      const glm::dmat4& world, std::optional<int> uv_set, const std::string& where,
                                      std::vector<std::string>& ignored);

}  // namespace lichtmc
