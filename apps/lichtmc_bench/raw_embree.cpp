#include "raw_embree.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <glm/geometric.hpp>

#include "chance/directions.hpp"
#include "tracer/embree.hpp"
#include "walk/wave.hpp"

namespace lichtmc::bench {

namespace {

struct Flight {
  glm::vec3 start;
  glm::vec3 direction;
};

// A walk that records every flight: estimator collision, in waves as the engine.
std::vector<Flight> flights_of(const Stage& stage, std::size_t count) {
  const Scene& scene = stage.scene();
  const Stream stream(1);
  std::vector<Flight> flights;
  Wave wave;
  Rays& rays = wave.rays;
  TraceCount traced;
  for (std::uint64_t first = 0; flights.size() < count; first += batch_histories) {
    for (std::uint32_t i = 0; i < batch_histories; ++i) {
      wave.photon[i] = i;
      scene.launcher->launch(stream, first + i, rays, i);
    }
    rays.size = batch_histories;
    for (std::uint32_t flight = 1; rays.size > 0; ++flight) {
      scene.tracer->depart(rays);
      for (std::size_t i = 0; i < rays.size; ++i) flights.push_back({rays.start(i), rays.direction(i)});
      scene.tracer->trace(rays, Misses::escape, traced);
      std::size_t kept = 0;
      for (std::size_t i = 0; i < rays.size; ++i) {
        const Words words = stream.draw(first + wave.photon[i], flight, Purpose::flight);
        if (rays.facet[i] == no_facet || unit_fine(words[2], words[3]) >= scene.reflectance(rays, i)) continue;
        const glm::vec3 out = direction_from(scene.tracer->facets()[rays.facet[i]], rays.behind[i] != 0,
                                             sample_lambert(words[0], words[1]));
        wave.move(i, kept);
        rays.set_direction(kept++, out);
      }
      rays.size = kept;
    }
  }
  flights.resize(count - count % 16);
  return flights;
}

}  // namespace

struct RawEmbree::Data {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  std::vector<RTCRayHit> single, single_fresh;
  std::vector<RTCRayHit8> eight, eight_fresh;
  std::vector<RTCRayHit16> sixteen, sixteen_fresh;
  EmbreeQuery query;

  void take_in(const Stage& stage);
  // Flights in the format of Embree, single and in packets.
  void prepare(const std::vector<Flight>& flights);

  ~Data() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

RawEmbree::~RawEmbree() = default;

RawEmbree::RawEmbree(const Stage& stage, std::size_t count) : data_(std::make_unique<Data>()) {
  data_->take_in(stage);
  data_->prepare(flights_of(stage, count));
}

// The room in Embree as the engine builds it: one mesh, translated and scaled, robust.
void RawEmbree::Data::take_in(const Stage& stage) {
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  std::vector<glm::vec3> corners;
  for (const Surface& surface : stage.room().surfaces) {
    for (const glm::uvec3& t : surface.triangles) {
      for (int k = 0; k < 3; ++k) corners.emplace_back(stage.scene().tracer->tracer_point(surface.positions[t[k]]));
    }
  }
  auto* positions = static_cast<float*>(
      rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), corners.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), corners.size() / 3));
  for (std::size_t k = 0; k < corners.size(); ++k) {
    for (int c = 0; c < 3; ++c) positions[3 * k + static_cast<std::size_t>(c)] = corners[k][c];
    indices[k] = static_cast<unsigned>(k);
  }
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(scene, mesh);
  rtcReleaseGeometry(mesh);
  rtcCommitScene(scene);
}

void RawEmbree::Data::prepare(const std::vector<Flight>& flights) {
  const auto fill = [](auto& ray, std::size_t lane, const Flight& flight) {
    ray.ray.org_x[lane] = flight.start.x;
    ray.ray.org_y[lane] = flight.start.y;
    ray.ray.org_z[lane] = flight.start.z;
    ray.ray.dir_x[lane] = flight.direction.x;
    ray.ray.dir_y[lane] = flight.direction.y;
    ray.ray.dir_z[lane] = flight.direction.z;
    ray.ray.tnear[lane] = 0.0F;
    ray.ray.tfar[lane] = std::numeric_limits<float>::infinity();
    ray.ray.mask[lane] = 0xFFFFFFFF;
    ray.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  };
  for (std::size_t k = 0; k < flights.size(); ++k) {
    RTCRayHit one{};
    one.ray = {flights[k].start.x,
               flights[k].start.y,
               flights[k].start.z,
               0.0F,
               flights[k].direction.x,
               flights[k].direction.y,
               flights[k].direction.z,
               0.0F,
               std::numeric_limits<float>::infinity(),
               0xFFFFFFFF,
               0,
               0};
    one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    single_fresh.push_back(one);
    if (k % 8 == 0) eight_fresh.emplace_back();
    if (k % 16 == 0) sixteen_fresh.emplace_back();
    fill(eight_fresh.back(), k % 8, flights[k]);
    fill(sixteen_fresh.back(), k % 16, flights[k]);
  }
}

double RawEmbree::trace(int packet) {
  // A query overwrites its ray: the rays are copied a thousand at a time, which fit into the cache.
  constexpr std::size_t at_a_time = 1024;
  const auto run = [](auto& fresh, auto& copy, std::size_t lanes, const auto& intersect) {
    for (std::size_t first = 0; first < fresh.size(); first += at_a_time / lanes) {
      const std::size_t last = std::min(fresh.size(), first + at_a_time / lanes);
      copy.assign(fresh.begin() + static_cast<std::ptrdiff_t>(first),
                  fresh.begin() + static_cast<std::ptrdiff_t>(last));
      for (auto& ray : copy) intersect(ray);
    }
  };
  Data& data = *data_;
  alignas(64) static const std::array<int, 16> all = [] {
    std::array<int, 16> valid{};
    valid.fill(-1);
    return valid;
  }();
  if (packet == 1) run(data.single_fresh, data.single, 1, [&](RTCRayHit& r) { data.query.intersect(data.scene, r); });
  if (packet == 8)
    run(data.eight_fresh, data.eight, 8, [&](RTCRayHit8& r) { data.query.intersect8(all.data(), data.scene, r); });
  if (packet == 16)
    run(data.sixteen_fresh, data.sixteen, 16,
        [&](RTCRayHit16& r) { data.query.intersect16(all.data(), data.scene, r); });
  return static_cast<double>(data.single_fresh.size());
}

}  // namespace lichtmc::bench
