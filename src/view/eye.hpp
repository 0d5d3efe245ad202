// The first visible side along a ray from an eye.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/picture.hpp"
#include "tracer/rays.hpp"
#include "tracer/tracer.hpp"
#include "view/camera.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

// In VisibleHit::tile: a surface that is not measured.
inline constexpr std::uint32_t unmeasured = no_tile - 1;

// The first visible impact of a ray from the eye.
struct VisibleHit {
  std::uint32_t facet = no_facet;
  std::uint32_t tile = no_tile;
  float depth = 0.0F;      // along the ray, in the tracer's coordinates
  glm::vec3 normal{0.0F};  // in the tracer's coordinates
};

// Traces rays through sides without light.
class Eye {
 public:
  static constexpr std::size_t max_rays = 1024;  // traced together

  // Both must outlive the eye.
  Eye(const Scene& scene, const LitSides& lit);

  // Traces n ≤ max_rays rays: hits[k] for ray_of(k), world coordinates.
  template <class RayOf>
  void trace(std::size_t n, const RayOf& ray_of, VisibleHit* hits) {
    for (std::size_t i = 0; i < n; ++i) start(i, ray_of(i));
    finish(n, hits);
  }

 private:
  void start(std::size_t i, const Ray& ray);
  void finish(std::size_t n, VisibleHit* hits);
  void keep_unfinished(VisibleHit* hits);

  const Scene* scene_;
  std::vector<std::uint8_t> opaque_;  // 1: lit and therefore visible; index: 2 · facet + behind
  Rays rays_;
  std::vector<std::uint32_t> hit_;
  std::vector<std::size_t> ray_;  // number of the ray in each lane
  std::vector<float> travelled_;
  std::vector<std::uint32_t> tile_, map_, surface_;
};

}  // namespace lichtmc
