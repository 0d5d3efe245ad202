#include "tracer/embree_tree.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

void throw_embree_error(RTCDevice device, const std::string& what) {
  const RTCError code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_NONE) return;
  const std::string reason = code == RTC_ERROR_OUT_OF_MEMORY     ? "out of memory"
                             : code == RTC_ERROR_UNSUPPORTED_CPU ? "this processor is not supported"
                                                                 : "error " + std::to_string(static_cast<int>(code));
  throw RuntimeError("Embree failed while " + what + " (" + reason +
                     "). Use a machine with more memory, or a smaller room.");
}

}  // namespace

EmbreeTree::EmbreeTree(const Room& room, Edges edges, unsigned threads, const FacesInOnePlane& planes)
    : placement_(placement_of(room)),
      device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str()), &rtcReleaseDevice) {
  if (!device_) throw_embree_error(nullptr, "starting");
  scene_ = {rtcNewScene(device_.get()), &rtcReleaseScene};
  if (edges == Edges::robust) rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  // Medium quality: the same tree for any number of threads.
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_MEDIUM);
  load(make_triangles(room, placement_, threads));
  if (!planes.empty()) step_off_all_planes(planes);
  groups_ = FacetGroups(departures_);
  throw_embree_error(device_.get(), "reading the room");
  rtcCommitScene(scene_.get());
  throw_embree_error(device_.get(), "building the tree of the room's triangles");
}

// Embree has its own copy of vertices and corners, so they are not kept.
void EmbreeTree::load(RoomTriangles triangles) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto fill = [geometry](RTCBufferType type, RTCFormat format, const auto& elements) {
    using Element = std::decay_t<decltype(elements[0])>;
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), elements.size());
    if (buffer != nullptr) std::copy(elements.begin(), elements.end(), static_cast<Element*>(buffer));
  };
  fill(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, triangles.vertices);
  fill(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles.corners);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  departures_ = std::move(triangles.departures);
  first_facet_ = std::move(triangles.first_facet);
}

// A photon that leaves a face starts off all others in its plane: each has a step of its own, and a distance from it by
// rounding.
void EmbreeTree::step_off_all_planes(const FacesInOnePlane& planes) {
  std::vector<double> steps(departures_.size(), 0.0);
  for (std::size_t n = 0; n < departures_.size(); ++n) {
    if (!planes.has_others(n)) continue;
    double step = double{departures_[n].step};
    for (const std::uint32_t other : planes.others(n)) step = std::max(step, double{departures_[other].step});
    steps[n] = step + placement_.scale * planes.gap_m(n);
  }
  for (std::size_t n = 0; n < departures_.size(); ++n) raise_step(departures_[n], steps[n]);
}

}  // namespace lichtmc
