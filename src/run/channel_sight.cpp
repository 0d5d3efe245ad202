#include "run/channel_sight.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lichtmc {

Figure mean_of_sets(const std::array<double, jackknife_groups>& sets) {
  double mean = 0.0;
  double squares = 0.0;
  for (const double one : sets) mean += one / jackknife_groups;
  for (const double one : sets) squares += (one - mean) * (one - mean);
  return {mean, std::sqrt(squares / (jackknife_groups - 1) / jackknife_groups)};
}

void match_direct(LineOfSight& sight, const DirectIrradiance& direct) {
  double exact = 0.0;
  std::array<double, jackknife_groups> of_set{};
  for (const SightPath& path : sight.paths)
    (path.set == SightPath::exact ? exact : of_set[path.set]) += path.irradiance;
  const double sampled = direct.value - exact;
  const double mean = std::accumulate(of_set.begin(), of_set.end(), 0.0) / jackknife_groups;
  if (!(sampled > 0.0) || !(mean > 0.0)) return;
  // Sets without light keep their own differences.
  const bool each = *std::min_element(of_set.begin(), of_set.end()) > 0.0;
  const double step = std::min(1.0, std::sqrt(jackknife_groups - 1.0) * direct.standard_error / sampled);
  for (SightPath& path : sight.paths) {
    if (path.set == SightPath::exact) continue;
    const double higher = path.set % 2 == 0 ? 1.0 + step : 1.0 - step;
    path.irradiance *= each ? sampled * higher / of_set[path.set] : sampled / mean;
  }
}

namespace {

struct TimedGain {
  double time_s;
  double gain;
};

// The response of many paths: those that arrive within 1/64 of the shortest period count at their mean time, which
// changes their part by less than (π/64)²/6 = 4e-4.
void add_paths(Response& response, std::vector<TimedGain>& paths, const std::vector<double>& frequencies_hz) {
  const double together = frequencies_hz.back() > 0.0 ? 1.0 / (64.0 * frequencies_hz.back()) : 0.0;
  std::sort(paths.begin(), paths.end(), [](const TimedGain& a, const TimedGain& b) { return a.time_s < b.time_s; });
  for (std::size_t first = 0; first < paths.size();) {
    DelayMoments sum;
    std::size_t next = first;
    for (; next < paths.size() && paths[next].time_s <= paths[first].time_s + together; ++next)
      sum += DelayMoments{paths[next].gain, paths[next].gain * paths[next].time_s, 0.0};
    add_path(response, sum.weight, sum.mean_s(), frequencies_hz);
    first = next;
  }
}

}  // namespace

SightOfChannel sight_of_group(const LineOfSight& all, std::uint32_t group, double gain, const ChannelAxes& axes,
                              const std::vector<double>& frequencies_hz) {
  SightOfChannel sight;
  sight.response.resize(frequencies_hz.size());
  std::vector<std::vector<TimedGain>> sampled;
  for (const SightPath& path : all.paths) {
    if (path.group != group) continue;
    const double t = path.length_m / speed_of_light;
    const double w = path.irradiance * gain;
    const double position = path.length_m * axes.bins_per_m;
    const std::uint32_t bin = position < axes.bins ? static_cast<std::uint32_t>(position) : axes.bins;
    const DelayMoments own{w, w * t, w * t * t};
    if (path.set == SightPath::exact) {
      sight.exact += own;
      sight.exact_bins.emplace_back(bin, w);
      add_path(sight.response, w, t, frequencies_hz);
      continue;
    }
    if (!sight.sampled) {
      sight.sampled = true;
      sight.response_of_set.assign(jackknife_groups, Response(frequencies_hz.size()));
      sampled.resize(jackknife_groups);
    }
    sight.of_set[path.set] += own;
    const auto place = std::lower_bound(sight.bins.begin(), sight.bins.end(), bin,
                                        [](const auto& one, std::uint32_t b) { return one.first < b; });
    const auto found = place != sight.bins.end() && place->first == bin
                           ? place
                           : sight.bins.insert(place, {bin, std::array<double, jackknife_groups>{}});
    found->second[path.set] += w;
    sampled[path.set].push_back({t, w});
  }
  for (std::size_t set = 0; set < sampled.size(); ++set)
    add_paths(sight.response_of_set[set], sampled[set], frequencies_hz);
  sight.moments = sight.exact;
  for (const DelayMoments& one : sight.of_set) sight.moments += one * (1.0 / jackknife_groups);
  sight.mean_of_sets.resize(sight.sampled ? frequencies_hz.size() : 0);
  for (const Response& one : sight.response_of_set) {
    for (std::size_t f = 0; f < one.size(); ++f) {
      const std::complex<double> part = one[f] / static_cast<double>(jackknife_groups);
      sight.response[f] += part;
      sight.mean_of_sets[f] += part;
    }
  }
  return sight;
}

}  // namespace lichtmc
