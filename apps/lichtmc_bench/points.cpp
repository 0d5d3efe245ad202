#include "points.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "lichtmc/cuboid.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/simulate.hpp"
#include "lichtmc/tiles.hpp"
#include "measure.hpp"
#include "plain_backward.hpp"
#include "walk/receiver_points.hpp"

namespace lichtmc::bench {

namespace {

// Seconds times the squares of the relative errors: independent of the length of a run.
struct Cost {
  double rms = 0.0;
  double median = 0.0;
};

Cost cost_of(double seconds, std::vector<double> squares) {
  double sum = 0.0;
  for (const double square : squares) sum += square;
  return {seconds * sum / static_cast<double>(squares.size()), seconds * median(std::move(squares))};
}

}  // namespace

TimeRatio time_of_points(const Room& room, Engine engine, std::uint64_t histories, std::uint64_t plain_walks) {
  Settings settings;
  settings.estimator = Estimator::weight;
  settings.engine = engine;
  settings.measured = lichtmc::Measured::receivers;
  settings.photons = histories;
  settings.threads = 1;
  const Result result = simulate(room, settings);

  const Tiling tiling = make_tiling(room, 1.0);
  const Scene scene(room, tiling, engine);
  const DirectLight light(room, *scene.tracer);
  const std::vector<ReferencePoint> points = receiver_points(room, *scene.tracer);
  PlainBackward plain(scene, light, points);
  std::vector<double> sums(points.size(), 0.0);
  std::vector<double> squares(points.size(), 0.0);
  const double plain_seconds = seconds_of([&] { plain.walk(0, plain_walks, sums, squares); });

  const auto n = static_cast<double>(plain_walks);
  std::vector<double> of_run;
  std::vector<double> of_plain;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const ReceiverResult& one = result.receiver_results[k];
    const double variance = (squares[k] - sums[k] * sums[k] / n) / (n - 1.0) / n;
    if (!(one.irradiance > 0.0) || !(variance > 0.0)) continue;
    of_run.push_back(std::pow(one.standard_error / one.irradiance, 2));
    of_plain.push_back(variance / (one.irradiance * one.irradiance));
  }
  const Cost run = cost_of(result.receiver_walk.seconds, std::move(of_run));
  const Cost reference = cost_of(plain_seconds, std::move(of_plain));
  return {reference.rms / run.rms, reference.median / run.median};
}

Room furnished_room() {
  Room room = read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb");
  room.emitters = {{"lamp", 1000.0, IsotropicEmitter{{2.5, 2.2, 2.0}}}};
  room.receivers.clear();
  for (int j = 0; j < 29; ++j) {
    for (int i = 0; i < 36; ++i)
      room.receivers.push_back({"point", {0.115 + 0.142 * i, 0.85, 0.104 + 0.142 * j}, {0, 1, 0}, 90.0, 1.0});
  }
  return room;
}

Room empty_room() {
  Room room = make_cuboid({5.0, 3.0, 4.0}, uniform_reflectance(0.5));
  room.emitters = {{"lamp", 1000.0, IsotropicEmitter{{2.5, 2.2, 2.0}}}};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 5; ++i)
      room.receivers.push_back({"point", {0.5 + i, 0.85, 0.5 + j}, {0, 1, 0}, 90.0, 1.0});
  }
  return room;
}

}  // namespace lichtmc::bench
