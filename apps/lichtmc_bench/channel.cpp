#include "channel.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "lichtmc/cuboid.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/simulate.hpp"
#include "measure.hpp"

namespace lichtmc::bench {

namespace {

constexpr double ns = 1e-9;  // s

// A grid at the height of desks of which every third, or tenth, … point is taken.
Room living_room(std::size_t receivers) {
  Room room = read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb");
  room.receivers.clear();
  constexpr std::size_t columns = 40;
  constexpr std::size_t all = 1000;
  for (std::size_t k = 0; k < receivers; ++k) {
    const std::size_t at = k * all / receivers;
    const auto i = static_cast<double>(at % columns);
    const auto j = static_cast<double>(at / columns);
    room.receivers.push_back({"point", {0.1 + 0.128 * i, 0.85, 0.1 + 0.166 * j}, {0, 1, 0}, 90.0, 1e-4});
  }
  return room;
}

Settings receiver_settings(std::uint64_t histories) {
  Settings settings;
  settings.estimator = Estimator::weight;
  settings.measured = lichtmc::Measured::receivers;
  settings.photons = histories;
  settings.threads = 1;
  return settings;
}

struct Seconds {
  double walk = 0.0;
  double whole = 0.0;
  WalkReport report;
};

Seconds time_of(const Room& room, const Settings& settings) {
  Seconds seconds;
  seconds.whole = seconds_of([&] { seconds.report = simulate(room, settings).receiver_walk; });
  seconds.walk = seconds.report.seconds - seconds.report.direct_seconds;
  return seconds;
}

}  // namespace

ChannelCost cost_of_channels(std::size_t receivers, std::uint64_t histories, int turns) {
  const Room room = living_room(receivers);
  Settings without = receiver_settings(histories);
  without.engine = Engine::embree;
  Settings with = without;
  with.channel.bin_width_s = 0.2 * ns;
  with.channel.time_span_s = 400.0 * ns;
  ChannelCost cost;
  for (int turn = 0; turn < turns; ++turn) {
    const Seconds plain = time_of(room, without);
    const Seconds resolved = time_of(room, with);
    if (plain.report.photons_per_round != resolved.report.photons_per_round ||
        plain.report.walks_per_round != resolved.report.walks_per_round)
      throw std::runtime_error("the runs with and without impulse responses have different walks");
    cost.walk.push_back(resolved.walk / plain.walk);
    cost.whole.push_back(resolved.whole / plain.whole);
  }
  return cost;
}

double seconds_to_one_percent_of_bins(std::uint64_t histories) {
  constexpr double target = 0.01;
  constexpr std::size_t first = 15;
  Room room = make_cuboid({5.0, 3.0, 5.0}, {0.3, 0.8, 0.8, 0.8, 0.8, 0.8});
  room.emitters = {{"lamp", 1.0, LambertEmitter{{2.5, 3.0, 2.5}, {0, -1, 0}, 1.0}}};
  room.receivers = {{"eye", {0.5, 0.0, 1.0}, {0, 1, 0}, 85.0, 1e-4}};
  Settings settings = receiver_settings(histories);
  settings.channel.bin_width_s = 1.0 * ns;
  settings.channel.time_span_s = 60.0 * ns;
  const Result result = simulate(room, settings);
  const ImpulseResponses& found = result.channels.value();
  double squares = 0.0;
  for (std::size_t k = first; k < found.bins; ++k) squares += std::pow(found.standard_error_all[k] / found.h_all[k], 2);
  const double ratio = squares / static_cast<double>(found.bins - first) / (target * target);
  return result.receiver_walk.seconds * ratio;
}

}  // namespace lichtmc::bench
