#include "lichtmc/photometry.hpp"

namespace lichtmc {

std::optional<double> Photometry::efficacy() const {
  if (!(watts > 0.0)) return std::nullopt;
  return flux() / watts;
}

}  // namespace lichtmc
