#include "gltf/materials.hpp"
#include "base/luminance.hpp"

#include <algorithm>
#include <cmath>

#include "base/message.hpp"

namespace lichtmc {

namespace {

constexpr const char* strength_extension = "KHR_materials_emissive_strength";

std::string name_of(const tinygltf::Material& material, std::size_t index) {
  return material.name.empty() ? "material_" + std::to_string(index) : material.name;
}

bool gives_reflectance(const tinygltf::Material& material) {
  return material.extras.IsObject() && material.extras.Has("reflectance");
}

glm::dvec3 base_colour_factor(const tinygltf::Material& material) {
  const std::vector<double>& colour = material.pbrMetallicRoughness.baseColorFactor;
  return colour.size() >= 3 ? glm::dvec3(colour[0], colour[1], colour[2]) : glm::dvec3(1.0);
}

double read_reflectance(const Document& document, const tinygltf::Material& material, const std::string& where) {
  const glm::dvec3 colour = base_colour_factor(material);
  const double reflectance = gives_reflectance(material)
                                 ? number_in(document, material.extras, "reflectance", 0.0, where)
                                 : luminance(colour.r, colour.g, colour.b);
  if (reflectance >= 0.0 && reflectance <= 1.0) return reflectance;
  refuse(document,
         "the reflectance of " + where + " is " + to_text(reflectance) +
             " (allowed: 0 to 1). Set the custom property 'reflectance' of the material, or its base colour.");
}

std::vector<TextureUse> read_texture_uses(const Document& document, const tinygltf::Material& material,
                                          const std::string& where) {
  std::vector<TextureUse> uses;
  const auto add = [&](const auto& info) {
    if (info.index >= 0) uses.push_back(read_texture_use(document, info.index, info.texCoord, info.extensions, where));
  };
  add(material.pbrMetallicRoughness.baseColorTexture);
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
  result.reflectance = read_reflectance(document, material, where);
  result.factor = base_colour_factor(material);
  result.source = gives_reflectance(material)        ? ReflectanceSource::property
                  : result.factor == glm::dvec3(1.0) ? ReflectanceSource::default_white
                                                     : ReflectanceSource::base_colour;
  result.textures = read_texture_uses(document, material, where);
  if (material.pbrMetallicRoughness.baseColorTexture.index >= 0 && !gives_reflectance(material) && !by_number)
    result.base_colour = result.textures.front();
  result.takes_vertex_colours = !gives_reflectance(material) && !by_number;
  result.sides = material.doubleSided ? Sides::both : Sides::one;
  result.emission = read_emission(document, material, where);
  return result;
}

namespace {

void note_ignored_extensions(const tinygltf::Material& material, const std::string& where,
                             std::vector<Ignored>& ignored) {
  for (const auto& [name, value] : material.extensions) {
    if (name == strength_extension || name == "KHR_materials_unlit") continue;
    const bool transmits = name == "KHR_materials_transmission" || name == "KHR_materials_diffuse_transmission" ||
                           name == "KHR_materials_volume";
    const bool has_other_colour = name == "KHR_materials_pbrSpecularGlossiness";
    const char* consequence = transmits          ? " and transmits no light. Remove panes that should transmit light."
                              : has_other_colour ? " with the reflectance of its base colour. Set the custom property "
                                                   "'reflectance'."
                                                 : ".";
    ignored.push_back(
        {where + "the extension " + name + " is not modelled; the material reflects diffusely" + consequence,
         transmits || has_other_colour ? Effect::figures : Effect::none});
  }
}

// `where`: "Material 'name': ".
void note_ignored_properties(const tinygltf::Material& material, const std::string& where,
                             std::vector<Ignored>& ignored) {
  const auto note = [&](bool present, Effect effect, const char* what) {
    if (present) ignored.push_back({where + what, effect});
  };
  note(material.normalTexture.index >= 0, Effect::none, "its normal texture is not modelled; facets are flat.");
  note(material.alphaMode == "BLEND" || material.alphaMode == "MASK", Effect::figures,
       "transparency (alpha) is not modelled; the material is opaque. Remove surfaces that should transmit light.");
  note(material.occlusionTexture.index >= 0, Effect::none,
       "its occlusion texture is not used; occlusion is simulated.");
  note(material.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0, Effect::none,
       "its metallic-roughness texture is not modelled; the material reflects diffusely.");
}

}  // namespace

void note_ignored_materials(const Document& document, const std::vector<bool>& used, std::vector<Ignored>& ignored) {
  const auto& materials = document.model.materials;
  std::size_t metals = 0;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    if (!used[k]) continue;
    const auto& material = materials[k];
    const std::string where = "Material " + in_quotes(name_of(material, k)) + ": ";
    note_ignored_properties(material, where, ignored);
    if (material.pbrMetallicRoughness.metallicFactor > 0.0 && !gives_reflectance(material)) ++metals;
    note_ignored_extensions(material, where, ignored);
  }
  if (metals > 0) {
    ignored.push_back({to_text(metals, "material") + (metals == 1 ? " is" : " are") +
                           " metallic (glTF's default is metallicFactor 1): metal and gloss are not modelled, these "
                           "materials reflect diffusely. Near real mirrors the figures differ.",
                       Effect::figures});
  }
}

}  // namespace lichtmc
