#include "walk/near_area_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tracer/rays.hpp"
#include "walk/visibility.hpp"

namespace lichtmc {

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::uint32_t chunk = 64;  // flights that are traced together
// For an emitter with more triangles, testing all of them for every flight would cost more than the flights.
constexpr std::size_t most_triangles = 256;

class NearLightSampler {
 public:
  NearLightSampler(const AreaLight& light, const Tracer& tracer, const ReferencePoint& reference, const Stream& stream,
                   std::uint64_t number, TraceCount& count)
      : light_(light),
        tracer_(tracer),
        reference_(reference),
        stream_(stream),
        number_(number),
        count_(count),
        start_(start_of(reference, tracer)),
        view_(reference.squared_sine()),
        complement_(light.has_closed_form() && light.triangles() <= most_triangles && sees_hemisphere(reference)) {}

  DirectIrradiance sample(const SamplingAccuracy& accuracy) {
    const double unshadowed = complement_ ? light_.polygon_irradiance(reference_) : 0.0;
    std::uint32_t samples = 0;
    DirectIrradiance result;
    for (std::uint32_t level = chunk; level <= accuracy.most; level *= 2) {
      const std::uint32_t fresh = level - samples;
      for (std::uint32_t k = 0; k < fresh; k += chunk) add_flights(samples, k, fresh);
      samples = level;
      // If 1.148 events are expected, none occur with the probability of 32 %: their number k has at least the error
      // √(k + 1.148²), also for k = 0.
      constexpr double unseen = 1.148 * 1.148;
      const double error = std::sqrt(squares_ + unseen * unit() * unit()) / samples;
      result = {std::max(0.0, unshadowed + sum_ / samples), error};
      if (result.standard_error <= accuracy.relative * result.value) break;
    }
    return result;
  }

 private:
  // The score of one flight that arrives; of the largest, if they differ. An emitter with a map may have a small bright
  // part that no flight has hit yet.
  double unit() const { return std::max(largest_, pi * view_ * light_.mean_radiance() * light_.highest_exitance()); }

  // Flights k … k + chunk − 1 of n new ones after the first `samples`.
  void add_flights(std::uint32_t samples, std::uint32_t k, std::uint32_t n) {
    flights_.size = chunk;
    for (std::uint32_t i = 0; i < chunk; ++i) {
      const Words words = stream_.draw(number_, samples + k + i, Purpose::direct_flight);
      const FirstFlight flight =
          first_flight(reference_, in_stratum(k + i, n, unit_open(words[0])), unit_open(words[1]));
      flights_.facet[i] = no_facet;
      flights_.set_start(i, glm::vec3(start_));
      flights_.set_direction(i, glm::vec3(tracer_.directions() * flight.direction));
    }
    tracer_.trace(flights_, Misses::escape, count_);
    for (std::uint32_t i = 0; i < chunk; i += 2) {
      const double a = score(i);
      const double b = score(i + 1);
      sum_ += a + b;
      squares_ += (a - b) * (a - b);
      largest_ = std::max({largest_, std::abs(a), std::abs(b)});
    }
  }

  double score(std::uint32_t i) const {
    const bool hits = flights_.facet[i] != no_facet && flights_.behind[i] == 0 &&
                      tracer_.facets()[flights_.facet[i]].surface == light_.surface();
    if (complement_) {
      const glm::dvec3 direction = tracer_.world_vector(glm::dvec3(flights_.direction(i)));
      const int fronts = light_.fronts_hit(tracer_.world_point(glm::dvec3(flights_.start(i))), direction);
      return pi * light_.radiance(1.0) * ((hits ? 1 : 0) - fronts);
    }
    if (!hits) return 0.0;
    const FlightGeometry flight = flight_geometry(tracer_, flights_, i);
    if (flight.degenerate()) return 0.0;
    return pi * view_ * light_.radiance(flight.cosine_there) *
           light_.relative_exitance(flights_.facet[i], flights_.s[i], flights_.t[i]);
  }

  const AreaLight& light_;
  const Tracer& tracer_;
  const ReferencePoint& reference_;
  const Stream& stream_;
  std::uint64_t number_;
  TraceCount& count_;
  glm::dvec3 start_;  // in the tracer's coordinates
  double view_;
  bool complement_;  // scores are what is missing from the irradiance without shadows
  double sum_ = 0.0;
  double squares_ = 0.0;  // of the differences within pairs
  double largest_ = 0.0;
  Rays flights_{chunk};
};

}  // namespace

// At the distance d the density of flights per area is at most 1/(π d²).
bool is_near(const AreaLight& light, const ReferencePoint& reference) {
  constexpr double times = 100.0;
  const double distance = light.distance_m(reference.point);
  return times * pi * distance * distance < light.area_m2();
}

DirectIrradiance sample_near_light(const AreaLight& light, const Tracer& tracer, const ReferencePoint& reference,
                                   const Stream& stream, std::uint64_t number, const SamplingAccuracy& accuracy,
                                   TraceCount& count) {
  if (reference.law == ReceiverLaw::planar && !light.reaches_above_horizon(reference)) return {};
  return NearLightSampler(light, tracer, reference, stream, number, count).sample(accuracy);
}

}  // namespace lichtmc
