// Results of calculation areas as JSON.
#pragma once

#include "lichtmc/result.hpp"
#include "output/json.hpp"

namespace lichtmc {

// The areas of summary.json: figures by the names of areas.csv, grid, what is left out, and the names of the files.
Json areas_of(const Result& result);

}  // namespace lichtmc
