#include "gltf/materials.hpp"
#include "base/luminance.hpp"

#include <algorithm>
#include <cmath>

#include "base/decimal_shift.hpp"
#include "base/message.hpp"

namespace lichtmc {

namespace {

constexpr const char* strength_extension = "KHR_materials_emissive_strength";

std::string name_of(const tinygltf::Material& material, std::size_t index) {
  return material.name.empty() ? "material_" + std::to_string(index) : material.name;
}

// The base colour: factor, and texture if there is one.
struct BaseColour {
  glm::dvec3 factor{1.0};
  std::optional<TextureUse> texture;
};

// With KHR_materials_pbrSpecularGlossiness: diffuse factor and texture, which the extension puts in place of the base
// colour.
BaseColour read_base_colour(const Document& document, const tinygltf::Material& material, const std::string& where) {
  BaseColour result;
  const auto diffuse = material.extensions.find("KHR_materials_pbrSpecularGlossiness");
  if (diffuse != material.extensions.end()) {
    const tinygltf::Value& values = diffuse->second;
    result.factor = colour_in(document, values, "diffuseFactor", glm::dvec3(1.0), where);
    if (!values.IsObject() || !values.Has("diffuseTexture")) return result;
    const tinygltf::Value& info = values.Get("diffuseTexture");
    const std::string what = "the diffuse texture of " + where;
    const double index = number_in(document, info, "index", -1.0, what);
    const double set = number_in(document, info, "texCoord", 0.0, what);
    if (!(index >= 0.0 && index < 1e9 && set >= 0.0 && set < 1e6))
      refuse(document, what + " has the index " + to_text(index) + " and the texCoord " + to_text(set) +
                           " (allowed: numbers of a texture and a UV set). Export the file again.");
    const auto extensions = info.Has("extensions") && info.Get("extensions").IsObject()
                                ? info.Get("extensions").Get<tinygltf::Value::Object>()
                                : tinygltf::ExtensionMap{};
    result.texture = read_texture_use(document, static_cast<int>(index), static_cast<int>(set), extensions, where);
    return result;
  }
  const std::vector<double>& colour = material.pbrMetallicRoughness.baseColorFactor;
  if (colour.size() >= 3) result.factor = glm::dvec3(colour[0], colour[1], colour[2]);
  const auto& info = material.pbrMetallicRoughness.baseColorTexture;
  if (info.index >= 0) result.texture = read_texture_use(document, info.index, info.texCoord, info.extensions, where);
  return result;
}

double read_reflectance(const Document& document, const tinygltf::Material& material, const glm::dvec3& colour,
                        const std::string& where) {
  const double reflectance = gives_reflectance(material)
                                 ? number_in(document, material.extras, "reflectance", 0.0, where)
                                 : luminance(colour.r, colour.g, colour.b);
  if (reflectance >= 0.0 && reflectance <= 1.0) return reflectance;
  refuse(document,
         "the reflectance of " + where + " is " + to_text(reflectance) +
             " (allowed: 0 to 1). Set the custom property 'reflectance' of the material, or its base colour.");
}

std::vector<TextureUse> read_texture_uses(const Document& document, const tinygltf::Material& material,
                                          const BaseColour& base, const std::string& where) {
  std::vector<TextureUse> uses;
  if (base.texture) uses.push_back(*base.texture);
  const auto add = [&](const auto& info) {
    if (info.index >= 0) uses.push_back(read_texture_use(document, info.index, info.texCoord, info.extensions, where));
  };
  add(material.emissiveTexture);
  add(material.normalTexture);
  add(material.occlusionTexture);
  add(material.pbrMetallicRoughness.metallicRoughnessTexture);
  return uses;
}

std::optional<Emission> read_emission(const Document& document, const tinygltf::Material& material,
                                      const std::string& where) {
  Emission emission;
  const auto extension = material.extensions.find(strength_extension);
  if (extension != material.extensions.end())
    emission.strength = number_in(document, extension->second, "emissiveStrength", 1.0, where);
  const std::vector<double>& colour = material.emissiveFactor;
  if (colour.size() == 3) emission.factor = {colour[0], colour[1], colour[2]};
  const double of_factor = luminance(emission.factor.r, emission.factor.g, emission.factor.b);
  emission.luminance = emission.strength * of_factor;
  if (!(emission.luminance >= 0.0) || !std::isfinite(emission.luminance)) {
    refuse(document, "the emission of " + where + " is " + to_text(emission.luminance) +
                         " cd/m² (allowed: a finite number, 0 or more). Set its emissive factor and strength.");
  }
  emission.power = power_in(document, material.extras, where);
  emission.quantity = unit_in(document, material.extras, where).value_or(Quantity::photometric);
  emission.exponent = exponent_in(document, material.extras, where).value_or(1.0);
  emission.delay_s = delay_in(document, material.extras, where).value_or(0.0);
  emission.maintenance_factor = maintenance_in(document, material.extras, where);
  const auto& info = material.emissiveTexture;
  if (info.index >= 0 && of_factor > 0.0) {
    const double least = std::min({emission.factor.r, emission.factor.g, emission.factor.b});
    if (least < 0.0)
      refuse(document, "a component of the emissive factor of " + where + " is " + to_text(least) +
                           " (allowed: 0 to 1). Set its emissive factor.");
    emission.texture = read_texture_use(document, info.index, info.texCoord, info.extensions, where);
  }
  if (emission.power ? *emission.power > 0.0 : emission.luminance > 0.0) return emission;
  return std::nullopt;
}

}  // namespace

bool gives_reflectance(const tinygltf::Material& material) {
  return material.extras.IsObject() && material.extras.Has("reflectance");
}

std::optional<double> power_in(const Document& document, const tinygltf::Value& extras, const std::string& where) {
  if (!extras.IsObject() || !extras.Has("power")) return std::nullopt;
  const double power = number_in(document, extras, "power", 0.0, where);
  if (power >= 0.0 && std::isfinite(power)) return power;
  refuse(document, "'power' of " + where + " is " + to_text(power) +
                       " (allowed: a finite number, 0 or more). Correct this custom property.");
}

std::optional<Quantity> unit_in(const Document& document, const tinygltf::Value& extras, const std::string& where) {
  if (!extras.IsObject() || !extras.Has("unit")) return std::nullopt;
  const tinygltf::Value& unit = extras.Get("unit");
  const std::string text = unit.IsString() ? unit.Get<std::string>() : "(not a text)";
  if (text == "W") return Quantity::radiometric;
  if (text == "lm") return Quantity::photometric;
  refuse(document,
         "'unit' of " + where + " is '" + text + "' (allowed: \"W\" or \"lm\"). Correct this custom property.");
}

std::optional<double> delay_in(const Document& document, const tinygltf::Value& extras, const std::string& where) {
  if (!extras.IsObject() || !extras.Has("delay_ns")) return std::nullopt;
  const double delay_ns = number_in(document, extras, "delay_ns", 0.0, where);
  if (delay_ns >= 0.0 && std::isfinite(delay_ns)) return shift_decimals(delay_ns, -9);
  refuse(document, "'delay_ns' of " + where + " is " + to_text(delay_ns) +
                       " (allowed: a finite number of nanoseconds, 0 or more). Correct this custom property.");
}

std::optional<double> maintenance_in(const Document& document, const tinygltf::Value& extras,
                                     const std::string& where) {
  if (!extras.IsObject() || !extras.Has("maintenance_factor")) return std::nullopt;
  const double factor = number_in(document, extras, "maintenance_factor", 1.0, where);
  if (factor > 0.0 && factor <= 1.0) return factor;
  refuse(document, "'maintenance_factor' of " + where + " is " + to_text(factor) +
                       " (allowed: above 0 and up to 1, the share of its new power that it keeps). Correct this custom "
                       "property.");
}

void set_maintenance(Emitter& emitter, const std::optional<double>& factor) {
  if (!factor) return;
  emitter.maintenance_factor = *factor;
  emitter.own_maintenance = true;
}

std::optional<double> exponent_in(const Document& document, const tinygltf::Value& extras, const std::string& where) {
  if (!extras.IsObject() || !extras.Has("lambert_exponent")) return std::nullopt;
  const double exponent = number_in(document, extras, "lambert_exponent", 1.0, where);
  if (exponent >= 0.0) return exponent;
  refuse(document,
         "'lambert_exponent' of " + where + " is " + to_text(exponent) +
             " (allowed: 0 or more). Correct this custom property: 0 uniform hemisphere, 1 Lambert, above 1 a beam.");
}

std::string material_name(const Document& document, int index) {
  if (index == -1) return "(default)";
  const auto& materials = document.model.materials;
  const std::size_t k = checked_index(document, index, materials.size(), "the material of a mesh");
  return name_of(materials[k], k);
}

Material read_material(const Document& document, int index, bool by_number) {
  Material result;
  result.name = material_name(document, index);
  result.takes_vertex_colours = !by_number;
  if (index == -1) return result;
  const auto k = static_cast<std::size_t>(index);
  const auto& material = document.model.materials[k];
  const std::string where = label("material", material.name, k);
  const BaseColour base = read_base_colour(document, material, where);
  result.reflectance = read_reflectance(document, material, base.factor, where);
  result.factor = base.factor;
  result.source = gives_reflectance(material)        ? ReflectanceSource::property
                  : result.factor == glm::dvec3(1.0) ? ReflectanceSource::default_white
                                                     : ReflectanceSource::base_colour;
  result.textures = read_texture_uses(document, material, base, where);
  if (!gives_reflectance(material) && !by_number) result.base_colour = base.texture;
  result.takes_vertex_colours = !gives_reflectance(material) && !by_number;
  result.sides = material.doubleSided ? Sides::both : Sides::one;
  result.emission = read_emission(document, material, where);
  return result;
}

}  // namespace lichtmc
