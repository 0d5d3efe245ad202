// Luminaires for tests, made without a file.
#pragma once

#include <memory>
#include <vector>

#include "lichtmc/photometry.hpp"

namespace lichtmc::test {

// A luminaire of type C without any symmetry: its intensity (cd) differs in all directions of the table.
std::shared_ptr<Photometry> skew_luminaire();

}  // namespace lichtmc::test
