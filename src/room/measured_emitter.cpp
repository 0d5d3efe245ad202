#include "lichtmc/photometry.hpp"

namespace lichtmc {

MeasuredLaw MeasuredEmitter::law() const {
  return {photometry != nullptr ? photometry->candela : nullptr};
}

std::optional<double> Photometry::efficacy() const {
  if (!(watts > 0.0) || intensity_unit != "cd") return std::nullopt;
  return flux() / watts;
}

}  // namespace lichtmc
