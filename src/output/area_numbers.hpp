// The values of an area as numbers on its plan.
#pragma once

#include <string>

#include "lichtmc/area_drawing.hpp"
#include "lichtmc/units.hpp"

namespace lichtmc {

// The highest has three digits at least, and numbers from 100 on are integers.
class AreaNumbers {
 public:
  AreaNumbers(const AreaDrawing& drawing, Quantity quantity);

  std::string text(double value) const;
  // "lx"; with a factor where the values are very small or large: "0.001 W/m²".
  const std::string& unit() const { return unit_; }

 private:
  double factor_ = 1.0;
  int decimals_ = 0;
  std::string unit_;
};

}  // namespace lichtmc
