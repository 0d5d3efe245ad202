// A luminaire with a photometric file in a room that reflects, against illuminances by Radiance.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "lichtmc/photometry.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/verdict.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// A row of radiance.csv: illuminances in lx.
struct Point {
  glm::dvec3 position{0.0};
  double total = 0.0;
  double error = 0.0;
  double direct = 0.0;
};

std::vector<Point> points_of_table() {
  std::vector<Point> points;
  for (const auto& row : read_table(std::string(LICHTMC_TEST_DATA) + "/luminaires/radiance.csv")) {
    points.push_back({{row.at(0), row.at(1), row.at(2)}, row.at(3), row.at(4), row.at(5)});
  }
  return points;
}

Room room_of_table(double rotation_deg, const std::vector<Point>& points) {
  CuboidReflectances reflectances;
  reflectances.x0 = reflectances.x1 = reflectances.z0 = reflectances.z1 = 0.5;
  reflectances.floor = 0.2;
  reflectances.ceiling = 0.7;
  Room room = make_cuboid({4.0, 2.8, 3.0}, reflectances);
  LuminaireOptions options;
  options.rotation_deg = rotation_deg;
  const auto photometry =
      std::make_shared<const Photometry>(read_photometry(std::string(LICHTMC_TEST_DATA) + "/luminaires/c_skew.ies"));
  LuminaireEmitter mounted = mount(photometry, {2.0, 2.3, 1.5}, axes_towards({0.0, -1.0, 0.0}), options, "test");
  room.emitters = {{"luminaire", mounted.power, std::move(mounted.shape)}};
  for (const Point& point : points) {
    Receiver& receiver = room.receivers.emplace_back();
    receiver.name = "p" + std::to_string(room.receivers.size());
    receiver.position = point.position;
    receiver.normal = {0.0, 1.0, 0.0};
  }
  return room;
}

std::vector<Compared> figures_of(const Result& result, const std::vector<Point>& points, double factor = 1.0) {
  std::vector<Compared> figures;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const ReceiverResult& one = result.receiver_results.at(k);
    figures.push_back({one.irradiance, one.standard_error, factor * points[k].total, points[k].error});
  }
  return figures;
}

}  // namespace

TEST_CASE("a luminaire in a room that reflects gives the illuminances of Radiance") {
  const std::vector<Point> points = points_of_table();
  REQUIRE(points.size() == 12);
  const Room room = room_of_table(30.0, points);
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    Settings settings = settings_of(Estimator::weight, engine, 1.5e6, 51);
    settings.measured = Measured::receivers;
    settings.receiver_walk = ReceiverWalk::two_way;
    const Result result = simulate(room, settings);
    const std::string name(to_string(engine));
    check(name, compare(figures_of(result, points), Deviations::correlated));
    check(name + ", 1 % more light", compare(figures_of(result, points, 1.01), Deviations::correlated), false);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const ReceiverResult& one = result.receiver_results.at(k);
      CHECK(std::abs(one.irradiance / points[k].total - 1.0) < 0.01);
      // 0.15 mm of a height of 1.55 m change 1/r² by 2e-4.
      CHECK(std::abs(one.direct / points[k].direct - 1.0) < 2e-4);
    }
  }
  Settings settings = settings_of(Estimator::weight, Engine::cuboid, 1.5e6, 52);
  settings.measured = Measured::receivers;
  const Result turned = simulate(room_of_table(-30.0, points), settings);
  check("rotated the other way", compare(figures_of(turned, points), Deviations::correlated), false);
}
