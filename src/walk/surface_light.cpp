#include "walk/surface_light.hpp"

#include <algorithm>

#include "chance/draw_many.hpp"

namespace lichtmc {

namespace {

LICHTMC_LANES void add_lanes(std::size_t n, const double* LICHTMC_APART some, double* LICHTMC_APART sums) {
  for (std::size_t i = 0; i < n; ++i) sums[i] += some[i];
}

LICHTMC_LANES void divide_by_probability(std::size_t n, const double* LICHTMC_APART probability,
                                         double* LICHTMC_APART irradiance) {
  for (std::size_t i = 0; i < n; ++i) irradiance[i] /= probability[i];
}

LICHTMC_LANES void gather_lanes(std::size_t n, const std::uint32_t* LICHTMC_APART at, const float* LICHTMC_APART from,
                                float* LICHTMC_APART to) {
  for (std::size_t i = 0; i < n; ++i) to[i] = from[at[i]];
}

std::vector<const PointLight*> point_lights(const DirectLight& light) {
  std::vector<const PointLight*> points;
  for (std::size_t k = 0; k < light.sources(); ++k) points.push_back(light.point_light(k));
  return points;
}

}  // namespace

SurfaceLight::SurfaceLight(const DirectLight& light, const Tracer& tracer, const Stream& stream)
    : light_(&light),
      tracer_(&tracer),
      stream_(stream),
      points_(point_lights(light), tracer),
      samples_(batch_histories),
      shadow_rays_(batch_histories),
      tested_(whole_lanes(batch_histories)),
      irradiance_(whole_lanes(batch_histories)),
      cells_(whole_lanes(batch_histories)),
      words_0_(whole_lanes(batch_histories)),
      words_1_(whole_lanes(batch_histories)),
      words_2_3_(whole_lanes(batch_histories)) {}

void SurfaceLight::begin(const Wave& wave) {
  std::fill_n(irradiance_.begin(), wave.rays.size, 0.0);
  if (!light_->takes_all()) find_cells(wave.rays);
}

// One sample for every photon: of source k, or of a chosen one.
void SurfaceLight::sample_one(const Wave& wave, std::uint32_t number, std::size_t k, const double* forward_ratio,
                              TraceCount& count) {
  choose(wave, number, k);
  points_.sample(wave.rays, samples_);
  weigh(wave, forward_ratio);
  if (light_->has_extended_lights()) sample_extended(wave, number, forward_ratio);
  if (tracer_->casts_shadows()) remove_blocked(wave.rays, count);
  add_lanes(wave.rays.size, samples_.irradiance.data(), irradiance_.data());
}

ReferencePoint SurfaceLight::reference_at(const Rays& rays, std::size_t i) const {
  return {tracer_->world_point(glm::dvec3(rays.start(i))), hit_normal(*tracer_, rays, i), 0.0};
}

void SurfaceLight::find_cells(const Rays& rays) {
  for (std::size_t i = 0; i < rays.size; ++i) cells_[i] = light_->cell_of(reference_at(rays, i));
}

void SurfaceLight::choose(const Wave& wave, std::uint32_t number, std::size_t k) {
  const std::size_t n = wave.rays.size;
  if (light_->takes_all()) {
    std::fill_n(samples_.source.begin(), n, static_cast<std::uint32_t>(k));
    return;
  }
  draw_many(stream_, n, wave.history.data(), number, Purpose::light, words_0_.data(), words_1_.data(),
            words_2_3_.data());
  for (std::size_t i = 0; i < n; ++i) {
    const DirectLight::Choice choice = light_->choose_source(cells_[i], unit_fine(words_0_[i], words_1_[i]));
    samples_.source[i] = static_cast<std::uint32_t>(choice.source);
    samples_.probability[i] = choice.probability;
  }
}

// Point lights: see DirectLight::sample_light().
void SurfaceLight::weigh(const Wave& wave, const double* forward_ratio) {
  const std::size_t n = wave.rays.size;
  if (forward_ratio == nullptr) {
    if (!light_->takes_all()) divide_by_probability(n, samples_.probability.data(), samples_.irradiance.data());
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double irradiance = samples_.irradiance[i];
    if (irradiance > 0.0)
      samples_.irradiance[i] = light_->weighted(irradiance, samples_.probability[i], forward_ratio[wave.photon[i]]);
  }
}

void SurfaceLight::sample_extended(const Wave& wave, std::uint32_t number, const double* forward_ratio) {
  const Rays& rays = wave.rays;
  const std::size_t n = rays.size;
  const bool some = std::any_of(samples_.source.begin(), samples_.source.begin() + static_cast<std::ptrdiff_t>(n),
                                [&](std::uint32_t source) { return light_->point_light(source) == nullptr; });
  if (!some) return;
  draw_many(stream_, n, wave.history.data(), number, Purpose::on_light, words_0_.data(), words_1_.data(),
            words_2_3_.data());
  for (std::size_t i = 0; i < n; ++i) {
    if (light_->point_light(samples_.source[i]) != nullptr) continue;
    const Words where{words_0_[i], words_1_[i], static_cast<std::uint32_t>(words_2_3_[i] >> 32),
                      static_cast<std::uint32_t>(words_2_3_[i])};
    const LightSample sample = light_->sample_of({samples_.source[i], samples_.probability[i]}, reference_at(rays, i),
                                                 where, forward_ratio == nullptr ? 0.0 : forward_ratio[wave.photon[i]]);
    samples_.irradiance[i] = sample.irradiance;
    samples_.target[i] = sample.target;
    if (!(sample.irradiance > 0.0) || !tracer_->casts_shadows()) continue;
    const auto segment = shadow_segment(*tracer_, glm::dvec3(rays.start(i)), sample.target);
    samples_.within_reach[i] = segment ? 0 : 1;
    if (!segment) continue;
    samples_.dx[i] = segment->x;
    samples_.dy[i] = segment->y;
    samples_.dz[i] = segment->z;
  }
}

// Samples without irradiance need no shadow ray; the others are traced together.
void SurfaceLight::remove_blocked(const Rays& rays, TraceCount& count) {
  std::size_t tested = 0;
  for (std::uint32_t i = 0; i < rays.size; ++i) {
    tested_[tested] = i;
    tested += samples_.irradiance[i] > 0.0 && samples_.within_reach[i] == 0 ? 1U : 0U;
  }
  if (tested == 0) return;
  ShadowRays& shadow = shadow_rays_;
  shadow.size = tested;
  gather_lanes(tested, tested_.data(), rays.x.data(), shadow.x.data());
  gather_lanes(tested, tested_.data(), rays.y.data(), shadow.y.data());
  gather_lanes(tested, tested_.data(), rays.z.data(), shadow.z.data());
  gather_lanes(tested, tested_.data(), samples_.dx.data(), shadow.dx.data());
  gather_lanes(tested, tested_.data(), samples_.dy.data(), shadow.dy.data());
  gather_lanes(tested, tested_.data(), samples_.dz.data(), shadow.dz.data());
  tracer_->find_blocked(shadow, count);
  for (std::size_t k = 0; k < tested; ++k) {
    if (shadow.blocked[k] != 0) samples_.irradiance[tested_[k]] = 0.0;
  }
}

}  // namespace lichtmc
