// A wave's flights as arrays, one element per photon.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "tracer/facet.hpp"

namespace lichtmc {

struct Rays {
  explicit Rays(std::size_t capacity)
      : x(capacity),
        y(capacity),
        z(capacity),
        dx(capacity),
        dy(capacity),
        dz(capacity),
        facet(capacity),
        s(capacity),
        t(capacity),
        behind(capacity) {}

  std::size_t size = 0;  // photons in flight; elements beyond are spare

  std::vector<float> x, y, z;     // where a flight starts, in the tracer's coordinates
  std::vector<float> dx, dy, dz;  // direction of flight, any length but 0

  // Before a flight: the facet the photon leaves, or no_facet where it starts in the open. After it: the facet it
  // landed on, or no_facet.
  std::vector<std::uint32_t> facet;
  std::vector<float> s, t;           // where on the facet
  std::vector<std::uint8_t> behind;  // 1: on the back of the facet, 0: on its front

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
  glm::vec3 start(std::size_t i) const { return {x[i], y[i], z[i]}; }
  glm::vec3 direction(std::size_t i) const { return {dx[i], dy[i], dz[i]}; }
};

}  // namespace lichtmc
