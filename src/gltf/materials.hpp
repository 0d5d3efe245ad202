// What materials say about light: reflectance and emission.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "gltf/document.hpp"
#include "gltf/textures.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Luminance of a linear colour with Rec. 709 primaries.
double luminance(double red, double green, double blue);

// A power as a file gives it: in W or lm.
struct FilePower {
  double value = 0.0;
  Quantity quantity = Quantity::photometric;
};

// extras.power with extras.unit, where there is one; what the unit is where only it is given. Throws InputError where
// the power is negative or not finite, or the unit is neither "W" nor "lm".
std::optional<double> power_in(const Document& document, const tinygltf::Value& extras, const std::string& where);
std::optional<Quantity> unit_in(const Document& document, const tinygltf::Value& extras, const std::string& where);

// extras.lambert_exponent, ≥ 0, where there is one.
std::optional<double> exponent_in(const Document& document, const tinygltf::Value& extras, const std::string& where);

// A material that shines.
struct Emission {
  double luminance = 0.0;       // L in cd/m², or W/(m² sr)
  std::optional<double> power;  // of each surface with the material; in place of the luminance
  Quantity quantity = Quantity::photometric;
  double exponent = 1.0;
};

struct Material {
  std::string name;
  double reflectance = 1.0;               // of the whole material, or where `base_colour` cannot be read
  std::optional<TextureUse> base_colour;  // where a texture says ρ point by point
  glm::dvec3 factor{1.0};                 // that it is multiplied with, linear
  std::vector<TextureUse> textures;       // all that the material uses, base colour first
  Sides sides = Sides::one;
  std::optional<Emission> emission;
};

// Reads material number `index`; −1 is glTF's default material, white. `by_number`: ρ will be given as one number, no
// texture is needed. Throws InputError naming the material and the value.
Material read_material(const Document& document, int index, bool by_number);

// The name of material number `index`, as surfaces and tables have it.
std::string material_name(const Document& document, int index);

// What materials hold that is not modelled.
void note_ignored_materials(const Document& document, const std::vector<bool>& used, std::vector<Ignored>& ignored);

}  // namespace lichtmc
