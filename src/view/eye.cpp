#include "view/eye.hpp"

namespace lichtmc {

namespace {

constexpr int max_layers = 256;  // transparent sides along a ray; after that it ends without a hit

}  // namespace

Eye::Eye(const Scene& scene, const LitSides& lit)
    : scene_(&scene),
      rays_(max_rays),
      ray_(max_rays),
      travelled_(max_rays),
      tile_(max_rays),
      map_(max_rays),
      surface_(max_rays) {
  for (const std::vector<SideLight>& surface : lit) {
    for (const SideLight& side : surface) {
      opaque_.push_back(side.front ? 1 : 0);
      opaque_.push_back(side.back ? 1 : 0);
    }
  }
}

void Eye::start(std::size_t i, const Ray& ray) {
  const Tracer& tracer = *scene_->tracer;
  rays_.set_start(i, glm::vec3(tracer.tracer_point(ray.start)));
  rays_.set_direction(i, glm::vec3(tracer.directions() * ray.direction));
  rays_.facet[i] = no_facet;
  ray_[i] = i;
  travelled_[i] = 0.0F;
}

void Eye::finish(std::size_t n, VisibleHit* hits) {
  for (std::size_t i = 0; i < n; ++i) hits[i] = VisibleHit{};
  rays_.size = n;
  TraceCount count;
  for (int layer = 0; layer < max_layers && rays_.size > 0; ++layer) {
    scene_->tracer->trace(rays_, Misses::escape, count);
    keep_unfinished(hits);
    scene_->tracer->depart(rays_);
  }
}

// Stores the hits of rays on visible sides and removes these rays; the others continue behind the transparent side.
void Eye::keep_unfinished(VisibleHit* hits) {
  const std::size_t n = rays_.size;
  hit_ = rays_.facet;
  for (std::size_t i = 0; i < whole_lanes(n); ++i) {
    if (i >= n || rays_.facet[i] == no_facet) rays_.facet[i] = 0;
  }
  scene_->tile_of_each(rays_, tile_.data(), map_.data(), surface_.data());
  const std::vector<Facet>& facets = scene_->tracer->facets();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (hit_[i] == no_facet) continue;
    travelled_[i] += rays_.length[i];
    const std::uint32_t behind = rays_.behind[i];
    if (opaque_[2 * std::size_t{hit_[i]} + behind] != 0) {
      const bool measured = scene_->surfaces[surface_[i]].map != SurfaceOptics::no_map;
      hits[ray_[i]] = {hit_[i], measured ? tile_[i] : unmeasured, travelled_[i], facets[hit_[i]].normal};
      continue;
    }
    rays_.move_landing(i, kept);
    rays_.behind[kept] = 1 - behind;
    rays_.set_direction(kept, rays_.direction(i));
    ray_[kept] = ray_[i];
    travelled_[kept] = travelled_[i];
    ++kept;
  }
  rays_.size = kept;
}

}  // namespace lichtmc
