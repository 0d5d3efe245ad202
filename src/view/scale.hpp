// The colour scale of any set of values.
#pragma once

#include <utility>
#include <vector>

#include "lichtmc/picture.hpp"

namespace lichtmc {

// The scale as by choose_scale(), for values (W/m² or lx, above 0) with their areas.
ColourScale scale_of(std::vector<std::pair<double, double>> lit, Quantity quantity, const ScaleOptions& options = {});

}  // namespace lichtmc
