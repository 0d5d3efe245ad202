#include "room/patches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "room/mesh_links.hpp"

namespace lichtmc {

namespace {

// Cosine of the largest angle between the normals of a triangle and of its patch: 50°. Projection shortens the lengths
// of a patch to no less than 0.64; the walls of a box never share a patch; and bevels and octagons, whose angle is 45°
// within rounding, are well below the limit.
constexpr double least_cosine = 0.6427876096865394;

// A world axis lies in a plane if its component along the normal is no more than the rounding of float normals.
constexpr double in_plane = 1e-6;

struct Plane {
  glm::dvec3 origin{0.0};
  glm::dvec3 normal{0.0};
  glm::dvec3 u{0.0};
  glm::dvec3 v{0.0};

  glm::dvec2 operator()(const glm::dvec3& point) const {
    return {glm::dot(point - origin, u), glm::dot(point - origin, v)};
  }
};

// u along the first of x, y, z that lies in the plane, otherwise along the one nearest to it; v with a positive
// component along its nearest world axis: a wall along the axes gets the same axes as from make_cuboid().
Plane plane_through(const glm::dvec3& origin, const glm::dvec3& normal) {
  const glm::dvec3 slope = glm::abs(normal);
  int first = 0;
  for (int n = 2; n > 0; --n) {
    if (slope[n] < slope[first]) first = n;
  }
  for (int n = 2; n >= 0; --n) {
    if (slope[n] <= in_plane) first = n;
  }
  Plane plane{origin, normal, glm::dvec3(0.0), glm::dvec3(0.0)};
  plane.u[first] = 1.0;
  plane.u = glm::normalize(plane.u - normal * normal[first]);
  plane.v = glm::cross(normal, plane.u);
  int steepest = 0;
  for (int n = 1; n < 3; ++n) {
    if (std::abs(plane.v[n]) > std::abs(plane.v[steepest])) steepest = n;
  }
  if (plane.v[steepest] < 0.0) plane.v = -plane.v;
  return plane;
}

class PatchCutter {
 public:
  PatchCutter(const Surface& surface, const std::vector<TriangleShape>& shapes, double noise_m)
      : surface_(surface), shapes_(shapes), noise_m_(noise_m), links_(surface), tested_by_(shapes.size(), no_seed) {}

  // The patch that grows from `seed`; its triangles then count as taken.
  Patch grow(std::uint32_t seed);

  bool taken(std::uint32_t triangle) const { return tested_by_[triangle] == taken_mark; }
  bool thin(std::uint32_t triangle) const { return !(shapes_[triangle].thickness_m > noise_m_); }

 private:
  static constexpr std::uint32_t no_seed = 0xFFFFFFFF;
  static constexpr std::uint32_t taken_mark = 0xFFFFFFFE;

  bool joins(std::uint32_t triangle, const Plane& plane, OverlapIndex& index, Patch& patch);

  const Surface& surface_;
  const std::vector<TriangleShape>& shapes_;
  double noise_m_;
  MeshLinks links_;
  std::vector<std::uint32_t> tested_by_;  // seed of the patch that last tested a triangle
};

bool PatchCutter::joins(std::uint32_t triangle, const Plane& plane, OverlapIndex& index, Patch& patch) {
  if (!thin(triangle) && glm::dot(shapes_[triangle].normal, plane.normal) < least_cosine) return false;
  const glm::uvec3 corner = surface_.triangles[triangle];
  const FlatTriangle flat{plane(surface_.positions[corner.x]), plane(surface_.positions[corner.y]),
                          plane(surface_.positions[corner.z])};
  if (index.add(flat, triangle)) return false;
  patch.triangles.push_back(triangle);
  patch.flat.push_back(flat);
  tested_by_[triangle] = taken_mark;
  return true;
}

// Breadth first, so that a patch stays compact where overlap ends it (a spiral stair: turn by turn).
Patch PatchCutter::grow(std::uint32_t seed) {
  Patch patch;
  const Plane plane = plane_through(surface_.positions[surface_.triangles[seed].x], shapes_[seed].normal);
  OverlapIndex index(noise_m_);
  joins(seed, plane, index, patch);
  for (std::size_t n = 0; n < patch.triangles.size(); ++n) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      for (const std::uint32_t neighbour : links_.at_edge(patch.triangles[n], edge)) {
        if (taken(neighbour) || tested_by_[neighbour] == seed) continue;
        tested_by_[neighbour] = seed;
        joins(neighbour, plane, index, patch);
      }
    }
  }
  return patch;
}

}  // namespace

Patches cut_into_patches(const Surface& surface, const std::vector<TriangleShape>& shapes, double noise_m) {
  std::vector<std::uint32_t> by_area(shapes.size());
  std::iota(by_area.begin(), by_area.end(), 0U);
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return shapes[a].area_m2 > shapes[b].area_m2; });
  PatchCutter cutter(surface, shapes, noise_m);
  Patches result;
  for (const std::uint32_t seed : by_area) {
    if (!cutter.taken(seed) && !cutter.thin(seed)) result.patches.push_back(cutter.grow(seed));
  }
  for (std::uint32_t k = 0; k < shapes.size(); ++k) {
    if (!cutter.taken(k)) result.slivers.push_back(k);
  }
  return result;
}

}  // namespace lichtmc
