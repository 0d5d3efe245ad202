// Bounds of a texture map's values over a rectangle of it, in constant time.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

struct ValueRange {
  float low = 0.0F;
  float high = 0.0F;
};

// The map must outlive this. It stores the lowest and the highest value of blocks of 2 × 2, 4 × 4, … pixels.
class ValueBounds {
 public:
  explicit ValueBounds(const TextureMap& map);

  // Bounds of all values interpolated at texture coordinates from `low` to `high` (both finite). Exact up to rounding
  // between the centres of four neighbouring pixels; wider than necessary in larger rectangles.
  ValueRange over(const glm::dvec2& low, const glm::dvec2& high) const;

 private:
  struct Level {
    std::uint32_t columns = 0;
    std::vector<ValueRange> blocks;
  };

  ValueRange of_pixels(const glm::dvec2& low, const glm::dvec2& high) const;
  ValueRange at(std::size_t level, std::uint32_t column, std::uint32_t row) const;

  const TextureMap* map_;
  std::vector<Level> levels_;  // of blocks of 2, 4, … pixels
};

}  // namespace lichtmc
