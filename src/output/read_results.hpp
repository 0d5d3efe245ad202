// Reads the files of write_results().
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace lichtmc {

struct StoredTile {
  std::string surface;
  std::uint32_t column = 0;
  std::uint32_t row = 0;
  glm::dvec3 point{0.0};
  double irradiance = 0.0;
  double standard_error = 0.0;
};

struct StoredReceiver {
  std::string name;
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};
  double irradiance = 0.0;
  double standard_error = 0.0;
};

struct StoredResult {
  std::string folder;
  std::string unit;           // of power: "W" or "lm"
  double tile_freedom = 0.0;  // degrees of freedom of the standard errors of the tiles
  double receiver_freedom = 0.0;
  std::vector<StoredTile> tiles;
  std::vector<StoredReceiver> receivers;
};

// Throws InputError if the folder contains no result, or if a file is damaged.
StoredResult read_results(const std::filesystem::path& folder);

}  // namespace lichtmc
