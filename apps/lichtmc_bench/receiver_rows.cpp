#include "receiver_rows.hpp"

#include "backward.hpp"
#include "channel.hpp"
#include "direct.hpp"
#include "points.hpp"
#include "storey.hpp"

namespace lichtmc::bench {

namespace {

// Of the rms and of the median receiver, the medians of some turns.
std::vector<Measured> points(const Options& options, const std::string& what, const Room& room, Engine engine,
                             std::uint64_t histories, std::uint64_t plain_walks, double rms_bar, double median_bar) {
  std::vector<double> rms;
  std::vector<double> middle;
  for (int turn = 0; turn < (options.quick ? 1 : 3); ++turn) {
    const TimeRatio ratio = time_of_points(room, engine, histories, plain_walks);
    rms.push_back(ratio.rms);
    middle.push_back(ratio.median);
  }
  std::vector<Measured> measured{
      {what + ", time to 1 % against the plain backward walk", median(rms), rms_bar, true, "", {{"ratios", rms}}}};
  if (median_bar > 0.0)
    measured.push_back({what + ", median point", median(middle), median_bar, true, "", {{"ratios", middle}}});
  return measured;
}

std::vector<Measured> channel(const Options& options, std::size_t receivers, std::uint64_t histories, double bar) {
  const ChannelCost cost =
      cost_of_channels(receivers, options.quick ? histories / 4 : histories, options.quick ? 1 : 3);
  const std::string what = "impulse responses at " + std::to_string(receivers) + " receivers of a living room, ";
  return {
      {what + "time of the walks against the run without", median(cost.walk), bar, false, "", {{"ratios", cost.walk}}},
      {what + "time of the whole", median(cost.whole), bar, false, "", {{"ratios", cost.whole}}}};
}

std::vector<Measured> together(const std::vector<std::vector<Measured>>& parts) {
  std::vector<Measured> all;
  for (const std::vector<Measured>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

Measured backward_speed(const Options& options) {
  BackwardStage stage;
  const Ratio ratio = compare_speeds([&] { return stage.walk(); }, [&] { return stage.plain_walk(); },
                                     (options.quick ? 1 : 3) * options.turns());
  return {"backward walk of a living room, walks per second against the plain one", ratio.value, 2.0, true, "",
          details_of(ratio, "walks_per_second", "plain_walks_per_second")};
}

Measured backward_variance(const Options& options) {
  BackwardStage stage;
  const BackwardStage::Variances found = stage.compare_variances(options.quick ? 1024 : 4096);
  return {"its variance with evenly spread first flights, median point",
          found.median,
          0.6,
          false,
          "",
          {{"median_point", found.median}, {"mean_of_relative_variances", found.mean}}};
}

Measured direct_light(const Options& options) {
  DirectStage stage;
  const Ratio ratio =
      compare_speeds([&] { return stage.all(); }, [&] { return stage.plain_eighth(); }, options.turns());
  return {"direct light of a living room's tiles to a target of 2 %, against integration of each emitter",
          ratio.value,
          10.0,
          true,
          "",
          details_of(ratio, "faces_per_second", "plain_faces_per_second")};
}

Measured many_lamps(const Options& options) {
  const Room one = storey_of_rooms(1, 1);
  const Room storey = storey_of_rooms(5, 4);
  const Ratio ratio = compare_speeds([&] { return points_to_one_percent(storey); },
                                     [&] { return points_to_one_percent(one); }, options.turns());
  return {"points to 1 % per second, 20 rooms with 240 lamps against one with 12", ratio.value, 0.5, true, "",
          details_of(ratio, "storey_points_per_second", "room_points_per_second")};
}

Measured bins_to_one_percent(const Options& options) {
  std::vector<double> times;
  for (int turn = 0; turn < options.turns(); ++turn) times.push_back(seconds_to_one_percent_of_bins(1'000'000));
  return {"impulse response of an empty room, bins of 1 ns from 15 to 60 ns, time to 1 %",
          median(times),
          {},
          false,
          "s",
          {{"times", times}}};
}

std::vector<Measured> points_rows(const Options& options) {
  return together({points(options, "1044 points of a furnished room", furnished_room(), Engine::embree, 20'000'000, 400,
                          10.0, 40.0),
                   points(options, "20 points of an empty room, Embree", empty_room(), Engine::embree, 20'000'000,
                          40'000, 5.0, 0.0),
                   points(options, "20 points of an empty room, closed form", empty_room(), Engine::cuboid, 40'000'000,
                          80'000, 8.0, 0.0)});
}

std::vector<Measured> channel_rows(const Options& options) {
  return together({channel(options, 1000, 16'000'000, 1.25), channel(options, 20, 4'000'000, 1.15)});
}

}  // namespace lichtmc::bench
