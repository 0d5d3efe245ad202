// Textures: texture coordinates of vertices, and reflectance maps from base colour textures.
#pragma once

#include <cstddef>
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

// Converts textures to reflectance maps, one for each pair of texture and factor.
class ReflectanceMaps {
 public:
  explicit ReflectanceMaps(const Document& document) : document_(&document) {}

  // The index of the reflectance map of a base colour texture and its factor (linear colours): the Rec. 709 luminance
  // of their product, pixel by pixel. Throws InputError with the names of material and image if the image is missing,
  // is neither PNG nor JPEG, is damaged, or has more than 2^28 pixels.
  std::size_t find_or_make(int texture, const glm::dvec3& factor, const std::string& where);

  std::vector<ReflectanceMap> take() { return std::move(maps_); }

 private:
  const Document* document_;
  std::vector<ReflectanceMap> maps_;
  std::map<std::tuple<int, double, double, double>, std::size_t> made_;
};

}  // namespace lichtmc
