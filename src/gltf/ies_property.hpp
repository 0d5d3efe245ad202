// The custom property 'ies' of nodes and lights: a luminaire with a photometric file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "gltf/document.hpp"

namespace lichtmc {

// What the property says; it is a text, the name of the file, or an object.
struct IesProperty {
  std::optional<std::string> file;  // name relative to the folder of the glTF file, "/" between folders; not encoded
  std::optional<double> lumens;     // at most one of these three
  std::optional<double> scale;
  std::optional<double> watts;
  std::optional<double> rotation_deg;
  std::optional<std::size_t> lamp_set;  // counted from 1
  std::optional<bool> area;             // "opening": whether it is "area"
  std::optional<bool> flip_horizontal;

  bool scaled() const { return lumens || scale || watts; }
};

// extras.ies; none if not present. Throws InputError naming the part and its value.
std::optional<IesProperty> ies_in(const Document& document, const tinygltf::Value& extras, const std::string& where);

// What both say together: that of the node precedes that of its light, which several nodes may share.
std::optional<IesProperty> together(const std::optional<IesProperty>& of_node,
                                    const std::optional<IesProperty>& of_light);

}  // namespace lichtmc
