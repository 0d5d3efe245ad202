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
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/fields.hpp"
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
  std::uint64_t rays = 0;         // rays traced, with those traced again and shadow rays
  std::uint64_t retraced = 0;     // rays that were traced again
  std::uint64_t shadow_rays = 0;  // rays that only asked whether something stands between two points

  void add(const TraceCount& other) { add_fields(*this, other); }
};

template <class F, AllOf<TraceCount>... Things>
void visit_fields(const F& f, Things&... counts) {
  f(Field{"rays"}, counts.rays...);
  f(Field{"retraced"}, counts.retraced...);
  f(Field{"shadow_rays"}, counts.shadow_rays...);
}

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

  // Sends flights off the facets they have landed on by Lambert's law, on the side named: departs, and sets dx, dy, dz
  // from two random words each. cosines: of the angles to the normals, unless null.
  virtual void scatter(Rays& rays, const std::uint32_t* polar, const std::uint32_t* azimuth, float* cosines) const = 0;

  // Where photons of an emitter at this point start; axis: the middle of its beam, of length 1, or 0 where it has none.
  // An emitter on a surface, as far as coordinates of floats can say, shines to both sides of it, from each side what
  // goes there. One before a surface, closer than the tracer's own coordinates can say, stays before it, unless its
  // beam goes through it: then the distance is taken for a rounding.
  virtual Start start(const glm::dvec3& world_point_m, const glm::dvec3& axis) const = 0;
  virtual TriangleOnFacet locate(std::size_t surface, std::size_t triangle) const = 0;

  // Which of these straight segments are blocked: sets blocked. A segment that begins and ends free of surfaces is
  // blocked by any surface between.
  virtual void find_blocked(ShadowRays& rays, TraceCount& count) const = 0;

  // The same for one of them.
  virtual bool is_blocked(const glm::vec3& start, const glm::vec3& segment, TraceCount& count) const = 0;

  // Whether some surface can stand between two points in the room. Where none can, nothing is asked.
  virtual bool casts_shadows() const = 0;

  // The least distance from any surface that can be told apart from lying on it, in the tracer's coordinates.
  virtual float step() const = 0;

  // A point and a vector in the tracer's coordinates → the world, in m; and back.
  glm::dvec3 world_point(const glm::dvec3& point) const { return origin_ + to_world_ * point; }
  glm::dvec3 world_vector(const glm::dvec3& vector) const { return to_world_ * vector; }
  glm::dvec3 tracer_point(const glm::dvec3& world_m) const { return from_world_ * (world_m - origin_); }

  const std::vector<Facet>& facets() const { return facets_; }
  // World direction → the tracer's coordinates.
  const glm::dmat3& directions() const { return directions_; }

 protected:
  Tracer() = default;
  Tracer(const Tracer&) = default;
  Tracer& operator=(const Tracer&) = default;

  void set_place(const glm::dvec3& origin, const glm::dmat3& to_world) {
    origin_ = origin;
    to_world_ = to_world;
    from_world_ = glm::inverse(to_world);
  }

  std::vector<Facet> facets_;
  glm::dmat3 directions_{1.0};

 private:
  glm::dvec3 origin_{0.0};  // m
  glm::dmat3 to_world_{1.0};
  glm::dmat3 from_world_{1.0};
};

// The closed form of the cuboid, or null where the room is none that it can serve; then `why_not` says why, as the end
// of a sentence that begins with "the room".
std::unique_ptr<Tracer> make_cuboid_tracer(const Room& room, const Tiling& tiling, std::string& why_not);

// How rays meet the edges of triangles.
enum class Edges {
  robust,  // a ray does not slip between triangles that share an edge
  fast,    // it may, once in many millions of flights
};

// Embree, for any room, which must outlive it. Throws RuntimeError where Embree fails.
std::unique_ptr<Tracer> make_embree_tracer(const Room& room, const Tiling& tiling, Edges edges = Edges::robust);

}  // namespace lichtmc
