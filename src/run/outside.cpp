#include "run/outside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

#include "room/bounds.hpp"
#include "room/close_triangles.hpp"
#include "room/cuboid_shape.hpp"
#include "room/emitter_shape.hpp"
#include "room/enclosure.hpp"
#include "room/triangle_shapes.hpp"
#include "tracer/touch.hpp"

namespace lichtmc {

namespace {

// The closed shells that contain a point.
using Shells = std::vector<std::size_t>;

double largest_of(const glm::dvec3& size) {
  return std::max({size.x, size.y, size.z});
}

// The closed shells of a room, or the cuboid that it is.
class Walls {
 public:
  // enclosure: of the room, or null.
  Walls(const Room& room, const Enclosure* enclosure) : enclosure_(enclosure) {
    if (enclosure_ == nullptr) enclosure_ = &own_.emplace(room);
    if (!enclosure_->has_closed_shell()) cuboid_ = recognise_cuboid(room);
  }

  bool exist() const { return enclosure_->has_closed_shell() || cuboid_; }

  std::vector<Shells> around_each(const std::vector<glm::dvec3>& points) const {
    if (!cuboid_) return enclosure_->shells_around_each(points);
    std::vector<Shells> around(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const bool inside = std::all_of(cuboid_->edges.begin(), cuboid_->edges.end(), [&](const glm::dvec3& edge) {
        const double along = glm::dot(points[k] - cuboid_->corner, edge) / glm::dot(edge, edge);
        return along >= 0.0 && along <= 1.0;
      });
      if (inside) around[k] = {0};
    }
    return around;
  }

  // Whether they are those of a closed room, which extends over `bounds`.
  bool are_closed_room(const Bounds& bounds) const {
    if (cuboid_) return true;
    const glm::dvec3 size = bounds.high - bounds.low;
    constexpr double slack = 1e-6;  // of the room's size, as WeldedMesh
    if (!enclosure_->has_shell_over(bounds, slack * largest_of(size))) return false;
    constexpr int n = 8;
    std::vector<glm::dvec3> lattice;
    for (int i = 0; i < n * n * n; ++i)
      lattice.push_back(bounds.low + (glm::dvec3(i % n, i / n % n, i / n / n) + 0.5) / double{n} * size);
    const std::vector<Shells> around = around_each(lattice);
    const auto empty = std::count_if(around.begin(), around.end(), [](const Shells& shells) { return shells.empty(); });
    return 2 * empty < n * n * n;
  }

 private:
  std::optional<Enclosure> own_;
  const Enclosure* enclosure_;
  std::optional<CuboidShape> cuboid_;
};

// Points where light of an emitter starts.
struct LightStarts {
  std::vector<glm::dvec3> points;
  std::vector<std::size_t> emitters;  // of each point, indices into Room::emitters
};

LightStarts light_starts(const Room& room) {
  LightStarts starts;
  for (std::size_t k = 0; k < room.emitters.size(); ++k) {
    const auto add = [&](const glm::dvec3& point) {
      starts.points.push_back(point);
      starts.emitters.push_back(k);
    };
    if (room.emitters[k].power == 0.0) continue;
    visit_shape(
        room.emitters[k], [&](const auto& point) { add(point.position); },
        [&](const auto& area_light) {
          constexpr double share = 1e-4;  // of the triangle's size, in front of it
          for (const TriangleSample& triangle : sample_triangles(room.surfaces[area_light.surface]))
            add(triangle.middle + share * triangle.size_m * triangle.normal);
        });
  }
  return starts;
}

// The triangles on which points lie, within the rounding of float coordinates.
std::vector<std::vector<CloseTriangle>> touched(const Room& room, const std::vector<glm::dvec3>& points,
                                                double extent) {
  auto close = close_triangles(room, points, NearPlane::most_rounding * extent);
  for (std::size_t k = 0; k < points.size(); ++k) {
    std::erase_if(close[k], [&](const CloseTriangle& triangle) {
      return std::abs(triangle.distance_m) > NearPlane{points[k], triangle.corner, triangle.normal, extent}.rounding();
    });
  }
  return close;
}

// Whether in a quarter of all directions nothing is hit from a point: of 32 that are distributed over the sphere
// (Fibonacci's spiral).
bool sees_far(const Room& room, const glm::dvec3& point) {
  constexpr int n = 32;
  std::array<bool, n> hit{};
  for (const Surface& surface : room.surfaces) {
    for (const glm::uvec3& t : surface.triangles) {
      const glm::dvec3 a = surface.positions[t.x];
      const glm::dvec3 b = surface.positions[t.y] - a;
      const glm::dvec3 c = surface.positions[t.z] - a;
      for (int i = 0; i < n; ++i) {
        if (hit[static_cast<std::size_t>(i)]) continue;
        const double height = 1.0 - (2.0 * i + 1.0) / n;
        const double radius = std::sqrt(1.0 - height * height);
        const double azimuth = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
        const glm::dvec3 direction(radius * std::cos(azimuth), height, radius * std::sin(azimuth));
        const glm::dvec3 across = glm::cross(direction, c);
        const double determinant = glm::dot(b, across);
        if (determinant == 0.0) continue;
        const glm::dvec3 from = point - a;
        const double s = glm::dot(from, across) / determinant;
        const glm::dvec3 up = glm::cross(from, b);
        const double u = glm::dot(direction, up) / determinant;
        if (s >= 0.0 && u >= 0.0 && s + u <= 1.0 && glm::dot(c, up) / determinant > 0.0)
          hit[static_cast<std::size_t>(i)] = true;
      }
    }
  }
  return 4 * std::count(hit.begin(), hit.end(), false) >= n;
}

}  // namespace

std::vector<Separation> separation_of_receivers(const Room& room, const Enclosure* enclosure) {
  std::vector<Separation> found(room.receivers.size(), Separation::none);
  if (room.receivers.empty()) return found;
  const Walls walls(room, enclosure);
  if (!walls.exist()) return found;
  const Bounds bounds = bounds_of(room);
  const double extent = largest_of(bounds.high - bounds.low);
  // An emitter on a surface may emit to both sides.
  std::vector<glm::dvec3> starts = light_starts(room).points;
  const auto below_emitters = touched(room, starts, extent);
  constexpr double aside = 1e-5;  // of the room's size
  for (std::size_t k = 0; k < below_emitters.size(); ++k) {
    for (const CloseTriangle& triangle : below_emitters[k]) {
      const glm::dvec3 at = starts[k];
      for (const double side : {aside, -aside}) starts.push_back(at + side * extent * triangle.normal);
    }
  }
  std::vector<Shells> lit = walls.around_each(starts);
  std::sort(lit.begin(), lit.end());
  std::vector<glm::dvec3> points;
  for (const Receiver& receiver : room.receivers) points.push_back(receiver.position);
  const auto below = touched(room, points, extent);
  const std::vector<Shells> around = walls.around_each(points);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!below[k].empty() || std::binary_search(lit.begin(), lit.end(), around[k])) continue;
    found[k] = around[k].empty() ? Separation::outside : Separation::inside;
  }
  return found;
}

std::vector<bool> emitters_beyond_walls(const Room& room, const Enclosure* enclosure) {
  std::vector<bool> beyond(room.emitters.size(), false);
  const LightStarts starts = light_starts(room);
  if (starts.points.empty()) return beyond;
  const Walls walls(room, enclosure);
  if (!walls.exist()) return beyond;
  const std::vector<Shells> around = walls.around_each(starts.points);
  // Emitters of which no start lies in a shell, and a start of each.
  std::vector<std::optional<std::size_t>> candidate(room.emitters.size());
  std::vector<bool> enclosed(room.emitters.size(), false);
  for (std::size_t n = 0; n < starts.points.size(); ++n) {
    candidate[starts.emitters[n]] = n;
    if (!around[n].empty()) enclosed[starts.emitters[n]] = true;
  }
  std::vector<glm::dvec3> points;
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < candidate.size(); ++k) {
    if (!candidate[k] || enclosed[k]) continue;
    points.push_back(starts.points[*candidate[k]]);
    numbers.push_back(k);
  }
  std::size_t triangles = 0;
  for (const Surface& surface : room.surfaces) triangles += surface.triangles.size();
  constexpr std::size_t most = 2'000'000;  // pairs of point and triangle, at some 0.5 µs
  if (points.empty() || points.size() * triangles > most) return beyond;
  const Bounds bounds = bounds_of(room);
  if (!walls.are_closed_room(bounds)) return beyond;
  const auto below = touched(room, points, largest_of(bounds.high - bounds.low));
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (below[n].empty()) beyond[numbers[n]] = sees_far(room, points[n]);
  }
  return beyond;
}

}  // namespace lichtmc
