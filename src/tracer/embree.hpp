// Embree 3 (Debian 12) or 4 (Debian 13): the only file that handles their differences.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>  // IWYU pragma: export
#else
#include <embree3/rtcore.h>  // IWYU pragma: export
#endif

namespace lichtmc {

// The arguments (Embree 4) or the context (Embree 3) for the queries of one wave.
class EmbreeQuery {
 public:
#if RTC_VERSION_MAJOR >= 4
  EmbreeQuery() {
    rtcInitIntersectArguments(&arguments_);
    rtcInitOccludedArguments(&occluded_);
    rtcInitOccludedArguments(&bundle_);
    bundle_.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  }
  void intersect(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray, &arguments_);
  }
  // Packets; valid: −1 for every ray to trace, 0 for the others.
  void intersect8(const int* valid, RTCScene scene, RTCRayHit8& rays) {
    rtcIntersect8(valid, scene, &rays, &arguments_);
  }
  void intersect16(const int* valid, RTCScene scene, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene, &rays, &arguments_);
  }
  void occluded(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &ray, &occluded_);
  }
  // Rays with a common start and similar directions.
  void occluded_bundle(const int* valid, RTCScene scene, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &rays, &bundle_);
  }
  void occluded16(const int* valid, RTCScene scene, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &rays, &occluded_);
  }

 private:
  RTCIntersectArguments arguments_{};
  RTCOccludedArguments occluded_{};
  RTCOccludedArguments bundle_{};
#else
  EmbreeQuery() {
    rtcInitIntersectContext(&context_);
    rtcInitIntersectContext(&bundle_);
    bundle_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
  void intersect(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &context_, &ray);
  }
  // Packets; valid: −1 for every ray to trace, 0 for the others.
  void intersect8(const int* valid, RTCScene scene, RTCRayHit8& rays) {
    rtcIntersect8(valid, scene, &context_, &rays);
  }
  void intersect16(const int* valid, RTCScene scene, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene, &context_, &rays);
  }
  void occluded(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &context_, &ray);
  }
  // Rays with a common start and similar directions.
  void occluded_bundle(const int* valid, RTCScene scene, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &bundle_, &rays);
  }
  void occluded16(const int* valid, RTCScene scene, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &context_, &rays);
  }

 private:
  RTCIntersectContext context_{};
  RTCIntersectContext bundle_{};
#endif
};

}  // namespace lichtmc
