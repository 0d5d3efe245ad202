// The engine compared with the textbook walk, which shares no code with it.
#include <array>
#include <cmath>
#include <vector>

#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/textbook_walk.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr int cells = 10;
constexpr std::array<double, 3> size{1.0, 1.0, 1.0};

// The index at which the textbook walk counts a tile's hits.
std::size_t place_of(const Tile& tile) {
  const std::array<double, 3> at{tile.point.x, tile.point.y, tile.point.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool high = std::abs(at[axis] - size[axis]) < 1e-9;
    if (!high && std::abs(at[axis]) > 1e-9) continue;
    const auto cell = [&](std::size_t k) { return static_cast<std::size_t>(at[k % 3] / size[k % 3] * cells); };
    return ((2 * axis + (high ? 1 : 0)) * cells + cell(axis + 1)) * cells + cell(axis + 2);
  }
  FAIL("a tile on no wall");
  return 0;
}

// Hits per photon and tile, with errors from independent runs.
std::vector<Compared> textbook(const TextbookRoom& room) {
  constexpr int runs = 300;
  constexpr std::uint64_t photons = 10'000;
  std::vector<Compared> tiles(6 * cells * cells);
  std::vector<double> squares(tiles.size());
  std::uint64_t impacts = 0;
  for (int run = 0; run < runs; ++run) {
    const auto hits = textbook_walk(room, photons, 1000 + static_cast<std::uint64_t>(run), impacts);
    for (std::size_t k = 0; k < tiles.size(); ++k) {
      const double per_photon = static_cast<double>(hits[k]) / photons;
      tiles[k].value += per_photon / runs;
      squares[k] += per_photon * per_photon / runs;
    }
  }
  for (std::size_t k = 0; k < tiles.size(); ++k)
    tiles[k].standard_error = std::sqrt((squares[k] - tiles[k].value * tiles[k].value) / (runs - 1));
  return tiles;
}

}  // namespace

TEST_CASE("every tile agrees with the textbook walk, by every estimator and both tracers") {
  TextbookRoom textbook_room;
  textbook_room.size = size;
  textbook_room.reflectance = 0.7;
  textbook_room.emitter = {0.3, 0.8, 0.6};
  textbook_room.exponent = 3.0;
  textbook_room.cells = cells;
  const std::vector<Compared> expected = textbook(textbook_room);

  Room room = make_cuboid({size[0], size[1], size[2]}, uniform_reflectance(0.7));
  room.quantity = Quantity::radiometric;
  room.emitters = {lambert({0.3, 0.8, 0.6}, {0, -1, 0}, 3.0)};
  std::uint64_t seed = 900;
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption}) {
      const Settings settings = settings_of(estimator, engine, 3e6, ++seed);
      const Result result = simulate(room, settings);
      std::vector<Compared> figures;
      for (std::size_t k = 0; k < result.tiles.size(); ++k) {
        const Tile& tile = result.tiling.tiles[k];
        const Compared& other = expected[place_of(tile)];
        figures.push_back({result.tiles[k].irradiance * tile.area_m2, result.tiles[k].standard_error * tile.area_m2,
                           other.value, other.standard_error});
      }
      const Judgement verdict = compare(figures);
      INFO(to_string(engine) << " " << to_string(estimator) << ": " << verdict.text);
      WARN(to_string(engine) << " " << to_string(estimator) << ": " << verdict.text);
      CHECK(verdict.agrees);
    }
  }
}
