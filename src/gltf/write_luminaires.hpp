// Luminaires with photometric files in a glTF file that is written: EXT_lights_ies.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "gltf/builder.hpp"
#include "lichtmc/photometry.hpp"

namespace lichtmc {

class LuminaireWriter {
 public:
  explicit LuminaireWriter(GltfBuilder& document) : document_(&document) {}

  // Adds rotation, extension and properties to the node of a luminaire. The file is embedded, once for all luminaires
  // that share it. The caller adds position, power and unit. opening: all over which its light starts, if it does.
  void add(const Photometry& file, const LuminaireAxes& axes, const std::optional<LuminousOpening>& opening,
           double power, Quantity quantity, GltfBuilder::Json& node);

 private:
  std::size_t light_of(const Photometry& file, const std::optional<LuminousOpening>& opening);

  GltfBuilder* document_;
  std::map<std::string, std::size_t> lights_;  // by the text of the file
  std::map<const Photometry*, std::size_t> known_;
};

}  // namespace lichtmc
