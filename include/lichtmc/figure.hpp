// A figure with its standard error.
#pragma once

#include <limits>

namespace lichtmc {

struct Figure {
  double value = std::numeric_limits<double>::quiet_NaN();           // NaN: it does not exist
  double standard_error = std::numeric_limits<double>::quiet_NaN();  // NaN: unknown; 0: exact
};

}  // namespace lichtmc
