// Flights through any room by Embree.
//
// Embree computes in float. Three things keep that from showing:
//  * The room is moved to the origin and scaled by a power of two so that its largest half extent lies in [½, 1).
//  * A hit point is computed in double from the facet's own corners, as Embree has them, and the barycentric
//  coordinates of
//    the hit: it lies in the facet's plane, however long the flight was (C. Waechter, N. Binder: A Fast and Robust
//    Method for Avoiding Self-Intersection. Ray Tracing Gems, 2019, ch. 6).
//  * A photon leaves a surface by the rule written at depart().
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "base/lanes.hpp"
#include "chance/directions.hpp"
#include "lichtmc/error.hpp"
#include "room/bounds.hpp"
#include "room/convexity.hpp"
#include "tracer/embree.hpp"
#include "tracer/touch.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

namespace {

using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, decltype(&rtcReleaseDevice)>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, decltype(&rtcReleaseScene)>;

// What leaving a facet needs: its corners as Embree has them, and the two lengths of the rule at depart(). Together it
// fills a line of the cache: in large rooms every one is a walk to memory.
struct alignas(64) Departure {
  glm::vec3 corner{0.0F};
  glm::vec3 edge_s{0.0F};
  glm::vec3 edge_t{0.0F};
  glm::vec3 normal{0.0F};
  glm::vec3 margin{0.0F};  // least distance from the three sides, as barycentric coordinates: of 1 − s − t, s and t
  float step = 0.0F;       // off the plane
};

// Embree decides on which side of a plane a ray starts from (corner − start)·normal. With the start rounded to float
// and three differences and products the error is below 4 roundings (2⁻²⁴ each) of the distance between start and
// corner and one of the coordinates; twice that is the step.
constexpr double step_roundings = 8.0 * 0x1p-24;

// Where a facet is parallel to two axes the normal has one component, to the last digit, and only the coordinate along
// it counts: such walls may stand as close to each other as they like. Near the origin a distance remains that does not
// vanish in the products.
constexpr double least_step = step_roundings * 0x1p-24;

// A photon keeps this many steps away from the sides of its facet, so that it stays inside where walls meet at angles
// down to 27°.
constexpr double margin_steps = 2.0;

// But it is never moved by more than this share of the facet: on slivers, narrower than some steps, the margin gives
// way.
constexpr double largest_margin = 0x1p-10;

double largest_component(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

Departure make_departure(const std::array<glm::vec3, 3>& corners, const glm::dvec3& normal) {
  const std::array<glm::dvec3, 3> p{corners[0], corners[1], corners[2]};
  const double twice_area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
  const double reach = std::max({largest_component(p[0]), largest_component(p[1]), largest_component(p[2])});
  const std::array<double, 3> side{glm::length(p[2] - p[1]), glm::length(p[0] - p[2]), glm::length(p[1] - p[0])};
  const double step = step_roundings * (reach + std::max({side[0], side[1], side[2]}));
  double own_step = step;
  for (int k = 0; k < 3; ++k) {
    if (p[0][k] == p[1][k] && p[0][k] == p[2][k]) own_step = step_roundings * std::abs(p[0][k]) + least_step;
  }

  Departure departure;
  departure.corner = corners[0];
  departure.edge_s = corners[1] - corners[0];
  departure.edge_t = corners[2] - corners[0];
  departure.normal = glm::vec3(normal);
  departure.step = static_cast<float>(own_step);
  for (int k = 0; k < 3; ++k) {
    // Height of the triangle over side k; a share of it is a barycentric coordinate.
    const double share = margin_steps * step * side[static_cast<std::size_t>(k)] / twice_area;
    departure.margin[k] = static_cast<float>(share < largest_margin ? share : largest_margin);
  }
  return departure;
}

void throw_embree_error(RTCDevice device, const std::string& what) {
  const RTCError code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_NONE) return;
  const std::string reason = code == RTC_ERROR_OUT_OF_MEMORY     ? "out of memory"
                             : code == RTC_ERROR_UNSUPPORTED_CPU ? "this processor is not supported"
                                                                 : "error " + std::to_string(static_cast<int>(code));
  throw RuntimeError("Embree failed while " + what + " (" + reason +
                     "). Use a machine with more memory, or a smaller room.");
}

// Where a photon on a facet starts: the rule is written at depart().
struct StartPoint {
  double x, y, z;

  StartPoint(const Departure& from, float on_s, float on_t, bool behind) {
    const double margin_s = from.margin.y;
    const double margin_t = from.margin.z;
    double s = on_s < from.margin.y ? margin_s : on_s;
    double t = on_t < from.margin.z ? margin_t : on_t;
    const double too_far = s + t - (1.0 - double{from.margin.x});
    const double excess = too_far > 0.0 ? 0.5 * too_far : 0.0;
    s -= excess;
    t -= excess;
    // In the acute corner that took one of them below its margin; the other has more than enough.
    const double s_lacks = s < margin_s ? margin_s - s : 0.0;
    const double t_lacks = t < margin_t ? margin_t - t : 0.0;
    s += s_lacks - t_lacks;
    t += t_lacks - s_lacks;
    const double step = behind ? -double{from.step} : double{from.step};
    x = from.corner.x + s * from.edge_s.x + t * from.edge_t.x + step * from.normal.x;
    y = from.corner.y + s * from.edge_s.y + t * from.edge_t.y + step * from.normal.y;
    z = from.corner.z + s * from.edge_s.z + t * from.edge_t.z + step * from.normal.z;
  }
};

// Photons on facets: where they start, and directions off them by Lambert's law, on the side named.
LICHTMC_LANES void scatter_lanes(std::size_t n, const Departure* LICHTMC_APART departures,
                                 const std::uint32_t* LICHTMC_APART facet, const float* LICHTMC_APART s,
                                 const float* LICHTMC_APART t, const std::uint32_t* LICHTMC_APART behind,
                                 const std::uint32_t* LICHTMC_APART polar, const std::uint32_t* LICHTMC_APART azimuth,
                                 float* LICHTMC_APART x, float* LICHTMC_APART y, float* LICHTMC_APART z,
                                 float* LICHTMC_APART dx, float* LICHTMC_APART dy, float* LICHTMC_APART dz) {
  for (std::size_t i = 0; i < n; ++i) {
    const Departure& from = departures[facet[i]];
    const StartPoint start(from, s[i], t[i], behind[i] != 0);
    x[i] = static_cast<float>(start.x);
    y[i] = static_cast<float>(start.y);
    z[i] = static_cast<float>(start.z);
    // About the normal as frame_about() does.
    const glm::vec3 local = sample_lambert(polar[i], azimuth[i]);
    const float normal_x = from.normal.x;
    const float normal_y = from.normal.y;
    const float normal_z = from.normal.z;
    const float sign = normal_z < 0.0F ? -1.0F : 1.0F;
    const float a = -1.0F / (sign + normal_z);
    const float b = normal_x * normal_y * a;
    const float up = behind[i] != 0 ? -local.z : local.z;
    dx[i] = local.x * (1.0F + sign * normal_x * normal_x * a) + local.y * b + up * normal_x;
    dy[i] = local.x * sign * b + local.y * (sign + normal_y * normal_y * a) + up * normal_y;
    dz[i] = local.x * -sign * normal_x - local.y * normal_y + up * normal_z;
  }
}

class EmbreeTracer final : public Tracer {
 public:
  EmbreeTracer(const Room& room, const Tiling& tiling, Edges edges) : room_(&room) {
    if (!device_) throw_embree_error(nullptr, "starting");
    scene_ = {rtcNewScene(device_.get()), &rtcReleaseScene};
    if (edges == Edges::robust) rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    // Medium quality: the same tree for any number of threads.
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_MEDIUM);
    place(room);
    casts_shadows_ = !is_convex(WeldedMesh(room));
    add_facets(room, tiling);
    throw_embree_error(device_.get(), "taking in the room");
    rtcCommitScene(scene_.get());
    throw_embree_error(device_.get(), "sorting the room's triangles");
  }

  void trace(Rays& rays, Misses misses, TraceCount& count) const override {
    EmbreeQuery query;
    RTCRayHit8 packet{};
    std::fill_n(packet.ray.mask, packet_size, 0xFFFFFFFF);
    alignas(32) std::array<int, packet_size> valid{};
    for (std::size_t first = 0; first < rays.size; first += packet_size) {
      for (std::size_t k = 0; k < packet_size; ++k) valid[k] = first + k < rays.size ? -1 : 0;
      fill(packet, rays, first);
      query.intersect8(valid.data(), scene_.get(), packet);
      if (!land(packet, rays, first) || misses != Misses::retrace) continue;
      for (std::size_t i = first; i < std::min(first + packet_size, rays.size); ++i) {
        if (rays.facet[i] != no_facet) continue;
        retrace(query, rays, i);
        count.rays += 4;
        ++count.retraced;
      }
    }
    count.rays += rays.size;
  }

  // The rule for leaving a surface:
  //  1. The photon keeps a margin from the facet's sides: a photon that landed within rounding of an edge would
  //  otherwise start outside the room.
  //  2. It starts one step off the facet's plane, on the side that it was hit on: Embree would otherwise find the facet
  //  itself at distance 0.
  // Both are some 10⁻⁶ of the room, below what float coordinates can tell apart, and are scored nowhere: tiles count
  // the true hit.
  void depart(Rays& rays) const override {
    for (std::size_t i = 0; i < rays.size; ++i) {
      if (rays.facet[i] == no_facet) continue;
      const StartPoint start(departures_[rays.facet[i]], rays.s[i], rays.t[i], rays.behind[i] != 0);
      rays.set_start(i, {start.x, start.y, start.z});
    }
  }

  void scatter(Rays& rays, const std::uint32_t* polar, const std::uint32_t* azimuth, float* cosines) const override {
    scatter_lanes(rays.size, departures_.data(), rays.facet.data(), rays.s.data(), rays.t.data(), rays.behind.data(),
                  polar, azimuth, rays.x.data(), rays.y.data(), rays.z.data(), rays.dx.data(), rays.dy.data(),
                  rays.dz.data());
    for (std::size_t i = 0; cosines != nullptr && i < rays.size; ++i) cosines[i] = sample_lambert(polar[i], 0).z;
  }

  Start start(const glm::dvec3& world_point_m, const glm::dvec3& axis) const override;

  bool is_blocked(const glm::vec3& start, const glm::vec3& way, TraceCount& count) const override {
    EmbreeQuery query;
    ++count.rays;
    ++count.shadow_rays;
    return meets_something(query, start, way);
  }

  void find_blocked(ShadowRays& rays, TraceCount& count) const override {
    EmbreeQuery query;
    for (std::size_t i = 0; i < rays.size; ++i)
      rays.blocked[i] = meets_something(query, rays.starts[i], rays.ways[i]) ? 1 : 0;
    count.rays += rays.size;
    count.shadow_rays += rays.size;
  }

  bool casts_shadows() const override { return casts_shadows_; }

  // Coordinates lie between −1 and 1, and no side is longer than 2√3: the step of the largest facet there can be.
  float step() const override { return static_cast<float>(step_roundings * 5.0); }

  TriangleOnFacet locate(std::size_t surface, std::size_t triangle) const override {
    return {static_cast<std::uint32_t>(first_facet_[surface] + triangle), {0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}};
  }

 private:
  bool meets_something(EmbreeQuery& query, const glm::vec3& start, const glm::vec3& way) const {
    RTCRay ray{};
    ray.org_x = start.x;
    ray.org_y = start.y;
    ray.org_z = start.z;
    ray.dir_x = way.x;
    ray.dir_y = way.y;
    ray.dir_z = way.z;
    ray.tnear = 0.0F;
    ray.tfar = 1.0F;
    ray.mask = 0xFFFFFFFF;
    query.occluded(scene_.get(), ray);
    return ray.tfar < 0.0F;  // Embree's word for yes is −∞
  }

  // The first corner of a facet in the world, m.
  const glm::dvec3& corner_of(std::size_t facet) const {
    const std::size_t surface = facets_[facet].surface;
    const Surface& own = room_->surfaces[surface];
    return own.positions[own.triangles[facet - first_facet_[surface]].x];
  }

  void place(const Room& room);
  void add_facets(const Room& room, const Tiling& tiling);

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
    query.intersect(scene_.get(), hit);
    return hit;
  }

  // A ray that found no surface in a closed room went exactly through an edge or a corner. Four rays beside it, about a
  // step away, cannot all do so; the nearest surface they meet is the one. One of them may start behind a wall close by
  // and meet its outside at once: what is met within some steps counts only where nothing else is.
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

  // Flights first … first + 7 as Embree takes them. Arrays of rays reach to whole_lanes().
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

  // Where they ended; whether some met nothing. The normals that Embree tells point to the fronts.
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
    // Those that fly on will ask for it.
    for (std::size_t k = 0; k < packet_size && misses == 0; ++k) __builtin_prefetch(&departures_[facet[k]]);
    return misses != 0;
  }

  const Room* room_;
  Device device_{rtcNewDevice(nullptr), &rtcReleaseDevice};
  Scene scene_{nullptr, &rtcReleaseScene};
  glm::dvec3 centre_{0.0};
  double scale_ = 1.0;
  bool casts_shadows_ = true;
  std::vector<std::size_t> first_facet_;  // of each surface
  std::vector<Departure> departures_;
};

void EmbreeTracer::place(const Room& room) {
  const auto [low, high] = bounds_of(room);
  centre_ = low + 0.5 * (high - low);
  int exponent = 0;
  std::frexp(largest_component(0.5 * (high - low)), &exponent);
  scale_ = std::ldexp(1.0, -exponent);
  set_place(centre_, glm::dmat3(1.0 / scale_));
}

void EmbreeTracer::add_facets(const Room& room, const Tiling& tiling) {
  std::vector<glm::vec3> vertices;
  std::vector<glm::uvec3> triangles;
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    const Surface& surface = room.surfaces[k];
    const auto first_vertex = static_cast<std::uint32_t>(vertices.size());
    first_facet_.push_back(triangles.size());
    for (const glm::dvec3& position : surface.positions) vertices.emplace_back(scale_ * (position - centre_));
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
      const glm::uvec3 triangle = surface.triangles[n];
      const glm::dvec3 a = surface.positions[triangle.x];
      // Scaled first: the cross product of a tiny room's edges would underflow.
      const glm::dvec3 cross =
          glm::cross(scale_ * (surface.positions[triangle.y] - a), scale_ * (surface.positions[triangle.z] - a));
      const double length = glm::length(cross);
      // A triangle without area has no tile. Rounded to float it might become a sliver that is hit: it gets one corner
      // only, and any normal.
      const Frame frame = frame_about(length > 0.0 ? cross / length : glm::dvec3(0.0, 1.0, 0.0));
      const auto& cells = tiling.cells[k][n];
      facets_.push_back({glm::vec3(frame.tangent), glm::vec3(frame.bitangent), glm::vec3(frame.normal),
                         static_cast<std::uint32_t>(k), cells[0], cells[1] - cells[0], cells[2] - cells[0]});
      triangles.push_back((length > 0.0 ? triangle : glm::uvec3(triangle.x)) + first_vertex);
      const glm::uvec3 corner = triangles.back();
      departures_.push_back(make_departure({vertices[corner.x], vertices[corner.y], vertices[corner.z]}, frame.normal));
    }
  }

  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto fill = [geometry](RTCBufferType type, RTCFormat format, const auto& elements) {
    using Element = std::decay_t<decltype(elements[0])>;
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), elements.size());
    if (buffer != nullptr) std::copy(elements.begin(), elements.end(), static_cast<Element*>(buffer));
  };
  fill(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices);
  fill(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
}

// Whether a point (tracer's coordinates) lies on a facet, or not farther from it than `distance`.
bool touches(const Departure& facet, const glm::dvec3& point, double distance) {
  const glm::dvec3 normal(facet.normal);
  const glm::dvec3 from_corner = point - glm::dvec3(facet.corner);
  if (std::abs(glm::dot(from_corner, normal)) > distance) return false;
  const glm::dvec3 cross = glm::cross(glm::dvec3(facet.edge_s), glm::dvec3(facet.edge_t));
  const double area = glm::dot(cross, cross);
  if (!(area > 0.0)) return false;
  const double s = glm::dot(glm::cross(from_corner, glm::dvec3(facet.edge_t)), cross) / area;
  const double t = glm::dot(glm::cross(glm::dvec3(facet.edge_s), from_corner), cross) / area;
  const glm::dvec3 margin(facet.margin);
  return !(s < -margin.y || t < -margin.z || s + t > 1.0 + margin.x);
}

Start EmbreeTracer::start(const glm::dvec3& world_point_m, const glm::dvec3& axis) const {
  Start result;
  const glm::dvec3 point = scale_ * (world_point_m - centre_);
  result.point = glm::vec3(point);
  std::vector<glm::vec3> planes;
  for (std::size_t k = 0; k < departures_.size(); ++k) {
    const Departure& facet = departures_[k];
    // Most facets are far off.
    if (!touches(facet, point, std::max(double{facet.step}, NearPlane::most_rounding))) continue;
    const glm::dvec3 normal(facet.normal);
    const NearPlane plane{world_point_m, corner_of(k), normal, 1.0 / scale_};
    if (!touches(facet, point, std::max(double{facet.step}, scale_ * plane.rounding()))) continue;
    // Triangles of one plane count once.
    const bool known = std::any_of(planes.begin(), planes.end(), [&](const glm::vec3& other) {
      return std::abs(glm::dot(glm::dvec3(other), normal)) > 1.0 - 1e-6;
    });
    if (known) continue;
    planes.push_back(facet.normal);
    const glm::vec3 step = 2.0F * facet.step * facet.normal;
    if (stays_before(plane, axis)) {
      result.point += plane.distance() < 0.0 ? -step : step;
    } else {
      result.steps.push_back(step);
      result.on_surface = true;
    }
  }
  return result;
}

}  // namespace

std::unique_ptr<Tracer> make_embree_tracer(const Room& room, const Tiling& tiling, Edges edges) {
  return std::make_unique<EmbreeTracer>(room, tiling, edges);
}

}  // namespace lichtmc
