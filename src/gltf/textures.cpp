#include "gltf/textures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

#include "base/luminance.hpp"
#include "base/message.hpp"
#include "base/png.hpp"
#include "gltf/texture_source.hpp"

namespace lichtmc {

namespace {

glm::dvec2 pair_in(const Document& document, const tinygltf::Value& object, const char* name,
                   const glm::dvec2& otherwise, const std::string& where) {
  if (!object.IsObject() || !object.Has(name)) return otherwise;
  const tinygltf::Value& value = object.Get(name);
  const bool numbers = value.IsArray() && value.ArrayLen() == 2 && value.Get(0).IsNumber() && value.Get(1).IsNumber();
  if (!numbers) {
    refuse(document, "'" + std::string(name) + "' of the texture transform of " + where +
                         " is not an array of two numbers. Export the file again.");
  }
  return {value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble()};
}

// The linear value of every sRGB value of a channel.
template <class Channel>
std::vector<double> linear_values() {
  constexpr std::size_t count = std::size_t{1} << (8 * sizeof(Channel));
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k)
    values[k] = light_of_srgb(static_cast<double>(k) / static_cast<double>(count - 1));
  return values;
}

template <class Channel>
void set_values(const std::vector<Channel>& pixels, const glm::dvec3& factor, bool coloured, double highest,
                TextureMap& map) {
  const std::vector<double> light = linear_values<Channel>();
  const std::size_t count = std::size_t{map.columns} * map.rows;
  map.values.resize(count);
  if (coloured) map.colours.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Channel* p = pixels.data() + 3 * k;
    const glm::dvec3 colour(factor.r * light[p[0]], factor.g * light[p[1]], factor.b * light[p[2]]);
    map.values[k] = static_cast<float>(std::min(luminance(colour.r, colour.g, colour.b), highest));
    if (coloured) map.colours[k] = glm::vec3(glm::min(colour, glm::dvec3(highest)));
  }
}

Wrap wrap_of(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
  if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirror;
  return Wrap::repeat;
}

}  // namespace

// The product of the matrices in the specification of the extension.
glm::dvec2 UvTransform::operator()(const glm::dvec2& uv) const {
  const glm::dvec2 scaled = scale * uv;
  const double c = std::cos(rotation);
  const double s = std::sin(rotation);
  return {c * scaled.x + s * scaled.y + offset.x, -s * scaled.x + c * scaled.y + offset.y};
}

TextureUse read_texture_use(const Document& document, int texture, int uv_set, const tinygltf::ExtensionMap& extensions,
                            const std::string& where) {
  TextureUse use{texture, uv_set, {}};
  const auto extension = extensions.find("KHR_texture_transform");
  if (extension == extensions.end()) return use;
  const tinygltf::Value& values = extension->second;
  const std::string what = "the texture transform of " + where;
  use.transform.offset = pair_in(document, values, "offset", use.transform.offset, where);
  use.transform.rotation = number_in(document, values, "rotation", 0.0, what);
  use.transform.scale = pair_in(document, values, "scale", use.transform.scale, where);
  const double set = number_in(document, values, "texCoord", uv_set, what);
  if (!(set >= 0.0 && set < 1e6))
    refuse(document, "'texCoord' of " + what + " is " + to_text(set) +
                         " (allowed: the number of a UV set, below 1000000). Export the file again.");
  use.uv_set = static_cast<int>(set);
  return use;
}

std::size_t TextureMaps::find_or_make(int texture, const glm::dvec3& factor, bool coloured, const std::string& where) {
  const std::tuple key{texture, coloured, factor.r, factor.g, factor.b};
  if (const auto made = made_.find(key); made != made_.end()) return made->second;

  const std::string what = "the " + std::string(role_->texture) + " of " + where;
  const DecodedImage image = read_texture(*document_, texture, what, "Or " + std::string(role_->remedy));
  const auto& model = document_->model;
  const auto& used = model.textures[static_cast<std::size_t>(texture)];
  TextureMap map;
  map.name = image_name(*document_, *image_of_texture(*document_, texture, what));
  if (used.sampler >= 0) {
    const auto& sampler =
        model.samplers[checked_index(*document_, used.sampler, model.samplers.size(), "the sampler of " + where)];
    map.wrap_u = wrap_of(sampler.wrapS);
    map.wrap_v = wrap_of(sampler.wrapT);
  }
  map.columns = image.columns;
  map.rows = image.rows;
  if (image.words.empty()) {
    set_values(image.bytes, factor, coloured, role_->highest, map);
  } else {
    set_values(image.words, factor, coloured, role_->highest, map);
  }
  maps_.push_back(std::move(map));
  return made_[key] = maps_.size() - 1;
}

}  // namespace lichtmc
