// Reads numbers from the buffers of a glTF file. Every offset, stride, count and index is checked before the data is
// read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "gltf/document.hpp"

namespace lichtmc {

// Arguments of each function: the index of an accessor, and what it belongs to (`where`, for messages). Each throws
// InputError if the accessor does not exist, has a type that the specification does not allow there, or reaches beyond
// its buffer. Integers are read as defined by KHR_mesh_quantization: normalized integers as fractions of their range,
// others unchanged.

// Positions, or translations and scales of instances (VEC3). They must be finite.
std::vector<glm::dvec3> read_vectors(const Document& document, int accessor, const std::string& where);

// Rotations of instances (VEC4), normalized to length 1.
std::vector<glm::dquat> read_rotations(const Document& document, int accessor, const std::string& where);

// Texture coordinates (VEC2) as stored; KHR_texture_transform is not applied.
std::vector<glm::dvec2> read_texture_coordinates(const Document& document, int accessor, const std::string& where);

// Indices (unsigned SCALAR), each below `vertices`.
std::vector<std::uint32_t> read_indices(const Document& document, int accessor, std::size_t vertices,
                                        const std::string& where);

}  // namespace lichtmc
