#include "tracer/triangle_start.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "tracer/touch.hpp"

namespace lichtmc {

namespace {

// The largest distance from its plane at which a point can touch a facet.
double reach_of(const Departure& facet) {
  return std::max(double{facet.step}, NearPlane::most_rounding);
}

// Whether a point (tracer's coordinates) lies above or below a facet, at most `distance` from its plane.
bool touches(const Departure& facet, const glm::dvec3& point, double distance) {
  const glm::dvec3 normal(facet.normal);
  const glm::dvec3 from_corner = point - glm::dvec3(facet.corner);
  if (std::abs(glm::dot(from_corner, normal)) > distance) return false;
  const glm::dvec3 cross = glm::cross(glm::dvec3(facet.edge_s), glm::dvec3(facet.edge_t));
  const double area = glm::dot(cross, cross);
  if (!(area > 0.0)) return false;
  const double s = glm::dot(glm::cross(from_corner, glm::dvec3(facet.edge_t)), cross) / area;
  const double t = glm::dot(glm::cross(glm::dvec3(facet.edge_s), from_corner), cross) / area;
  const glm::dvec3 margin(facet.margin);
  return !(s < -margin.y || t < -margin.z || s + t > 1.0 + margin.x);
}

// Collects the facets that an emitter touches.
class Touching {
 public:
  Touching(const glm::dvec3& world_point_m, const glm::dvec3& axis, const Placement& placement)
      : emitter_(world_point_m), axis_(axis), scale_(placement.scale), point_(placement(world_point_m)) {
    start_.point = glm::vec3(point_);
  }

  // corner_m: of the facet, in the world.
  void test(const Departure& facet, const glm::dvec3& corner_m) {
    // Most facets are far away.
    if (!touches(facet, point_, reach_of(facet))) return;
    const glm::dvec3 normal(facet.normal);
    const NearPlane plane{emitter_, corner_m, normal, 1.0 / scale_};
    if (!touches(facet, point_, std::max(double{facet.step}, scale_ * plane.rounding()))) return;
    // Triangles of one plane count once.
    const bool known = std::any_of(planes_.begin(), planes_.end(), [&](const glm::vec3& other) {
      return std::abs(glm::dot(glm::dvec3(other), normal)) > 1.0 - 1e-6;
    });
    if (known) return;
    planes_.push_back(facet.normal);
    const glm::vec3 step = 2.0F * facet.step * facet.normal;
    if (stays_before(plane, axis_)) {
      start_.point += plane.distance() < 0.0 ? -step : step;
    } else {
      start_.steps.push_back(step);
      start_.on_surface = true;
    }
  }

  const Start& start() const { return start_; }

 private:
  glm::dvec3 emitter_;  // m
  glm::dvec3 axis_;
  double scale_;
  glm::dvec3 point_;  // of the emitter, in the tracer's coordinates
  std::vector<glm::vec3> planes_;
  Start start_;
};

// The box of all points that may touch a facet: those up to `reach` from the triangle that its margins enlarge (in
// touches(): s ≥ −margin.y, t ≥ −margin.z, s + t ≤ 1 + margin.x). The reach is doubled, which is far above the rounding
// of these sums.
void enclose(const Departure& facet, Bounds& box) {
  const glm::dvec3 margin(facet.margin);
  const std::array<glm::dvec2, 3> corners{glm::dvec2(-margin.y, -margin.z),
                                          glm::dvec2(1.0 + margin.x + margin.z, -margin.z),
                                          glm::dvec2(-margin.y, 1.0 + margin.x + margin.y)};
  for (const glm::dvec2& at : corners) {
    const glm::dvec3 corner =
        glm::dvec3(facet.corner) + at.x * glm::dvec3(facet.edge_s) + at.y * glm::dvec3(facet.edge_t);
    box.add(corner - 2.0 * reach_of(facet));
    box.add(corner + 2.0 * reach_of(facet));
  }
}

}  // namespace

FacetGroups::FacetGroups(const std::vector<Departure>& departures) : boxes_((departures.size() + size - 1) / size) {
  for (std::size_t n = 0; n < departures.size(); ++n) enclose(departures[n], boxes_[n / size]);
}

Start start_at(const glm::dvec3& world_point_m, const glm::dvec3& axis, const Room& room, const Placement& placement,
               const std::vector<Departure>& departures, const FacetGroups& groups) {
  Touching touching(world_point_m, axis, placement);
  const glm::dvec3 point = placement(world_point_m);
  std::size_t first = 0;  // facet of the surface's first triangle
  for (const Surface& surface : room.surfaces) {
    const std::size_t last = first + surface.triangles.size();
    for (std::size_t n = first; n < last;) {
      const std::size_t end = std::min(last, (n / FacetGroups::size + 1) * FacetGroups::size);
      if (groups.may_touch(n / FacetGroups::size, point)) {
        for (std::size_t k = n; k < end; ++k)
          touching.test(departures[k], surface.positions[surface.triangles[k - first].x]);
      }
      n = end;
    }
    first = last;
  }
  return touching.start();
}

}  // namespace lichtmc
