// Patches of neighbouring triangles that face nearly the same way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc {

// One triangle of a room.
struct RoomFace {
  std::size_t surface = 0;
  std::uint32_t triangle = 0;
};

// Every triangle belongs to one patch: triangles of one surface, connected by edges, with normals within 25° of that of
// the largest. The angle is less than the 30° of a chamfer in two steps, so that the top and the underside of a slab
// with rounded edges are different patches; a curved wall has some patches, not one for every triangle.
//
// Each patch has two sides, numbered 2·patch and 2·patch + 1: the front and the back of its largest triangle. The
// others may be wound the other way.
class FacePatches {
 public:
  explicit FacePatches(const Room& room);

  std::size_t size() const { return areas_.size(); }
  double area_m2(std::size_t patch) const { return areas_[patch]; }
  std::size_t surface(std::size_t patch) const { return surfaces_[patch]; }

  // The side of a patch that the front (back) of a triangle belongs to.
  std::uint32_t side_of(std::size_t surface, std::size_t triangle, bool back) const {
    return sides_[surface][triangle] ^ (back ? 1U : 0U);
  }

  // The triangles of each patch.
  std::vector<std::vector<RoomFace>> triangles() const;

 private:
  void cut(const Surface& surface, std::size_t number);

  std::vector<std::vector<std::uint32_t>> sides_;  // of the fronts, by surface and triangle
  std::vector<double> areas_;                      // by patch
  std::vector<std::size_t> surfaces_;
};

}  // namespace lichtmc
