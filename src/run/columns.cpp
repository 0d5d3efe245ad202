#include "run/columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/geometric.hpp>

#include "room/bounds.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t at_once = 4096;

// Gaps between heights in ascending order.
std::vector<Gap> gaps_between(const std::vector<double>& heights, double rounding, double above) {
  std::vector<Gap> gaps;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const bool last = k + 1 == heights.size();
    const double high = last ? above : heights[k + 1];
    if (high - heights[k] > rounding) gaps.push_back({heights[k], high, last});
  }
  return gaps;
}

}  // namespace

ColumnTracer::ColumnTracer(const Room& room, const Tracer& tracer) : room_(room), tracer_(tracer) {
  const Bounds bounds = bounds_of(room);
  low_ = bounds.low;
  high_ = bounds.high;
  // Embree cannot separate surfaces closer than a millionth of the room's size.
  const glm::dvec3 size = high_ - low_;
  rounding_ = 1e-6 * std::max({size.x, size.y, size.z});
  triangle_of_.resize(tracer.facets().size());
  for (std::uint32_t k = 0; k < room.surfaces.size(); ++k) {
    for (std::uint32_t n = 0; n < room.surfaces[k].triangles.size(); ++n)
      triangle_of_[tracer.locate(k, n).facet] = {k, n};
  }
}

std::vector<Column> ColumnTracer::columns(const std::vector<glm::dvec2>& places) {
  std::vector<Column> columns(places.size());
  std::vector<std::vector<double>> heights(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) columns[k].at = places[k];
  for (std::size_t first = 0; first < places.size(); first += at_once)
    trace_down(columns, first, std::min(at_once, places.size() - first), heights);
  const double above = high_.y + std::max(1.0, 0.5 * (high_.y - low_.y));
  for (std::size_t k = 0; k < places.size(); ++k) {
    std::sort(heights[k].begin(), heights[k].end());
    columns[k].gaps = gaps_between(heights[k], rounding_, above);
  }
  return columns;
}

// Rays downwards that go on behind each surface that they meet.
void ColumnTracer::trace_down(std::vector<Column>& columns, std::size_t first, std::size_t n,
                              std::vector<std::vector<double>>& heights) {
  const glm::vec3 down(tracer_.directions() * glm::dvec3(0.0, -1.0, 0.0));
  const double top = high_.y + 0.1 * (high_.y - low_.y) + 1000.0 * rounding_;
  Rays rays(n);
  std::vector<std::size_t> column_of(n);
  std::iota(column_of.begin(), column_of.end(), first);
  rays.size = n;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2& at = columns[first + i].at;
    rays.facet[i] = no_facet;
    rays.set_start(i, glm::vec3(tracer_.tracer_point({at.x, top, at.y})));
    rays.set_direction(i, down);
  }
  constexpr int most_layers = 4096;
  for (int layer = 0; layer < most_layers && rays.size > 0; ++layer) {
    tracer_.trace(rays, Misses::escape, count_);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rays.size; ++i) {
      if (rays.facet[i] == no_facet) continue;
      const std::size_t column = column_of[i];
      heights[column].push_back(height_on(rays.facet[i], columns[column].at));
      rays.move_landing(i, kept);
      rays.set_start(kept, rays.start(i));
      rays.behind[kept] ^= 1U;  // goes on behind the surface
      column_of[kept++] = column;
    }
    rays.size = kept;
    for (std::size_t i = 0; i < kept; ++i) rays.set_direction(i, down);
    tracer_.depart(rays);
  }
}

double ColumnTracer::height_on(std::uint32_t facet, const glm::dvec2& at) const {
  const RoomTriangle& triangle = triangle_of_[facet];
  const Surface& surface = room_.surfaces[triangle.surface];
  const glm::uvec3 corner = surface.triangles[triangle.number];
  const glm::dvec3 a = surface.positions[corner.x];
  const glm::dvec3 b = surface.positions[corner.y];
  const glm::dvec3 c = surface.positions[corner.z];
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double low = std::min({a.y, b.y, c.y});
  const double high = std::max({a.y, b.y, c.y});
  if (normal.y == 0.0 || low == high) return low;
  return std::clamp(a.y - (normal.x * (at.x - a.x) + normal.z * (at.y - a.z)) / normal.y, low, high);
}

bool ColumnTracer::sees(const glm::dvec2& from, const glm::dvec2& to, double height) {
  return sees(glm::dvec3(from.x, height, from.y), glm::dvec3(to.x, height, to.y));
}

bool ColumnTracer::sees(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 start = tracer_.tracer_point(from);
  return !tracer_.is_blocked(glm::vec3(start), glm::vec3(tracer_.tracer_point(to) - start), count_);
}

std::uint32_t ColumnTracer::facet_from(const glm::dvec3& from, const glm::dvec3& direction, double& distance) {
  Rays rays(1);
  rays.size = 1;
  rays.facet[0] = no_facet;
  rays.set_start(0, glm::vec3(tracer_.tracer_point(from)));
  rays.set_direction(0, glm::vec3(tracer_.directions() * direction));
  tracer_.trace(rays, Misses::escape, count_);
  distance = rays.facet[0] == no_facet
                 ? std::numeric_limits<double>::infinity()
                 : glm::length(tracer_.world_vector(double{rays.length[0]} * glm::dvec3(rays.direction(0))));
  return rays.facet[0];
}

double ColumnTracer::distance(const glm::dvec3& from, const glm::dvec3& direction) {
  double distance = 0.0;
  facet_from(from, direction, distance);
  return distance;
}

bool ColumnTracer::meets_front(const glm::dvec3& from, const glm::dvec3& direction) {
  double distance = 0.0;
  const std::uint32_t facet = facet_from(from, direction, distance);
  if (facet == no_facet) return false;
  const Surface& surface = room_.surfaces[triangle_of_[facet].surface];
  const glm::uvec3 corner = surface.triangles[triangle_of_[facet].number];
  const glm::dvec3 a = surface.positions[corner.x];
  return glm::dot(glm::cross(surface.positions[corner.y] - a, surface.positions[corner.z] - a), direction) < 0.0;
}

}  // namespace lichtmc
