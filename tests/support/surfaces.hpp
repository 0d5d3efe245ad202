// Surfaces for tests of charts and tiles.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc::test {

// Adds a triangle with separate corners, without UVs.
inline void add_triangle(Surface& surface, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto first = static_cast<std::uint32_t>(surface.positions.size());
  surface.positions.insert(surface.positions.end(), {a, b, c});
  surface.triangles.emplace_back(first, first + 1, first + 2);
}

// Adds the parallelogram corner, corner + s, corner + s + t, corner + t as two triangles.
inline void add_quad(Surface& surface, const glm::dvec3& corner, const glm::dvec3& s, const glm::dvec3& t) {
  add_triangle(surface, corner, corner + s, corner + s + t);
  add_triangle(surface, corner, corner + s + t, corner + t);
}

// A floor [0, x] × [0, z] at height 0, divided into n × n quads; UVs from 0 to `uv_size` along x and z.
inline Surface make_floor(double x, double z, int n = 1, double uv_size = 1.0) {
  Surface surface;
  surface.name = "floor";
  const glm::dvec3 s(x / n, 0.0, 0.0);
  const glm::dvec3 t(0.0, 0.0, z / n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) add_quad(surface, s * static_cast<double>(i) + t * static_cast<double>(j), s, t);
  }
  for (const glm::dvec3& p : surface.positions) surface.uvs.emplace_back(p.x / x * uv_size, p.z / z * uv_size);
  return surface;
}

// The six sides of a box from the origin to `size`, without UVs.
inline Surface make_box(const glm::dvec3& size) {
  Surface surface;
  surface.name = "box";
  const glm::dvec3 x(size.x, 0.0, 0.0);
  const glm::dvec3 y(0.0, size.y, 0.0);
  const glm::dvec3 z(0.0, 0.0, size.z);
  const glm::dvec3 o(0.0);
  add_quad(surface, o, z, x);
  add_quad(surface, y, x, z);
  add_quad(surface, o, y, z);
  add_quad(surface, x, z, y);
  add_quad(surface, o, x, y);
  add_quad(surface, z, y, x);
  return surface;
}

// A sphere of radius 1 with n slices and n bands, without UVs; including triangles without area at the poles.
inline Surface make_sphere(int n) {
  Surface surface;
  surface.name = "sphere";
  const auto point = [n](int i, int j) {
    const double azimuth = 2.0 * std::numbers::pi * (i % n) / n;
    const double polar = std::numbers::pi * j / n;
    const double radius = j == 0 || j == n ? 0.0 : std::sin(polar);
    return glm::dvec3(radius * std::cos(azimuth), std::cos(polar), radius * std::sin(azimuth));
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      add_triangle(surface, point(i, j), point(i + 1, j + 1), point(i, j + 1));
      add_triangle(surface, point(i, j), point(i + 1, j), point(i + 1, j + 1));
    }
  }
  return surface;
}

// A spiral ramp with `turns` turns around an axis, without UVs: its turns lie above each other.
inline Surface make_ramp(int turns, int steps_per_turn) {
  Surface surface;
  surface.name = "ramp";
  const auto point = [steps_per_turn](int step, double radius) {
    const double turn = static_cast<double>(step) / steps_per_turn;
    const double angle = 2.0 * std::numbers::pi * turn;
    return glm::dvec3(radius * std::cos(angle), 0.5 * turn, radius * std::sin(angle));
  };
  for (int step = 0; step < turns * steps_per_turn; ++step) {
    add_triangle(surface, point(step, 1.0), point(step + 1, 2.0), point(step, 2.0));
    add_triangle(surface, point(step, 1.0), point(step + 1, 1.0), point(step + 1, 2.0));
  }
  return surface;
}

// Front normal of a surface's first triangle.
inline glm::dvec3 first_normal(const Surface& surface) {
  const glm::uvec3 t = surface.triangles.at(0);
  const glm::dvec3 a = surface.positions[t.x];
  return glm::normalize(glm::cross(surface.positions[t.y] - a, surface.positions[t.z] - a));
}

// Sum of the triangles' areas in m².
inline double area_of(const Surface& surface) {
  double area = 0.0;
  for (const glm::uvec3& corner : surface.triangles) {
    const glm::dvec3 a = surface.positions[corner.x];
    area += 0.5 * glm::length(glm::cross(surface.positions[corner.y] - a, surface.positions[corner.z] - a));
  }
  return area;
}

}  // namespace lichtmc::test
