// Textures: texture coordinates of vertices, reflectance maps from base colour textures, emission maps from emissive
// textures.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "gltf/document.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// KHR_texture_transform: scale, rotation, translation.
struct UvTransform {
  glm::dvec2 offset{0.0};
  double rotation = 0.0;  // rad
  glm::dvec2 scale{1.0};

  glm::dvec2 operator()(const glm::dvec2& uv) const;
};

// The reference of a material to a texture.
struct TextureUse {
  int texture = -1;
  int uv_set = 0;  // n of TEXCOORD_n; that of the transform if it has one
  UvTransform transform;
};

// Reads the reference to a texture; the arguments are those of tinygltf's three types for it. `where` names the
// material.
TextureUse read_texture_use(const Document& document, int texture, int uv_set, const tinygltf::ExtensionMap& extensions,
                            const std::string& where);

// A use of textures, in the words of messages.
struct TextureRole {
  const char* texture;  // "base colour texture"
  const char* remedy;   // what to do if the image is missing or cannot be read, besides providing it
  double highest;       // values above it, by rounding of a factor, are set to it
};
inline constexpr TextureRole reflectance_role{
    "base colour texture",
    "set the reflectance of the material: custom property 'reflectance', or --reflectance NAME=R.", 1.0};
inline constexpr TextureRole emission_role{
    "emissive texture",
    "give the material the custom property 'power': its surfaces then emit this power, uniformly over their area.",
    std::numeric_limits<double>::infinity()};

// Converts the textures of one role to maps, one for each pair of texture and factor.
class TextureMaps {
 public:
  TextureMaps(const Document& document, const TextureRole& role) : document_(&document), role_(&role) {}

  // The index of the map of a texture and a factor (linear colours): the Rec. 709 luminance of their product, pixel by
  // pixel; `coloured`: also the product itself. Throws InputError with the names of material and image if the image is
  // missing, is neither PNG, JPEG nor WebP, is damaged, or has more than 2^28 pixels.
  std::size_t find_or_make(int texture, const glm::dvec3& factor, bool coloured, const std::string& where);

  const TextureMap& operator[](std::size_t map) const { return maps_[map]; }
  std::vector<TextureMap> take() { return std::move(maps_); }

 private:
  const Document* document_;
  const TextureRole* role_;
  std::vector<TextureMap> maps_;
  std::map<std::tuple<int, bool, double, double, double>, std::size_t> made_;
};

}  // namespace lichtmc
