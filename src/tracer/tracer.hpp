// One question: where does each of these rays land?
//
// Two tracers answer it, the closed form of the cuboid and Embree, and they must agree. Each has coordinates of its
// own, centred on the room and scaled to it, so that neither a room's size nor its place matters.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "tracer/facet.hpp"
#include "tracer/rays.hpp"

namespace lichtmc {

// What a ray that meets no surface is.
enum class Misses {
  escape,   // it leaves through an opening
  retrace,  // the room is closed and the ray started inside: a numerical fault; it is traced again by a slower rule
};

struct TraceCount {
  std::uint64_t rays = 0;      // rays traced, with those traced again
  std::uint64_t retraced = 0;  // rays that were traced again
};

// Where the photons of a point emitter start.
struct Start {
  glm::vec3 point{0.0F};  // tracer's coordinates
  // The emitter touches these planes (normals times the step off a surface): a photon starts this far from each,
  // on the side it flies to.
  std::vector<glm::vec3> steps;
  bool on_surface = false;  // it touches a surface, so that some of its light may leave the room at once
};

// A triangle of the room as part of a facet: facet coordinates (s, t) = st_0 + b1·st_1 + b2·st_2 for the barycentric
// coordinates b1, b2 of its second and third corner.
struct TriangleOnFacet {
  std::uint32_t facet = no_facet;
  glm::vec2 st_0{0.0F};
  glm::vec2 st_1{0.0F};
  glm::vec2 st_2{0.0F};
};

class Tracer {
 public:
  virtual ~Tracer() = default;

  // Ends every flight of the wave at the first surface it meets: sets facet, s, t and behind.
  virtual void trace(Rays& rays, Misses misses, TraceCount& count) const = 0;

  // Sets where flights start that leave a facet: x, y, z from facet, s, t and behind. Flights that leave none stay as
  // they are.
  virtual void depart(Rays& rays) const = 0;

  virtual Start start(const glm::dvec3& world_point_m) const = 0;
  virtual TriangleOnFacet locate(std::size_t surface, std::size_t triangle) const = 0;

  // A point in the tracer's coordinates → the world, in m.
  virtual glm::dvec3 world_point(const glm::vec3& point) const = 0;

  const std::vector<Facet>& facets() const { return facets_; }
  // World direction → the tracer's coordinates.
  const glm::dmat3& directions() const { return directions_; }

 protected:
  Tracer() = default;
  Tracer(const Tracer&) = default;
  Tracer& operator=(const Tracer&) = default;

  std::vector<Facet> facets_;
  glm::dmat3 directions_{1.0};
};

// The closed form of the cuboid, or null where the room is none that it can serve; then `why_not` says why, as the end
// of a sentence that begins with "the room".
std::unique_ptr<Tracer> make_cuboid_tracer(const Room& room, const Tiling& tiling, std::string& why_not);

// Embree, for any room. Throws RuntimeError where Embree fails.
std::unique_ptr<Tracer> make_embree_tracer(const Room& room, const Tiling& tiling);

}  // namespace lichtmc
