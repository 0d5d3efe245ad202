// Faces that light cannot reach are found from the room alone and left out of the means.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// Appends the triangles of a cuboid, with its normals inwards, to a surface.
void add_cuboid(Surface& surface, const glm::dvec3& low, const glm::dvec3& size) {
  for (const Surface& wall : make_cuboid(size, uniform_reflectance(0.5)).surfaces) {
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    for (const glm::dvec3& position : wall.positions) surface.positions.push_back(position + low);
    for (const glm::uvec3& triangle : wall.triangles) surface.triangles.push_back(triangle + first);
  }
}

Surface shell(const std::string& name, double reflectance = 0.5) {
  Surface surface;
  surface.name = name;
  surface.reflectance = reflectance;
  return surface;
}

// A room of 3 × 2 × 3 m; in walls of 0.2 m if they are thick. One surface.
Room room_in_walls(bool thick, const glm::dvec3& lamp = {1.5, 1.7, 1.5}) {
  Room room;
  room.source = "test";
  room.surfaces.push_back(shell("walls"));
  add_cuboid(room.surfaces[0], {0.0, 0.0, 0.0}, {3.0, 2.0, 3.0});
  if (thick) add_cuboid(room.surfaces[0], {-0.2, -0.2, -0.2}, {3.4, 2.4, 3.4});
  room.emitters.push_back(isotropic(lamp, 1000.0));
  return room;
}

constexpr double inner_m2 = 2.0 * (9.0 + 6.0 + 6.0);
constexpr double outer_m2 = 2.0 * (3.4 * 3.4 + 2.0 * 3.4 * 2.4);

Result run(const Room& room, double photons = 100'000, unsigned threads = 1) {
  Settings settings = settings_of(Estimator::collision, Engine::automatic, photons, 1);
  settings.threads = threads;
  return simulate(room, settings);
}

// A plate of 1 × 1 m upright before the wall x = 0, with one tile map for both sides.
Surface plate(double distance) {
  Surface surface = shell("plate");
  add_quad(surface, {distance, 0.5, 1.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
  return surface;
}

}  // namespace

TEST_CASE("the outer faces of thick walls do not count in the mean") {
  const Result thick = run(room_in_walls(true));
  const Result thin = run(room_in_walls(false));
  const SurfaceResult& walls = thick.surfaces[0];
  CHECK(std::abs(walls.unreached_area_m2 - outer_m2) <= 1e-12 * outer_m2);
  CHECK(thin.surfaces[0].unreached_area_m2 == 0.0);
  CHECK(std::abs(walls.area_m2 - inner_m2 - outer_m2) <= 1e-12 * walls.area_m2);
  CHECK(walls.min_irradiance > 0.0);
  CHECK(thick.tiles_without_hits == 0);
  CHECK(thick.unreached_tiles == thick.tiles.size() - thin.tiles.size());
  CHECK_THAT(unreached_text(thick), ContainsSubstring("m² of 1 surface cannot be reached by light"));
  CHECK(unreached_text(thin).empty());

  // By the balance: absorbed = (1 − ρ) E A. Bias that would fail: 5 standard errors of 0.3 %, some 1.5 %.
  const double mean = 1000.0 / (0.5 * inner_m2);
  const SurfaceResult& bare = thin.surfaces[0];
  const Judgement verdict = compare({{walls.mean_irradiance, walls.standard_error, mean, 0.0},
                                     {bare.mean_irradiance, bare.standard_error, mean, 0.0}});
  INFO(verdict.text);
  CHECK(verdict.agrees);
  CHECK(verdict.smallest_bias < 0.02);
  // The mean over all faces, as if the outer ones counted.
  const double lit_share = inner_m2 / (inner_m2 + outer_m2);
  CHECK_FALSE(compare({{walls.mean_irradiance * lit_share, walls.standard_error * lit_share, mean, 0.0}}).agrees);
}

TEST_CASE("what is unreached does not depend on the number of photons, threads or the direction of the walk") {
  const Room room = room_in_walls(true);
  for (const double photons : {1.0, 3000.0}) {
    for (const unsigned threads : {1U, 2U}) {
      CHECK(std::abs(run(room, photons, threads).surfaces[0].unreached_area_m2 - outer_m2) <= 1e-12 * outer_m2);
    }
  }
  Settings backward = settings_of(Estimator::collision, Engine::automatic, 3000, 1, 0.5);
  backward.tile_walk = WalkDirection::backward;
  const Result result = simulate(room, backward);
  CHECK(std::abs(result.surfaces[0].unreached_area_m2 - outer_m2) <= 1e-12 * outer_m2);
  CHECK(result.tiles_without_hits == 0);
}

TEST_CASE("a wall and a plate with a gap of a centimetre between them are reached") {
  Room room = room_in_walls(false);
  room.surfaces.push_back(plate(0.01));
  room.surfaces[1].sides = Sides::both;
  const Result result = run(room, 1000.0);
  for (const SurfaceResult& surface : result.surfaces) CHECK(surface.unreached_area_m2 == 0.0);
  CHECK(result.tiles_without_hits > 0);
}

TEST_CASE("a neighbouring room is dark unless its wall has an opening") {
  Room room = room_in_walls(false);
  room.surfaces.push_back(shell("next"));
  add_cuboid(room.surfaces[1], {3.0, 0.0, 0.0}, {1.0, 2.0, 3.0});
  CHECK(run(room, 3000.0).surfaces[1].unreached_area_m2 > 15.999);  // of 22 m²; 6 m² are the wall that both have
  // A body in the dark room is dark too.
  room.surfaces.push_back(shell("box"));
  add_cuboid(room.surfaces[2], {3.4, 0.0, 1.0}, {0.2, 0.2, 0.2});
  Result result = run(room, 3000.0);
  CHECK(result.surfaces[2].unreached_area_m2 == result.surfaces[2].area_m2);
  CHECK(result.surfaces[2].mean_irradiance == 0.0);

  // Without the walls between them, but with a frame that leaves 0.3 × 0.3 m of 6 m² open.
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<glm::uvec3>& triangles = room.surfaces[k].triangles;
    const auto between = [&](const glm::uvec3& t) {
      const std::vector<glm::dvec3>& p = room.surfaces[k].positions;
      return p[t.x].x == 3.0 && p[t.y].x == 3.0 && p[t.z].x == 3.0;
    };
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(), between), triangles.end());
  }
  Surface frame = shell("frame");
  add_quad(frame, {3.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 0.0, 1.0});
  add_quad(frame, {3.0, 0.0, 1.3}, {0.0, 2.0, 0.0}, {0.0, 0.0, 1.7});
  add_quad(frame, {3.0, 0.3, 1.0}, {0.0, 1.7, 0.0}, {0.0, 0.0, 0.3});
  room.surfaces.push_back(frame);
  result = run(room, 3000.0);
  for (const SurfaceResult& surface : result.surfaces) {
    // The bottom of the box stands on the floor: between both there is nothing to see.
    if (surface.name != "box") CHECK(surface.unreached_area_m2 == 0.0);
    if (surface.name == "box") CHECK(surface.unreached_area_m2 <= 0.0401);
  }
}

TEST_CASE("backs with tile maps of their own are unreached in a closed room, with either engine") {
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    Room room = unit_cube(0.5, isotropic(glm::dvec3(0.5)));
    for (Surface& wall : room.surfaces) wall.sides = Sides::both;
    const Result result = simulate(room, settings_of(Estimator::collision, engine, 30'000, 1, 0.2));
    CHECK(result.unreached_tiles == 150);
    CHECK(result.tiles_without_hits == 0);
    for (std::size_t m = 0; m < result.surfaces.size(); ++m) {
      const bool back = result.tiling.maps[m].side == Side::back;
      CHECK(result.surfaces[m].unreached_area_m2 == (back ? result.surfaces[m].area_m2 : 0.0));
      CHECK((result.surfaces[m].mean_irradiance > 0.0) == !back);
    }
  }
}

TEST_CASE("around a lamp that is shut into a body everything is unreached") {
  Room room = room_in_walls(false);
  room.surfaces.push_back(shell("body"));
  add_cuboid(room.surfaces[1], {1.4, 1.6, 1.4}, {0.2, 0.2, 0.2});
  const Result result = run(room, 3000.0);
  CHECK(result.surfaces[0].unreached_area_m2 == result.surfaces[0].area_m2);
  CHECK(result.surfaces[0].mean_irradiance == 0.0);
  CHECK(result.surfaces[1].unreached_area_m2 == 0.0);  // one tile map for both sides
}

TEST_CASE("light that only a black surface could pass on does not arrive") {
  // An emitter below a table top, over it a plate: only the black wall would scatter light between them.
  Room room = room_in_walls(false, {1.5, 0.5, 1.5});
  for (Surface& surface : room.surfaces) surface.reflectance = 0.0;
  Surface top = shell("top");
  add_quad(top, {1.0, 0.8, 1.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0});  // faces up
  top.sides = Sides::both;
  room.surfaces.push_back(top);
  const Result black = run(room, 3000.0);
  CHECK(surface_named(black, "top").unreached_area_m2 == surface_named(black, "top").area_m2);
  CHECK(surface_named(black, "top.back").unreached_area_m2 == 0.0);
  room.surfaces[0].reflectance = 0.01;
  CHECK(surface_named(run(room, 3000.0), "top").unreached_area_m2 == 0.0);
}
