// Reads numbers from the buffers of a glTF file. Every offset, stride, count and index is checked before the data is
// read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

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

// Vertex colours (VEC3 or VEC4; floats or normalized unsigned integers): red, green and blue, limited to 0 … 1 as the
// specification demands. Opacity is not returned.
std::vector<glm::dvec3> read_colours(const Document& document, int accessor, const std::string& where);

// Joints of vertices: numbers of joints below `joints` (VEC4; unsigned integers, or whole floats after decompression).
std::vector<glm::uvec4> read_joints(const Document& document, int accessor, std::size_t joints,
                                    const std::string& where);

// Weights of joints (VEC4; floats or normalized integers), finite and ≥ 0.
std::vector<glm::dvec4> read_weights(const Document& document, int accessor, const std::string& where);

// Matrices (MAT4, float), finite.
std::vector<glm::dmat4> read_matrices(const Document& document, int accessor, const std::string& where);

// Indices (unsigned SCALAR), each below `vertices`.
std::vector<std::uint32_t> read_indices(const Document& document, int accessor, std::size_t vertices,
                                        const std::string& where);

}  // namespace lichtmc
