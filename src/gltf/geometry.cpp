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

// Lists, strips and fans as triples of indices; the order keeps the winding (glTF 2.0 specification, section 3.7.2.1).
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

// Whether a triangle has an area. Collinear points with float coordinates, transformed in double, deviate from a line
// by rounding errors of 2⁻⁵³ of their distance from the origin.
bool has_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 cross = glm::cross(b - a, c - a);
  const double longest = std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)});
  const double reach = std::max({glm::length(a), glm::length(b), glm::length(c)});
  return glm::length(cross) > 16.0 * 0x1p-53 * longest * (longest + reach);
}

std::optional<int> choose_uv_set(const Document& document, const tinygltf::Primitive& primitive,
                                 std::optional<int> requested) {
  if (requested && *requested < 0)
    refuse(document, "the UV set is " + std::to_string(*requested) +
                         " (allowed: 0 or more). Give --uv-set the number n of TEXCOORD_n.");
  const auto has = [&](int n) { return primitive.attributes.count("TEXCOORD_" + std::to_string(n)) != 0; };
  if (requested) return has(*requested) ? requested : std::nullopt;
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

// The texture coordinates of a set, one per position, after the texture transform.
std::vector<glm::dvec2> read_uvs(const Document& document, const tinygltf::Primitive& primitive, int set,
                                 const UvTransform& transform, std::size_t vertices, const std::string& where) {
  std::vector<glm::dvec2> uvs = read_texture_coordinates(
      document, primitive.attributes.at("TEXCOORD_" + std::to_string(set)), "the texture coordinates of " + where);
  if (uvs.size() != vertices) {
    refuse(document, where + " has " + to_text(vertices, "position") + " but " + std::to_string(uvs.size()) +
                         " texture coordinates (allowed: one per position). Export the file again.");
  }
  for (glm::dvec2& uv : uvs) uv = transform(uv);
  return uvs;
}

UvTransform transform_of_set(const Material& material, int set) {
  for (const TextureUse& use : material.textures) {
    if (use.uv_set == set) return use.transform;
  }
  return {};
}

void note_ignored_attributes(const tinygltf::Primitive& primitive, const Material& material, const std::string& where,
                             std::vector<Ignored>& ignored) {
  if (primitive.attributes.count("COLOR_0") != 0) {
    ignored.push_back({"Vertex colours of " + where + " are not read; its material alone determines its reflectance.",
                       Effect::figures});
  }
  if (primitive.attributes.count("JOINTS_0") != 0)
    ignored.push_back(
        {"The skin of " + where + " is not applied; the vertices stay in the rest pose.", Effect::figures});
  if (!primitive.targets.empty())
    ignored.push_back({"Morph targets of " + where + " are not applied.", Effect::figures});
  const auto& base = material.base_colour;
  if (base && primitive.attributes.count("TEXCOORD_" + std::to_string(base->uv_set)) == 0) {
    ignored.push_back({"The base colour texture of " + where + " has no texture coordinates (TEXCOORD_" +
                           std::to_string(base->uv_set) + "): the base colour factor alone determines its reflectance.",
                       Effect::figures});
  }
}

}  // namespace

std::optional<Primitive> read_primitive(const Document& document, const tinygltf::Primitive& primitive,
                                        const Material& material, std::optional<int> uv_set, const std::string& where,
                                        std::vector<Ignored>& ignored) {
  if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    refuse(document, "the mode of " + where + " is " + std::to_string(primitive.mode) +
                         " (allowed: 0 to 6). Export the file again.");
  }
  if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
    ignored.push_back({"Points or lines of " + where + ": they have no area.", Effect::none});
    return std::nullopt;
  }
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) {
    ignored.push_back({where + " has no positions: it is left out.", Effect::none});
    return std::nullopt;
  }
  Primitive result;
  result.where = where;
  result.positions = read_vectors(document, position->second, "the positions of " + where);
  const std::size_t vertices = result.positions.size();
  if (const auto set = choose_uv_set(document, primitive, uv_set))
    result.uvs = read_uvs(document, primitive, *set, transform_of_set(material, *set), vertices, where);
  const auto& base = material.base_colour;
  if (base && primitive.attributes.count("TEXCOORD_" + std::to_string(base->uv_set)) != 0) {
    result.reflectance_uvs = read_uvs(document, primitive, base->uv_set, base->transform, vertices, where);
    for (const glm::dvec2& uv : result.reflectance_uvs) {
      if (std::isfinite(uv.x) && std::isfinite(uv.y)) continue;
      refuse(document, "the texture coordinates of " + where +
                           " are not finite (allowed: finite numbers). Unwrap the mesh again, or set the custom "
                           "property 'reflectance' of its material.");
    }
  }
  result.triangles = read_triangles(document, primitive, vertices, where);
  note_ignored_attributes(primitive, material, where, ignored);
  if (result.triangles.empty()) {
    ignored.push_back({where + " has no triangles: it is left out.", Effect::none});
    return std::nullopt;
  }
  return result;
}

Surface place_primitive(const Primitive& primitive, const glm::dmat4& world) {
  Surface surface;
  surface.positions.reserve(primitive.positions.size());
  for (const glm::dvec3& local : primitive.positions) surface.positions.emplace_back(world * glm::dvec4(local, 1.0));
  surface.uvs = primitive.uvs;
  surface.reflectance_uvs = primitive.reflectance_uvs;
  const bool mirrored = glm::determinant(glm::dmat3(world)) < 0.0;
  for (glm::uvec3 triangle : primitive.triangles) {
    if (!has_area(surface.positions[triangle.x], surface.positions[triangle.y], surface.positions[triangle.z])) {
      ++surface.without_area;
      continue;
    }
    if (mirrored) std::swap(triangle.y, triangle.z);
    surface.triangles.push_back(triangle);
  }
  return surface;
}

}  // namespace lichtmc
