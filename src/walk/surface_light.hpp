// Direct light at the surface points that the photons of a backward wave have left: light samples and their shadow
// rays, all photons together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "chance/stream.hpp"
#include "tracer/tracer.hpp"
#include "walk/direct_light.hpp"
#include "walk/point_lights.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

class SurfaceLight {
 public:
  // Light and tracer must outlive this.
  SurfaceLight(const DirectLight& light, const Tracer& tracer, const Stream& stream);

  // The direct irradiance at the surface point that each photon has left for its next flight, W/m² or lx:
  // irradiance()[i] for position i of the wave. Wave::history must be set. flight: the number of impacts before.
  // forward_ratio: of each photon, by its number, see DirectLight::sample_light(); null: 0 for all. Shadow rays are
  // counted.
  void sample(const Wave& wave, std::uint32_t flight, const double* forward_ratio, TraceCount& count) {
    sample(wave, flight, forward_ratio, count, [](const LightSamples& /*samples*/) {});
  }
  // The same; calls record(samples) for one sample of every photon after the other.
  template <class Record>
  void sample(const Wave& wave, std::uint32_t flight, const double* forward_ratio, TraceCount& count,
              const Record& record) {
    const std::size_t per_point = light_->light_samples_per_point();
    begin(wave);
    for (std::size_t k = 0; k < per_point; ++k) {
      // Separate random words for each emitter at each surface.
      sample_one(wave, static_cast<std::uint32_t>(flight * per_point + k), k, forward_ratio, count);
      record(samples_);
    }
  }

  const std::vector<double>& irradiance() const { return irradiance_; }
  // The cell of each point, see DirectLight::cell_of(), unless all emitters are taken.
  const std::vector<std::uint32_t>& cells() const { return cells_; }

 private:
  void begin(const Wave& wave);
  void sample_one(const Wave& wave, std::uint32_t number, std::size_t k, const double* forward_ratio,
                  TraceCount& count);
  ReferencePoint reference_at(const Rays& rays, std::size_t i) const;
  void find_cells(const Rays& rays);
  void choose(const Wave& wave, std::uint32_t number, std::size_t k);
  void weigh(const Wave& wave, const double* forward_ratio);
  void sample_extended(const Wave& wave, std::uint32_t number, const double* forward_ratio);
  void remove_blocked(const Rays& rays, TraceCount& count);

  const DirectLight* light_;
  const Tracer* tracer_;
  Stream stream_;
  PointLights points_;
  LightSamples samples_;
  ShadowRays shadow_rays_;
  std::vector<std::uint32_t> tested_;  // positions whose shadow rays are traced
  std::vector<double> irradiance_;
  std::vector<std::uint32_t> cells_;
  std::vector<std::uint32_t> words_0_, words_1_;  // random words of draw_many()
  std::vector<std::uint64_t> words_2_3_;
};

}  // namespace lichtmc
