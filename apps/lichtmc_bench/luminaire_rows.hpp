// Rows of the table: measured luminaires against spots.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "row.hpp"

namespace lichtmc::bench {

std::vector<Measured> luminaire_rows(const Options& options);

// A luminaire of 73 × 73 angles without symmetry, 5 328 cells: an office luminaire that also emits upwards.
Emitter office_luminaire(const glm::dvec3& position, double power);

}  // namespace lichtmc::bench
