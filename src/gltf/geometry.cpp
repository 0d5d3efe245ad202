#include "gltf/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "base/message.hpp"
#include "gltf/accessor.hpp"
#include "gltf/deform.hpp"

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

bool has_uvs(const tinygltf::Primitive& primitive, const TextureUse& use) {
  return primitive.attributes.count("TEXCOORD_" + std::to_string(use.uv_set)) != 0;
}

// The coordinates on a texture of the material; none if there is no texture, or no coordinates for it. remedy: what to
// do besides unwrapping the mesh again.
std::vector<glm::dvec2> read_texture_uvs(const Document& document, const tinygltf::Primitive& primitive,
                                         const std::optional<TextureUse>& use, std::size_t vertices,
                                         const std::string& where, const char* remedy) {
  if (!use || !has_uvs(primitive, *use)) return {};
  std::vector<glm::dvec2> uvs = read_uvs(document, primitive, use->uv_set, use->transform, vertices, where);
  for (const glm::dvec2& uv : uvs) {
    if (std::isfinite(uv.x) && std::isfinite(uv.y)) continue;
    refuse(document, "the texture coordinates of " + where +
                         " are not finite (allowed: finite numbers). Unwrap the mesh again, or " + remedy);
  }
  return uvs;
}

std::vector<glm::dvec3> read_vertex_colours(const Document& document, const tinygltf::Primitive& primitive,
                                            std::size_t vertices, const std::string& where) {
  const auto attribute = primitive.attributes.find("COLOR_0");
  if (attribute == primitive.attributes.end()) return {};
  std::vector<glm::dvec3> colours = read_colours(document, attribute->second, "the vertex colours of " + where);
  if (colours.size() != vertices)
    refuse(document, where + " has " + to_text(vertices, "position") + " but " + std::to_string(colours.size()) +
                         " vertex colours (allowed: one per position). Export the file again.");
  return colours;
}

UvTransform transform_of_set(const Material& material, int set) {
  for (const TextureUse& use : material.textures) {
    if (use.uv_set == set) return use.transform;
  }
  return {};
}

void note_ignored_attributes(const tinygltf::Primitive& primitive, const Material& material, const std::string& where,
                             std::vector<Ignored>& ignored) {
  const auto& base = material.base_colour;
  if (base && !has_uvs(primitive, *base)) {
    ignored.push_back({"The base colour texture of " + where + " has no texture coordinates (TEXCOORD_" +
                           std::to_string(base->uv_set) + "): the base colour factor alone determines its reflectance.",
                       Effect::figures});
  }
  if (material.emission && material.emission->texture && !has_uvs(primitive, *material.emission->texture)) {
    ignored.push_back({"The emissive texture of " + where + " has no texture coordinates (TEXCOORD_" +
                           std::to_string(material.emission->texture->uv_set) +
                           "): the emissive factor alone determines its emission, uniform over its area.",
                       Effect::figures});
  }
}

}  // namespace

std::optional<Primitive> read_primitive(const Document& document, const tinygltf::Primitive& primitive,
                                        const Material& material, std::optional<int> uv_set,
                                        const std::vector<double>& morph_weights, const std::string& where,
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
  apply_morph_targets(document, primitive, morph_weights, where, result.positions, ignored);
  if (const auto set = choose_uv_set(document, primitive, uv_set))
    result.uvs = read_uvs(document, primitive, *set, transform_of_set(material, *set), vertices, where);
  result.reflectance_uvs = read_texture_uvs(document, primitive, material.base_colour, vertices, where,
                                            "set the custom property 'reflectance' of its material.");
  if (material.emission)
    result.emission_uvs = read_texture_uvs(document, primitive, material.emission->texture, vertices, where,
                                           "remove the emissive texture of its material.");
  if (material.takes_vertex_colours) result.vertex_colours = read_vertex_colours(document, primitive, vertices, where);
  result.triangles = read_triangles(document, primitive, vertices, where);
  note_ignored_attributes(primitive, material, where, ignored);
  if (result.triangles.empty()) {
    ignored.push_back({where + " has no triangles: it is left out.", Effect::none});
    return std::nullopt;
  }
  return result;
}

double coarse_rounding(const Document& document, const tinygltf::Primitive& primitive, const Primitive& stored) {
  const auto accessor = static_cast<std::size_t>(primitive.attributes.at("POSITION"));
  if (document.model.accessors[accessor].componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) return 0.0;
  glm::dvec3 low = stored.positions.front();
  glm::dvec3 high = low;
  for (const glm::dvec3& p : stored.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const auto largest = [](const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); };
  const auto farthest = static_cast<float>(largest(glm::max(glm::abs(low), glm::abs(high))));
  const double spacing = double{std::nextafter(farthest, std::numeric_limits<float>::max())} - double{farthest};
  constexpr double noticeable = 0.001;
  return spacing > noticeable * largest(high - low) ? spacing : 0.0;
}

namespace {

// to_world(n): the transform of vertex n; mirrors(t): whether that of a triangle mirrors.
template <class ToWorld, class Mirrors>
Surface place(const Primitive& primitive, const ToWorld& to_world, const Mirrors& mirrors) {
  Surface surface;
  surface.positions.reserve(primitive.positions.size());
  for (std::size_t n = 0; n < primitive.positions.size(); ++n)
    surface.positions.emplace_back(to_world(n) * glm::dvec4(primitive.positions[n], 1.0));
  surface.uvs = primitive.uvs;
  surface.reflectance_uvs = primitive.reflectance_uvs;
  for (glm::uvec3 triangle : primitive.triangles) {
    if (!has_area(surface.positions[triangle.x], surface.positions[triangle.y], surface.positions[triangle.z])) {
      ++surface.without_area;
      continue;
    }
    if (mirrors(triangle)) std::swap(triangle.y, triangle.z);
    surface.triangles.push_back(triangle);
  }
  return surface;
}

}  // namespace

Surface place_primitive(const Primitive& primitive, const glm::dmat4& world) {
  const bool mirrored = glm::determinant(glm::dmat3(world)) < 0.0;
  return place(
      primitive, [&](std::size_t) -> const glm::dmat4& { return world; }, [&](const glm::uvec3&) { return mirrored; });
}

Surface place_primitive(const Primitive& primitive, const std::vector<glm::dmat4>& worlds) {
  return place(
      primitive, [&](std::size_t n) -> const glm::dmat4& { return worlds[n]; },
      [&](const glm::uvec3& t) {
        return glm::determinant(glm::dmat3(worlds[t.x]) + glm::dmat3(worlds[t.y]) + glm::dmat3(worlds[t.z])) < 0.0;
      });
}

}  // namespace lichtmc
