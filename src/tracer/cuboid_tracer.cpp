// Flights through an empty cuboid in closed form: λ = (d − n·a)/(n·v) for the three walls that a flight approaches; the
// smallest λ counts.
//
// Source: H. Schulze, Lichtausbreitung in Räumen, 2021, eq. 15-17. In the tracer's coordinates the cuboid is the unit
// cube. A photon on a wall lies exactly on it and flies away from it: it cannot hit the wall that it leaves, and no
// photon can escape. No tolerance is needed.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/lanes.hpp"
#include "chance/directions.hpp"
#include "room/cuboid_shape.hpp"
#include "room/emitter_shape.hpp"
#include "room/reflectance.hpp"
#include "tracer/cuboid_facets.hpp"
#include "tracer/touch.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

namespace {

using Three = std::array<const float*, 3>;

// End points of flights through the unit cube. `behind`: bit k is 1 if face k is hit on its back. One function, so that
// the loop vectorises as a whole.
LICHTMC_LANES void trace_lanes(std::size_t n, const Three& start, const Three& direction, std::uint32_t behind,
                               std::uint32_t* LICHTMC_APART facet, float* LICHTMC_APART s, float* LICHTMC_APART t,
                               std::uint32_t* LICHTMC_APART back, float* LICHTMC_APART length) {
  const float* LICHTMC_APART x = start[0];
  const float* LICHTMC_APART y = start[1];
  const float* LICHTMC_APART z = start[2];
  const float* LICHTMC_APART dx = direction[0];
  const float* LICHTMC_APART dy = direction[1];
  const float* LICHTMC_APART dz = direction[2];
  // λ of the wall that the flight approaches along one axis; infinite if the flight is parallel to it.
  const auto distance = [](float from, float along) {
    const float wall = along > 0.0F ? 1.0F : 0.0F;
    const float lambda = (wall - from) / along;
    return along == 0.0F ? std::numeric_limits<float>::infinity() : lambda;
  };
  const auto inside = [](float coordinate) {
    const float low = coordinate < 0.0F ? 0.0F : coordinate;
    return low > 1.0F ? 1.0F : low;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const float to_x = distance(x[i], dx[i]);
    const float to_y = distance(y[i], dy[i]);
    const float to_z = distance(z[i], dz[i]);
    const bool y_first = to_y < to_x;
    const float nearer = y_first ? to_y : to_x;
    const bool z_first = to_z < nearer;
    const float lambda = z_first ? to_z : nearer;
    const std::uint32_t axis = z_first ? 2U : (y_first ? 1U : 0U);
    const float along = z_first ? dz[i] : (y_first ? dy[i] : dx[i]);
    const std::uint32_t face = 2 * axis + (along > 0.0F ? 1U : 0U);
    const float end_x = inside(x[i] + lambda * dx[i]);
    const float end_y = inside(y[i] + lambda * dy[i]);
    const float end_z = inside(z[i] + lambda * dz[i]);
    // Only a photon of an emitter on a wall can start towards that wall; it leaves the room at once.
    const bool leaves = (facet[i] == no_facet) & (lambda <= 0.0F);
    facet[i] = leaves ? no_facet : face;
    s[i] = z_first ? end_x : (y_first ? end_z : end_y);
    t[i] = z_first ? end_y : (y_first ? end_x : end_z);
    back[i] = (behind >> face) & 1U;
    length[i] = lambda;
  }
}

// A point on a face, from the coordinates s and t of the face.
struct OnFace {
  float x, y, z;

  OnFace(std::uint32_t face, float along_s, float along_t) {
    const bool on_x = face < 2;
    const bool on_z = face >= 4;
    const float on = (face & 1U) != 0 ? 1.0F : 0.0F;
    x = on_x ? on : (on_z ? along_s : along_t);
    y = on_x ? along_s : (on_z ? along_t : on);
    z = on_x ? along_t : (on_z ? on : along_s);
  }
};

LICHTMC_LANES void depart_lanes(std::size_t n, const std::uint32_t* LICHTMC_APART facet, const float* LICHTMC_APART s,
                                const float* LICHTMC_APART t, float* LICHTMC_APART x, float* LICHTMC_APART y,
                                float* LICHTMC_APART z) {
  for (std::size_t i = 0; i < n; ++i) {
    const bool stays = facet[i] == no_facet;
    const OnFace point(facet[i], s[i], t[i]);
    const float old_x = x[i];
    const float old_y = y[i];
    const float old_z = z[i];
    x[i] = stays ? old_x : point.x;
    y[i] = stays ? old_y : point.y;
    z[i] = stays ? old_z : point.z;
  }
}

// Points on the faces, and directions into the cube by Lambert's law.
LICHTMC_LANES void scatter_lanes(std::size_t n, const std::uint32_t* LICHTMC_APART facet, const float* LICHTMC_APART s,
                                 const float* LICHTMC_APART t, const std::uint32_t* LICHTMC_APART polar,
                                 const std::uint32_t* LICHTMC_APART azimuth, const std::array<float, 3>& unit,
                                 float* LICHTMC_APART x, float* LICHTMC_APART y, float* LICHTMC_APART z,
                                 float* LICHTMC_APART dx, float* LICHTMC_APART dy, float* LICHTMC_APART dz) {
  const float unit_x = unit[0];
  const float unit_y = unit[1];
  const float unit_z = unit[2];
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t face = facet[i];
    const OnFace point(face, s[i], t[i]);
    x[i] = point.x;
    y[i] = point.y;
    z[i] = point.z;
    const glm::vec3 local = sample_lambert(polar[i], azimuth[i]);
    const bool on_x = face < 2;
    const bool on_z = face >= 4;
    const float inwards = (face & 1U) != 0 ? -local.z : local.z;
    dx[i] = unit_x * (on_x ? inwards : (on_z ? local.x : local.y));
    dy[i] = unit_y * (on_x ? local.x : (on_z ? local.y : inwards));
    dz[i] = unit_z * (on_x ? local.y : (on_z ? inwards : local.x));
  }
}

class CuboidTracer final : public Tracer {
 public:
  CuboidTracer(const CuboidShape& shape, std::vector<std::vector<TriangleOnFacet>> triangles, std::vector<Facet> facets)
      : corner_(shape.corner), triangles_(std::move(triangles)) {
    facets_ = std::move(facets);
    glm::dmat3 to_unit{0.0};
    double longest = 0.0;
    for (const glm::dvec3& edge : shape.edges) longest = std::max(longest, glm::length(edge));
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& edge = shape.edges[static_cast<std::size_t>(k)];
      const double length = glm::length(edge);
      for (int c = 0; c < 3; ++c) to_unit[c][k] = edge[c] / length / length;
    }
    points_ = to_unit;
    set_place(shape.corner, glm::dmat3(shape.edges[0], shape.edges[1], shape.edges[2]));
    // A direction may have any length: scaled to the longest edge, its components stay near 1.
    directions_ = longest * to_unit;
    for (std::size_t face = 0; face < 6; ++face) face_frame(face);
    for (std::size_t axis = 0; axis < 3; ++axis)
      unit_[axis] = std::abs(facets_[2 * axis].normal[static_cast<int>(axis)]);
  }

  void trace(Rays& rays, Misses /*misses*/, TraceCount& count) const override {
    trace_lanes(whole_lanes(rays.size), {rays.x.data(), rays.y.data(), rays.z.data()},
                {rays.dx.data(), rays.dy.data(), rays.dz.data()}, behind_, rays.facet.data(), rays.s.data(),
                rays.t.data(), rays.behind.data(), rays.length.data());
    count.rays += rays.size;
  }

  void depart(Rays& rays) const override {
    depart_lanes(whole_lanes(rays.size), rays.facet.data(), rays.s.data(), rays.t.data(), rays.x.data(), rays.y.data(),
                 rays.z.data());
  }

  void scatter(Rays& rays, const std::uint32_t* polar, const std::uint32_t* azimuth, float* cosines) const override {
    scatter_lanes(whole_lanes(rays.size), rays.facet.data(), rays.s.data(), rays.t.data(), polar, azimuth, unit_,
                  rays.x.data(), rays.y.data(), rays.z.data(), rays.dx.data(), rays.dy.data(), rays.dz.data());
    for (std::size_t i = 0; cosines != nullptr && i < rays.size; ++i) cosines[i] = sample_lambert(polar[i], 0).z;
  }

  Start start(const glm::dvec3& world_point_m, const glm::dvec3& axis) const override {
    Start result;
    const glm::dvec3 unit = points_ * (world_point_m - corner_);
    for (int k = 0; k < 3; ++k) {
      const bool upper = unit[k] >= 0.5;
      const double wall = upper ? 1.0 : 0.0;
      if (std::abs(unit[k] - wall) > wall_rounding) {
        result.point[k] = static_cast<float>(unit[k]);
        continue;
      }
      // Within rounding of a wall the point lies on it, or at the next float in front of it.
      const glm::dvec3 edge = world_vector({k == 0, k == 1, k == 2});
      const bool inside = upper ? unit[k] < wall : unit[k] > wall;
      const double length = glm::length(edge);
      const bool before = inside && stays_before({world_point_m, corner_ + wall * edge, edge / length, length}, axis);
      const double next = upper ? 1.0 - 0x1p-24 : 0x1p-24;
      result.point[k] = static_cast<float>(before ? next : wall);
      result.on_surface = result.on_surface || !before;
    }
    return result;
  }

  // Whether a point lies in the cuboid, its walls included.
  bool holds(const glm::dvec3& world_point_m) const {
    const glm::vec3 unit = start(world_point_m, glm::dvec3(0.0)).point;
    return unit.x >= 0.0F && unit.x <= 1.0F && unit.y >= 0.0F && unit.y <= 1.0F && unit.z >= 0.0F && unit.z <= 1.0F;
  }

  // Whether a surface's front, from which it emits, is the outside of any face of the cuboid.
  bool emits_outwards(std::size_t surface) const {
    for (std::size_t face = 0; face < 6; ++face) {
      if (facets_[face].surface == surface && (behind_ >> face & 1U) != 0) return true;
    }
    return false;
  }

  // A segment that begins inside is free. One that begins outside is blocked if it enters the cuboid before its end, by
  // more than the rounding of its points.
  bool is_blocked(const glm::vec3& start, const glm::vec3& segment, TraceCount& count) const override {
    ++count.rays;
    ++count.shadow_rays;
    double enters = 0.0;  // along the segment, from 0 to 1
    double leaves = 1.0;
    for (int k = 0; k < 3; ++k) {
      const double from = start[k];
      const double along = segment[k];
      if (along == 0.0) {
        if (from <= 0.0 || from >= 1.0) return false;
        continue;
      }
      enters = std::max(enters, ((along > 0.0 ? 0.0 : 1.0) - from) / along);
      leaves = std::min(leaves, ((along > 0.0 ? 1.0 : 0.0) - from) / along);
    }
    const double size = glm::length(glm::dvec3(start)) + glm::length(glm::dvec3(segment)) + 1.0;
    const double rounding = 4.0 * 0x1p-24 * size / glm::length(glm::dvec3(segment));
    return enters > 0.0 && leaves - enters > rounding;
  }
  void find_blocked(ShadowRays& rays, TraceCount& count) const override {
    for (std::size_t i = 0; i < rays.size; ++i) {
      const bool blocked = is_blocked({rays.x[i], rays.y[i], rays.z[i]}, {rays.dx[i], rays.dy[i], rays.dz[i]}, count);
      rays.blocked[i] = blocked ? 1 : 0;
    }
  }
  bool casts_shadows() const override { return false; }

  // Flights start on walls exactly.
  float step() const override { return 0.0F; }

  // In front of a wall they start some floats off it.
  double clearance_m(const glm::dvec3& normal) const override {
    double extent = 0.0;
    for (int k = 0; k < 3; ++k)
      extent = std::max(extent, std::abs(glm::dot(world_vector({k == 0, k == 1, k == 2}), normal)));
    return 2.0 * wall_rounding * extent;
  }

  TriangleOnFacet locate(std::size_t surface, std::size_t triangle) const override {
    return triangles_[surface][triangle];
  }

 private:
  // The spacing of floats at 1.
  static constexpr double wall_rounding = 0x1p-23;

  // Frame for scattering: the world's unit vectors along the edges, in the tracer's coordinates, where they have other
  // lengths.
  void face_frame(std::size_t face) {
    const std::size_t axis = axis_of(face);
    const auto along = [&](std::size_t k) {
      glm::vec3 v(0.0F);
      const auto column = static_cast<glm::length_t>(k);
      v[column] = static_cast<float>(
          glm::length(glm::dvec3(directions_[0][column], directions_[1][column], directions_[2][column])));
      return v;
    };
    Facet& facet = facets_[face];
    const bool normal_inwards = glm::dot(facet.normal, glm::vec3(1.0F)) > 0.0F;  // along the axis, see facet_of_face()
    facet.tangent = along(s_axis(axis));
    facet.bitangent = along(t_axis(axis));
    facet.normal = normal_inwards ? along(axis) : -along(axis);
    const bool towards_middle = normal_inwards == (face % 2 == 0);
    if (!towards_middle) behind_ |= 1U << face;
  }

  glm::dvec3 corner_;
  glm::dmat3 points_{1.0};
  std::uint32_t behind_ = 0;     // bit k is 1 if the inside of the room is the back of face k
  std::array<float, 3> unit_{};  // lengths of the world's unit vectors along the axes, in the tracer's coordinates
  std::vector<std::vector<TriangleOnFacet>> triangles_;
};

// Whether an emitter is outside the cuboid or emits out of it: its light would hit the other side of the walls.
bool emits_outside(const Emitter& emitter, const CuboidTracer& tracer) {
  return visit_shape(
      emitter,
      [&](const auto& point) {
        const std::vector<glm::dvec3> starts = outermost_points(point);
        return !std::all_of(starts.begin(), starts.end(), [&](const glm::dvec3& place) { return tracer.holds(place); });
      },
      [&](const auto& area_light) { return tracer.emits_outwards(area_light.surface); });
}

}  // namespace

std::unique_ptr<Tracer> make_cuboid_tracer(const Room& room, const Tiling& tiling, std::string& why_not) {
  const std::optional<CuboidShape> shape = recognise_cuboid(room);
  if (!shape) {
    why_not = "is not an empty cuboid";
    return nullptr;
  }
  if (std::any_of(room.surfaces.begin(), room.surfaces.end(),
                  [](const Surface& surface) { return has_varying_reflectance(surface); })) {
    why_not = "has a reflectance that varies over a surface";
    return nullptr;
  }
  if (std::any_of(room.emitters.begin(), room.emitters.end(), has_emission_map)) {
    why_not = "has an emission map";
    return nullptr;
  }
  std::optional<CuboidFacets> facets = facets_of_cuboid(room, tiling, *shape);
  if (!facets) {
    why_not = "has a wall that consists of several surfaces, or whose UVs are not one affine transformation";
    return nullptr;
  }
  auto tracer = std::make_unique<CuboidTracer>(*shape, std::move(facets->triangles), std::move(facets->facets));
  if (std::any_of(room.emitters.begin(), room.emitters.end(),
                  [&tracer](const Emitter& emitter) { return emits_outside(emitter, *tracer); })) {
    why_not = "has an emitter outside, or one that emits outwards";
    return nullptr;
  }
  return tracer;
}

}  // namespace lichtmc
