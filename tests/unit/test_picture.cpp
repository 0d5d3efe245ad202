#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "lichtmc/error.hpp"
#include "lichtmc/lichtmc.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "view/flat_pieces.hpp"
#include "view/isolines.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

Result simulate_cube(const Room& room, double tile_edge_m = 0.25) {
  return simulate(room, settings_of(Estimator::collision, Engine::automatic, 2e5, 3, tile_edge_m));
}

// A result of tiles of 1 m² with these irradiances, on one surface.
Result result_of(const std::vector<double>& irradiances) {
  Result result;
  result.tiling.maps.emplace_back();
  for (const double irradiance : irradiances) {
    result.tiling.tiles.push_back({0, 0, 0, 0, glm::dvec3(0.0), 1.0});
    TileResult tile;
    tile.irradiance = irradiance;
    result.tiles.push_back(tile);
  }
  return result;
}

// The value of a pixel at a point of the room, in W/m² or lx.
float shown_at(const Picture& picture, const glm::dvec3& place) {
  const glm::dvec4 at = picture.to_pixel * glm::dvec4(place, 1.0);
  const auto x = static_cast<std::size_t>(at.x / at.w);
  const auto y = static_cast<std::size_t>(at.y / at.w);
  REQUIRE(x < picture.width);
  REQUIRE(y < picture.height);
  return picture.irradiance[y * picture.width + x];
}

}  // namespace

TEST_CASE("picture: the colour maps have the published colours at 0, 128/255 and 1") {
  // Matplotlib 3.10, viridis and inferno at 0, 128/255 and 1.
  CHECK(colour_at(ColourMap::viridis, 0.0) == Colour{0x44, 0x01, 0x54});
  CHECK(colour_at(ColourMap::viridis, 128.0 / 255.0) == Colour{0x21, 0x91, 0x8c});
  CHECK(colour_at(ColourMap::viridis, 1.0) == Colour{0xfd, 0xe7, 0x25});
  CHECK(colour_at(ColourMap::inferno, 0.0) == Colour{0x00, 0x00, 0x04});
  CHECK(colour_at(ColourMap::inferno, 128.0 / 255.0) == Colour{0xbc, 0x37, 0x54});
  CHECK(colour_at(ColourMap::inferno, 1.0) == Colour{0xfc, 0xff, 0xa4});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(colour_at(ColourMap::viridis, nan) == colour_at(ColourMap::viridis, -1.0));
  CHECK(colour_at(ColourMap::viridis, 7.0) == colour_at(ColourMap::viridis, 1.0));
}

TEST_CASE("picture: a scale is linear or logarithmic between its ends, and constant beyond them") {
  const ColourScale even{ColourMap::viridis, false, 0.0, 200.0};
  CHECK(even.share(50.0) == 0.25);
  CHECK(even.share(-1.0) == 0.0);
  CHECK(even.share(1e9) == 1.0);
  const ColourScale decades{ColourMap::viridis, true, 1.0, 100.0};
  CHECK(decades.share(10.0) == 0.5);
  CHECK(decades.share(0.0) == 0.0);
}

TEST_CASE("picture: the scale ends at a round number, and 98 percent of the lit area is below it") {
  std::vector<double> irradiances(99, 100.0);
  irradiances.push_back(1e6);  // a sliver at a boundary
  const ColourScale scale = choose_scale(result_of(irradiances));
  CHECK(scale.high == 100.0);
  CHECK(scale.low == 0.0);
  CHECK_FALSE(scale.logarithmic);
  // The irradiance of one half of the room is a hundredth of the other's: a linear scale would show one colour.
  irradiances.assign(60, 1.0);
  irradiances.insert(irradiances.end(), 40, 430.0);
  const ColourScale contrast = choose_scale(result_of(irradiances));
  CHECK(contrast.logarithmic);
  CHECK(contrast.high == 500.0);
  CHECK(contrast.low == 1.0);
  CHECK(choose_scale(result_of(irradiances), {ColourMap::inferno, ScaleType::linear, 750.0}).high == 750.0);
  CHECK(choose_scale(result_of(irradiances), {ColourMap::inferno, ScaleType::linear, 750.0}).low == 0.0);
  CHECK(choose_scale(result_of({0.0, 0.0})).high == 1.0);
  for (const double wrong : {0.0, -1.0, 1e-323, 1e301, std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(choose_scale(result_of({1.0}), {ColourMap::viridis, ScaleType::automatic, wrong}), InputError);
}

TEST_CASE("picture: light reaches only the inner sides of a cube") {
  const Room room = unit_cube(0.5, paper_emitter());
  const Result result = simulate_cube(room);
  const RoomPainter painter(room, result, 1);
  for (const std::vector<SideLight>& surface : painter.lit_sides()) {
    for (const SideLight& side : surface) CHECK(side.front != side.back);
  }
}

TEST_CASE("picture: from above a cube shows the irradiance of its floor, tile by tile, through its ceiling") {
  const Room room = unit_cube(0.5, paper_emitter());
  const Result result = simulate_cube(room);
  const ColourScale scale = choose_scale(result);
  const Picture picture = RoomPainter(room, result, 2).draw(View::above, scale, 200, 160);
  std::size_t seen = 0;
  for (std::size_t t = 0; t < result.tiles.size(); ++t) {
    const Tile& tile = result.tiling.tiles[t];
    if (result.tiling.maps[tile.map].name != "floor") continue;
    ++seen;
    CHECK(shown_at(picture, tile.point) == static_cast<float>(result.tiles[t].irradiance));
  }
  CHECK(seen == 16);
  CHECK(picture.colour[0] == glm::vec4(0.0F));  // beside the room
}

TEST_CASE("picture: from a corner the far walls and the floor are seen, the near ones are not") {
  const Room room = unit_cube(0.5, paper_emitter());
  Result result = simulate_cube(room);
  for (std::size_t t = 0; t < result.tiles.size(); ++t)
    result.tiles[t].irradiance = std::sqrt(2.0 + static_cast<double>(t));  // no mean of several is equal to another
  const Picture picture = RoomPainter(room, result, 2).draw(View::corner, choose_scale(result), 200, 160);
  std::set<float> shown;
  for (const float irradiance : picture.irradiance) {
    if (!std::isnan(irradiance)) shown.insert(irradiance);  // a set cannot order NaN
  }
  std::size_t surfaces = 0;
  for (std::size_t m = 0; m < result.tiling.maps.size(); ++m) {
    std::size_t tiles = 0;
    for (std::size_t t = 0; t < result.tiles.size(); ++t) {
      const bool seen = shown.count(static_cast<float>(result.tiles[t].irradiance)) > 0;
      if (result.tiling.tiles[t].map == m && seen) ++tiles;
    }
    if (tiles >= 12) ++surfaces;
  }
  CHECK(surfaces == 3);
}

TEST_CASE("picture: any number of threads draws the same picture") {
  const Room room = read_gltf(std::string(LICHTMC_SCENES) + "/l_room.gltf");
  const Result result = simulate(room, settings_of(Estimator::collision, Engine::automatic, 5e4, 3, 0.5));
  const ColourScale scale = choose_scale(result);
  const Picture one = RoomPainter(room, result, 1).draw(View::corner, scale, 160, 120);
  const Picture four = RoomPainter(room, result, 4).draw(View::corner, scale, 160, 120);
  CHECK(one.colour == four.colour);
}

TEST_CASE("picture: sizes out of range and results without tiles are refused") {
  const Room room = unit_cube(0.5, paper_emitter());
  const Result result = simulate_cube(room);
  const RoomPainter painter(room, result, 1);
  const ColourScale scale = choose_scale(result);
  CHECK_THROWS_AS(painter.draw(View::above, scale, 15, 100), InputError);
  CHECK_THROWS_AS(painter.draw(View::above, scale, 100, 16385), InputError);
  CHECK_THROWS_AS(draw_plans(room, result, painter.lit_sides(), scale, 12, 5000), InputError);
  CHECK_THROWS_AS(RoomPainter(room, Result{}, 1), InputError);
}

TEST_CASE("plans: every wall of a cube has one, to scale, with each tile in its position") {
  const Room room = unit_cube(0.5, paper_emitter());
  const Result result = simulate_cube(room);
  const RoomPainter painter(room, result, 1);
  const std::vector<SurfacePlan> plans =
      draw_plans(room, result, painter.lit_sides(), choose_scale(result), 12, 120).plans;
  REQUIRE(plans.size() == 6);
  for (const SurfacePlan& plan : plans) {
    INFO(result.tiling.maps[plan.map].name);
    CHECK(plan.flat);
    CHECK(plan.picture.width == 120);
    CHECK(plan.picture.height == 120);
    CHECK(std::abs(plan.area_m2 - 1.0) < 1e-12);
    CHECK(plan.mean_irradiance == Approx(result.surfaces[plan.map].mean_irradiance).epsilon(1e-12));
    for (std::size_t t = 0; t < result.tiles.size(); ++t) {
      if (result.tiling.tiles[t].map != plan.map) continue;
      const glm::dvec3 segment = result.tiling.tiles[t].point - plan.corner;
      const auto x = static_cast<std::size_t>(glm::dot(segment, plan.across) / glm::dot(plan.across, plan.across));
      const auto y = static_cast<std::size_t>(glm::dot(segment, plan.down) / glm::dot(plan.down, plan.down));
      CHECK(plan.picture.irradiance[y * 120 + x] == static_cast<float>(result.tiles[t].irradiance));
    }
    // Walls are upright and seen from inside the room: across × down points from the eye to the wall.
    const glm::dvec3 middle = plan.corner + 60.0 * (plan.across + plan.down);
    const glm::dvec3 outwards = middle - glm::dvec3(0.5);
    if (std::abs(outwards.y) < 0.1) {
      CHECK(plan.down.y < 0.0);
      CHECK(glm::dot(glm::cross(plan.across, plan.down), outwards) > 0.0);
    } else {
      CHECK(plan.across.x > 0.0);
      CHECK(plan.down.z > 0.0);
    }
  }
}

TEST_CASE("plans: plane pieces are found across gaps, and a curved surface has none") {
  Surface surface;
  surface.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {3, 0, 0}, {4, 0, 0},
                       {4, 0, 1}, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}};
  surface.triangles = {{0, 2, 1}, {3, 5, 4}, {6, 8, 7}};
  const std::vector<FlatPiece> pieces = flat_pieces(surface, 0.1);
  REQUIRE(pieces.size() == 2);
  CHECK(pieces[0].triangles == std::vector<std::uint32_t>{0, 1});
  CHECK(pieces[0].area_m2 == 1.0);
  CHECK(pieces[1].triangles == std::vector<std::uint32_t>{2});
  CHECK(flat_pieces(surface, 0.6).size() == 1);

  const Room sphere = read_gltf(std::string(LICHTMC_SCENES) + "/integrating_sphere.glb");
  CHECK(flat_pieces(sphere.surfaces[0], 0.02 * surface_area(sphere.surfaces[0])).empty());
}

TEST_CASE("isolines: those of a plane are straight, those of a cone are circles") {
  IrradianceField field{41, 31, {}, {}};
  for (std::size_t y = 0; y < field.rows; ++y) {
    for (std::size_t x = 0; x < field.columns; ++x) {
      field.values.push_back(static_cast<double>(x) + 0.5 * static_cast<double>(y));
      field.weight.push_back(1.0);
    }
  }
  const std::vector<Isoline> lines = lines_of(field, 20.3);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].points.size() > 30);
  for (const glm::dvec2& p : lines[0].points) CHECK(std::abs(p.x + 0.5 * p.y - 20.3) < 1e-12);

  for (std::size_t k = 0; k < field.values.size(); ++k)
    field.values[k] = glm::length(glm::dvec2(k % field.columns, k / field.columns) - glm::dvec2(20.0, 15.0));
  const std::vector<Isoline> circles = lines_of(field, 10.0);
  REQUIRE(circles.size() == 1);
  CHECK(circles[0].points.front() == circles[0].points.back());
  double length = 0.0;
  for (std::size_t k = 1; k < circles[0].points.size(); ++k) {
    // Between points of the grid the distance is interpolated linearly: its error is below 1/(8 r).
    CHECK(std::abs(glm::length(circles[0].points[k] - glm::dvec2(20.0, 15.0)) - 10.0) < 1.0 / 80.0);
    length += glm::length(circles[0].points[k] - circles[0].points[k - 1]);
  }
  CHECK(length == Approx(20.0 * std::numbers::pi).epsilon(0.01));
}

TEST_CASE("isolines: a saddle is cut into two lines, and lines end where the surface does") {
  IrradianceField field{2, 2, {1.0, 0.0, 0.0, 1.0}, {1.0, 1.0, 1.0, 1.0}};
  CHECK(lines_of(field, 0.5).size() == 2);
  field.weight[0] = 0.0;
  CHECK(lines_of(field, 0.5).empty());
}

TEST_CASE("isolines: smoothing keeps a constant field constant up to its boundary and reduces noise") {
  IrradianceField field{30, 20, std::vector<double>(600, 7.0), std::vector<double>(600, 1.0)};
  for (std::size_t k = 0; k < 600; k += 7) {
    field.weight[k] = 0.0;
    field.values[k] = 1e9;  // beside the surface: no meaning
  }
  for (const double value : smoothed(field, 2.5).values) CHECK(value == Approx(7.0).epsilon(1e-12));
}

TEST_CASE("isolines: levels are round and between the ends") {
  CHECK(round_levels(0.0, 100.0, false) == std::vector<double>{20.0, 40.0, 60.0, 80.0});
  CHECK(round_levels(310.0, 330.0, false) == std::vector<double>{315.0, 320.0, 325.0});
  CHECK(round_levels(0.0, 1000.0, true) == std::vector<double>{20.0, 50.0, 100.0, 200.0, 500.0});
}
