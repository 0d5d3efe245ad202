#include "gltf/materials.hpp"

#include <cmath>

#include "base/message.hpp"

namespace lichtmc {

namespace {

constexpr const char* strength_extension = "KHR_materials_emissive_strength";

std::string material_name(const tinygltf::Material& material, std::size_t index) {
  return material.name.empty() ? "material_" + std::to_string(index) : material.name;
}

double read_reflectance(const Document& document, const tinygltf::Material& material, const std::string& where) {
  const std::vector<double>& colour = material.pbrMetallicRoughness.baseColorFactor;
  const bool given = material.extras.IsObject() && material.extras.Has("reflectance");
  const double reflectance = given                ? number_in(document, material.extras, "reflectance", 0.0, where)
                             : colour.size() >= 3 ? luminance(colour[0], colour[1], colour[2])
                                                  : 1.0;
  if (reflectance >= 0.0 && reflectance <= 1.0) return reflectance;
  refuse(document, "the reflectance of " + where + " is " + to_text(reflectance) +
                       " (allowed: 0 to 1). Set the material's custom property 'reflectance' or its base colour.");
}

std::optional<Emission> read_emission(const Document& document, const tinygltf::Material& material,
                                      const std::string& where) {
  Emission emission;
  double strength = 1.0;
  const auto extension = material.extensions.find(strength_extension);
  if (extension != material.extensions.end())
    strength = number_in(document, extension->second, "emissiveStrength", 1.0, where);
  const std::vector<double>& colour = material.emissiveFactor;
  if (colour.size() == 3) emission.luminance = strength * luminance(colour[0], colour[1], colour[2]);
  if (!(emission.luminance >= 0.0) || !std::isfinite(emission.luminance)) {
    refuse(document, "the emission of " + where + " is " + to_text(emission.luminance) +
                         " cd/m² (allowed: a finite number, 0 or more). Set its emissive colour and strength.");
  }
  emission.power = power_in(document, material.extras, where);
  emission.quantity = unit_in(document, material.extras, where).value_or(Quantity::photometric);
  emission.exponent = exponent_in(document, material.extras, where).value_or(1.0);
  if (emission.power ? *emission.power > 0.0 : emission.luminance > 0.0) return emission;
  return std::nullopt;
}

}  // namespace

double luminance(double red, double green, double blue) {
  // ITU-R BT.709: 0.2126 R + 0.7152 G + 0.0722 B, arranged so that greys keep their value exactly.
  return green + 0.2126 * (red - green) + 0.0722 * (blue - green);
}

std::optional<double> power_in(const Document& document, const tinygltf::Value& extras, const std::string& where) {
  if (!extras.IsObject() || !extras.Has("power")) return std::nullopt;
  const double power = number_in(document, extras, "power", 0.0, where);
  if (power >= 0.0 && std::isfinite(power)) return power;
  refuse(document, "'power' of " + where + " is " + to_text(power) +
                       " (allowed: a finite number, 0 or more). Set that custom property.");
}

std::optional<Quantity> unit_in(const Document& document, const tinygltf::Value& extras, const std::string& where) {
  if (!extras.IsObject() || !extras.Has("unit")) return std::nullopt;
  const tinygltf::Value& unit = extras.Get("unit");
  const std::string text = unit.IsString() ? unit.Get<std::string>() : "(not a text)";
  if (text == "W") return Quantity::radiometric;
  if (text == "lm") return Quantity::photometric;
  refuse(document, "'unit' of " + where + " is '" + text + "' (allowed: \"W\" or \"lm\"). Set that custom property.");
}

std::optional<double> exponent_in(const Document& document, const tinygltf::Value& extras, const std::string& where) {
  if (!extras.IsObject() || !extras.Has("lambert_exponent")) return std::nullopt;
  const double exponent = number_in(document, extras, "lambert_exponent", 1.0, where);
  if (exponent >= 0.0) return exponent;
  refuse(document,
         "'lambert_exponent' of " + where + " is " + to_text(exponent) +
             " (allowed: 0 or more). Set that custom property: 0 uniform hemisphere, 1 Lambert, more for a beam.");
}

Material read_material(const Document& document, int index) {
  if (index == -1) return {"(default)", 1.0, Sides::one, std::nullopt};
  const auto& materials = document.model.materials;
  const std::size_t k = checked_index(document, index, materials.size(), "a mesh's material");
  const std::string where = label("material", materials[k].name, k);
  Material material;
  material.name = material_name(materials[k], k);
  material.reflectance = read_reflectance(document, materials[k], where);
  material.sides = materials[k].doubleSided ? Sides::both : Sides::one;
  material.emission = read_emission(document, materials[k], where);
  return material;
}

void note_ignored_materials(const Document& document, const std::vector<bool>& used,
                            std::vector<std::string>& ignored) {
  const auto& materials = document.model.materials;
  std::size_t metals = 0;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    if (!used[k]) continue;
    const auto& material = materials[k];
    const auto& pbr = material.pbrMetallicRoughness;
    const std::string where = "Material " + in_quotes(material_name(material, k)) + ": ";
    const bool given = material.extras.IsObject() && material.extras.Has("reflectance");
    if (pbr.baseColorTexture.index >= 0 && !given)
      ignored.push_back(where +
                        "its base colour texture is not read; the base colour factor alone is its reflectance.");
    if (material.emissiveTexture.index >= 0)
      ignored.push_back(where + "its emissive texture is not read; it shines evenly.");
    if (material.normalTexture.index >= 0)
      ignored.push_back(where + "its normal map is not modelled; surfaces are flat.");
    if (material.alphaMode == "BLEND" || material.alphaMode == "MASK")
      ignored.push_back(where + "transparency (alpha) is not modelled; it is opaque.");
    if (material.occlusionTexture.index >= 0)
      ignored.push_back(where + "its occlusion map is not used; occlusion is simulated.");
    if (pbr.metallicRoughnessTexture.index >= 0)
      ignored.push_back(where + "its metallic-roughness map is not modelled; it reflects diffusely.");
    if (pbr.metallicFactor > 0.0 && !given) ++metals;
    for (const auto& [name, value] : material.extensions) {
      if (name == strength_extension) continue;
      ignored.push_back(where + "the extension " + name + " is not modelled; it reflects diffusely.");
    }
  }
  if (metals > 0) {
    ignored.push_back(
        to_text(metals, "material") + (metals == 1 ? " is" : " are") +
        " metallic (glTF's default is metallicFactor 1): metal and gloss are not modelled, they reflect diffusely.");
  }
}

}  // namespace lichtmc
