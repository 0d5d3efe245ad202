#include "gltf/areas.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "base/message.hpp"
#include "gltf/deform.hpp"
#include "gltf/geometry.hpp"
#include "gltf/materials.hpp"

namespace lichtmc {

namespace {

[[noreturn]] void refuse_property(const Document& document, const PlacedNode& placed, const char* name,
                                  const std::string& value, const char* allowed) {
  refuse(document, "'" + std::string(name) + "' of the calculation area " + placed.label + " is " + value +
                       " (allowed: " + allowed + "). Set that custom property.");
}

// A number in a range; none without the property.
template <class Valid>
std::optional<double> number_of(const Document& document, const PlacedNode& placed, const char* name,
                                const char* allowed, const Valid& valid) {
  const tinygltf::Value& extras = document.model.nodes[placed.index].extras;
  if (!extras.Has(name)) return std::nullopt;
  const double value = number_in(document, extras, name, 0.0, placed.label);
  if (!std::isfinite(value) || !valid(value)) refuse_property(document, placed, name, to_text(value), allowed);
  return value;
}

std::string text_of(const Document& document, const PlacedNode& placed, const char* name) {
  const tinygltf::Value& value = document.model.nodes[placed.index].extras.Get(name);
  if (!value.IsString()) refuse_property(document, placed, name, "not a text", "a text");
  return value.Get<std::string>();
}

AreaQuantity read_quantity(const Document& document, const PlacedNode& placed) {
  const std::string text = text_of(document, placed, "quantity");
  for (const AreaQuantity quantity :
       {AreaQuantity::normal, AreaQuantity::horizontal, AreaQuantity::cylindrical, AreaQuantity::semicylindrical}) {
    if (to_string(quantity) == text) return quantity;
  }
  refuse_property(document, placed, "quantity", in_quotes(text), "normal, horizontal, cylindrical, semicylindrical");
}

glm::dvec3 read_direction(const Document& document, const PlacedNode& placed, const glm::dmat4& to_world) {
  const tinygltf::Value& value = document.model.nodes[placed.index].extras.Get("direction");
  glm::dvec3 direction(0.0);
  bool valid = value.IsArray() && value.ArrayLen() == 3;
  for (glm::length_t k = 0; valid && k < 3; ++k) {
    // Value::Get() with a number takes other types of it in other versions.
    const tinygltf::Value& part = value.Get<tinygltf::Value::Array>()[static_cast<std::size_t>(k)];
    valid = part.IsNumber() && std::isfinite(part.GetNumberAsDouble());
    if (valid) direction[k] = part.GetNumberAsDouble();
  }
  if (!valid)
    refuse_property(document, placed, "direction", "not three numbers",
                    "three numbers, in the axes of the file (Y up)");
  return glm::dmat3(to_world) * direction;
}

// Blender exports truth values as such, or as 0 and 1.
bool read_flag(const Document& document, const PlacedNode& placed, const char* name) {
  const tinygltf::Value& value = document.model.nodes[placed.index].extras.Get(name);
  if (value.IsBool()) return value.Get<bool>();
  const double number = value.IsNumber() ? value.GetNumberAsDouble() : -1.0;
  if (number != 0.0 && number != 1.0) refuse_property(document, placed, name, "not a truth value", "true or false");
  return number == 1.0;
}

AreaProperties read_area_properties(const Document& document, const PlacedNode& placed, const glm::dmat4& to_world) {
  const tinygltf::Node& node = document.model.nodes[placed.index];
  if (node.mesh < 0)
    refuse(document, placed.label +
                         " has the custom property 'calculation_area' but no mesh (allowed: a node with a mesh, whose "
                         "faces are the area). Set it on the object that is drawn, a plane for example.");
  const tinygltf::Value& extras = node.extras;
  const auto number = [&](const char* name, const char* allowed, const auto& valid) {
    return number_of(document, placed, name, allowed, valid);
  };
  AreaProperties properties;
  properties.role = text_of(document, placed, "calculation_area");
  properties.spacing_m = number("spacing", "a number of metres above 0", [](double v) { return v > 0.0; });
  properties.margin_m = number("margin", "a number of metres, 0 or more", [](double v) { return v >= 0.0; });
  properties.target_lx = number("target_lx", "a number above 0", [](double v) { return v > 0.0; });
  properties.target_uniformity = number("target_uniformity", "0 to 1", [](double v) { return v >= 0.0 && v <= 1.0; });
  if (extras.Has("quantity")) properties.quantity = read_quantity(document, placed);
  if (extras.Has("direction")) properties.direction = read_direction(document, placed, to_world);
  if (extras.Has("cells")) properties.cells = read_flag(document, placed, "cells");
  return properties;
}

// A mesh of so many faces is no area that anyone draws; instances could multiply any mesh.
constexpr std::size_t most_triangles = 10'000'000;

void add_primitive(const Document& document, const PlacedNode& placed, const tinygltf::Mesh& mesh, std::size_t k,
                   std::vector<Ignored>& ignored, AreaRequest& request) {
  const auto& node = document.model.nodes[placed.index];
  const std::string where = label("mesh", mesh.name, static_cast<std::size_t>(node.mesh)) + " (" + placed.label + ")";
  const auto stored =
      read_primitive(document, mesh.primitives[k], Material{}, std::nullopt, morph_weights(node, mesh), where, ignored);
  if (!stored) return;
  for (const glm::dmat4& world : mesh_transforms(document, placed)) {
    const Surface faces = place_primitive(*stored, world);
    for (const glm::uvec3& t : faces.triangles)
      request.triangles.push_back({faces.positions[t.x], faces.positions[t.y], faces.positions[t.z]});
    if (request.triangles.size() > most_triangles)
      refuse(document, "the calculation area " + placed.label + " has more than " + std::to_string(most_triangles) +
                           " triangles (the limit), including instances. Draw it with fewer faces.");
  }
}

}  // namespace

bool is_calculation_area(const tinygltf::Node& node) {
  return node.extras.IsObject() && node.extras.Has("calculation_area");
}

AreaRequest read_area(const Document& document, const PlacedNode& placed, const glm::dmat4& to_world,
                      std::vector<Ignored>& ignored) {
  AreaRequest request;
  request.properties = read_area_properties(document, placed, to_world);
  const auto& model = document.model;
  const std::size_t index =
      checked_index(document, model.nodes[placed.index].mesh, model.meshes.size(), "the mesh of " + placed.label);
  for (std::size_t k = 0; k < model.meshes[index].primitives.size(); ++k)
    add_primitive(document, placed, model.meshes[index], k, ignored, request);
  if (request.triangles.empty())
    refuse(document, "the calculation area " + placed.label +
                         " has no face with an area (allowed: at least one). Draw its faces.");
  return request;
}

}  // namespace lichtmc
