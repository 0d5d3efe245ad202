// A thing exactly in the plane of a surface gets what it gets a millimetre in front of it, by every method.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"
#include "support/verdict.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// Light that gets under an edge 0.1 mm high: the edges of the rug are 5 m long, the floor has 20 m², so that 10⁻⁴ of
// the light at most differs. The errors of the figures below are above 0.2 %.
constexpr double gap = 1e-4;

Surface rectangle(const std::string& name, const glm::dvec3& corner, const glm::dvec3& s, const glm::dvec3& t,
                  double reflectance) {
  Surface surface;
  surface.name = name;
  surface.reflectance = reflectance;
  add_quad(surface, corner, s, t);
  return surface;
}

// A dark rug on the floor, a bright paper that lies partly on the rug, a poster on the wall, and a luminous panel in
// the ceiling; all of them `off` in front of the surfaces below them.
Room room_with_things(double off) {
  Room room = make_cuboid({5.0, 2.6, 4.0}, uniform_reflectance(0.7));
  room.surfaces.push_back(rectangle("rug", {1, off, 1}, {0, 0, 1.5}, {2, 0, 0}, 0.1));
  room.surfaces.back().sides = Sides::both;
  room.surfaces.push_back(rectangle("paper", {2.5, 2 * off, 1.5}, {0, 0, 0.6}, {0.8, 0, 0}, 0.9));
  room.surfaces.push_back(rectangle("poster", {1, 0.8, off}, {1.5, 0, 0}, {0, 1, 0}, 0.0));
  room.surfaces.push_back(rectangle("panel", {2, 2.6 - off, 1}, {1.2, 0, 0}, {0, 0, 1.2}, 0.5));
  room.emitters.push_back(surface_emitter(room.surfaces.size() - 1, 3000.0));
  room.emitters.push_back(isotropic({1.0, 1.9, 3.0}, 500.0));
  return room;
}

Settings settings_for(const std::string& method, std::uint64_t seed) {
  const double photons = method == "backward" ? 3e5 : 4e5;
  Settings settings = settings_of(Estimator::collision, Engine::automatic, photons, seed, 0.5);
  if (method == "fast") settings.engine = Engine::embree_fast;
  if (method == "analytic") settings.direct = Direct::analytic;
  if (method == "backward") settings.tile_walk = WalkDirection::backward;
  return settings;
}

// Sides with light, by their means.
std::vector<Compared> surfaces_against(const Result& a, const Result& b) {
  std::vector<Compared> figures;
  for (const SurfaceResult& surface : a.surfaces) {
    if (!(surface.mean_irradiance > 0.05)) continue;  // 0.1 lx gets into the gaps
    const SurfaceResult& other = surface_named(b, surface.name);
    figures.push_back({surface.mean_irradiance, surface.standard_error, other.mean_irradiance, other.standard_error});
  }
  return figures;
}

}  // namespace

TEST_CASE("one plane: a flush rug, paper, poster and panel receive what they receive 0.1 mm higher") {
  const Result reference = simulate(room_with_things(gap), settings_for("forward", 1));
  CHECK(reference.covers.empty());
  std::uint64_t seed = 2;
  for (const std::string method : {"forward", "fast", "analytic", "backward"}) {
    Room room = room_with_things(0.0);
    const Result flush = simulate(room, settings_for(method, seed++));
    CHECK(flush.warnings == reference.warnings);
    CHECK(surface_named(flush, "floor").covered_m2 == Approx(3.18).epsilon(1e-9));
    CHECK(surface_named(flush, "rug").covered_m2 == Approx(0.3).epsilon(1e-9));
    CHECK(surface_named(flush, "ceiling").covered_m2 == Approx(1.44).epsilon(1e-9));
    check(method, compare(surfaces_against(flush, reference)));
    if (method != "backward") CHECK(flush.balance.absorbed == Approx(3500.0).epsilon(1e-12));
    // In any order.
    std::swap(room.surfaces[0], room.surfaces[6]);
    std::swap(room.surfaces[2], room.surfaces[7]);
    check(method + ", other order", compare(surfaces_against(simulate(room, settings_for(method, seed++)), reference)));
  }
  // With the larger surfaces on top the room is another one.
  Room wrong = room_with_things(gap);
  for (Surface& surface : wrong.surfaces) {
    if (surface.name != "rug" && surface.name != "paper") continue;
    for (glm::dvec3& position : surface.positions) position.y = -position.y;
  }
  const Judgement verdict = compare(surfaces_against(simulate(wrong, settings_for("forward", 20)), reference));
  INFO("rug under the floor: " << verdict.text);
  CHECK_FALSE(verdict.agrees);
}

TEST_CASE("one plane: receivers above flush things have the light of things 0.1 mm higher") {
  std::vector<Result> results;
  for (const double off : {0.0, gap}) {
    Room room = room_with_things(off);
    for (const double height : {0.3, 1.0}) {
      for (const double x : {0.5, 1.5, 2.9}) {
        room.receivers.push_back({"up", {x, height, 1.8}, {0.1, 1, 0}, 90.0, 1.0});
        room.receivers.push_back({"down", {x, height, 1.8}, {0, -1, 0}, 60.0, 1.0});
      }
    }
    Settings settings = settings_of(Estimator::collision, Engine::automatic, 3e4, results.size() + 30, 0.5);
    settings.measured = Measured::receivers;
    results.push_back(simulate(room, settings));
  }
  std::vector<Compared> figures;
  for (std::size_t k = 0; k < results[0].receiver_results.size(); ++k) {
    const ReceiverResult& a = results[0].receiver_results[k];
    const ReceiverResult& b = results[1].receiver_results[k];
    figures.push_back({a.irradiance, a.standard_error, b.irradiance, b.standard_error});
  }
  check("receivers", compare(figures));
}

TEST_CASE("one plane: walls of two faces, with another reflectance outside, have the inner one inside") {
  const Room single = [] {
    Room room = make_cuboid({5.0, 2.6, 4.0}, uniform_reflectance(0.8));
    room.emitters.push_back(isotropic({2.5, 1.9, 2.0}, 1257.0));
    return room;
  }();
  Settings settings = settings_of(Estimator::collision, Engine::embree, 3e5, 40, 0.5);
  const Result expected = simulate(single, settings);
  for (const Sides sides : {Sides::one, Sides::both}) {
    for (const bool outside_first : {false, true}) {
      Room room = single;
      std::vector<Surface> outside = room.surfaces;
      for (Surface& surface : outside) {
        surface.name += " outside";
        surface.reflectance = 0.1;
        for (glm::uvec3& corner : surface.triangles) std::swap(corner.y, corner.z);
      }
      room.surfaces.insert(outside_first ? room.surfaces.begin() : room.surfaces.end(), outside.begin(), outside.end());
      for (Surface& surface : room.surfaces) surface.sides = sides;
      for (const std::string method : {"forward", "analytic", "backward"}) {
        Settings own = settings_for(method, settings.seed + 1);
        own.photons = settings.photons;
        const Result result = simulate(room, own);
        for (const Surface& surface : outside) CHECK(surface_named(result, surface.name).power == 0.0);
        check("walls of two faces, " + method, compare(surfaces_against(result, expected)));
        CHECK(result.warnings.empty());
      }
      ++settings.seed;
    }
  }
}

TEST_CASE("one plane: the covered part of an area light does not light the room, and the balance closes") {
  // A frame covers 44 % of a panel.
  Room room = make_cuboid({5.0, 2.6, 4.0}, uniform_reflectance(0.5));
  room.surfaces.push_back(rectangle("panel", {2, 2, 1}, {1, 0, 0}, {0, 0, 1}, 0.5));
  room.emitters.push_back(surface_emitter(6, 1000.0));
  Room smaller = room;
  smaller.surfaces[6] = rectangle("panel", {2, 2, 1}, {1, 0, 0}, {0, 0, 0.56}, 0.5);
  smaller.emitters[0].power = 560.0;
  smaller.surfaces.push_back(rectangle("frame", {2, 2, 1.56}, {1, 0, 0}, {0, 0, 0.44}, 0.2));
  room.surfaces.push_back(rectangle("frame", {2, 2, 1.56}, {1, 0, 0}, {0, 0, 0.44}, 0.2));
  std::uint64_t seed = 60;
  for (const std::string method : {"forward", "analytic", "backward"}) {
    const Result covered = simulate(room, settings_for(method, seed++));
    const Result expected = simulate(smaller, settings_for("forward", seed++));
    std::vector<Compared> figures;
    for (const SurfaceResult& surface : covered.surfaces) {
      const SurfaceResult& other = surface_named(expected, surface.name);
      if (!(other.power > 0.0)) continue;
      figures.push_back(
          {surface.power, surface.standard_error * surface.area_m2, other.power, other.standard_error * other.area_m2});
    }
    check("half a panel, " + method, compare(figures));
    REQUIRE(covered.warnings.size() == 1);
    CHECK(covered.warnings[0].find("44 % of the area light") != std::string::npos);
    if (method == "backward") continue;
    CHECK(covered.balance.absorbed == Approx(1000.0).epsilon(1e-12));
  }
}

TEST_CASE("one plane: where no rule decides, run warns, if light arrives there") {
  Room room = make_cuboid({5.0, 2.6, 4.0}, uniform_reflectance(0.5));
  room.emitters.push_back(isotropic({2.5, 1.9, 2.0}, 1257.0));
  room.surfaces.push_back(room.surfaces[0]);
  room.surfaces.back().name = "floor again";
  const Settings settings = settings_of(Estimator::collision, Engine::automatic, 2e4, 70, 0.5);
  Result result = simulate(room, settings);
  CHECK(result.walk.undecided > 0);
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0].find("'floor' covers 20 m² of 'floor again'") != std::string::npos);
  // Two boxes side by side have walls in one place, but no light is between them.
  Room boxes = make_cuboid({5.0, 2.6, 4.0}, uniform_reflectance(0.5));
  boxes.emitters = room.emitters;
  for (const double x : {1.0, 2.0}) {
    Surface box = make_box({1.0, 0.7, 0.5});
    box.name = "box at " + std::to_string(x);
    box.sides = Sides::both;
    for (glm::dvec3& position : box.positions) position += glm::dvec3(x, 0.2, 1.0);
    boxes.surfaces.push_back(box);
  }
  result = simulate(boxes, settings);
  CHECK(result.walk.undecided == 0);
  CHECK(result.warnings.empty());
}
