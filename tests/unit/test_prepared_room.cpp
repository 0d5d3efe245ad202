#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lichtmc/inspect.hpp"
#include "lichtmc/prepared_room.hpp"
#include "lichtmc/simulate.hpp"
#include "lichtmc/tiles.hpp"
#include "room/faces_in_one_plane.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

Room living_room() {
  return read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb");
}

// Each triangle into four, several times.
Room subdivided(Room room, int times) {
  for (Surface& surface : room.surfaces) {
    for (int n = 0; n < times; ++n) {
      std::vector<glm::uvec3> fine;
      const auto middle = [&surface](std::uint32_t a, std::uint32_t b) {
        surface.positions.push_back(0.5 * (surface.positions[a] + surface.positions[b]));
        if (!surface.uvs.empty()) surface.uvs.push_back(0.5 * (surface.uvs[a] + surface.uvs[b]));
        return static_cast<std::uint32_t>(surface.positions.size() - 1);
      };
      for (const glm::uvec3& t : surface.triangles) {
        const std::uint32_t ab = middle(t.x, t.y);
        const std::uint32_t bc = middle(t.y, t.z);
        const std::uint32_t ca = middle(t.z, t.x);
        fine.insert(fine.end(), {{t.x, ab, ca}, {ab, t.y, bc}, {ca, bc, t.z}, {ab, bc, ca}});
      }
      surface.triangles = std::move(fine);
    }
  }
  return room;
}

void check_same(const Tiling& a, const Tiling& b) {
  REQUIRE(a.tiles.size() == b.tiles.size());
  bool same = true;
  for (std::size_t k = 0; k < a.tiles.size(); ++k) {
    same = same && a.tiles[k].area_m2 == b.tiles[k].area_m2 && a.tiles[k].point == b.tiles[k].point &&
           a.tiles[k].map == b.tiles[k].map && a.tiles[k].column == b.tiles[k].column &&
           a.tiles[k].row == b.tiles[k].row && a.tiles[k].triangle == b.tiles[k].triangle;
  }
  CHECK(same);
  CHECK(a.cells == b.cells);
}

}  // namespace

TEST_CASE("tiles and faces in one plane are the same for any number of threads") {
  Room room = subdivided(living_room(), 2);
  // A board flush with the floor: faces in one plane.
  Surface board = room.surfaces.front();
  board.name = "board";
  for (glm::dvec3& p : board.positions) p = 0.5 * p;
  room.surfaces.push_back(board);
  const Tiling one = make_tiling(room, 0.1, 1);
  check_same(one, make_tiling(room, 0.1, 2));
  check_same(one, make_tiling(room, 0.1, 5));
  const FacesInOnePlane plain(room, 1);
  const FacesInOnePlane shared(room, 3);
  REQUIRE_FALSE(plain.empty());
  REQUIRE(plain.covers().size() == shared.covers().size());
  for (std::size_t k = 0; k < plain.covers().size(); ++k)
    CHECK(plain.covers()[k].area_m2 == shared.covers()[k].area_m2);
  bool same = true;
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    for (std::size_t t = 0; t < room.surfaces[k].triangles.size(); ++t) {
      const std::size_t n = plain.number_of(k, t);
      same = same && plain.has_others(n) == shared.has_others(n);
      if (same && plain.has_others(n))
        same = std::equal(plain.others(n).begin(), plain.others(n).end(), shared.others(n).begin(),
                          shared.others(n).end());
    }
  }
  CHECK(same);
}

TEST_CASE("a prepared room serves inspection and simulation with the same results, each step once") {
  const Room room = subdivided(living_room(), 1);
  Settings settings;
  settings.photons = 20'000;
  settings.threads = 2;
  std::vector<std::string> steps;
  const auto prepared = prepare(room, 2, [&](std::string_view step) { steps.emplace_back(step); });
  CHECK(steps.empty());
  const Inspection with = inspect(room, settings.tile_edge_m, prepared);
  const Inspection without = inspect(room, settings.tile_edge_m);
  CHECK(inspection_json(room, with) == inspection_json(room, without));
  const std::size_t before = steps.size();
  CHECK(before >= 4);

  Control control;
  control.prepared = prepared;
  const Result shared = simulate(room, settings, control);
  CHECK(steps.size() == before);  // tiles, tree and the rest were there
  control.prepared = nullptr;
  std::vector<std::string> told;
  control.progress = [&](const Progress& progress) {
    if (progress.stage == Progress::Stage::preparation) told.emplace_back(progress.step);
  };
  const Result own = simulate(room, settings, control);
  CHECK(told == std::vector<std::string>{"Laying out tiles", "Searching for faces in one plane",
                                         "Building the tree of the triangles", "Joining the meshes"});
  check_same(shared.tiling, own.tiling);
  bool same = shared.tiles.size() == own.tiles.size();
  for (std::size_t k = 0; same && k < own.tiles.size(); ++k)
    same = own.tiles[k].irradiance == shared.tiles[k].irradiance &&
           own.tiles[k].standard_error == shared.tiles[k].standard_error;
  CHECK(same);
}

TEST_CASE("a prepared room belongs to one room") {
  const Room room = living_room();
  const Room other = room;
  CHECK_THROWS_MATCHES(inspect(other, 0.1, prepare(room)), InputError,
                       Catch::Matchers::Predicate<InputError>([](const InputError& error) {
                         return std::string(error.what()).find("prepare() with this room") != std::string::npos;
                       }));
}

// The forecast knows the area only: charts of living_room's tiles take 1.25 cells for each tile of area.
TEST_CASE("the forecast of memory is that of the tiles within a quarter") {
  const Room room = living_room();
  const MemoryForecast forecast = forecast_memory(room, 0.01);
  const double needed = memory_needed(room, make_tiling(room, 0.01));
  CAPTURE(forecast.needed, needed);
  CHECK(forecast.needed > 0.75 * needed);
  CHECK(forecast.needed < 1.25 * needed);
  CHECK(forecast.available > 0.0);
  CHECK(forecast_memory(room, 0.01, 6).needed > 1.5 * forecast.needed);
  const Room fine = subdivided(room, 2);
  const double per_triangle =
      (forecast_memory(fine, 0.1).needed - forecast_memory(room, 0.1).needed) / static_cast<double>(2228 * 15);
  CHECK(per_triangle == Approx(480.0).epsilon(0.01));
}
