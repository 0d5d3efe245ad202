// Receivers with an empty or full field of view, or on an emitter; and sums over emitters.
#include <cmath>
#include <numbers>

#include "extremes.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

Receiver at(const glm::dvec3& position, const glm::dvec3& normal, double half_angle_deg = 90.0, double area_m2 = 1.0) {
  return {"at", position, normal, half_angle_deg, area_m2};
}

ReceiverResult seen(const Room& empty, const Receiver& receiver, Engine engine, double photons = 1e5) {
  Room room = empty;
  room.receivers = {receiver};
  Settings settings = settings_of(Estimator::collision, engine, photons, 7);
  settings.measured = Measured::receivers;
  const ReceiverResult one = simulate(room, settings).receiver_results.at(0);
  REQUIRE(std::isfinite(one.irradiance));
  REQUIRE(std::isfinite(one.standard_error));
  return one;
}

}  // namespace

TEST_CASE(
    "extreme: a field of view of 0 degrees receives nothing, one of 90 degrees the hemisphere, and larger ones are "
    "refused") {
  const Room room = unit_cube(0.6, isotropic({0.5, 0.8, 0.5}));
  for (const Engine engine : both_engines) {
    CHECK(seen(room, at({0.5, 0.2, 0.5}, {0, 1, 0}, 0.0), engine).irradiance == 0.0);
    // As the floor under it, which has no field of view: 1/(4π r²) plus the indirect light of the room.
    const ReceiverResult whole = seen(room, at({0.5, 0.0, 0.5}, {0, 1, 0}, 90.0), engine);
    CHECK(whole.direct == Approx(1.0 / (4.0 * std::numbers::pi * 0.64)).epsilon(1e-12));
    CHECK(whole.indirect > 0.0);
    for (const double angle : {90.000001, 180.0, -1.0, std::nan("")}) {
      const std::string message = refusal([&] { seen(room, at({0.5, 0.2, 0.5}, {0, 1, 0}, angle), engine); });
      INFO(message);
      CHECK(message.find("field of view") != std::string::npos);
    }
  }
}

TEST_CASE("extreme: an emitter exactly at the edge of the field of view is on the same side of it for both engines") {
  // 45 degrees from the normal, exactly or with a difference in the last digit.
  const Room room = unit_cube(0.0, isotropic({0.75, 0.75, 0.5}));
  const auto direct = [&](Engine engine, double angle) {
    return seen(room, at({0.25, 0.25, 0.5}, {0, 1, 0}, angle), engine, 1024).direct;
  };
  const double whole = direct(Engine::cuboid, 46.0);
  CHECK(whole > 0.0);
  for (const Engine engine : both_engines) {
    CHECK(direct(engine, 46.0) == whole);
    CHECK(direct(engine, 44.0) == 0.0);
    const double on_edge = direct(engine, 45.0);
    CHECK((on_edge == 0.0 || on_edge == whole));
    CHECK(on_edge == direct(Engine::cuboid, 45.0));
  }
}

TEST_CASE("extreme: a receiver that faces away from the emitter gets no direct light") {
  const Room room = unit_cube(0.6, isotropic({0.5, 0.8, 0.5}));
  for (const Engine engine : both_engines) {
    const ReceiverResult away = seen(room, at({0.5, 0.4, 0.5}, {0, -1, 0}), engine);
    CHECK(away.direct == 0.0);
    CHECK(away.indirect > 0.0);
    CHECK(seen(room, at({0.5, 0.8, 0.2}, {0, 1, 0}), engine).direct == 0.0);  // in the plane of the emitter
  }
}

TEST_CASE("extreme: a receiver on an emitter is refused by name") {
  for (const Engine engine : both_engines) {
    const Room room = unit_cube(0.6, isotropic({0.5, 0.8, 0.5}));
    const std::string message = refusal([&] { seen(room, at({0.5, 0.8, 0.5}, {0, 1, 0}), engine); });
    INFO(message);
    CHECK(message.find("'at'") != std::string::npos);
    CHECK(message.find("isotropic") != std::string::npos);
    // A very small distance beside it the position is valid.
    CHECK(seen(room, at({0.5, 0.8 - 1e-9, 0.5}, {0, 1, 0}), engine, 1024).direct > 1e15);
  }
}

TEST_CASE("extreme: a receiver without area has irradiance and no gain") {
  const Room room = unit_cube(0.6, isotropic({0.5, 0.8, 0.5}, 2.0));
  for (const Engine engine : both_engines) {
    const ReceiverResult point = seen(room, at({0.5, 0.2, 0.5}, {0, 1, 0}, 90.0, 0.0), engine);
    CHECK(point.gain == 0.0);
    CHECK(point.irradiance > 0.0);
    const ReceiverResult plate = seen(room, at({0.5, 0.2, 0.5}, {0, 1, 0}, 90.0, 1e-4), engine);
    CHECK(plate.gain == Approx(plate.irradiance * 1e-4 / 2.0).epsilon(1e-14));
  }
}

TEST_CASE("extreme: a whole floor as a receiver equals its tile, not the irradiance at a point times 1 m²") {
  const Room room = unit_cube(0.0, lambert({0.5, 0.5, 0.5}, {0, -1, 0}, 1.0));
  for (const Engine engine : both_engines) {
    Settings settings = settings_of(Estimator::collision, engine, 1e5, 7, 1.0);
    settings.direct = Direct::analytic;
    CHECK(power_on(simulate(room, settings), "floor") == Approx(0.554126423980).epsilon(1e-4));
    // At the point under the emitter: I/r² = (1/π)/0.25.
    CHECK(seen(room, at({0.5, 0.0, 0.5}, {0, 1, 0}), engine, 1024).gain ==
          Approx(4.0 / std::numbers::pi).epsilon(1e-9));
  }
}

TEST_CASE("extreme: two emitters give the sum of each one alone") {
  const Emitter first = lambert({0.3, 0.9, 0.4}, {0, -1, 0}, 3.0, 0.7);
  const Emitter second = isotropic({0.8, 0.5, 0.6}, 0.3);
  for (const Engine engine : both_engines) {
    const auto lit_by = [&](const std::vector<Emitter>& emitters, std::uint64_t seed) {
      Room room = unit_cube(0.6, emitters.front());
      room.emitters = emitters;
      return simulate(room, settings_of(Estimator::collision, engine, 1e6, seed, 0.2));
    };
    const Result both = lit_by({first, second}, 1);
    const Result one = lit_by({first}, 2);
    const Result other = lit_by({second}, 3);
    std::vector<Compared> figures;
    for (std::size_t k = 0; k < both.tiles.size(); ++k) {
      figures.push_back({both.tiles[k].irradiance, both.tiles[k].standard_error,
                         one.tiles[k].irradiance + other.tiles[k].irradiance,
                         std::hypot(one.tiles[k].standard_error, other.tiles[k].standard_error)});
    }
    check_shares(figures);
    Room dark = unit_cube(0.6, first);
    dark.emitters[0].power = 0.0;
    CHECK(refusal([&] { simulate(dark, {}); }).find("power") != std::string::npos);
  }
}
