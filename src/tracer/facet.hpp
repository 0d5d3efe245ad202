// Facets: the plane elements that flights end on and that photons are scattered from.
//
// A facet is a triangle or a rectangle with coordinates s, t of its own: x = corner + s·edge_s + t·edge_t. A tracer
// holds their geometry; this header has what the walk requires of them.
#pragma once

#include <cstdint>
#include <limits>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace lichtmc {

// In Rays::facet: the photon starts from no facet, or hit none.
inline constexpr std::uint32_t no_facet = std::numeric_limits<std::uint32_t>::max();

struct Facet {
  // Frame for scattering, in the tracer's coordinates; the normal points to the surface's front.
  glm::vec3 tangent{0.0F};
  glm::vec3 bitangent{0.0F};
  glm::vec3 normal{0.0F};
  std::uint32_t surface = 0;  // index into Room::surfaces
  // Position in the surface's grid, in cells: cell = cell_0 + s·cell_s + t·cell_t, x along the columns, y along the
  // rows.
  glm::dvec2 cell_0{0.0};
  glm::dvec2 cell_s{0.0};
  glm::dvec2 cell_t{0.0};
};

// A direction in a facet's frame → the tracer's coordinates; the third axis points to the given side.
inline glm::vec3 direction_from(const Facet& facet, bool behind, const glm::vec3& local) {
  const float up = behind ? -local.z : local.z;
  return local.x * facet.tangent + local.y * facet.bitangent + up * facet.normal;
}

}  // namespace lichtmc
