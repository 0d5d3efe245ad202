#include "run/area_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "chance/significance.hpp"
#include "chance/stream.hpp"
#include "run/jackknife.hpp"
#include "walk/jackknife_groups.hpp"

namespace lichtmc {

namespace {

// The points of an area.
struct PointValues {
  std::vector<double> value;         // W/m² or lx
  std::vector<double> direct_error;  // independent errors
  // [point][group of rounds]: by what the mean over all rounds deviates because of this group. They add up to 0.
  std::vector<double> deviations;
  std::size_t groups = 0;

  std::size_t size() const { return value.size(); }
  const double* deviation(std::size_t point) const { return deviations.data() + point * groups; }
};

PointValues points_of(const Area& area, const EmitterParts& parts, const std::vector<double>& factors) {
  PointValues points;
  std::vector<std::size_t> with_rounds;
  std::vector<double> shares;  // of all rounds
  for (std::size_t j = 0; j < parts.group_rounds.size(); ++j) {
    if (parts.group_rounds[j] == 0) continue;
    with_rounds.push_back(j);
    shares.push_back(static_cast<double>(parts.group_rounds[j]) / static_cast<double>(parts.rounds));
  }
  points.groups = with_rounds.size();
  for (std::size_t k = 0; k < area.cells.size(); ++k) {
    const std::size_t receiver = area.first_receiver + k;
    double direct = 0.0;
    double reflected = 0.0;
    double variance = 0.0;
    std::vector<double> deviation(points.groups, 0.0);
    for (std::size_t p = 0; p < factors.size(); ++p) {
      const std::size_t at = parts.at(receiver, p);
      direct += factors[p] * parts.direct[at];
      reflected += factors[p] * parts.reflected[at];
      variance += std::pow(factors[p] * parts.direct_error[at], 2);
      const double* of_group = parts.of_groups.data() + at * parts.group_rounds.size();
      for (std::size_t j = 0; j < points.groups; ++j)
        deviation[j] += factors[p] * shares[j] * (of_group[with_rounds[j]] - parts.reflected[at]);
    }
    points.value.push_back(direct + reflected);
    points.direct_error.push_back(std::sqrt(variance));
    points.deviations.insert(points.deviations.end(), deviation.begin(), deviation.end());
  }
  return points;
}

// The standard error of a sum over points, given what each group of rounds contributes to its deviation.
double error_of_groups(const std::vector<double>& deviations) {
  const auto groups = static_cast<double>(deviations.size());
  if (deviations.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (const double one : deviations) sum += one * one;
  return student_factor(groups - 1.0) * std::sqrt(sum * groups / (groups - 1.0));
}

// A figure with what its error is made of, so that ratios of two figures get theirs.
struct AreaEstimate {
  double value = 0.0;
  std::vector<double> deviations;  // by groups of rounds
  double direct_error = 0.0;
  double bias = 0.0;  // bound of what is left of it

  Figure figure() const { return {value, std::hypot(error_of_groups(deviations), std::hypot(direct_error, bias))}; }
};

AreaEstimate mean_of(const PointValues& points) {
  AreaEstimate mean;
  const auto n = static_cast<double>(points.size());
  mean.deviations.assign(points.groups, 0.0);
  double variance = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    mean.value += points.value[k] / n;
    variance += std::pow(points.direct_error[k] / n, 2);
    for (std::size_t j = 0; j < points.groups; ++j) mean.deviations[j] += points.deviation(k)[j] / n;
  }
  mean.direct_error = std::sqrt(variance);
  return mean;
}

double error_at(const PointValues& points, std::size_t k) {
  std::vector<double> deviations(points.deviation(k), points.deviation(k) + points.groups);
  return std::hypot(error_of_groups(deviations), points.direct_error[k]);
}

// The same random numbers for every area and every run: the figures depend on the sums of a run alone.
constexpr std::uint32_t trials = 200;
double normal_number(std::uint64_t number, std::uint32_t trial) {
  return normal_quantile_above(unit_open(Stream(0).draw(number, trial, Purpose::bootstrap)[0]));
}
// Those of the groups of rounds: [trial][group]. They are needed at every error check.
const std::vector<double>& normals_of_groups() {
  static const std::vector<double> all = [] {
    std::vector<double> normals;
    for (std::uint32_t trial = 0; trial < trials; ++trial) {
      for (std::uint32_t j = 0; j < jackknife_groups; ++j) normals.push_back(normal_number(j, trial));
    }
    return normals;
  }();
  return all;
}

// How much the lowest of some values, varied by their errors, lies below the lowest of the values (≤ 0, but for the
// chance of 200 trials); sign −1: the highest in place of the lowest.
double bias_of_lowest(const PointValues& points, std::size_t lowest, double sign) {
  // Others are lowest in one of 10⁵ trials at most.
  constexpr double far = 4.5;
  const double bound = sign * points.value[lowest] + far * error_at(points, lowest);
  std::vector<std::size_t> candidates;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (sign * points.value[k] - far * error_at(points, k) <= bound) candidates.push_back(k);
  }
  if (candidates.size() < 2) return 0.0;
  const auto groups = static_cast<double>(points.groups);
  const double scale = std::sqrt(groups / (groups - 1.0));
  double sum = 0.0;
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    const double* of_group = normals_of_groups().data() + std::size_t{trial} * jackknife_groups;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t k : candidates) {
      double shift = 0.0;
      for (std::size_t j = 0; j < points.groups; ++j) shift += points.deviation(k)[j] * of_group[j];
      shift *= scale;
      if (points.direct_error[k] > 0.0) shift += points.direct_error[k] * normal_number(jackknife_groups + k, trial);
      least = std::min(least, sign * (points.value[k] + shift));
    }
    sum += least;
  }
  return std::min(0.0, sum / trials - sign * points.value[lowest]);
}

// The lowest value of the points, corrected; sign −1: the highest.
AreaEstimate lowest_of(const PointValues& points, std::size_t lowest, double sign) {
  constexpr double correction = 1.5;
  AreaEstimate extreme;
  extreme.deviations.assign(points.deviation(lowest), points.deviation(lowest) + points.groups);
  extreme.direct_error = points.direct_error[lowest];
  extreme.value = points.value[lowest];
  if (points.groups < 3) return extreme;
  const double bias = bias_of_lowest(points, lowest, sign);
  extreme.value -= sign * correction * bias;
  extreme.bias = std::abs(bias);
  return extreme;
}

// a/b, with the error of the same rounds for both.
Figure ratio_of(const AreaEstimate& a, const AreaEstimate& b) {
  if (!(b.value > 0.0)) return {};
  const double ratio = a.value / b.value;
  std::vector<double> deviations(a.deviations.size());
  for (std::size_t j = 0; j < deviations.size(); ++j) deviations[j] = a.deviations[j] - ratio * b.deviations[j];
  const double direct = std::hypot(a.direct_error, ratio * b.direct_error);
  const double bias = std::hypot(a.bias, ratio * b.bias);
  return {ratio, std::hypot(error_of_groups(deviations), std::hypot(direct, bias)) / b.value};
}

Verdict judge(const Figure& figure, const std::optional<double>& target) {
  if (!target) return Verdict::none;
  constexpr double certain = 2.0;  // standard errors
  if (figure.value - certain * figure.standard_error >= *target) return Verdict::pass;
  if (figure.value + certain * figure.standard_error < *target) return Verdict::fail;
  return Verdict::undecided;
}

Verdict judge_both(Verdict a, Verdict b) {
  if (a == Verdict::fail || b == Verdict::fail) return Verdict::fail;
  if (a == Verdict::undecided || b == Verdict::undecided) return Verdict::undecided;
  return a == Verdict::pass || b == Verdict::pass ? Verdict::pass : Verdict::none;
}

}  // namespace

AreaResult area_figures(const Area& area, const EmitterParts& parts, const std::vector<double>& factors) {
  AreaResult result;
  result.area = area;
  const PointValues points = points_of(area, parts, factors);
  if (points.size() == 0) return result;
  const auto [low, high] = std::minmax_element(points.value.begin(), points.value.end());
  const auto lowest = static_cast<std::size_t>(low - points.value.begin());
  const auto highest = static_cast<std::size_t>(high - points.value.begin());
  const AreaEstimate mean = mean_of(points);
  AreaEstimate minimum = lowest_of(points, lowest, 1.0);
  AreaEstimate maximum = lowest_of(points, highest, -1.0);
  // No lowest value is above the mean, no highest below it.
  minimum.value = std::min(minimum.value, mean.value);
  maximum.value = std::max(maximum.value, mean.value);
  result.mean = mean.figure();
  result.minimum = minimum.figure();
  result.maximum = maximum.figure();
  result.uniformity = ratio_of(minimum, mean);
  result.diversity = ratio_of(minimum, maximum);
  result.lowest = *low;
  result.highest = *high;
  result.lowest_cell = area.cells[lowest];
  result.highest_cell = area.cells[highest];
  return result;
}

std::vector<AreaResult> area_results(const std::vector<Area>& areas, const EmitterParts& parts,
                                     const std::vector<double>& factors) {
  std::vector<double> when_new;
  bool differ = false;
  for (std::size_t p = 0; p < factors.size(); ++p) {
    when_new.push_back(factors[p] / parts.parts[p].maintenance_factor);
    differ = differ || parts.parts[p].maintenance_factor != 1.0;
  }
  std::vector<AreaResult> results;
  for (const Area& area : areas) {
    AreaResult result = area_figures(area, parts, factors);
    const AreaResult initial = differ ? area_figures(area, parts, when_new) : result;
    result.initial_mean = initial.mean;
    result.initial_minimum = initial.minimum;
    result.initial_maximum = initial.maximum;
    result.mean_verdict = judge(result.mean, area.properties.target_lx);
    result.uniformity_verdict = judge(result.uniformity, area.properties.target_uniformity);
    result.verdict = judge_both(result.mean_verdict, result.uniformity_verdict);
    results.push_back(std::move(result));
  }
  return results;
}

AreaErrors largest_errors(const std::vector<Area>& areas, const EmitterParts& parts, double floor) {
  AreaErrors largest;
  const std::vector<double> undimmed(parts.parts.size(), 1.0);
  const auto raise = [](double& to, const Figure& figure, double least) {
    if (figure.standard_error == 0.0 || std::isnan(to)) return;  // exact, also where there is no light
    const double relative = figure.standard_error / std::max(figure.value, least);
    to = std::isnan(relative) ? relative : std::max(to, relative);
  };
  for (const Area& area : areas) {
    const AreaResult result = area_figures(area, parts, undimmed);
    for (const Figure* figure : {&result.mean, &result.minimum}) {
      raise(largest.relative, *figure, floor);
      raise(largest.without_floor, *figure, 0.0);
    }
  }
  return largest;
}

}  // namespace lichtmc
