#include "backward.hpp"

#include <vector>

#include "lichtmc/tiles.hpp"
#include "measure.hpp"
#include "plain_backward.hpp"
#include "points.hpp"
#include "walk/backward.hpp"
#include "walk/receiver_points.hpp"

namespace lichtmc::bench {

namespace {

constexpr std::uint32_t walks_in_round = 32;

Settings settings_of_walk() {
  Settings settings;
  settings.estimator = Estimator::weight;
  return settings;
}

double variance(double sum, double squares, double n) {
  return (squares - sum * sum / n) / (n - 1.0);
}

}  // namespace

struct BackwardStage::Parts {
  Parts()
      : room(furnished_room()),
        tiling(make_tiling(room, 1.0)),
        scene(room, tiling, Engine::embree),
        light(room, *scene.tracer),
        points(receiver_points(room, *scene.tracer)),
        origins(points, *scene.tracer),
        walk(make_backward_walk(scene, light, origins, BackwardScale(room), settings_of_walk(),
                                {.forward = 0, .backward = walks_in_round})),
        plain(scene, light, points),
        irradiance(points.size()),
        plain_sums(points.size()),
        plain_squares(points.size()) {}

  Room room;
  Tiling tiling;
  Scene scene;
  DirectLight light;
  std::vector<ReferencePoint> points;
  ReceiverOrigins origins;
  std::unique_ptr<BackwardWalk> walk;
  PlainBackward plain;
  std::vector<double> irradiance;
  std::vector<double> plain_sums;
  std::vector<double> plain_squares;
  std::uint64_t next = 0;
  std::uint64_t plain_next = 0;
};

BackwardStage::BackwardStage() : parts_(std::make_unique<Parts>()) {}
BackwardStage::~BackwardStage() = default;

double BackwardStage::walk() {
  Parts& p = *parts_;
  std::fill(p.irradiance.begin(), p.irradiance.end(), 0.0);
  BackwardCount count;
  p.walk->collect({0, p.points.size(), p.next, p.next + walks_in_round}, p.irradiance, count, [] { return false; },
                   nullptr);
  p.next += walks_in_round;
  return static_cast<double>(walks_in_round * p.points.size());
}

double BackwardStage::plain_walk() {
  Parts& p = *parts_;
  p.plain.walk(p.plain_next, walks_in_round, p.plain_sums, p.plain_squares);
  p.plain_next += walks_in_round;
  return static_cast<double>(walks_in_round * p.points.size());
}

BackwardStage::Variances BackwardStage::compare_variances(std::uint64_t walks) {
  Parts& p = *parts_;
  const std::uint64_t rounds = walks / walks_in_round;
  std::fill(p.plain_sums.begin(), p.plain_sums.end(), 0.0);
  std::fill(p.plain_squares.begin(), p.plain_squares.end(), 0.0);
  std::vector<double> sums(p.points.size(), 0.0);
  std::vector<double> squares(p.points.size(), 0.0);
  for (std::uint64_t round = 0; round < rounds; ++round) {
    walk();
    plain_walk();
    for (std::size_t k = 0; k < sums.size(); ++k) {
      sums[k] += p.irradiance[k];
      squares[k] += p.irradiance[k] * p.irradiance[k];
    }
  }
  const auto n = static_cast<double>(rounds);
  std::vector<double> ratios;
  double mean = 0.0;
  double plain_mean = 0.0;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const double plain = variance(p.plain_sums[k], p.plain_squares[k], n * walks_in_round);
    if (!(plain > 0.0)) continue;  // inside a piece of furniture
    const double one = variance(sums[k], squares[k], n) * walks_in_round;
    const double irradiance = sums[k] / n;
    ratios.push_back(one / plain);
    if (!(irradiance > 0.0)) continue;
    mean += one / (irradiance * irradiance);
    plain_mean += plain / (irradiance * irradiance);
  }
  return {median(ratios), mean / plain_mean};
}

}  // namespace lichtmc::bench
