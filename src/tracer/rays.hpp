// A wave's flights as arrays, one element per photon.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "base/lanes.hpp"
#include "tracer/facet.hpp"

namespace lichtmc {

struct Rays {
  // For at least `capacity` flights; the arrays have whole_lanes(capacity) elements.
  explicit Rays(std::size_t capacity) {
    const std::size_t whole = whole_lanes(capacity);
    for (auto* numbers : {&x, &y, &z, &dx, &dy, &dz, &s, &t, &length}) numbers->resize(whole);
    for (auto* numbers : {&facet, &behind}) numbers->resize(whole);
  }

  std::size_t size = 0;  // photons in flight; elements beyond are spare

  std::vector<float> x, y, z;     // where a flight starts, in the tracer's coordinates
  std::vector<float> dx, dy, dz;  // direction of flight, any length but 0

  // Before a flight: the facet that the photon leaves, or no_facet if it starts away from surfaces. After it: the facet
  // that it has hit, or no_facet.
  std::vector<std::uint32_t> facet;
  std::vector<float> s, t;            // where on the facet
  std::vector<std::uint32_t> behind;  // 1: on the back of the facet, 0: on its front
  std::vector<float> length;          // of the flight, in units of the length of its direction

  void set_start(std::size_t i, const glm::vec3& point) {
    x[i] = point.x;
    y[i] = point.y;
    z[i] = point.z;
  }
  void set_direction(std::size_t i, const glm::vec3& direction) {
    dx[i] = direction.x;
    dy[i] = direction.y;
    dz[i] = direction.z;
  }
  // Copies the hit of flight `from` to flight `to`.
  void move_landing(std::size_t from, std::size_t to) {
    facet[to] = facet[from];
    s[to] = s[from];
    t[to] = t[from];
    behind[to] = behind[from];
  }
  glm::vec3 start(std::size_t i) const { return {x[i], y[i], z[i]}; }
  glm::vec3 direction(std::size_t i) const { return {dx[i], dy[i], dz[i]}; }
};

// Straight segments between two points, to be tested for a surface between them.
struct ShadowRays {
  // For `capacity` segments, and more if they are added; the arrays have whole_lanes(size) elements at least.
  explicit ShadowRays(std::size_t capacity = 0) { reserve(capacity); }

  void clear() { size = 0; }
  void add(const glm::vec3& start, const glm::vec3& segment) {
    if (size == x.size()) reserve(2 * size + 1);
    x[size] = start.x;
    y[size] = start.y;
    z[size] = start.z;
    dx[size] = segment.x;
    dy[size] = segment.y;
    dz[size] = segment.z;
    ++size;
  }

  std::size_t size = 0;
  std::vector<float> x, y, z;         // start, in the tracer's coordinates
  std::vector<float> dx, dy, dz;      // from start to end
  std::vector<std::uint8_t> blocked;  // 1: a surface lies between

 private:
  void reserve(std::size_t capacity) {
    const std::size_t whole = whole_lanes(capacity);
    for (auto* numbers : {&x, &y, &z, &dx, &dy, &dz}) numbers->resize(whole);
    blocked.resize(whole);
  }
};

// Points that shadow rays of one start lead to; the arrays have whole_lanes() elements.
struct EndPoints {
  void resize(std::size_t n) {
    size = n;
    for (auto* numbers : {&x, &y, &z}) numbers->resize(whole_lanes(n), 0.0F);
  }
  void set(std::size_t k, const glm::vec3& point) {
    x[k] = point.x;
    y[k] = point.y;
    z[k] = point.z;
  }

  std::size_t size = 0;
  std::vector<float> x, y, z;  // in the tracer's coordinates
};

}  // namespace lichtmc
