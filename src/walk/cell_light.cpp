#include "walk/cell_light.hpp"

#include <cmath>
#include <cstddef>

#include "walk/opening_sampling.hpp"

namespace lichtmc {

namespace {

// The mean by point emitters: two points in each of n × n strata. The difference of the two gives the error.
DirectIrradiance by_points(const DirectLight& light, const Tracer& tracer, const ReferencePoint& cell,
                           const Stream& stream, std::uint64_t number, const SamplingAccuracy& accuracy,
                           TraceCount& count) {
  if (light.points().empty()) return {};
  constexpr std::uint32_t most = 8192;
  DirectIrradiance mean;
  for (std::uint32_t n = 4; 2 * n * n <= most; n *= 2) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::uint32_t k = 0; k < n * n; ++k) {
      const auto irradiance = [&](std::uint32_t sample) {
        const Words words = stream.draw(number, 2 * n * n + 2 * k + sample, Purpose::direct_cell);
        const double s = (k % n + unit_open(words[0])) / n;
        const double t = (k / n + unit_open(words[1])) / n;
        return light.irradiance_by_points(cell.in_cell(s, t, tracer), count);
      };
      const double first = irradiance(0);
      const double second = irradiance(1);
      sum += first + second;
      squares += (first - second) * (first - second);
    }
    const double strata = static_cast<double>(n) * n;
    mean = {0.5 * sum / strata, 0.5 * std::sqrt(squares) / strata};
    if (mean.standard_error <= accuracy.relative * mean.value) break;
  }
  return mean;
}

}  // namespace

DirectIrradiance cell_irradiance(const DirectLight& light, const Tracer& tracer, const ReferencePoint& cell,
                                 const Stream& stream, std::uint64_t number, const SamplingAccuracy& accuracy,
                                 TraceCount& count) {
  DirectIrradiance sum = by_points(light, tracer, cell, stream, number, accuracy, count);
  double variance = sum.standard_error * sum.standard_error;
  const auto add = [&](const DirectIrradiance& part) {
    sum.value += part.value;
    variance += part.standard_error * part.standard_error;
  };
  // Random points of the cell for the samples of an extended light.
  const auto anywhere_by = [&](std::uint64_t own) {
    return [&, own](std::uint32_t sample) {
      const Words words = stream.draw(own, sample, Purpose::direct_place);
      return cell.in_cell(unit_open(words[0]), unit_open(words[1]), tracer);
    };
  };
  for (std::size_t k = 0; k < light.openings().size(); ++k) {
    // Other words than those of area lights.
    const std::uint64_t own = (number * light.openings().size() + k) | std::uint64_t{1} << 63;
    add(sample_opening(light.openings()[k], tracer, anywhere_by(own), stream, own, accuracy, count));
  }
  for (std::size_t k = 0; k < light.areas().size() && !cell.way_out; ++k) {
    const std::uint64_t own = number * light.areas().size() + k;
    const auto anywhere = anywhere_by(own);
    add(sample_area_light(light.areas()[k], tracer, anywhere, stream, own, accuracy, count));
  }
  sum.standard_error = std::sqrt(variance);
  return sum;
}

}  // namespace lichtmc
