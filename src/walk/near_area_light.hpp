// The irradiance by an area light at a point so close to it that samples of its points would be useless: few of them
// fall on the small part that contributes most.
//
// Flights from the point with the density of what it receives (first_flight()) sample it instead. If the emitter is
// Lambertian, uniform and of few triangles, and the field of view is the whole hemisphere, the irradiance without
// shadows is known (the polygon formula), and the flights only estimate what is missing from it: where the emitter lies
// in the direction of a flight, but the flight does not arrive there. If nothing is in between, the value is exact. The
// standard error then is that of −ln(1 − 0.683) = 1.148 missing flights, as for tiles without hits.
#pragma once

#include <cstdint>

#include "chance/stream.hpp"
#include "tracer/tracer.hpp"
#include "walk/area_light_sampling.hpp"
#include "walk/light_source.hpp"
#include "walk/reference_point.hpp"

namespace lichtmc {

// Whether a point is that close: a flight by Lambert's law hits the closest part of the emitter with more than 100
// times the density of a sample uniform over its area. Then fewer than a tenth of those samples fall on this part.
bool is_near(const AreaLight& light, const ReferencePoint& reference);

// The irradiance, by 64 to 16 384 flights until the standard error is small enough. Random words depend on (seed,
// number) only.
DirectIrradiance sample_near_light(const AreaLight& light, const Tracer& tracer, const ReferencePoint& reference,
                                   const Stream& stream, std::uint64_t number, const SamplingAccuracy& accuracy,
                                   TraceCount& count);

}  // namespace lichtmc
