// Numbers out of a glTF file's buffers. Every offset, stride, count and index is checked before a byte is read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "gltf/document.hpp"

namespace lichtmc {

// Each takes the number of an accessor and what it belongs to, for messages, and throws InputError where the accessor
// does not exist, has another type than the specification allows there, or reaches beyond its buffer. Integers are read
// as KHR_mesh_quantization says: normalized ones as shares of their range, others as they are.

// Positions, or translations and scales of instances (VEC3). They must be finite.
std::vector<glm::dvec3> read_vectors(const Document& document, int accessor, const std::string& where);

// Rotations of instances (VEC4), made of length 1.
std::vector<glm::dquat> read_rotations(const Document& document, int accessor, const std::string& where);

// Texture coordinates (VEC2) as stored: a KHR_texture_transform is still to be applied.
std::vector<glm::dvec2> read_texture_coordinates(const Document& document, int accessor, const std::string& where);

// Indices (unsigned SCALAR), each below `vertices`.
std::vector<std::uint32_t> read_indices(const Document& document, int accessor, std::size_t vertices,
                                        const std::string& where);

}  // namespace lichtmc
