#include "gltf/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "base/message.hpp"
#include "gltf/accessor.hpp"

namespace lichtmc {

namespace {

// Lists, strips and fans as triples, in the order that keeps the winding (glTF 2.0 specification, section 3.7.2.1).
std::vector<glm::uvec3> triples(const std::vector<std::uint32_t>& index, int mode) {
  std::vector<glm::uvec3> triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    for (std::size_t k = 0; k + 2 < index.size(); k += 3) triangles.emplace_back(index[k], index[k + 1], index[k + 2]);
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (std::size_t k = 0; k + 2 < index.size(); ++k)
      triangles.emplace_back(index[k], index[k + 1 + k % 2], index[k + 2 - k % 2]);
  } else {
    for (std::size_t k = 1; k + 1 < index.size(); ++k) triangles.emplace_back(index[k], index[k + 1], index[0]);
  }
  return triangles;
}

// Whether three points span an area. Float coordinates of points on a line, put through a transform in double, miss it
// by roundings of 2⁻⁵³ of their distance from the origin.
bool has_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 cross = glm::cross(b - a, c - a);
  const double longest = std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)});
  const double reach = std::max({glm::length(a), glm::length(b), glm::length(c)});
  return glm::length(cross) > 16.0 * 0x1p-53 * longest * (longest + reach);
}

std::optional<int> choose_uv_set(const Document& document, const tinygltf::Primitive& primitive,
                                 std::optional<int> asked) {
  if (asked && *asked < 0)
    refuse(document,
           "the UV set is " + std::to_string(*asked) + " (allowed: 0 or more). Give --uv-set the n of TEXCOORD_n.");
  const auto has = [&](int n) { return primitive.attributes.count("TEXCOORD_" + std::to_string(n)) != 0; };
  if (asked) return has(*asked) ? asked : std::nullopt;
  if (has(1)) return 1;
  if (has(0)) return 0;
  return std::nullopt;
}

std::vector<glm::uvec3> read_triangles(const Document& document, const tinygltf::Primitive& primitive,
                                       std::size_t vertices, const std::string& where) {
  std::vector<std::uint32_t> index(vertices);
  if (primitive.indices >= 0) {
    index = read_indices(document, primitive.indices, vertices, "the indices of " + where);
  } else {
    std::iota(index.begin(), index.end(), 0U);
  }
  return triples(index, primitive.mode);
}

}  // namespace

std::optional<Surface> read_primitive(const Document& document, const tinygltf::Primitive& primitive,
                                      const glm::dmat4& world, std::optional<int> uv_set, const std::string& where,
                                      std::vector<std::string>& ignored) {
  if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    refuse(document, "the mode of " + where + " is " + std::to_string(primitive.mode) +
                         " (allowed: 0 to 6). Export the file again.");
  }
  if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
    ignored.push_back("Points or lines of " + where + ": they have no area.");
    return std::nullopt;
  }
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) {
    ignored.push_back(where + " has no positions: nothing is there.");
    return std::nullopt;
  }
  Surface surface;
  for (const glm::dvec3& local : read_positions(document, position->second, "the positions of " + where)) {
    surface.positions.emplace_back(world * glm::dvec4(local, 1.0));
  }
  if (const auto n = choose_uv_set(document, primitive, uv_set)) {
    surface.uvs = read_texture_coordinates(document, primitive.attributes.at("TEXCOORD_" + std::to_string(*n)),
                                           "the texture coordinates of " + where);
    if (surface.uvs.size() != surface.positions.size()) {
      refuse(document, where + " has " + to_text(surface.positions.size(), "position") + " but " +
                           std::to_string(surface.uvs.size()) +
                           " texture coordinates (allowed: as many). Export the file again.");
    }
  }
  const bool mirrored = glm::determinant(glm::dmat3(world)) < 0.0;
  std::size_t without_area = 0;
  for (glm::uvec3 triangle : read_triangles(document, primitive, surface.positions.size(), where)) {
    if (!has_area(surface.positions[triangle.x], surface.positions[triangle.y], surface.positions[triangle.z])) {
      ++without_area;
      continue;
    }
    if (mirrored) std::swap(triangle.y, triangle.z);
    surface.triangles.push_back(triangle);
  }
  if (without_area > 0)
    ignored.push_back(to_text(without_area, "triangle") + " without area in " + where + ": no light can fall on them.");
  if (primitive.attributes.count("COLOR_0") != 0) ignored.push_back("Vertex colours of " + where + " are not read.");
  if (primitive.attributes.count("JOINTS_0") != 0)
    ignored.push_back("The skin of " + where + " is not applied; the mesh is taken in its rest pose.");
  if (!primitive.targets.empty()) ignored.push_back("Morph targets of " + where + " are not applied.");
  if (surface.triangles.empty()) return std::nullopt;
  return surface;
}

}  // namespace lichtmc
