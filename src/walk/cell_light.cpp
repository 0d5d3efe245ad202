#include "walk/cell_light.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "walk/opening_sampling.hpp"

namespace lichtmc {

namespace {

// Sums over strata with two points in each: the difference of the two gives the error.
class PairSums {
 public:
  void add(double first, double second) {
    sum_ += first + second;
    squares_ += (first - second) * (first - second);
  }
  DirectIrradiance mean(std::uint32_t n) const {
    const double strata = static_cast<double>(n) * n;
    return {0.5 * sum_ / strata, 0.5 * std::sqrt(squares_) / strata};
  }

 private:
  double sum_ = 0.0;
  double squares_ = 0.0;
};

// The mean by point emitters: two points in each of n × n strata.
DirectIrradiance by_points(const DirectLight& light, const Tracer& tracer, const ReferencePoint& cell,
                           const Stream& stream, std::uint64_t number, const SamplingAccuracy& accuracy,
                           TraceCount& count, std::vector<DirectIrradiance>* of_emitters) {
  if (light.points().empty()) return {};
  constexpr std::uint32_t most = 8192;
  DirectIrradiance mean;
  const std::size_t emitters = of_emitters != nullptr ? of_emitters->size() : 0;
  std::vector<PairSums> sums_of_emitters;
  std::uint32_t divisions = 0;
  for (std::uint32_t n = 4; 2 * n * n <= most; n *= 2) {
    divisions = n;
    PairSums sums;
    sums_of_emitters.assign(emitters, {});
    for (std::uint32_t k = 0; k < n * n; ++k) {
      std::array<std::vector<DirectIrradiance>, 2> parts{std::vector<DirectIrradiance>(emitters),
                                                         std::vector<DirectIrradiance>(emitters)};
      const auto irradiance = [&](std::uint32_t sample) {
        const Words words = stream.draw(number, 2 * n * n + 2 * k + sample, Purpose::direct_cell);
        const double s = (k % n + unit_open(words[0])) / n;
        const double t = (k / n + unit_open(words[1])) / n;
        return light.irradiance_by_points(cell.in_cell(s, t, tracer), count, emitters > 0 ? &parts[sample] : nullptr);
      };
      const double first = irradiance(0);
      const double second = irradiance(1);
      sums.add(first, second);
      for (std::size_t e = 0; e < emitters; ++e) sums_of_emitters[e].add(parts[0][e].value, parts[1][e].value);
    }
    mean = sums.mean(n);
    if (mean.standard_error <= accuracy.relative * mean.value) break;
  }
  for (std::size_t e = 0; e < emitters; ++e) (*of_emitters)[e].add(sums_of_emitters[e].mean(divisions));
  return mean;
}

}  // namespace

DirectIrradiance cell_irradiance(const DirectLight& light, const Tracer& tracer, const ReferencePoint& cell,
                                 const Stream& stream, std::uint64_t number, const SamplingAccuracy& accuracy,
                                 TraceCount& count, std::vector<DirectIrradiance>* of_emitters) {
  DirectIrradiance sum = by_points(light, tracer, cell, stream, number, accuracy, count, of_emitters);
  double variance = sum.standard_error * sum.standard_error;
  const auto add = [&](std::size_t emitter, const DirectIrradiance& part) {
    sum.value += part.value;
    variance += part.standard_error * part.standard_error;
    if (of_emitters != nullptr) (*of_emitters)[emitter].add(part);
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
    add(light.openings()[k].number(),
        sample_opening(light.openings()[k], tracer, anywhere_by(own), stream, own, accuracy, count));
  }
  for (std::size_t k = 0; k < light.areas().size() && !cell.way_out; ++k) {
    const std::uint64_t own = number * light.areas().size() + k;
    const auto anywhere = anywhere_by(own);
    add(light.emitter_of_area(k), sample_area_light(light.areas()[k], tracer, anywhere, stream, own, accuracy, count));
  }
  sum.standard_error = std::sqrt(variance);
  return sum;
}

}  // namespace lichtmc
