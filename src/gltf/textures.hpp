// Textures: where on a picture a vertex lies, and pictures of base colour as reflectance.
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

// KHR_texture_transform: scaled, turned by an angle, moved.
struct UvTransform {
  glm::dvec2 offset{0.0};
  double rotation = 0.0;  // rad
  glm::dvec2 scale{1.0};

  glm::dvec2 operator()(const glm::dvec2& uv) const;
};

// A material's use of a texture.
struct TextureUse {
  int texture = -1;
  int uv_set = 0;  // n of TEXCOORD_n, also where the transform names another
  UvTransform transform;
};

// The use of a texture as the parser gives it (tinygltf has three types for it); `where` names the material.
TextureUse read_texture_use(const Document& document, int texture, int uv_set, const tinygltf::ExtensionMap& extensions,
                            const std::string& where);

// Makes reflectance maps of textures, one for every texture and factor.
class ReflectanceMaps {
 public:
  explicit ReflectanceMaps(const Document& document) : document_(&document) {}

  // The number of the map that a base colour texture and its factor (linear colours) make: the Rec. 709 luminance of
  // their product, pixel by pixel. Throws InputError naming the material and the image where the image is missing,
  // cannot be decoded (PNG and JPEG are), or has more than 2^28 pixels.
  std::size_t find_or_make(int texture, const glm::dvec3& factor, const std::string& where);

  std::vector<ReflectanceMap> take() { return std::move(maps_); }

 private:
  const Document* document_;
  std::vector<ReflectanceMap> maps_;
  std::map<std::tuple<int, double, double, double>, std::size_t> made_;
};

}  // namespace lichtmc
