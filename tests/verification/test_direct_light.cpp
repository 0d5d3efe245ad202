// Direct light of emitters in black rooms, compared with closed forms.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;

// A rectangle in the plane y = 0 with corner (x, z) and edges along x and z, front up; UVs from 0 to 1.
Surface floor_rectangle(double x, double z, double width, double depth) {
  Surface surface;
  surface.name = "floor";
  surface.reflectance = 0.0;
  surface.positions = {{x, 0, z}, {x + width, 0, z}, {x, 0, z + depth}, {x + width, 0, z + depth}};
  surface.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  surface.triangles = {{0, 2, 1}, {1, 2, 3}};
  return surface;
}

Room floor_and(Emitter emitter, double edge) {
  Room room;
  room.source = "floor";
  room.surfaces.push_back(floor_rectangle(-edge / 2, -edge / 2, edge, edge));
  room.emitters.push_back(std::move(emitter));
  return room;
}

// Mean over a floor tile of edge e by 32 × 32 midpoints: E varies over a tile by some 20 %, the rule's error is
// (1/32)²/24 of that.
double floor_tile_mean(const Tile& tile, double edge, const std::function<double(const glm::dvec3&)>& irradiance) {
  return tile_mean(tile.point, {edge / 2, 0, 0}, {0, 0, edge / 2}, 32, irradiance);
}

Compared share(const Result& result, double expected) {
  const SurfaceResult& floor = result.surfaces.front();
  return {floor.power, floor.standard_error * floor.area_m2, expected, 0.0};
}

}  // namespace

TEST_CASE("CIE 171 case 5.2: a point source over a plane") {
  // 4 m × 4 m, source 3 m above its centre, I0 = 1000 cd, Lambert: E = I0 h²/d⁴ in lx, for example 111.111
  // below, 49.383 at (1.5, 1.5).
  constexpr double height = 3.0;
  const auto lambert_law = [](const glm::dvec3& p) {
    const double d2 = p.x * p.x + p.z * p.z + height * height;
    return 1000.0 * height * height / (d2 * d2);
  };
  REQUIRE(std::abs(lambert_law({0, 0, 0}) - 111.111111) < 1e-6);
  REQUIRE(std::abs(lambert_law({1.5, 0, 1.0}) - 59.975010) < 1e-6);
  REQUIRE(std::abs(lambert_law({1.5, 0, 1.5}) - 49.382716) < 1e-6);
  const Result result = simulate(floor_and(lambert({0, height, 0}, {0, -1, 0}, 1.0, 1000.0 * pi), 4.0),
                                 settings_of(Estimator::collision, Engine::embree, 4e6, 52, 0.25));
  const auto figures =
      against(result, "floor", [&](const Tile& tile) { return floor_tile_mean(tile, 0.25, lambert_law); });
  REQUIRE(figures.size() == 256);
  const Judgement verdict = compare(figures);
  INFO(verdict.text);
  CHECK(verdict.agrees);
  CHECK(result.walk.impacts + static_cast<std::uint64_t>(std::llround(result.balance.escaped / (1000.0 * pi) * 4e6)) ==
        4'000'000);
  // A source 1 % higher must be rejected.
  const auto higher = against(result, "floor", [&](const Tile& tile) {
    return floor_tile_mean(tile, 0.25, [](const glm::dvec3& p) {
      const double h = 1.01 * height;
      const double d2 = p.x * p.x + p.z * p.z + h * h;
      return 1000.0 * h * h / (d2 * d2);
    });
  });
  CHECK_FALSE(compare(higher).agrees);
}

TEST_CASE("generalized Lambert and isotropic emitters over a plane") {
  // E = Φ (m+1)/(2π) h^{m+1}/d^{m+3}; isotropic E = Φ/(4π) h/d³.
  constexpr double height = 1.0;
  for (const double m : {0.0, 2.5, 20.0}) {
    const Result result = simulate(floor_and(lambert({0, height, 0}, {0, -3, 0}, m), 2.0),
                                   settings_of(Estimator::collision, Engine::embree, 2e6, 53, 0.1));
    const Judgement verdict = compare(against(result, "floor", [&](const Tile& tile) {
      return floor_tile_mean(tile, 0.1, [m](const glm::dvec3& p) {
        const double d = std::sqrt(p.x * p.x + p.z * p.z + height * height);
        return (m + 1.0) / (2.0 * pi) * std::pow(height, m + 1.0) / std::pow(d, m + 3.0);
      });
    }));
    INFO("m = " << m << ": " << verdict.text);
    CHECK(verdict.agrees);
  }
  const Result result = simulate(floor_and(isotropic({0, height, 0}), 2.0),
                                 settings_of(Estimator::collision, Engine::embree, 2e6, 54, 0.1));
  const Judgement verdict = compare(against(result, "floor", [&](const Tile& tile) {
    return floor_tile_mean(tile, 0.1, [](const glm::dvec3& p) {
      return height / (4.0 * pi * std::pow(p.x * p.x + p.z * p.z + height * height, 1.5));
    });
  }));
  INFO("isotropic: " << verdict.text);
  CHECK(verdict.agrees);
}

TEST_CASE("a spot light has its specified falloff inside its cone") {
  // I0 = Φ/(2π[(1 − cos i) + (cos i − cos o)/3]); E = I(θ) cos θ/d² with I = I0 a² between the cones.
  constexpr double height = 2.0;
  constexpr double inner = 0.35;
  constexpr double outer = 0.6;  // radius 1.37 m on the floor
  const double on_axis = 100.0 / (2.0 * pi * ((1.0 - std::cos(inner)) + (std::cos(inner) - std::cos(outer)) / 3.0));
  const Result result = simulate(floor_and({"spot", 100.0, SpotEmitter{{0, height, 0}, {0, -1, 0}, inner, outer}}, 3.0),
                                 settings_of(Estimator::collision, Engine::embree, 4e6, 55, 0.1));
  const Judgement verdict = compare(against(result, "floor", [&](const Tile& tile) {
    return floor_tile_mean(tile, 0.1, [&](const glm::dvec3& p) {
      const double d2 = p.x * p.x + p.z * p.z + height * height;
      const double cosine = height / std::sqrt(d2);
      const double a = std::clamp((cosine - std::cos(outer)) / (std::cos(inner) - std::cos(outer)), 0.0, 1.0);
      return on_axis * a * a * cosine / d2;
    });
  }));
  INFO(verdict.text);
  CHECK(verdict.agrees);
  CHECK(std::abs(surface_named(result, "floor").power - 100.0) < 1e-9);  // nothing outside the cone
}

TEST_CASE("a spot with equal cones has a hard edge") {
  // I = Φ/(2π (1 − cos o)) inside the cone, 0 outside; E = I cos θ/d². Tiles of 0.1 m; the edge crosses some 80 of
  // them, where 256 × 256 midpoints give the lit share to some 10⁻³.
  constexpr double height = 2.0;
  constexpr double outer = 0.6;  // radius 1.37 m on the floor
  const auto irradiance_within = [](double angle) {
    const double intensity = 100.0 / (2.0 * pi * (1.0 - std::cos(outer)));
    return [=](const Tile& tile) {
      return tile_mean(tile.point, {0.05, 0, 0}, {0, 0, 0.05}, 256, [&](const glm::dvec3& p) {
        const double d2 = p.x * p.x + p.z * p.z + height * height;
        const double cosine = height / std::sqrt(d2);
        return cosine < std::cos(angle) ? 0.0 : intensity * cosine / d2;
      });
    };
  };
  const Room room = floor_and({"spot", 100.0, SpotEmitter{{0, height, 0}, {0, -1, 0}, outer, outer}}, 3.0);
  Settings settings = settings_of(Estimator::collision, Engine::embree, 2e6, 57, 0.1);
  const Result result = simulate(room, settings);
  CHECK(std::abs(surface_named(result, "floor").power - 100.0) < 1e-9);  // nothing outside the cone
  const Judgement verdict = compare(against(result, "floor", irradiance_within(outer)));
  INFO(verdict.text);
  CHECK(verdict.agrees);
  // The mutation: a cone that is 1 % wider, with the same flux in the narrower one.
  CHECK_FALSE(compare(against(result, "floor", irradiance_within(1.01 * outer))).agrees);

  // Integrated over tiles: no photon is needed. The integration errs by at most 10⁻³ of a tile at the edge, the
  // expectation likewise: the shorter side of the smallest lit piece of a tile is one midpoint in 256.
  settings.direct = Direct::analytic;
  settings.photons = 1000;
  const Result integrated = simulate(room, settings);
  const auto expected = irradiance_within(outer);
  const double full = 100.0 / (2.0 * pi * (1.0 - std::cos(outer))) / (height * height);
  for (std::size_t k = 0; k < integrated.tiles.size(); ++k) {
    INFO("tile " << k);
    CHECK(std::abs(integrated.tiles[k].irradiance - expected(integrated.tiling.tiles[k])) < 2e-3 * full);
  }
}

TEST_CASE("an emitter in a black cube: shares of the faces") {
  const auto floor_share = [](const Emitter& emitter, Engine engine) {
    const Result result = simulate(unit_cube(0.0, emitter), settings_of(Estimator::collision, engine, 2e6, 56));
    CHECK(result.walk.impacts == result.walk.histories);
    return share(result, 0.0);
  };
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    std::vector<Compared> figures;
    const auto add = [&](const Emitter& emitter, double expected) {
      figures.push_back(floor_share(emitter, engine));
      figures.back().expected = expected;
    };
    const glm::dvec3 centre(0.5);
    add(isotropic(centre), 1.0 / 6.0);
    add(lambert(centre, {0, -1, 0}, 1.0), 0.554126423980);  // four corner rectangles, Hottel
    add(lambert(centre, {0, -1, 0}, 0.0), 1.0 / 3.0);
    add(lambert(centre, {0, -1, 0}, 5.0), 0.908183296);
    const Judgement verdict = compare(figures);
    INFO(to_string(engine) << ": " << verdict.text);
    CHECK(verdict.agrees);
  }
}

TEST_CASE("in a black room the three estimators are equal") {
  const Room room = unit_cube(0.0, isotropic({0.3, 0.4, 0.5}));
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    const Result collision = simulate(room, settings_of(Estimator::collision, engine, 50000, 57));
    for (const Estimator estimator : {Estimator::weight, Estimator::absorption}) {
      const Result other = simulate(room, settings_of(estimator, engine, 50000, 57));
      CHECK(other.walk.impacts == 50000);
      bool same = true;
      for (std::size_t i = 0; i < other.tiles.size(); ++i)
        same = same && other.tiles[i].irradiance == collision.tiles[i].irradiance;
      CHECK(same);
    }
  }
}

TEST_CASE("a single triangle receives its solid angle") {
  // Right triangle with legs 1 m, isotropic source 1 m over the right angle: solid angle / 4π.
  Room room;
  room.source = "triangle";
  Surface surface;
  surface.name = "triangle";
  surface.reflectance = 0.0;
  surface.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  surface.triangles = {{0, 2, 1}};
  room.surfaces.push_back(surface);
  room.emitters.push_back(isotropic({0, 1, 0}));
  const Result result = simulate(room, settings_of(Estimator::collision, Engine::embree, 4e6, 58));
  const Judgement verdict = compare({share(result, 0.02704336199)});
  INFO(verdict.text);
  CHECK(verdict.agrees);
  CHECK(std::abs(result.balance.escaped + result.surfaces.front().power - 1.0) < 4.0 * 0x1p-53);
}

TEST_CASE("two emitters give the sum of each one alone") {
  const Emitter a = isotropic({0.3, 0.7, 0.2}, 2.0);
  const Emitter b = lambert({0.8, 0.9, 0.5}, {0.2, -1, 0}, 3.0, 0.5);
  Room both = unit_cube(0.5, a);
  both.emitters.push_back(b);
  const Result sum = simulate(both, settings_of(Estimator::collision, Engine::cuboid, 4e6, 59));
  const Result first = simulate(unit_cube(0.5, a), settings_of(Estimator::collision, Engine::cuboid, 4e6, 60));
  const Result second = simulate(unit_cube(0.5, b), settings_of(Estimator::collision, Engine::cuboid, 4e6, 61));
  std::vector<Compared> figures;
  for (std::size_t i = 0; i < sum.tiles.size(); ++i) {
    figures.push_back({sum.tiles[i].irradiance, sum.tiles[i].standard_error,
                       first.tiles[i].irradiance + second.tiles[i].irradiance,
                       std::hypot(first.tiles[i].standard_error, second.tiles[i].standard_error)});
  }
  const Judgement verdict = compare(figures);
  INFO(verdict.text);
  CHECK(verdict.agrees);
}
