// Interreflection in rooms with exact results.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "chance/significance.hpp"
#include "support/catch.hpp"
#include "support/form_factors.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;

const std::vector<Engine> engines{Engine::cuboid, Engine::embree};
const std::vector<Estimator> estimators{Estimator::weight, Estimator::collision, Estimator::absorption};

Compared mean_irradiance(const Result& result, const std::string& name, double expected) {
  const SurfaceResult& surface = surface_named(result, name);
  return {surface.mean_irradiance, surface.standard_error, expected, 0.0};
}

}  // namespace

TEST_CASE("CIE 171 case 5.6: light from a diffuse surface") {
  // A floor of 4 m × 4 m with exitance M = 1 lm/m²; a black wall 4 m × 2.5 m from 0.5 m up at its edge and a black
  // ceiling 3 m above. Points at half of the width: 100 E/M, and the same closed form averaged over the tiles.
  Room room = make_cuboid({4.0, 3.0, 4.0}, uniform_reflectance(0.0));
  room.emitters.push_back(surface_emitter(0, 16.0));
  const auto on_wall = [](const glm::dvec3& p) { return element_to_perpendicular_rectangle(p.y, p.z, 4.0 - p.z, 4.0); };
  const auto on_ceiling = [](const glm::dvec3& p) {
    return element_to_parallel_rectangle(3.0, p.x, 4.0 - p.x, p.z, 4.0 - p.z);
  };
  for (const auto& [height, value] :
       {std::pair{0.75, 35.900505}, {1.25, 27.991624}, {1.75, 21.638511}, {2.25, 16.716315}, {2.75, 12.967372}}) {
    CHECK(std::abs(100.0 * on_wall({0, height, 2.0}) - value) < 1e-6);
  }
  for (const auto& [x, value] : {std::pair{0.25, 26.795188}, {0.75, 30.938711}, {1.25, 33.975719}, {1.75, 35.566592}}) {
    CHECK(std::abs(100.0 * on_ceiling({x, 3.0, 2.0}) - value) < 1e-6);
  }
  for (const Engine engine : engines) {
    const Result result = simulate(room, settings_of(Estimator::collision, engine, 4e6, 560, 0.25));
    // 16 × 16 midpoints of a tile; below 0.5 m the wall's tiles touch the floor, where E changes fast, and are not part
    // of the case.
    std::vector<Compared> wall;
    for (const Compared& figure : against(result, "wall_x0", [&](const Tile& tile) {
           return tile.point.y < 0.5 ? -1.0 : tile_mean(tile.point, {0, 0.125, 0}, {0, 0, 0.125}, 16, on_wall);
         })) {
      if (figure.expected >= 0.0) wall.push_back(figure);
    }
    REQUIRE(wall.size() == 160);
    const auto ceiling = against(result, "ceiling", [&](const Tile& tile) {
      return tile_mean(tile.point, {0.125, 0, 0}, {0, 0, 0.125}, 16, on_ceiling);
    });
    const Judgement verdict_wall = compare(wall);
    const Judgement verdict_ceiling = compare(ceiling);
    INFO(to_string(engine) << "\nwall: " << verdict_wall.text << "\nceiling: " << verdict_ceiling.text);
    CHECK(verdict_wall.agrees);
    CHECK(verdict_ceiling.agrees);
  }
}

TEST_CASE("CIE 171 case 5.8: the internally reflected component of a cube") {
  // 4 m cube, 10 000 lm isotropic at the centre: mean of every face = direct 104.1667 lx + Φρ/(S(1 − ρ)).
  for (const double rho : {0.05, 0.3, 0.5, 0.8, 0.95}) {
    const double expected = 10000.0 / 96.0 + 10000.0 * rho / (96.0 * (1.0 - rho));
    Room room = make_cuboid({4.0, 4.0, 4.0}, uniform_reflectance(rho));
    room.emitters.push_back(isotropic({2, 2, 2}, 10000.0));
    for (const Engine engine : engines) {
      for (const Estimator estimator : estimators) {
        const Result result = simulate(room, settings_of(estimator, engine, 2e5, 580, 1.0));
        std::vector<Compared> figures;
        for (const SurfaceResult& surface : result.surfaces)
          figures.push_back(mean_irradiance(result, surface.name, expected));
        const Judgement verdict = compare(figures);
        INFO(to_string(engine) << ", " << to_string(estimator) << ", reflectance " << rho << ": " << verdict.text);
        CHECK(verdict.agrees);
        CHECK(result.quantity == Quantity::photometric);
      }
    }
  }
}

TEST_CASE("furnace: irradiance is uniform when every surface emits what it absorbs") {
  // Exitance M = (1 − ρ) K on every wall, each with a ρ of its own: E = K everywhere, in a room of unequal edges.
  constexpr double k = 2.0;
  Room room = make_cuboid({3.0, 2.0, 4.0}, {0.2, 0.9, 0.5, 0.35, 0.7, 0.0});
  for (std::size_t s = 0; s < 6; ++s) {
    room.emitters.push_back(
        surface_emitter(s, (1.0 - room.surfaces[s].reflectance) * k * surface_area(room.surfaces[s])));
  }
  for (const Engine engine : engines) {
    for (const Estimator estimator : estimators) {
      const Result result = simulate(room, settings_of(estimator, engine, 2e6, 34, 0.5));
      std::vector<Compared> figures;
      for (const TileResult& tile : result.tiles) figures.push_back({tile.irradiance, tile.standard_error, k, 0.0});
      const Judgement verdict = compare(figures);
      INFO(to_string(engine) << ", " << to_string(estimator) << ": " << verdict.text);
      CHECK(verdict.agrees);
    }
  }
  // Two reflectances exchanged: the test must reject.
  std::swap(room.surfaces[0].reflectance, room.surfaces[1].reflectance);
  const Result swapped = simulate(room, settings_of(Estimator::collision, Engine::cuboid, 2e6, 34, 0.5));
  std::vector<Compared> figures;
  for (const TileResult& tile : swapped.tiles) figures.push_back({tile.irradiance, tile.standard_error, k, 0.0});
  CHECK_FALSE(compare(figures).agrees);
}

TEST_CASE("integrating sphere: indirect light is the same everywhere") {
  // Isotropic emitter at the centre: every tile has E = Φ/(S(1 − ρ)) in total, direct light on the facets is nearly
  // uniform. The mean over the surface is exact with the mesh's own area; single tiles of the icosphere differ in
  // direct light by their distance, so they are compared with a case without a point emitter: the sphere itself emits.
  Room room = read_gltf(std::string(LICHTMC_SCENES) + "/integrating_sphere.glb");
  REQUIRE(room.surfaces.size() == 1);
  const double rho = room.surfaces[0].reflectance;
  const double power = total_power(room);
  const double area = surface_area(room.surfaces[0]);
  for (const Estimator estimator : estimators) {
    const Result result = simulate(room, settings_of(estimator, Engine::embree, 2e5, 91, 0.2));
    const Judgement verdict = compare({mean_irradiance(result, room.surfaces[0].name, power / (area * (1.0 - rho)))});
    INFO(to_string(estimator) << ": " << verdict.text);
    if (estimator != Estimator::absorption) CHECK(verdict.agrees);
    CHECK(result.lost_histories == 0);
    CHECK(result.balance.escaped == 0.0);
    CHECK(result.surfaces[0].behind_share == 0.0);
  }
  room.emitters = {surface_emitter(0, power)};
  const Result furnace = simulate(room, settings_of(Estimator::collision, Engine::embree, 2e6, 92, 0.2));
  std::vector<Compared> figures;
  for (const TileResult& tile : furnace.tiles)
    figures.push_back({tile.irradiance, tile.standard_error, power / (area * (1.0 - rho)), 0.0});
  const Judgement verdict = compare(figures);
  INFO("uniformly emitting sphere, tile by tile: " << verdict.text);
  CHECK(verdict.agrees);
}

TEST_CASE("open-top cube: the share of light that escapes") {
  // Deterministic radiosity of the cube without its ceiling.
  struct Case {
    Emitter emitter;
    double rho;
    double escaped;
  };
  const Emitter centre = isotropic({0.5, 0.5, 0.5});
  const std::vector<Case> cases{{paper_emitter(), 0.5, 0.16198436}, {paper_emitter(), 0.6, 0.2227789},
                                {paper_emitter(), 0.9, 0.625017},   {centre, 0.5, 0.3024131},
                                {centre, 0.6, 0.3538954},           {centre, 0.9, 0.690326}};
  for (const Estimator estimator : estimators) {
    std::vector<Compared> figures;
    for (const Case& each : cases) {
      const Room room = without_surface(unit_cube(each.rho, each.emitter), "ceiling");
      const Result result = simulate(room, settings_of(estimator, Engine::automatic, 1e6, 44));
      CHECK(result.engine == Engine::embree);
      CHECK(result.lost_histories == 0);
      const Balance& b = result.balance;
      CHECK(std::abs(b.absorbed + b.escaped + b.residual + b.lost - b.emitted) < 1e-9);
      // A history leaves with weight 0 to 1: its variance is at most that of the binomial law.
      figures.push_back({b.escaped, std::sqrt(each.escaped * (1.0 - each.escaped) / 1e6), each.escaped, 0.0});
    }
    // The weight estimator's variance is smaller than the bound, which may make χ² too small: the largest z alone
    // determines the result there.
    const Judgement verdict = compare(figures);
    INFO(to_string(estimator) << ": " << verdict.text);
    CHECK(verdict.largest_z <= largest_z_allowed(figures.size()));
    CHECK(verdict.chi_square <= chi_square_above(static_cast<double>(figures.size()), false_alarm));
  }
}

TEST_CASE("an opening is a black wall") {
  const Room closed_room = [] {
    Room room = unit_cube(0.7, paper_emitter());
    room.surfaces[1].reflectance = 0.0;
    return room;
  }();
  const Result black = simulate(closed_room, settings_of(Estimator::collision, Engine::embree, 1e6, 45));
  const Result open =
      simulate(without_surface(closed_room, "ceiling"), settings_of(Estimator::collision, Engine::embree, 1e6, 46));
  std::vector<Compared> figures;
  for (std::size_t k = 0; k < open.surfaces.size(); ++k) {
    const SurfaceResult& surface = surface_named(black, open.surfaces[k].name);
    figures.push_back({open.surfaces[k].mean_irradiance, open.surfaces[k].standard_error, surface.mean_irradiance,
                       surface.standard_error});
  }
  const Judgement verdict = compare(figures);
  INFO(verdict.text);
  CHECK(verdict.agrees);
  CHECK(open.balance.escaped > 0.0);
}

TEST_CASE("L-room: the end walls exchange no direct light") {
  // Black walls, the end wall z = 2 emits: no light reaches the end wall x = 2 directly, not even along the line of
  // sight that grazes the re-entrant edge.
  Room room = read_gltf(std::string(LICHTMC_SCENES) + "/l_room.gltf");
  for (Surface& surface : room.surfaces) surface.reflectance = 0.0;
  const std::size_t end = surface_number(room, "end_wall_z2");
  REQUIRE(end < room.surfaces.size());
  room.emitters = {surface_emitter(end, 1000.0)};
  const Result result = simulate(room, settings_of(Estimator::collision, Engine::embree, 4e6, 55));
  CHECK(surface_named(result, "end_wall_x2").hits == 0);
  CHECK(result.balance.escaped == 0.0);
  CHECK(result.lost_histories == 0);
  CHECK(result.walk.impacts == result.walk.histories);
}

TEST_CASE("parallel plates exchange light by their form factor") {
  // Unit squares a distance of 1 m apart, one emits, both are black: the flux on the other.
  Room room = make_cuboid({1.0, 1.0, 1.0}, uniform_reflectance(0.0));
  for (const char* name : {"wall_x0", "wall_x1", "wall_z0", "wall_z1"}) room = without_surface(room, name);
  room.emitters.push_back(surface_emitter(0, 1.0));
  const Result result = simulate(room, settings_of(Estimator::collision, Engine::embree, 4e6, 18));
  const SurfaceResult& ceiling = surface_named(result, "ceiling");
  const Judgement verdict =
      compare({{ceiling.power, ceiling.standard_error * ceiling.area_m2, 0.199824895698387, 0.0}});
  INFO(verdict.text);
  CHECK(verdict.agrees);
}
