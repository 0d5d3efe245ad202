// What a material has beyond reflectance and emission, and whether that may change the figures.
#include <algorithm>
#include <string>

#include "base/message.hpp"
#include "gltf/materials.hpp"

namespace lichtmc {

namespace {

// A material with what its notes need.
struct Noted {
  const Document& document;
  const tinygltf::Material& material;
  std::string label;  // "material 'name'"
  bool given;         // its reflectance is given as a number
  std::vector<Ignored>& ignored;

  void note(const std::string& what, Effect effect) const {
    ignored.push_back({"M" + label.substr(1) + ": " + what, effect});
  }
  double number(const tinygltf::Value& extension, const char* name, double otherwise) const {
    return number_in(document, extension, name, otherwise, label);
  }
};

double highest(const glm::dvec3& colour) {
  return std::max({colour.r, colour.g, colour.b});
}

void note_transmission(const Noted& m, const std::string& name, const tinygltf::Value& extension) {
  // Volume and dispersion only describe light that has entered by one of the others.
  const char* const factor = name == "KHR_materials_transmission"           ? "transmissionFactor"
                             : name == "KHR_materials_diffuse_transmission" ? "diffuseTransmissionFactor"
                                                                            : nullptr;
  if (factor == nullptr || m.number(extension, factor, 0.0) == 0.0) return;
  m.note(
      "the extension " + name +
          " is not modelled; the material transmits no light. Leave out panes that should transmit light (--without).",
      Effect::figures);
}

void note_specular_glossiness(const Noted& m, const tinygltf::Value& extension) {
  constexpr double of_dielectrics = 0.04;  // glTF's reflectance of every surface that is not metallic
  const double specular = highest(colour_in(m.document, extension, "specularFactor", glm::dvec3(1.0), m.label));
  const bool changes = !m.given && specular > of_dielectrics;
  m.note("the specular colour of KHR_materials_pbrSpecularGlossiness, up to " + to_text(specular) +
             ", is not modelled; the material reflects diffusely" +
             (changes ? ", with its diffuse colour. Set the custom property 'reflectance'." : "."),
         changes ? Effect::figures : Effect::none);
}

void note_unlit(const Noted& m) {
  m.note(m.given
             ? "it is unlit (KHR_materials_unlit); it reflects as given."
             : "it is unlit (KHR_materials_unlit): its colour is meant to be seen without light, for example a sky or "
               "a picture with its light. It is taken as reflectance. Set the custom property 'reflectance', or leave "
               "the surfaces out (--without).",
         m.given ? Effect::none : Effect::figures);
}

// Whether an extension that describes gloss changes the reflectance of the material considerably.
bool changes_reflectance(const Noted& m, const std::string& name, const tinygltf::Value& extension) {
  if (m.given) return false;
  if (name == "KHR_materials_clearcoat") return m.number(extension, "clearcoatFactor", 0.0) > 0.0;
  if (name == "KHR_materials_iridescence") return m.number(extension, "iridescenceFactor", 0.0) > 0.0;
  if (name == "KHR_materials_sheen")
    return highest(colour_in(m.document, extension, "sheenColorFactor", glm::dvec3(0.0), m.label)) > 0.0;
  // An index of refraction of 0 means a mirror (specification of the extension). Other indices change the 4 % of gloss
  // that glTF gives every surface and that is not modelled in any material.
  if (name == "KHR_materials_ior") return m.number(extension, "ior", 1.5) == 0.0;
  if (name == "KHR_materials_specular")
    return highest(colour_in(m.document, extension, "specularColorFactor", glm::dvec3(1.0), m.label)) > 1.0;
  return false;  // anisotropy: only the direction of gloss
}

void note_gloss(const Noted& m, const std::string& name, const tinygltf::Value& extension) {
  const bool changes = changes_reflectance(m, name, extension);
  m.note("the extension " + name + " is not modelled; the material reflects diffusely" +
             (changes ? ", without what this extension reflects. Set the custom property 'reflectance'." : "."),
         changes ? Effect::figures : Effect::none);
}

void note_extensions_of(const Noted& m) {
  for (const auto& [name, extension] : m.material.extensions) {
    if (name == "KHR_materials_transmission" || name == "KHR_materials_diffuse_transmission" ||
        name == "KHR_materials_volume" || name == "KHR_materials_dispersion") {
      note_transmission(m, name, extension);
    } else if (name == "KHR_materials_pbrSpecularGlossiness") {
      note_specular_glossiness(m, extension);
    } else if (name == "KHR_materials_unlit") {
      note_unlit(m);
    } else if (name == "KHR_materials_anisotropy" || name == "KHR_materials_clearcoat" || name == "KHR_materials_ior" ||
               name == "KHR_materials_iridescence" || name == "KHR_materials_sheen" ||
               name == "KHR_materials_specular") {
      note_gloss(m, name, extension);
    }  // others: note_extensions()
  }
}

// Exporters of IFC files give the volumes of rooms a material of this name.
std::string boxes_of_spaces(const std::string& material) {
  if (material.rfind("IfcSpace", 0) != 0) return {};
  return std::string(" Boxes of spaces fill the rooms and keep the light from their walls: leave them out by ") +
         (material == "IfcSpace" ? "--without IfcSpace." : "--without 'IfcSpace*'.");
}

void note_properties(const Noted& m) {
  const auto note = [&](bool present, Effect effect, const char* what) {
    if (present) m.note(what, effect);
  };
  const tinygltf::Material& material = m.material;
  note(material.normalTexture.index >= 0, Effect::none, "its normal texture is not modelled; facets are flat.");
  if (material.alphaMode == "BLEND" || material.alphaMode == "MASK")
    m.note(
        "transparency (alpha) is not modelled; the material is opaque. Leave out surfaces that should transmit light "
        "(--without)." +
            boxes_of_spaces(material.name),
        Effect::figures);
  note(material.occlusionTexture.index >= 0, Effect::none,
       "its occlusion texture is not used; occlusion is simulated.");
  note(material.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0, Effect::none,
       "its metallic-roughness texture is not modelled; the material reflects diffusely.");
}

}  // namespace

void note_ignored_materials(const Document& document, const std::vector<MaterialUse>& uses,
                            std::vector<Ignored>& ignored) {
  const auto& materials = document.model.materials;
  std::size_t metals = 0;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    if (!uses[k].used) continue;
    const auto& material = materials[k];
    const int index = static_cast<int>(k);
    const Noted noted{document, material, "material " + in_quotes(material_name(document, index)),
                      uses[k].by_number || gives_reflectance(material), ignored};
    note_properties(noted);
    const bool other_model = material.extensions.count("KHR_materials_pbrSpecularGlossiness") != 0;
    if (material.pbrMetallicRoughness.metallicFactor > 0.0 && !gives_reflectance(material) && !other_model) ++metals;
    note_extensions_of(noted);
  }
  if (metals > 0) {
    ignored.push_back({to_text(metals, "material") + (metals == 1 ? " is" : " are") +
                           " metallic (glTF's default is metallicFactor 1): metal and gloss are not modelled, these "
                           "materials reflect diffusely. Near real mirrors the figures differ.",
                       Effect::figures});
  }
}
}  // namespace lichtmc
