#include "output/lit_side_words.hpp"

#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

namespace lichtmc {

namespace {

// A component of a direction counts from sin 22.5° on: every direction then has a name of one or, where it slants, two
// or three parts.
constexpr double least_component = 0.38;
// The sum of the normals over the lit area: a surface that deviates by 18° everywhere still has a direction.
constexpr double one_direction = 0.95;

std::string direction_words(const glm::dvec3& direction) {
  std::string text;
  const auto add = [&text](double component, const char* positive, const char* negative) {
    if (std::abs(component) < least_component) return;
    text += (text.empty() ? "" : " and ") + std::string(component > 0.0 ? positive : negative);
  };
  add(direction.y, "up", "down");
  add(direction.x, "+x", "−x");
  add(direction.z, "+z", "−z");
  return "facing " + text;
}

// Area vectors of the lit sides: their sum, the sum of their lengths, and how much of them is parallel to the largest.
class LitNormals {
 public:
  void add(const glm::dvec3& normal) {
    sum_ += normal;
    area_ += glm::length(normal);
    if (glm::length(normal) > glm::length(largest_)) largest_ = normal;
    all_.push_back(normal);
  }

  std::string words() const {
    if (!(area_ > 0.0)) return "none";
    if (glm::length(sum_) >= one_direction * area_) return direction_words(glm::normalize(sum_));
    const glm::dvec3 axis = glm::normalize(largest_);
    double parallel = 0.0;
    for (const glm::dvec3& normal : all_) parallel += std::abs(glm::dot(normal, axis));
    return parallel >= one_direction * area_ ? "both sides" : "several sides";
  }

 private:
  std::vector<glm::dvec3> all_;  // m²
  glm::dvec3 sum_{0.0};
  glm::dvec3 largest_{0.0};
  double area_ = 0.0;
};

}  // namespace

std::vector<std::string> lit_side_words(const Room& room, const Result& result, const LitSides& lit) {
  std::vector<std::string> words;
  for (const TileMap& map : result.tiling.maps) {
    const Surface& surface = room.surfaces[map.surface];
    LitNormals normals;
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
      const glm::uvec3& corners = surface.triangles[n];
      const glm::dvec3& first = surface.positions[corners.x];
      const glm::dvec3 front =
          0.5 * glm::cross(surface.positions[corners.y] - first, surface.positions[corners.z] - first);
      const SideLight& side = lit[map.surface][n];
      if (side.front && map.side != Side::back) normals.add(front);
      if (side.back && (surface.sides == Sides::one || map.side == Side::back)) normals.add(-front);
    }
    words.push_back(normals.words());
  }
  return words;
}

}  // namespace lichtmc
