// Luminaires of nodes: EXT_lights_ies, and the custom property 'ies' of a node or its light.
#pragma once

#include <optional>
#include <vector>

#include "gltf/lights.hpp"
#include "gltf/photometric_files.hpp"

namespace lichtmc {

class Luminaires {
 public:
  explicit Luminaires(const Document& document) : document_(&document), files_(document) {}

  // The emitter of a node with a photometric file, without its name; none for a node without. The file gives the
  // intensity: that of a light of the node, with its cone and range, does not count. Throws InputError naming the node.
  std::optional<FileEmitter> read(const PlacedNode& placed, std::vector<Ignored>& ignored);

 private:
  const Document* document_;
  PhotometricFiles files_;
};

}  // namespace lichtmc
