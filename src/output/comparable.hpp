// The figures of a result that a comparison needs, whether they come from a Result in memory or from its files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/result.hpp"

namespace lichtmc {

struct ComparableTile {
  std::string surface;  // name of the tile map
  std::uint32_t column = 0;
  std::uint32_t row = 0;
  glm::dvec3 point{0.0};        // m
  double irradiance = 0.0;      // W/m² or lx
  double standard_error = 0.0;  // NaN: unknown
};

struct ComparableReceiver {
  std::string name;
  glm::dvec3 position{0.0};  // m
  glm::dvec3 normal{0.0};
  double irradiance = 0.0;      // W/m² or lx
  double standard_error = 0.0;  // NaN: unknown
};

struct ComparableResult {
  std::string name;           // for messages: of the folder, or of the result
  std::string unit;           // of power: "W" or "lm"
  double tile_freedom = 0.0;  // degrees of freedom of the standard errors of the tiles
  double receiver_freedom = 0.0;
  std::vector<ComparableTile> tiles;
  std::vector<ComparableReceiver> receivers;
};

ComparableResult comparable(const Result& result, const std::string& name);

// Degrees of freedom of standard errors, which are computed from batches of photons (forward) or from rounds of walks
// (backward).
double freedom_of_tiles(WalkDirection direction, std::uint64_t histories, std::size_t tiles);
// Those of receivers are enlarged if they are from few rounds: their deviations are normal, unless they are from very
// few.
double freedom_of_receivers(std::uint64_t rounds);

}  // namespace lichtmc
