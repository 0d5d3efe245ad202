#include "room/room_faces.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "base/parallel.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

namespace {

// As WeldedMesh merges corners.
constexpr double of_room = 1e-6;

// A thinner face has no certain plane: with a height of 8 tolerances its normal is certain to 1/8 rad. That of a face
// parallel to two axes is exact; it must only be thicker than its outline is uncertain.
constexpr double least_thickness = 8.0;
constexpr double least_thickness_along_axis = 1.0;

// Cosine of the largest angle between the normals of two faces in one plane: twice 1/8 rad, and some more.
constexpr double nearly_parallel = 0.9;

// A component of a normal this close to 1: the other two are below 10⁻⁶, so the face is parallel to two axes.
constexpr double along_axis = 1.0 - 1e-12;

// Twice the step with which the tracer leaves a face that is parallel to two axes, as a share of its coordinate along
// the third one, counted from the centre of the room (step_roundings in tracer/departure.hpp): a photon of one of two
// such faces starts between them only if they are farther apart.
constexpr double steps_along_axis = 16.0 * 0x1p-24;

}  // namespace

RoomFaces::RoomFaces(const Room& room, unsigned threads) : room_(&room) {
  const Bounds bounds = bounds_of(room);
  const glm::dvec3 size = bounds.high - bounds.low;
  centre_ = 0.5 * (bounds.low + bounds.high);
  extent_ = std::max({size.x, size.y, size.z});
  in_plane_ = of_room * extent_;
  std::size_t count = 0;
  for (const Surface& surface : room.surfaces) {
    first_.push_back(count);
    count += surface.triangles.size();
  }
  faces_.resize(count);
  for_each_on_threads(threads, room.surfaces.size(), [&](std::size_t k) { add(static_cast<std::uint32_t>(k)); });
}

void RoomFaces::add(std::uint32_t surface) {
  const std::vector<TriangleShape> shapes = triangle_shapes(room_->surfaces[surface]);
  for (std::uint32_t n = 0; n < shapes.size(); ++n) {
    PlaneFace face{shapes[n].normal, shapes[n].thickness_m, shapes[n].area_m2, surface, n, 3};
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      if (std::abs(face.normal[static_cast<int>(axis)]) > along_axis) face.along = axis;
    }
    const double least = face.along == 3 ? least_thickness : least_thickness_along_axis;
    if (!(face.thickness_m > least * in_plane_)) face.thickness_m = 0.0;
    faces_[first_[surface] + n] = face;
  }
}

RoomFaces::Corners RoomFaces::corners(std::size_t n) const {
  const Surface& surface = room_->surfaces[faces_[n].surface];
  const glm::uvec3 corner = surface.triangles[faces_[n].triangle];
  return {surface.positions[corner.x], surface.positions[corner.y], surface.positions[corner.z]};
}

Bounds RoomFaces::box(std::size_t n) const {
  Bounds bounds;
  for (const glm::dvec3& corner : corners(n)) bounds.add(corner);
  // Half of the tolerance for each of two faces; those of planes along an axis are below the general one.
  bounds.low -= 0.5 * in_plane_;
  bounds.high += 0.5 * in_plane_;
  return bounds;
}

// In general the tracer cannot separate faces below a millionth of the room's size (docs/numerics.md), so all closer
// ones count as one plane. This includes the rounding of the positions in files: float_noise, a quarter of it, for each
// of the two. Of faces parallel to two axes only the coordinate along the third one is rounded: by float_noise of the
// coordinate itself in files (a translation far from the origin counts as exact, as in NearPlane), and by the tracer's
// step.
double RoomFaces::plane_tolerance(const PlaneFace& a, const PlaneFace& b, const glm::dvec3& point) const {
  if (a.along == 3 || a.along != b.along) return in_plane_;
  const int k = static_cast<int>(a.along);
  const double of_file = float_noise * std::min(extent_, std::abs(point[k]));
  return std::min(in_plane_, of_file + steps_along_axis * std::abs(point[k] - centre_[k]));
}

bool RoomFaces::in_one_plane(std::size_t a, std::size_t b, double& gap) const {
  if (std::abs(glm::dot(faces_[a].normal, faces_[b].normal)) < nearly_parallel) return false;
  // The plane of the thicker face is the more certain one.
  if (faces_[a].thickness_m < faces_[b].thickness_m) std::swap(a, b);
  const glm::dvec3 origin = corners(a)[0];
  const double tolerance = plane_tolerance(faces_[a], faces_[b], origin);
  gap = 0.0;
  for (const glm::dvec3& corner : corners(b))
    gap = std::max(gap, std::abs(glm::dot(corner - origin, faces_[a].normal)));
  return gap <= tolerance;
}

// The shift that separates them along the normal of that side is then at most half of the tolerance, and the rounding
// of overlap() is far smaller than the other half. overlap() works in the plane of the thicker face: the sides of the
// other lie in it only if both have the same normal. Corners are up to the tolerance away from the plane, which at this
// angle (4·10⁻⁵) adds less than 10⁻⁴ of it. A side is at least as long as the smallest height.
bool RoomFaces::beside(std::size_t a, std::size_t b) const {
  constexpr double same_normal = 1.0 - 1e-9;  // cosine
  if (faces_[a].thickness_m < faces_[b].thickness_m) std::swap(a, b);
  const auto beyond_a_side = [this](std::size_t n, const Corners& own, const Corners& other) {
    const double slack = -0.5 * in_plane_ * faces_[n].thickness_m;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 outwards = glm::cross(own[(k + 1) % 3] - own[k], faces_[n].normal);
      if (glm::dot(other[0] - own[k], outwards) >= slack && glm::dot(other[1] - own[k], outwards) >= slack &&
          glm::dot(other[2] - own[k], outwards) >= slack)
        return true;
    }
    return false;
  };
  const Corners of_a = corners(a);
  const Corners of_b = corners(b);
  if (beyond_a_side(a, of_a, of_b)) return true;
  return std::abs(glm::dot(faces_[a].normal, faces_[b].normal)) > same_normal && beyond_a_side(b, of_b, of_a);
}

bool RoomFaces::overlap(std::size_t a, std::size_t b) const {
  if (faces_[a].thickness_m < faces_[b].thickness_m) std::swap(a, b);
  const Frame frame = frame_about(faces_[a].normal);
  const glm::dvec3 origin = corners(a)[0];
  const auto flat = [&](std::size_t n) {
    FlatTriangle triangle;
    const Corners corner = corners(n);
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = {glm::dot(corner[k] - origin, frame.tangent), glm::dot(corner[k] - origin, frame.bitangent)};
    return triangle;
  };
  return penetration_depth(flat(a), flat(b)) > in_plane_;
}

}  // namespace lichtmc
