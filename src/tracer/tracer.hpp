// Ray tracers: the first surface that each ray of a wave hits.
//
// There are two, the closed form of the cuboid and Embree; their results must agree. Each has its own coordinates,
// centred on the room and scaled to it, so that the size and position of a room do not affect the precision.
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
#include "room/faces_in_one_plane.hpp"
#include "tracer/facet.hpp"
#include "tracer/rays.hpp"

namespace lichtmc {

// What it means if a ray hits no surface.
enum class Misses {
  escape,   // it leaves through an opening
  retrace,  // the room is closed and the ray started inside: a numerical fault; it is traced again by a slower rule
};

struct TraceCount {
  std::uint64_t rays = 0;         // all rays, including those traced again and shadow rays
  std::uint64_t retraced = 0;     // rays that were traced again
  std::uint64_t shadow_rays = 0;  // rays that test whether a surface lies between two points
  std::uint64_t bundled = 0;      // those of them that were traced in bundles with a common start
  // Flights that ended where several faces in one plane have an equal right to count (room/faces_in_one_plane.hpp).
  std::uint64_t undecided = 0;

  void add(const TraceCount& other) { add_fields(*this, other); }
};

template <class F, AllOf<TraceCount>... Things>
void visit_fields(const F& f, Things&... counts) {
  f(Field{"rays"}, counts.rays...);
  f(Field{"retraced"}, counts.retraced...);
  f(Field{"shadow_rays"}, counts.shadow_rays...);
  f(Field{"bundled"}, counts.bundled...);
  f(Field{"undecided"}, counts.undecided...);
}

// Where the photons of a point emitter start.
struct Start {
  glm::vec3 point{0.0F};  // tracer's coordinates
  // The emitter touches these planes (normals times the step off a surface): a photon starts this far from each,
  // on the side it flies to.
  std::vector<glm::vec3> steps;
  bool on_surface = false;  // it touches a surface: part of its light may leave the room at once
};

// A triangle of the room as part of a facet: facet coordinates (s, t) = st_0 + b1·st_1 + b2·st_2 for the barycentric
// coordinates b1, b2 of its second and third corner.
struct TriangleOnFacet {
  std::uint32_t facet = no_facet;
  glm::vec2 st_0{0.0F};
  glm::vec2 st_1{0.0F};
  glm::vec2 st_2{0.0F};
};

class PreparedRoom;

class Tracer {
 public:
  virtual ~Tracer() = default;

  // Ends every flight of the wave at the first surface that it hits: sets facet, s, t, behind and length. Of several
  // faces in one plane the one that counts is hit.
  virtual void trace(Rays& rays, Misses misses, TraceCount& count) const = 0;

  // Sets the start points x, y, z of flights that leave a facet, from facet, s, t and behind. Other flights do not
  // change.
  virtual void depart(Rays& rays) const = 0;

  // Scatters flights by Lambert's law from the facets that they have hit, on the side given by `behind`: sets x, y, z
  // as depart() does, and dx, dy, dz from two random words each. cosines: receives those of the angles to the normals,
  // unless null.
  virtual void scatter(Rays& rays, const std::uint32_t* polar, const std::uint32_t* azimuth, float* cosines) const = 0;

  // Where photons of an emitter at this point start. axis: centre of its beam, of length 1, or 0 if it has none. An
  // emitter that lies on a surface, within the rounding of float coordinates, emits to both sides: each photon starts
  // on the side to which it flies. An emitter in front of a surface, closer than the tracer's coordinates resolve,
  // stays in front of it, unless its beam goes through the surface: then the distance counts as rounding.
  virtual Start start(const glm::dvec3& world_point_m, const glm::dvec3& axis) const = 0;
  virtual TriangleOnFacet locate(std::size_t surface, std::size_t triangle) const = 0;

  // Which of these straight segments are blocked: sets blocked. A segment that begins and ends free of surfaces is
  // blocked by any surface between.
  virtual void find_blocked(ShadowRays& rays, TraceCount& count) const = 0;

  // The same for one segment.
  virtual bool is_blocked(const glm::vec3& start, const glm::vec3& segment, TraceCount& count) const = 0;

  // A bundle of segments with one start to ends first … last − 1: sets value[k] to 0 where a surface lies between the
  // start and end k. Ends with a value of 0 are not tested. Both ends of a segment must be free of surfaces. `first` is
  // a multiple of most_lanes; `value` belongs to all ends and has whole_lanes() elements.
  virtual void darken_blocked(const glm::vec3& start, const EndPoints& ends, std::size_t first, std::size_t last,
                              float* value, TraceCount& count) const;

  // Whether a surface can lie between an emitter and a point of the room. If not, the room is one closed convex shell
  // around all its emitters, and shadow rays are traced only from points outside.
  virtual bool casts_shadows() const = 0;

  // The smallest distance from any surface that is distinguishable from 0, in the tracer's coordinates.
  virtual float step() const = 0;

  // The least distance, in m, from a plane with this normal (world, length 1) at which rays may start that must not
  // start on the plane or behind it.
  virtual double clearance_m(const glm::dvec3& normal) const = 0;

  // A point and a vector in the tracer's coordinates → the world, in m; and back.
  glm::dvec3 world_point(const glm::dvec3& point) const { return origin_ + to_world_ * point; }
  glm::dvec3 world_vector(const glm::dvec3& vector) const { return to_world_ * vector; }
  const glm::dmat3& to_world() const { return to_world_; }
  glm::dvec3 tracer_point(const glm::dvec3& world_m) const { return from_world_ * (world_m - origin_); }
  glm::dvec3 tracer_vector(const glm::dvec3& world_m) const { return from_world_ * world_m; }

  const std::vector<Facet>& facets() const { return facets_; }

  // The faces that have others in their place; null if there are none. Their triangles have the numbers of the facets.
  const FacesInOnePlane* faces_in_one_plane() const { return planes_.get(); }
  // What is known of the room's surfaces, shared with other tracers; null if this tracer needs none of it.
  PreparedRoom* prepared() const { return prepared_.get(); }

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
  std::shared_ptr<const FacesInOnePlane> planes_;
  std::shared_ptr<PreparedRoom> prepared_;  // null if the tracer needs none

 private:
  glm::dvec3 origin_{0.0};  // m
  glm::dmat3 to_world_{1.0};
  glm::dmat3 from_world_{1.0};
};

// The closed form of the cuboid, or null if it is not valid for this room; then `why_not` is the reason, as the end of
// a sentence that begins with "the room".
std::unique_ptr<Tracer> make_cuboid_tracer(const Room& room, const Tiling& tiling, std::string& why_not);

// Treatment of rays at the edges of triangles.
enum class Edges {
  robust,  // no ray passes between triangles that share an edge
  fast,    // a ray may pass, once in many millions of flights
};

// Embree, for any room, which must outlive it. prepared: of a room with the same surfaces; null: this
// room is prepared here. Throws RuntimeError if Embree fails.
std::unique_ptr<Tracer> make_embree_tracer(const Room& room, const Tiling& tiling, Edges edges = Edges::robust,
                                           std::shared_ptr<PreparedRoom> prepared = nullptr);

}  // namespace lichtmc
