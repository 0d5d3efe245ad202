// Embree 3 (Debian 12) or 4 (Debian 13): the one place where their difference shows.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>  // IWYU pragma: export
#else
#include <embree3/rtcore.h>  // IWYU pragma: export
#endif

namespace lichtmc {

// What accompanies the queries of one wave.
class EmbreeQuery {
 public:
#if RTC_VERSION_MAJOR >= 4
  EmbreeQuery() {
    rtcInitIntersectArguments(&arguments_);
    rtcInitOccludedArguments(&occluded_);
  }
  void intersect(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray, &arguments_);
  }
  void occluded(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &ray, &occluded_);
  }

 private:
  RTCIntersectArguments arguments_{};
  RTCOccludedArguments occluded_{};
#else
  EmbreeQuery() {
    rtcInitIntersectContext(&context_);
  }
  void intersect(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &context_, &ray);
  }
  void occluded(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &context_, &ray);
  }

 private:
  RTCIntersectContext context_{};
#endif
};

}  // namespace lichtmc
