// The triangles of a room as plane faces: when two of them lie in one plane, and when they overlap there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "room/bounds.hpp"
#include "room/overlap.hpp"

namespace lichtmc {

// A triangle of the room. Triangles are numbered through the room, surface by surface.
struct PlaneFace {
  glm::dvec3 normal{0.0};    // towards the front, length 1
  double thickness_m = 0.0;  // the smallest of its heights; 0: too thin to have a plane
  double area_m2 = 0.0;
  std::uint32_t surface = 0;
  std::uint32_t triangle = 0;  // index into Surface::triangles
  std::uint32_t along = 3;     // the axis that its normal is parallel to; 3: none
};

class RoomFaces {
 public:
  using Corners = std::array<glm::dvec3, 3>;  // m

  // The room must outlive the faces.
  // On up to `threads` (≥ 1) threads.
  explicit RoomFaces(const Room& room, unsigned threads = 1);

  std::size_t size() const { return faces_.size(); }
  const PlaneFace& operator[](std::size_t n) const { return faces_[n]; }
  std::size_t first_of(std::size_t surface) const { return first_[surface]; }
  const Room& room() const { return *room_; }
  Corners corners(std::size_t n) const;
  bool has_plane(std::size_t n) const { return faces_[n].thickness_m > 0.0; }
  bool both_sides(std::size_t n) const { return room_->surfaces[faces_[n].surface].sides == Sides::both; }

  // Two lengths below which positions mean nothing, in m: the distance up to which corners in a plane count as one
  // place, a millionth of the room's size as everywhere in lichtmc; and the distance up to which two faces count as
  // being in one plane, see plane_tolerance().
  double in_plane_tolerance() const { return in_plane_; }

  // The box of a face, enlarged by the tolerances.
  Bounds box(std::size_t n) const;

  // Whether two faces lie in one plane, either way round; `gap`: receives their largest distance, in m.
  bool in_one_plane(std::size_t a, std::size_t b, double& gap) const;
  // Whether it is certain that two faces do not overlap if they lie in one plane: a line along a side of one of them
  // lies between them. Most neighbours in a mesh are told apart in this way, at a small part of the cost of overlap().
  bool beside(std::size_t a, std::size_t b) const;
  // Whether two faces of one plane overlap by more than the tolerance.
  bool overlap(std::size_t a, std::size_t b) const;

 private:
  void add(std::uint32_t surface);
  double plane_tolerance(const PlaneFace& a, const PlaneFace& b, const glm::dvec3& point) const;

  const Room* room_;
  std::vector<PlaneFace> faces_;
  std::vector<std::size_t> first_;  // of each surface
  glm::dvec3 centre_{0.0};          // of the room
  double extent_ = 0.0;             // of the room, m: the largest edge of its box
  double in_plane_ = 0.0;
};

}  // namespace lichtmc
