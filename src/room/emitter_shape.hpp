// Emitters are points or surfaces: one visit for both kinds, for every use of an emitter's shape.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "base/frame.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

template <class Shape>
concept PointShape = requires(const Shape& shape) {
  shape.position;
};

template <class Shape>
concept SurfaceShape = requires(const Shape& shape) {
  shape.surface;
};

// The frame of a point emitter: its normal is the axis. Without an axis: +Z. Where the azimuth matters, the tangent is
// its reference, and the frame may be left-handed.
template <PointShape Shape>
Frame frame_of(const Shape& shape) {
  if constexpr (requires { shape.c90; }) {
    return {shape.c0, shape.c90, shape.axis};
  } else if constexpr (requires { shape.axis; }) {
    // Scaled by its largest component first: the square of a very long or short axis would overflow or underflow.
    const glm::dvec3& a = shape.axis;
    return frame_about(glm::normalize(a / std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)})));
  } else {
    return frame_about(glm::dvec3(0.0, 0.0, 1.0));
  }
}

// The opening all over which the light of a point emitter starts; null: it starts at its position.
template <PointShape Shape>
const LuminousOpening* opening_of(const Shape& shape) {
  if constexpr (requires { shape.opening; }) {
    return shape.opening ? &*shape.opening : nullptr;
  } else {
    return nullptr;
  }
}

// Points of the world between which all of its light starts: its position, or the corners of the box around its
// opening.
template <PointShape Shape>
std::vector<glm::dvec3> outermost_points(const Shape& shape) {
  const LuminousOpening* opening = opening_of(shape);
  if (opening == nullptr) return {shape.position};
  const Frame frame = frame_of(shape);
  std::vector<glm::dvec3> corners;
  for (int k = 0; k < 8; ++k) {
    const auto half = [k](double size, int bit) { return (k >> bit & 1) != 0 ? 0.5 * size : -0.5 * size; };
    const glm::dvec3& size = opening->size_m;
    corners.push_back(shape.position + half(size.x, 0) * frame.tangent + half(size.y, 1) * frame.bitangent +
                      half(size.z, 2) * frame.normal);
  }
  return corners;
}

// Calls on_point(shape) for an emitter that is a point (it has a position, a law, and a frame_of()), on_surface(shape)
// for one that is a surface. A shape that is neither does not compile.
template <class OnPoint, class OnSurface>
decltype(auto) visit_shape(const Emitter& emitter, const OnPoint& on_point, const OnSurface& on_surface) {
  return std::visit(
      [&](const auto& shape) -> decltype(auto) {
        using Shape = std::decay_t<decltype(shape)>;
        static_assert(PointShape<Shape> != SurfaceShape<Shape>, "an emitter is a point or a surface");
        if constexpr (PointShape<Shape>) {
          return on_point(shape);
        } else {
          return on_surface(shape);
        }
      },
      emitter.shape);
}

// The surface of an area light, as index into Room::surfaces; none for a point emitter.
inline std::optional<std::size_t> emitting_surface(const Emitter& emitter) {
  return visit_shape(
      emitter, [](const auto& /*point*/) -> std::optional<std::size_t> { return std::nullopt; },
      [](const auto& surface) -> std::optional<std::size_t> { return surface.surface; });
}

inline bool has_emission_map(const Emitter& emitter) {
  return visit_shape(
      emitter, [](const auto& /*point*/) { return false; },
      [](const auto& surface) { return surface.emission_map.has_value(); });
}

}  // namespace lichtmc
