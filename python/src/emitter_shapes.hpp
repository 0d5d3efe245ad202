// Shapes of emitters as Python objects: those of the library, and two that differ from them.
#pragma once

#include <memory>
#include <string>

#include "lichtmc/photometry.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc::python {

// A photometric file.
struct PhotometryFile {
  std::shared_ptr<const Photometry> photometry;
};

// An area light by the name of its surface; the library has its number.
struct AreaLightShape {
  std::string surface;
  double exponent = 1.0;
};

// A luminaire with its power, which its file and its scaling give.
struct LuminaireShape {
  LuminaireEmitter mounted;
};

}  // namespace lichtmc::python
