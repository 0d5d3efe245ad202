// Faces in one plane: which of several triangles in one place counts, on each side.
//
// Rugs, posters, panels and doors are often modelled exactly in the plane of the surface that they lie on, and thin
// walls as two faces in one place. Geometry alone does not tell which of them light meets; rounding would decide. The
// rule (docs/physics.md):
//
//  1. Of the faces at a point, those that face the side from which light arrives count: one-sided ones with their
//     front, two-sided ones always. If none does, all count, as for a single face that is hit on its back.
//  2. Of these, the one with the smallest patch lies on top (patch_areas.hpp). It alone receives, reflects and emits on
//     this side; the others are covered.
//  3. Of equal patches, those count that turn their front to this side. If there are several, no rule decides: the
//  first
//     in the order of the room counts, and a warning says so.
//
// It is found once, before any walk. Rooms without such faces pay nothing afterwards.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/cover.hpp"
#include "lichtmc/room.hpp"
#include "room/box_tree.hpp"
#include "room/convex_cut.hpp"

namespace lichtmc {

class RoomFaces;

// A position on a side of a triangle. Triangles are numbered through the room, surface by surface.
struct FacePlace {
  std::uint32_t triangle = 0;
  double s = 0.0;  // barycentric coordinates of its second and third corner
  double t = 0.0;
  bool behind = false;  // on its back
};

class FacesInOnePlane {
 public:
  // Finds all pairs of triangles that lie in one plane and overlap, in O(n log n) for n triangles, on up to
  // `threads` (≥ 1) threads; the result is the same for any number of them.
  explicit FacesInOnePlane(const Room& room, unsigned threads = 1);
  FacesInOnePlane(const FacesInOnePlane&) = delete;
  FacesInOnePlane& operator=(const FacesInOnePlane&) = delete;
  ~FacesInOnePlane();

  // Whether there are none.
  bool empty() const { return faces_.empty(); }

  // The number of a surface's triangle.
  std::size_t number_of(std::size_t surface, std::size_t triangle) const {
    return first_of_surface_[surface] + triangle;
  }

  // Whether a triangle has others in its place.
  bool has_others(std::size_t triangle) const { return number_[triangle] != none; }
  // Whether some part of this side of a triangle may be covered.
  bool may_be_covered(std::size_t triangle, bool behind) const;
  // The largest distance of a triangle from the others in its place, in m: rounding.
  double gap_m(std::size_t triangle) const { return faces_[number_[triangle]].gap_m; }
  double largest_gap_m() const { return largest_gap_m_; }
  // The others in the place of a triangle.
  std::span<const std::uint32_t> others(std::size_t triangle) const { return faces_[number_[triangle]].others; }

  // The face that counts where light arrives at `place`, on the same side. undecided: set if another one has an equal
  // right. For triangles with others only.
  FacePlace counting(const FacePlace& place, bool& undecided) const;

  // Whether the face at `place` counts there.
  bool counts(const FacePlace& place) const;

  // The parts of a polygon, in barycentric coordinates of a triangle, on which this side of the triangle counts. Parts
  // thinner than the tolerance of positions are left out.
  std::vector<ConvexPolygon> uncovered(std::size_t triangle, bool behind, const ConvexPolygon& polygon) const;

  // Which surface covers which, sorted by `under`, `over` and side.
  const std::vector<Cover>& covers() const { return covers_; }
  // The covered area of a side of a surface. On the back of a one-sided surface: 0.
  double covered_m2(std::size_t surface, bool behind) const;
  // A surface reduced to the parts of its front that are uncovered, if some part of it is covered; else none.
  std::optional<Surface> uncovered_front(const Room& room, std::size_t surface) const;
  // One-sided surfaces that look in opposite directions in one place, each counting on its own side: pairs in any
  // order.
  const std::vector<Cover>& opposites() const { return opposites_; }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  // Another face of the same place that counts instead, where it is.
  struct Rival {
    std::uint32_t triangle = 0;
    bool tied = false;    // by the order of the room only
    bool facing = false;  // it faces this side
  };
  // A side of a face.
  struct OneSide {
    std::vector<Rival> rivals;        // the best first
    std::vector<std::uint32_t> ties;  // faces that have an equal right, better or worse
    std::unique_ptr<BoxTree> tree;    // of the rivals, if there are many
  };
  struct Face {
    std::uint32_t triangle = 0;
    bool both_sides = false;
    glm::dvec3 normal{0.0};
    glm::dvec3 corner{0.0};
    std::array<glm::dvec3, 2> edges{};  // to the second and third corner
    std::array<glm::dvec3, 2> duals{};  // s and t of a point are the products of these and the point − corner
    double area_m2 = 0.0;
    double gap_m = 0.0;
    std::vector<std::uint32_t> others;
    std::array<OneSide, 2> sides;  // front, back
  };

  const Face& face_of(std::size_t triangle) const { return faces_[number_[triangle]]; }
  void find(const RoomFaces& all, const BoxTree& tree, unsigned threads);
  void rank(const RoomFaces& all, const BoxTree& tree);
  void measure(const RoomFaces& all);
  const Rival* best_at(const OneSide& side, const glm::dvec3& point) const;
  FlatTriangle in_coordinates_of(const Face& face, std::size_t triangle) const;

  // Calls outside(polygon) for the parts of a polygon that no rival covers, and inside(rival, polygon) for the others.
  template <class Inside, class Outside>
  void divide(const Face& face, const OneSide& side, const ConvexPolygon& polygon, const std::vector<std::uint32_t>& by,
              int depth, const Inside& inside, const Outside& outside) const;
  template <class Inside, class Outside>
  bool halve(const Face& face, const OneSide& side, const ConvexPolygon& polygon, const std::vector<std::uint32_t>& by,
             int depth, const Inside& inside, const Outside& outside) const;
  bool negligible(const Face& face, const ConvexPolygon& polygon) const;

  std::vector<std::size_t> first_of_surface_;
  std::vector<std::uint32_t> number_;  // of each triangle of the room: index into faces_, or none
  std::vector<Face> faces_;            // those with others in their place
  std::vector<Cover> covers_;
  std::vector<Cover> opposites_;
  std::vector<std::array<double, 2>> covered_m2_;  // of each surface: front, back
  double in_plane_tolerance_ = 0.0;                // m
  double largest_gap_m_ = 0.0;
};

}  // namespace lichtmc
