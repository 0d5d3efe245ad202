// Flights through any room by Embree.
//
// Embree computes in float. Three measures keep results independent of that precision:
//  * The room is moved to the origin and scaled: see Placement.
//  * A hit point is computed in double from the facet's own corners, as Embree has them, and the barycentric
//    coordinates of the hit: it lies in the facet's plane, however long the flight was (C. Waechter, N. Binder: A Fast
//    and Robust Method for Avoiding Self-Intersection. Ray Tracing Gems, 2019, ch. 6).
//  * A photon leaves a surface by the rule in departure.hpp.
//
// Where several triangles lie in one plane, Embree returns any of them. All of them stay in its tree, so that no cut
// can open a gap; the hit is then moved to the triangle that counts there.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "base/lanes.hpp"
#include "tracer/convex_room.hpp"
#include "tracer/departure.hpp"
#include "tracer/embree.hpp"
#include "tracer/embree_tree.hpp"
#include "tracer/prepared_room.hpp"
#include "tracer/room_triangles.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

namespace {

class EmbreeTracer final : public Tracer {
 public:
  EmbreeTracer(const Room& room, const Tiling& tiling, Edges edges, std::shared_ptr<PreparedRoom> prepared)
      : room_(&room), tree_(prepared->tree(edges)), departures_(tree_->departures()), placement_(tree_->placement()) {
    set_place(placement_.centre, glm::dmat3(1.0 / placement_.scale));
    facets_ = make_facets(room, tiling, placement_, prepared->threads());
    if (!prepared->planes()->empty()) planes_ = prepared->planes();
    prepared_ = std::move(prepared);
    casts_shadows_ = !prepared_->mesh().convex || !ConvexRoom(room, *this).holds_all_emitters();
  }

  void trace(Rays& rays, Misses misses, TraceCount& count) const override {
    EmbreeQuery query;
    RTCRayHit8 packet{};
    std::fill_n(packet.ray.mask, packet_size, 0xFFFFFFFF);
    alignas(32) std::array<int, packet_size> valid{};
    for (std::size_t first = 0; first < rays.size; first += packet_size) {
      for (std::size_t k = 0; k < packet_size; ++k) valid[k] = first + k < rays.size ? -1 : 0;
      fill(packet, rays, first);
      query.intersect8(valid.data(), tree_->scene(), packet);
      if (!land(packet, rays, first) || misses != Misses::retrace) continue;
      for (std::size_t i = first; i < std::min(first + packet_size, rays.size); ++i) {
        if (rays.facet[i] != no_facet) continue;
        retrace(query, rays, i);
        count.rays += 4;
        ++count.retraced;
      }
    }
    count.rays += rays.size;
    if (planes_) move_to_counting_faces(rays, count);
  }

  void depart(Rays& rays) const override { depart_from(departures_, rays); }

  void scatter(Rays& rays, const std::uint32_t* polar, const std::uint32_t* azimuth, float* cosines) const override {
    scatter_from(departures_, rays, polar, azimuth, cosines);
  }

  Start start(const glm::dvec3& world_point_m, const glm::dvec3& axis) const override {
    return start_at(world_point_m, axis, *room_, placement_, departures_, tree_->groups());
  }

  bool is_blocked(const glm::vec3& start, const glm::vec3& segment, TraceCount& count) const override {
    EmbreeQuery query;
    ++count.rays;
    ++count.shadow_rays;
    return is_occluded(query, start, segment);
  }

  void find_blocked(ShadowRays& rays, TraceCount& count) const override {
    EmbreeQuery query;
    RTCRay16 packet{};
    std::fill_n(packet.mask, shadow_packet_size, 0xFFFFFFFF);
    alignas(64) std::array<int, shadow_packet_size> valid{};
    for (std::size_t first = 0; first < rays.size; first += shadow_packet_size) {
      for (std::size_t k = 0; k < shadow_packet_size; ++k) valid[k] = first + k < rays.size ? -1 : 0;
      fill(packet, rays, first);
      query.occluded16(valid.data(), tree_->scene(), packet);
      // Embree reports occlusion by tfar = −∞.
      for (std::size_t k = 0; k < shadow_packet_size; ++k) rays.blocked[first + k] = packet.tfar[k] < 0.0F ? 1 : 0;
    }
    count.rays += rays.size;
    count.shadow_rays += rays.size;
  }

  void darken_blocked(const glm::vec3& start, const EndPoints& ends, std::size_t first, std::size_t last, float* value,
                      TraceCount& count) const override;

  bool casts_shadows() const override { return casts_shadows_; }

  // Coordinates lie between −1 and 1, and no side is longer than 2√3: the step of the largest possible facet.
  // Of faces in one plane, all must be behind it.
  float step() const override {
    const double gap = planes_ ? placement_.scale * planes_->largest_gap_m() : 0.0;
    return static_cast<float>(step_roundings * 5.0 + gap);
  }

  double clearance_m(const glm::dvec3& /*normal*/) const override {
    return glm::length(world_vector({double{step()}, 0.0, 0.0}));
  }

  TriangleOnFacet locate(std::size_t surface, std::size_t triangle) const override {
    return {
        static_cast<std::uint32_t>(tree_->first_facet()[surface] + triangle), {0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}};
  }

 private:
  bool is_occluded(EmbreeQuery& query, const glm::vec3& start, const glm::vec3& segment) const {
    RTCRay ray{};
    ray.org_x = start.x;
    ray.org_y = start.y;
    ray.org_z = start.z;
    ray.dir_x = segment.x;
    ray.dir_y = segment.y;
    ray.dir_z = segment.z;
    ray.tnear = 0.0F;
    ray.tfar = 1.0F;
    ray.mask = 0xFFFFFFFF;
    query.occluded(tree_->scene(), ray);
    return ray.tfar < 0.0F;  // Embree reports occlusion by tfar = −∞
  }

  void move_to_counting_faces(Rays& rays, TraceCount& count) const {
    for (std::size_t i = 0; i < rays.size; ++i) {
      if (rays.facet[i] == no_facet || !planes_->has_others(rays.facet[i])) continue;
      bool undecided = false;
      const FacePlace place =
          planes_->counting({rays.facet[i], double{rays.s[i]}, double{rays.t[i]}, rays.behind[i] != 0}, undecided);
      rays.facet[i] = place.triangle;
      rays.s[i] = static_cast<float>(place.s);
      rays.t[i] = static_cast<float>(place.t);
      rays.behind[i] = place.behind ? 1 : 0;
      count.undecided += undecided ? 1 : 0;
    }
  }

  RTCRayHit intersect(EmbreeQuery& query, const glm::vec3& start, const glm::vec3& direction) const {
    RTCRayHit hit{};
    hit.ray.org_x = start.x;
    hit.ray.org_y = start.y;
    hit.ray.org_z = start.z;
    hit.ray.dir_x = direction.x;
    hit.ray.dir_y = direction.y;
    hit.ray.dir_z = direction.z;
    hit.ray.tnear = 0.0F;
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = 0xFFFFFFFF;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.intersect(tree_->scene(), hit);
    return hit;
  }

  // A ray that hit no surface in a closed room went exactly through an edge or a corner. Four rays beside it, about a
  // step away, cannot all do so; the nearest surface that they hit is the result. One of them may start behind a wall
  // close by and hit its outside at once: a hit within some steps counts only if there is no other.
  void retrace(EmbreeQuery& query, Rays& rays, std::size_t i) const {
    const glm::vec3 start = rays.start(i);
    const glm::vec3 direction = rays.direction(i);
    const Frame beside = frame_about(glm::normalize(glm::dvec3(direction)));
    constexpr double distance = 4.0 * step_roundings;
    RTCRayHit nearest{};
    nearest.ray.tfar = std::numeric_limits<float>::infinity();
    nearest.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCRayHit touching = nearest;
    for (const glm::dvec3& shift : {beside.tangent, -beside.tangent, beside.bitangent, -beside.bitangent}) {
      const RTCRayHit hit = intersect(query, glm::vec3(glm::dvec3(start) + distance * shift), direction);
      if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
      RTCRayHit& best = hit.ray.tfar < 8.0 * distance ? touching : nearest;
      if (hit.ray.tfar < best.ray.tfar) best = hit;
    }
    const RTCRayHit& found = nearest.hit.geomID != RTC_INVALID_GEOMETRY_ID ? nearest : touching;
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
    rays.facet[i] = found.hit.primID;
    rays.s[i] = found.hit.u;
    rays.t[i] = found.hit.v;
    rays.behind[i] = glm::dot(direction, facets_[found.hit.primID].normal) > 0.0F ? 1 : 0;
    rays.length[i] = found.ray.tfar;
  }

  static constexpr std::size_t packet_size = 8;
  static constexpr std::size_t shadow_packet_size = 16;

  static void fill(RTCRay16& packet, const ShadowRays& rays, std::size_t first) {
    std::copy_n(&rays.x[first], shadow_packet_size, packet.org_x);
    std::copy_n(&rays.y[first], shadow_packet_size, packet.org_y);
    std::copy_n(&rays.z[first], shadow_packet_size, packet.org_z);
    std::copy_n(&rays.dx[first], shadow_packet_size, packet.dir_x);
    std::copy_n(&rays.dy[first], shadow_packet_size, packet.dir_y);
    std::copy_n(&rays.dz[first], shadow_packet_size, packet.dir_z);
    std::fill_n(packet.tnear, shadow_packet_size, 0.0F);
    std::fill_n(packet.tfar, shadow_packet_size, 1.0F);
  }

  // Copies flights first … first + 7 into a packet. The arrays of rays have whole_lanes() elements.
  static void fill(RTCRayHit8& packet, const Rays& rays, std::size_t first) {
    RTCRay8& ray = packet.ray;
    std::copy_n(&rays.x[first], packet_size, ray.org_x);
    std::copy_n(&rays.y[first], packet_size, ray.org_y);
    std::copy_n(&rays.z[first], packet_size, ray.org_z);
    std::copy_n(&rays.dx[first], packet_size, ray.dir_x);
    std::copy_n(&rays.dy[first], packet_size, ray.dir_y);
    std::copy_n(&rays.dz[first], packet_size, ray.dir_z);
    std::fill_n(ray.tnear, packet_size, 0.0F);
    std::fill_n(ray.tfar, packet_size, std::numeric_limits<float>::infinity());
    std::fill_n(packet.hit.geomID, packet_size, RTC_INVALID_GEOMETRY_ID);
  }

  // Copies the hits of a packet to its flights; returns whether some hit nothing. Embree's normals point to the fronts.
  bool land(const RTCRayHit8& packet, Rays& rays, std::size_t first) const {
    const RTCHit8& hit = packet.hit;
    const RTCRay8& ray = packet.ray;
    std::uint32_t* LICHTMC_APART facet = &rays.facet[first];
    std::uint32_t* LICHTMC_APART behind = &rays.behind[first];
    std::uint32_t misses = 0;
    for (std::size_t k = 0; k < packet_size; ++k) {
      const bool missed = hit.geomID[k] == RTC_INVALID_GEOMETRY_ID;
      const float along = ray.dir_x[k] * hit.Ng_x[k] + ray.dir_y[k] * hit.Ng_y[k] + ray.dir_z[k] * hit.Ng_z[k];
      facet[k] = missed ? no_facet : hit.primID[k];
      behind[k] = along > 0.0F ? 1U : 0U;
      misses |= missed ? 1U : 0U;
    }
    std::copy_n(hit.u, packet_size, &rays.s[first]);
    std::copy_n(hit.v, packet_size, &rays.t[first]);
    std::copy_n(ray.tfar, packet_size, &rays.length[first]);
    // Flights that continue will need it.
    for (std::size_t k = 0; k < packet_size && misses == 0; ++k) __builtin_prefetch(&departures_[facet[k]]);
    return misses != 0;
  }

  const Room* room_;
  std::shared_ptr<const EmbreeTree> tree_;
  const std::vector<Departure>& departures_;  // of the tree
  Placement placement_;
  bool casts_shadows_ = true;
};

// Packets of 16 neighbours; those of which none is to be tested are left out.
void EmbreeTracer::darken_blocked(const glm::vec3& start, const EndPoints& ends, std::size_t first_end,
                                  std::size_t last_end, float* value, TraceCount& count) const {
  constexpr std::size_t size = shadow_packet_size;
  static_assert(most_lanes % size == 0);
  EmbreeQuery query;
  RTCRay16 packet{};
  std::fill_n(packet.org_x, size, start.x);
  std::fill_n(packet.org_y, size, start.y);
  std::fill_n(packet.org_z, size, start.z);
  std::fill_n(packet.tnear, size, 0.0F);
  std::fill_n(packet.mask, size, 0xFFFFFFFF);
  alignas(64) std::array<int, size> valid{};
  std::uint64_t tested = 0;
  for (std::size_t first = first_end; first < last_end; first += size) {
    float* of_packet = value + first;
    int any = 0;
    for (std::size_t k = 0; k < size; ++k) {
      valid[k] = of_packet[k] > 0.0F ? -1 : 0;
      any += valid[k];
    }
    if (any == 0) continue;
    tested -= static_cast<std::uint64_t>(std::int64_t{any});
    for (std::size_t k = 0; k < size; ++k) {
      packet.dir_x[k] = ends.x[first + k] - start.x;
      packet.dir_y[k] = ends.y[first + k] - start.y;
      packet.dir_z[k] = ends.z[first + k] - start.z;
      packet.tfar[k] = 1.0F;
    }
    query.occluded_bundle(valid.data(), tree_->scene(), packet);
    for (std::size_t k = 0; k < size; ++k) of_packet[k] = packet.tfar[k] < 0.0F ? 0.0F : of_packet[k];
  }
  count.rays += tested;
  count.shadow_rays += tested;
  count.bundled += tested;
}

}  // namespace

std::unique_ptr<Tracer> make_embree_tracer(const Room& room, const Tiling& tiling, Edges edges,
                                           std::shared_ptr<PreparedRoom> prepared) {
  if (prepared == nullptr) prepared = prepare(room);
  return std::make_unique<EmbreeTracer>(room, tiling, edges, std::move(prepared));
}

}  // namespace lichtmc
