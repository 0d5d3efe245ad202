// The irradiance by an area light at a reference point, or its mean over several, by stratified samples.
//
// Two kinds of samples: points on the emitter, in strata of its area, and flights from the reference point, in strata
// of its field of view, which may hit the emitter. Both are combined by the balance heuristic (E. Veach, L. Guibas,
// Optimally Combining Sampling Techniques for Monte Carlo Rendering, SIGGRAPH 1995): points are efficient for small
// emitters, flights for near ones and those that fill a narrow field of view. The number of samples doubles until the
// standard error, computed from the differences between the two samples of each stratum, is small enough.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "chance/stream.hpp"
#include "tracer/rays.hpp"
#include "tracer/tracer.hpp"
#include "walk/light_source.hpp"
#include "walk/visibility.hpp"

namespace lichtmc {

struct DirectIrradiance {
  double value = 0.0;           // W/m² or lx
  double standard_error = 0.0;  // 0: exact

  // Adds light whose error is independent.
  void add(const DirectIrradiance& other) {
    value += other.value;
    standard_error = std::hypot(standard_error, other.standard_error);
  }
};

// Required accuracy of a sampled value: the number of pairs of samples doubles from 32 up to `most`/2 until the
// standard error is at most `relative` times the value, or `absolute`.
struct SamplingAccuracy {
  double relative = 1e-3;
  double absolute = 0.0;  // W/m² or lx
  std::uint32_t most = 16384;
};

// Position of sample k of n in [0, 1): two samples in each of n/2 strata.
inline double in_stratum(std::uint32_t k, std::uint32_t n, double u) {
  const std::uint32_t stratum = k / 2;
  const std::uint32_t strata = n / 2;
  return std::min((stratum + u) / strata, 1.0 - 0x1p-53);
}

struct NoRecord {
  void operator()(double /*irradiance*/, double /*length_m*/) const {}
};

// reference_at(n): the reference point of sample n. Random words depend on (seed, number) only. record(irradiance,
// length in m): called for each sample above 0, in units of which the mean over all samples is the irradiance.
template <class ReferenceAt, class Record = NoRecord>
class AreaLightSampler {
 public:
  AreaLightSampler(const AreaLight& light, const Tracer& tracer, const ReferenceAt& reference_at, const Stream& stream,
                   std::uint64_t number, TraceCount& count, const Record& record = {})
      : light_(light),
        tracer_(tracer),
        reference_at_(reference_at),
        stream_(stream),
        number_(number),
        count_(count),
        record_(record),
        pdf_light_(1.0 / light.area_m2()) {}

  DirectIrradiance sample(const SamplingAccuracy& accuracy) {
    std::uint32_t samples = 0;
    DirectIrradiance result;
    for (std::uint32_t level = chunk; level <= accuracy.most; level *= 2) {
      const std::uint32_t fresh = level - samples;
      for (std::uint32_t k = 0; k < fresh; k += 2)
        add_pair(by_point(samples, k, fresh), by_point(samples, k + 1, fresh));
      for (std::uint32_t k = 0; k < fresh; k += chunk) add_flights(samples, k, fresh);
      samples = level;
      // The variance of a pair's mean is its squared difference/4, on average.
      result = {sum_ / samples, std::sqrt(squares_) / samples};
      if (result.standard_error <= std::max(accuracy.relative * result.value, accuracy.absolute)) break;
    }
    return result;
  }

 private:
  static constexpr std::uint32_t chunk = 64;  // flights that are traced together; samples of the first level

  void add_pair(double a, double b) {
    sum_ += a + b;
    squares_ += (a - b) * (a - b);
  }

  // Sample k of n new ones after the first `samples`: a point on the emitter.
  double by_point(std::uint32_t samples, std::uint32_t k, std::uint32_t n) {
    const ReferencePoint reference = reference_at_(samples + k);
    const Words words = stream_.draw(number_, samples + k, Purpose::direct_point);
    const LightSample sample =
        light_.sample_light(reference, in_stratum(k, n, unit_open(words[0])), unit_open(words[1]), unit_open(words[2]));
    if (!(sample.irradiance > 0.0) || is_blocked(tracer_, reference, sample.target, count_)) return 0.0;
    const double pdf_light = pdf_light_ * sample.relative;
    const double part = sample.irradiance * pdf_light / (pdf_light + sample.pdf_bsdf / reference.squared_sine());
    record_(part, glm::length(sample.target - reference.point));
    return part;
  }

  // Samples k … k + chunk − 1 of n new ones: flights from the reference points.
  void add_flights(std::uint32_t samples, std::uint32_t k, std::uint32_t n) {
    std::array<double, chunk> weights;
    std::array<double, chunk> views;
    flights_.size = chunk;
    for (std::uint32_t i = 0; i < chunk; ++i) {
      const ReferencePoint reference = reference_at_(samples + k + i);
      const Words words = stream_.draw(number_, samples + k + i, Purpose::direct_flight);
      views[i] = reference.squared_sine();
      const FirstFlight flight =
          first_flight(reference, in_stratum(k + i, n, unit_open(words[0])), unit_open(words[1]));
      weights[i] = flight.weight;
      flights_.facet[i] = no_facet;
      flights_.set_start(i, glm::vec3(start_of(reference, tracer_)));
      flights_.set_direction(i, glm::vec3(tracer_.directions() * flight.direction));
    }
    tracer_.trace(flights_, Misses::escape, count_);
    for (std::uint32_t i = 0; i < chunk; i += 2)
      add_pair(by_flight(i, weights[i], views[i]), by_flight(i + 1, weights[i + 1], views[i + 1]));
  }

  double by_flight(std::uint32_t i, double weight, double view) const {
    if (flights_.facet[i] == no_facet || flights_.behind[i] != 0) return 0.0;
    if (tracer_.facets()[flights_.facet[i]].surface != light_.surface()) return 0.0;
    const FlightGeometry flight = flight_geometry(tracer_, flights_, i);
    if (flight.degenerate()) return 0.0;
    const double pdf_flight = flight.pdf_bsdf(weight) / view;
    const double relative = light_.relative_exitance(flights_.facet[i], flights_.s[i], flights_.t[i]);
    const double part = view * (light_.radiance(flight.cosine_there) * relative) * std::numbers::pi * pdf_flight /
                        (pdf_flight + pdf_light_ * relative);
    if (part > 0.0) record_(part, flight.length_m);
    return part;
  }

  const AreaLight& light_;
  const Tracer& tracer_;
  const ReferenceAt& reference_at_;
  const Stream& stream_;
  std::uint64_t number_;
  TraceCount& count_;
  Record record_;
  double pdf_light_;  // mean over the emitter
  double sum_ = 0.0;
  double squares_ = 0.0;  // of the differences within pairs
  Rays flights_{chunk};
};

template <class ReferenceAt>
DirectIrradiance sample_area_light(const AreaLight& light, const Tracer& tracer, const ReferenceAt& reference_at,
                                   const Stream& stream, std::uint64_t number, const SamplingAccuracy& accuracy,
                                   TraceCount& count) {
  return AreaLightSampler<ReferenceAt>(light, tracer, reference_at, stream, number, count).sample(accuracy);
}

}  // namespace lichtmc
