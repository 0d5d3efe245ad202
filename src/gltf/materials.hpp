// Reads reflectance and emission of materials.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "gltf/document.hpp"
#include "gltf/textures.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// A power as given by a file: radiant flux (W) or luminous flux (lm).
struct FilePower {
  double value = 0.0;
  Quantity quantity = Quantity::photometric;
};

// extras.power, and extras.unit; none if not present. Throws InputError if the power is negative or not finite, or if
// the unit is neither "W" nor "lm".
std::optional<double> power_in(const Document& document, const tinygltf::Value& extras, const std::string& where);
std::optional<Quantity> unit_in(const Document& document, const tinygltf::Value& extras, const std::string& where);

// extras.lambert_exponent, ≥ 0; none if not present.
std::optional<double> exponent_in(const Document& document, const tinygltf::Value& extras, const std::string& where);

// extras.delay_ns, ≥ 0 and finite, in s; none if not present. Throws InputError if it is out of range.
std::optional<double> delay_in(const Document& document, const tinygltf::Value& extras, const std::string& where);

// extras.maintenance_factor, above 0 and up to 1; none if not present. Throws InputError if it is out of range.
std::optional<double> maintenance_in(const Document& document, const tinygltf::Value& extras, const std::string& where);

// Gives an emitter a factor of its own, or leaves it. Its power stays that of a new one until
// set_maintenance_of_node().
void set_maintenance(Emitter& emitter, const std::optional<double>& factor);

// Emission of an emissive material.
struct Emission {
  double luminance = 0.0;             // L in cd/m², or radiance in W/(m² sr); where the texture is white
  double strength = 1.0;              // L = strength · luminance of (factor · colour of the texture)
  glm::dvec3 factor{0.0};             // linear
  std::optional<TextureUse> texture;  // none if the factor is black
  std::optional<double> power;        // of each surface with the material; replaces the luminance
  Quantity quantity = Quantity::photometric;
  double exponent = 1.0;
  double delay_s = 0.0;
  std::optional<double> maintenance_factor;
};

struct Material {
  std::string name;
  double reflectance = 1.0;  // uniform; used where a surface has no coordinates for `base_colour`
  ReflectanceSource source = ReflectanceSource::default_white;  // of `reflectance`; not a texture
  std::optional<TextureUse> base_colour;                        // the texture that determines ρ point by point
  glm::dvec3 factor{1.0};                                       // base colour factor, linear; multiplies the texture
  bool takes_vertex_colours = false;  // ρ is not given as a number: vertex colours multiply it
  std::vector<TextureUse> textures;   // all textures of the material, base colour first
  Sides sides = Sides::one;
  std::optional<Emission> emission;
};

// Reads material number `index`; −1 is glTF's default material, white. `by_number`: ρ will be set as a number, so no
// texture is needed. Throws InputError with the name of the material and the value.
Material read_material(const Document& document, int index, bool by_number);

// The name of material number `index`, as used in surfaces and tables.
std::string material_name(const Document& document, int index);

// Whether a material has the custom property 'reflectance'.
bool gives_reflectance(const tinygltf::Material& material);

// How a material is used in the room.
struct MaterialUse {
  bool used = false;
  bool by_number = false;  // its reflectance will be set as a number
};

// Adds the properties of used materials that are not modelled. `uses`: one for each material of the file.
void note_ignored_materials(const Document& document, const std::vector<MaterialUse>& uses,
                            std::vector<Ignored>& ignored);

}  // namespace lichtmc
