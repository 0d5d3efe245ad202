// The irradiance at a reference point, or its mean over several, by a point emitter with an opening: the mean over
// stratified points of the opening.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "chance/stream.hpp"
#include "walk/area_light_sampling.hpp"
#include "walk/light_source.hpp"
#include "walk/visibility.hpp"

namespace lichtmc {

// Two points in each of n × n strata, n = 4, 8, …: the difference of the two gives the error. The last, largest number
// counts. Arguments as of AreaLightSampler.
template <class ReferenceAt, class Record = NoRecord>
DirectIrradiance sample_opening(const PointLight& light, const Tracer& tracer, const ReferenceAt& reference_at,
                                const Stream& stream, std::uint64_t number, const SamplingAccuracy& accuracy,
                                TraceCount& count, const Record& record = {}) {
  struct Found {
    double irradiance;
    double length_m;
  };
  std::vector<Found> found;
  DirectIrradiance mean;
  for (std::uint32_t n = 4; 2 * n * n <= accuracy.most; n *= 2) {
    found.clear();
    double sum = 0.0;
    double squares = 0.0;
    const auto irradiance = [&](std::uint32_t stratum, std::uint32_t which) {
      const std::uint32_t k = 2 * (n * n + stratum) + which;
      const ReferencePoint reference = reference_at(k);
      const Words words = stream.draw(number, k, Purpose::direct_opening);
      const double u = (stratum % n + unit_open(words[0])) / n;
      const double v = (static_cast<double>(stratum / n) + unit_open(words[1])) / n;
      const LightSample sample = light.sample_light(reference, light.place(u, v));
      if (!(sample.irradiance > 0.0) || is_blocked(tracer, reference, sample.target, count)) return 0.0;
      found.push_back({sample.irradiance, glm::length(sample.target - reference.point)});
      return sample.irradiance;
    };
    for (std::uint32_t stratum = 0; stratum < n * n; ++stratum) {
      const double first = irradiance(stratum, 0);
      const double second = irradiance(stratum, 1);
      sum += first + second;
      squares += (first - second) * (first - second);
    }
    const double strata = static_cast<double>(n) * n;
    mean = {0.5 * sum / strata, 0.5 * std::sqrt(squares) / strata};
    if (mean.standard_error <= std::max(accuracy.relative * mean.value, accuracy.absolute)) break;
  }
  for (const Found& one : found) record(one.irradiance, one.length_m);
  return mean;
}

}  // namespace lichtmc
