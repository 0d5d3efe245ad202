// Vertical lines through a room: at which heights they meet surfaces, and the gaps between these heights.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

// Part of a vertical line without a surface, in m. The highest gap of a line ends above the room.
struct Gap {
  double low = 0.0;
  double high = 0.0;
  bool open_above = false;  // nothing lies above it

  double height() const { return high - low; }
};

// A vertical line at (x, z) and its gaps, in ascending order; below the lowest surface there is none. Surfaces closer
// to each other than rounding count as one.
struct Column {
  glm::dvec2 at{0.0};
  std::vector<Gap> gaps;
};

class ColumnTracer {
 public:
  // `tracer`: Embree's, of this room. Both must outlive it.
  ColumnTracer(const Room& room, const Tracer& tracer);

  std::vector<Column> columns(const std::vector<glm::dvec2>& places);

  // Whether a horizontal segment between two lines is free at a height (m) that is free on both.
  bool sees(const glm::dvec2& from, const glm::dvec2& to, double height);
  // The same for any two free points.
  bool sees(const glm::dvec3& from, const glm::dvec3& to);
  // Where a ray from a free point meets a surface: the distance in m, infinite if it meets none.
  double distance(const glm::dvec3& from, const glm::dvec3& direction);
  // Whether a ray from a free point meets the front of a surface.
  bool meets_front(const glm::dvec3& from, const glm::dvec3& direction);
  // Whether a point lies on a surface, within the rounding of float coordinates.
  bool on_surface(const glm::dvec3& point) const { return tracer_.start(point, glm::dvec3(0.0)).on_surface; }

  const glm::dvec3& low() const { return low_; }  // bounding box, m
  const glm::dvec3& high() const { return high_; }
  double rounding() const { return rounding_; }  // m

 private:
  struct RoomTriangle {
    std::uint32_t surface = 0;
    std::uint32_t number = 0;
  };

  void trace_down(std::vector<Column>& columns, std::size_t first, std::size_t n,
                  std::vector<std::vector<double>>& heights);
  std::uint32_t facet_from(const glm::dvec3& from, const glm::dvec3& direction, double& distance);
  double height_on(std::uint32_t facet, const glm::dvec2& at) const;

  const Room& room_;
  const Tracer& tracer_;
  glm::dvec3 low_{0.0};
  glm::dvec3 high_{0.0};
  double rounding_ = 0.0;
  std::vector<RoomTriangle> triangle_of_;  // of each facet
  TraceCount count_;
};

}  // namespace lichtmc
