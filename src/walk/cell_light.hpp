// The direct irradiance of a cell of a calculation grid: its mean over the cell, by stratified points.
#pragma once

#include <cstdint>
#include <vector>

#include "chance/stream.hpp"
#include "tracer/tracer.hpp"
#include "walk/area_light_sampling.hpp"
#include "walk/direct_light.hpp"
#include "walk/reference_point.hpp"

namespace lichtmc {

// With the accuracy asked for, as far as some thousand points give it. Samples depend on (seed, number)
// only; shadow rays are counted. of_emitters: as for DirectLight::irradiance_at().
DirectIrradiance cell_irradiance(const DirectLight& light, const Tracer& tracer, const ReferencePoint& cell,
                                 const Stream& stream, std::uint64_t number, const SamplingAccuracy& accuracy,
                                 TraceCount& count, std::vector<DirectIrradiance>* of_emitters = nullptr);

}  // namespace lichtmc
