// Measured luminaires at the extremes: beams of a hundredth of a degree, tables with one bright value, openings without
// size and larger than the room, places far from the origin, fluxes of any size.
#include <cmath>
#include <memory>
#include <vector>

#include "lichtmc/photometry.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

std::shared_ptr<Photometry> rotational(std::vector<double> angles, std::vector<double> candela) {
  auto photometry = std::make_shared<Photometry>();
  photometry->source = "test";
  photometry->intensity_unit = "cd";
  photometry->candela = std::make_shared<const CandelaTable>(CandelaTable::Grid{
      PhotometricType::c, PhotometricSymmetry::rotational, {0}, std::move(angles), std::move(candela)});
  return photometry;
}

Emitter downwards(std::shared_ptr<const Photometry> photometry, const glm::dvec3& position, double power = 1.0) {
  return {"luminaire", power, MeasuredEmitter{std::move(photometry), position}};
}

Room box_with(const Emitter& emitter, double reflectance = 0.0) {
  Room room = make_cuboid({4.0, 3.0, 5.0}, uniform_reflectance(reflectance));
  room.emitters = {emitter};
  return room;
}

// The light that falls on the tile of the floor at this place, as a part of all.
double on_floor(const Result& result, double x, double z) {
  for (std::size_t k = 0; k < result.tiles.size(); ++k) {
    const Tile& tile = result.tiling.tiles[k];
    if (result.tiling.maps[tile.map].name != "floor") continue;
    const double half = 0.5 * std::sqrt(tile.area_m2);
    if (std::abs(tile.point.x - x) <= half && std::abs(tile.point.z - z) <= half) return result.tiles[k].power;
  }
  return -1.0;
}

}  // namespace

TEST_CASE("extreme: a beam of a hundredth of a degree falls on one tile, by photons and integrated") {
  const auto beam = rotational({0, 0.005, 0.01, 90}, {1e9, 1e9, 0, 0});
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    Settings settings = settings_of(Estimator::collision, engine, 1e5, 1, 0.5);
    const Room room = box_with(downwards(beam, {1.1, 2.5, 2.2}));
    CHECK(on_floor(simulate(room, settings), 1.25, 2.25) == Approx(1.0).epsilon(1e-12));
    settings.tile_walk = WalkDirection::backward;
    CHECK(on_floor(simulate(room, settings), 1.25, 2.25) == Approx(1.0).epsilon(2e-3));
  }
}

TEST_CASE("extreme: a table with one value above 0 gives all its light about that direction") {
  std::vector<double> candela(8 * 19, 0.0);
  candela[3 * 19 + 6] = 1e-6;
  CandelaTable::Grid grid{
      PhotometricType::c, PhotometricSymmetry::c0_c180, {0, 10, 20, 45, 90, 120, 150, 180}, {}, candela};
  for (int k = 0; k < 19; ++k) grid.vertical_deg.push_back(10.0 * k);
  const CandelaTable table(grid);
  for (int k = 0; k < 1000; ++k) {
    const glm::dvec3 d = table.sample((k + 0.5) / 1000, std::fmod(0.618 * k, 1.0));
    const double polar = std::acos(d.z) * 57.29577951308232;
    const double azimuth = std::abs(std::atan2(d.y, d.x)) * 57.29577951308232;
    REQUIRE((polar >= 50.0 && polar <= 70.0));
    REQUIRE((azimuth >= 20.0 && azimuth <= 90.0));
    REQUIRE(table.candela(d) > 0.0);
  }
}

TEST_CASE("extreme: fluxes of luminaires from 10⁻³⁰ to 10³⁰ lm scale all figures") {
  const auto table = rotational({0, 30, 90}, {100, 80, 0});
  const Settings settings = settings_of(Estimator::collision, Engine::embree, 2e4, 2, 0.5);
  const Result one = simulate(box_with(downwards(table, {2, 2.5, 2.5}), 0.5), settings);
  for (const double power : {1e-30, 1e30}) {
    const Result other = simulate(box_with(downwards(table, {2, 2.5, 2.5}, power), 0.5), settings);
    for (std::size_t k = 0; k < one.tiles.size(); ++k)
      REQUIRE(other.tiles[k].irradiance == Approx(power * one.tiles[k].irradiance).epsilon(1e-12));
  }
}

TEST_CASE("extreme: a luminaire a thousand kilometres from the origin lights its room as one at the origin") {
  const auto table = rotational({0, 30, 90}, {100, 80, 0});
  const Settings settings = settings_of(Estimator::collision, Engine::embree, 2e5, 3, 1.0);
  const Result here = simulate(box_with(downwards(table, {2, 2.5, 2.5}), 0.5), settings);
  Room far = box_with(downwards(table, {2e0 + 1e6, 2.5, 2.5}), 0.5);
  for (Surface& surface : far.surfaces) {
    for (glm::dvec3& position : surface.positions) position.x += 1e6;
  }
  Settings others = settings;
  others.seed = 33;
  const Judgement verdict = compare(against(here, simulate(far, others)));
  INFO(verdict.text);
  CHECK(verdict.agrees);
}

TEST_CASE("extreme: an opening of a nanometre is a point; one larger than the room loses what starts outside") {
  const auto table = rotational({0, 60, 90}, {100, 100, 100});
  Emitter emitter = downwards(table, {2, 1.5, 2.5});
  const Settings settings = settings_of(Estimator::collision, Engine::embree, 2e5, 4, 1.0);
  const Result point = simulate(box_with(emitter), settings);
  std::get<MeasuredEmitter>(emitter.shape).opening = LuminousOpening{OpeningForm::rectangle, {1e-9, 1e-9, 0.0}};
  Settings others = settings;
  others.seed = 44;
  const Judgement verdict = compare(against(point, simulate(box_with(emitter), others)));
  INFO(verdict.text);
  CHECK(verdict.agrees);
  // Half of the opening lies outside of the walls x = 0 and x = 4, from where no light enters a closed room.
  std::get<MeasuredEmitter>(emitter.shape).opening = LuminousOpening{OpeningForm::rectangle, {8.0, 4.0, 0.0}};
  const Result lost = simulate(box_with(emitter), settings);
  double inside = 0.0;
  for (const SurfaceResult& surface : lost.surfaces) inside += surface.power;
  const double total = lost.balance.emitted;
  CHECK(lost.balance.absorbed + lost.balance.escaped == Approx(total).epsilon(1e-9));
  CHECK(std::isfinite(inside));
}

TEST_CASE("extreme: a luminaire flush with the ceiling gives all its downward light to the room") {
  const auto table = rotational({0, 60, 90}, {100, 60, 0});
  for (const bool opens : {false, true}) {
    Emitter emitter = downwards(table, {2, 3.0, 2.5});
    if (opens)
      std::get<MeasuredEmitter>(emitter.shape).opening = LuminousOpening{OpeningForm::rectangle, {1.2, 0.6, 0.0}};
    for (const Engine engine : {Engine::cuboid, Engine::embree}) {
      const Result result = simulate(box_with(emitter), settings_of(Estimator::collision, engine, 1e5, 5, 1.0));
      CHECK(result.balance.escaped == 0.0);
      CHECK(result.balance.absorbed == Approx(1.0).epsilon(1e-12));
    }
  }
}
