#include "walk/channel_axes.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include "room/bounds.hpp"
#include "room/reflectance.hpp"
#include "walk/emitter_groups.hpp"

namespace lichtmc {

namespace {

// Coarse bins, from whose differences between groups of rounds the error of the frequency response follows.
constexpr std::uint32_t usual_coarse_bins = 64;

std::uint32_t whole_bins(double span_s, double width_s) {
  constexpr double rounding = 1e-9;  // a span of 400 bins is 400 bins
  return static_cast<std::uint32_t>(std::max(1.0, std::ceil(span_s / width_s - rounding)));
}

}  // namespace

std::uint32_t usual_bins(const Room& room, double bin_width_s) {
  double area = 0.0;
  double reflected = 0.0;
  for (const Surface& surface : room.surfaces) {
    const double own = surface_area(surface);
    area += own;
    reflected += own * surface.reflectance;
  }
  const Bounds bounds = bounds_of(room);
  const glm::dvec3 size = bounds.high - bounds.low;
  const double box_area = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
  const double mean_flight = box_area > 0.0 ? 4.0 * size.x * size.y * size.z / box_area : 0.0;
  constexpr double later = 1e-4;
  constexpr double highest = 0.97;  // mirror-like rooms: the time span would have no bound
  const double reflectance = std::min(highest, reflected / area);
  const double flights = reflectance > later ? std::log(later) / std::log(reflectance) : 1.0;
  double latest_delay_s = 0.0;
  for (const Emitter& emitter : room.emitters) latest_delay_s = std::max(latest_delay_s, emitter.delay_s);
  const double length_m = 2.0 * glm::length(size) + flights * mean_flight;
  constexpr double most = 8192.0;
  return static_cast<std::uint32_t>(
      std::clamp(std::ceil((length_m / speed_of_light + latest_delay_s) / bin_width_s), 1.0, most));
}

ChannelAxes::ChannelAxes(const Room& room, const Settings& settings) {
  const ChannelSettings& wanted = settings.channel;
  bin_width_s = *wanted.bin_width_s;
  bins = wanted.time_span_s ? whole_bins(*wanted.time_span_s, bin_width_s) : usual_bins(room, bin_width_s);
  bins_per_m = 1.0 / (speed_of_light * bin_width_s);
  orders = wanted.orders;
  columns = orders == 0 ? 1 : orders + 2;
  if (!wanted.squared_weights)
    while (bins >> coarse_shift > usual_coarse_bins) ++coarse_shift;
  coarse_bins = ((bins - 1) >> coarse_shift) + 1;
  frequencies = wanted.frequencies;
  frequency_count = static_cast<std::uint32_t>(frequencies.size());
  EmitterGroups by_name = wanted.per_emitter ? groups_by_name(room) : one_group(room);
  group_names = std::move(by_name.names);
  group_of_emitter = std::move(by_name.of_emitter);
  groups = static_cast<std::uint32_t>(group_names.size());
  for (const Emitter& emitter : room.emitters) delay_m.push_back(emitter.delay_s * speed_of_light);
}

}  // namespace lichtmc
