// Measures tiles by photons from the emitters.
#pragma once

#include "run/context.hpp"
#include "run/error_measure.hpp"
#include "run/measured_tiles.hpp"

namespace lichtmc {

// Throws RuntimeError if the run is stopped before the first photon is simulated.
TileMeasurement measure_tiles_forward(const RunContext& context, const TileErrorMeasure& measure);

}  // namespace lichtmc
