// Receivers and emitters outside a closed room, and receivers on its surfaces.
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>

#include "lichtmc/error.hpp"
#include "support/catch.hpp"
#include "support/form_factors.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double flux = 1000.0;
const glm::dvec3 size(5.0, 2.5, 4.0);

Receiver at(const glm::dvec3& position, const glm::dvec3& normal) {
  return {"at", position, normal, 90.0, 1.0};
}

Room closed_room(Emitter emitter) {
  Room room = make_cuboid(size, uniform_reflectance(0.5));
  room.emitters.push_back(std::move(emitter));
  return room;
}

// A crate near a corner: the room is not convex, and shadow rays are traced.
Room with_crate(Room room) {
  Surface crate = make_box({0.4, 0.4, 0.4});
  crate.name = "crate";
  for (glm::dvec3& p : crate.positions) p += glm::dvec3(4.4, 0.1, 3.4);
  room.surfaces.push_back(crate);
  return room;
}

// The same room turned about an oblique axis and moved.
glm::dvec3 turned(const glm::dvec3& p) {
  const glm::dvec3 x = glm::normalize(glm::dvec3(0.6, 0.3, -0.2));
  const glm::dvec3 y = glm::normalize(glm::cross(glm::dvec3(0.1, 0.2, 1.0), x));
  return p.x * x + p.y * y + p.z * glm::cross(x, y);
}
Room turned(Room room) {
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& p : surface.positions) p = turned(p);
  }
  for (Emitter& emitter : room.emitters) {
    if (auto* point = std::get_if<IsotropicEmitter>(&emitter.shape)) point->position = turned(point->position);
  }
  for (Receiver& receiver : room.receivers) {
    receiver.position = turned(receiver.position);
    receiver.normal = turned(receiver.normal);
  }
  return room;
}

Settings receivers_only(Engine engine, double photons, std::uint64_t seed) {
  Settings settings = settings_of(Estimator::collision, engine, photons, seed);
  settings.measured = Measured::receivers;
  return settings;
}

struct Case {
  std::string name;
  Room room;
  Engine engine = Engine::automatic;
};

std::vector<Case> in_all_tracers(const Room& room) {
  return {{"cuboid", room, Engine::cuboid},
          {"embree", room, Engine::embree},
          {"embree with shadows", with_crate(room), Engine::embree}};
}

}  // namespace

TEST_CASE("outside: no light of a closed room reaches receivers outside") {
  const std::vector<Receiver> outside{at({-0.7, 1.2, 2.0}, {1, 0, 0}),   at({2.0, 4.1, 2.0}, {0, -1, 0}),
                                      at({6.0, 4.0, 7.0}, {-1, -1, -1}), at({-1e-4, 1.2, 2.0}, {1, 0, 0}),
                                      at({2.0, 1.0, 1e4}, {0, 0, -1}),   at({2.0, 2.501, 2.0}, {0, 1, 0})};
  const std::vector<Emitter> emitters{isotropic({2.5, 2.0, 2.0}, flux), surface_emitter(1, flux)};
  for (const Emitter& emitter : emitters) {
    for (Case& one : in_all_tracers(closed_room(emitter))) {
      INFO(one.name);
      one.room.receivers = outside;
      one.room.receivers.push_back(at({2.5, 0.8, 2.0}, {0, 1, 0}));
      const Result result = simulate(one.room, receivers_only(one.engine, 7000, 3));
      for (std::size_t k = 0; k < outside.size(); ++k) {
        CHECK(result.receiver_results[k].irradiance == 0.0);
        CHECK(result.receiver_results[k].standard_error == 0.0);
      }
      CHECK(result.receiver_results.back().direct > 10.0);
      CHECK(result.receiver_results.back().indirect > 1.0);
      REQUIRE(result.warnings.size() == 1);
      CHECK_THAT(result.warnings[0],
                 ContainsSubstring("6 receivers of 7 lie outside the closed walls around the emitters: no light"));
    }
  }
}

TEST_CASE("outside: a lamp above the ceiling lights the ceiling's outer face and nothing inside") {
  Room room = closed_room(isotropic({2.5, 3.5, 2.0}, flux));
  CHECK_THROWS_AS(simulate(room, receivers_only(Engine::cuboid, 1000, 1)), InputError);
  room.receivers = {at({2.5, 0.85, 2.0}, {0, 1, 0}), at({2.5, 5.0, 2.0}, {0, -1, 0})};
  // Of the light of the ceiling's outer face at the second receiver: ρ/π ∫ E_d cos θ cos θ'/r² dA, by 200 × 160
  // midpoints, whose error is below 1e-4 because the distances are at least 1 m and 2.5 m.
  double indirect = 0.0;
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 160; ++j) {
      const glm::dvec3 p((i + 0.5) / 200.0 * size.x, size.y, (j + 0.5) / 160.0 * size.z);
      const double to_lamp = glm::length(glm::dvec3(2.5, 3.5, 2.0) - p);
      const double to_receiver = glm::length(glm::dvec3(2.5, 5.0, 2.0) - p);
      const double direct = flux / (4.0 * pi) * 1.0 / std::pow(to_lamp, 3);
      indirect += 0.5 / pi * direct * std::pow(2.5, 2) / std::pow(to_receiver, 4) * size.x * size.z / 32000.0;
    }
  }
  const double on_ceiling = flux * isotropic_point_to_rectangle(1.0, 2.5, 2.5, 2.0, 2.0);
  for (const bool crate : {false, true}) {
    const Room lit = crate ? with_crate(room) : room;
    for (const Direct direct : {Direct::sampled, Direct::analytic}) {
      Settings settings = settings_of(Estimator::collision, Engine::automatic, 200'000, 5, 0.5);
      settings.direct = direct;
      settings.measured = Measured::all;
      const Result result = simulate(lit, settings);
      CHECK(result.engine == Engine::embree);
      for (const char* inside : {"floor", "wall_x0", "wall_z1"}) CHECK(surface_named(result, inside).power == 0.0);
      const SurfaceResult& ceiling = surface_named(result, "ceiling");
      CHECK(ceiling.behind_share == 1.0);
      const Judgement verdict = compare({{ceiling.power, ceiling.standard_error * ceiling.area_m2, on_ceiling}});
      INFO(verdict.text);
      CHECK(verdict.agrees);
      CHECK(result.receiver_results[0].irradiance == 0.0);
      CHECK(result.receiver_results[1].direct == Approx(flux / (4.0 * pi) / 2.25).epsilon(1e-12));
      const ReceiverResult& seen = result.receiver_results[1];
      const Judgement reflected = compare({{seen.indirect, seen.standard_error, indirect}});
      INFO(reflected.text);
      CHECK(reflected.agrees);
      CHECK(reflected.smallest_bias < 0.05);
      CHECK_THAT(result.warnings.at(0), ContainsSubstring("outside the room"));
    }
    Settings settings = settings_of(Estimator::collision, Engine::automatic, 20'000, 6, 0.5);
    settings.tile_walk = WalkDirection::backward;
    const Result result = simulate(lit, settings);
    CHECK(surface_named(result, "floor").power == 0.0);
    CHECK(surface_named(result, "ceiling").power == Approx(on_ceiling).epsilon(0.02));
  }
}

TEST_CASE("outside: an emitter on the ceiling lights a receiver above it, not one beside the room") {
  for (Case& one : in_all_tracers(closed_room(isotropic({2.5, 2.5, 2.0}, flux)))) {
    INFO(one.name);
    one.room.receivers = {at({2.5, 4.5, 2.0}, {0, -1, 0}), at({-1.0, 1.2, 2.0}, {1, 0, 0})};
    const Result result = simulate(one.room, receivers_only(one.engine, 2000, 3));
    CHECK(result.receiver_results[0].direct == Approx(flux / (4.0 * pi) / 4.0).epsilon(1e-9));
    CHECK(result.receiver_results[0].indirect == 0.0);
    CHECK(result.receiver_results[1].irradiance == 0.0);
  }
}

TEST_CASE("on a surface: receivers have the limit of the side that they look to, in all tracers") {
  // A position on surfaces, a way off them, and the direction.
  struct Place {
    glm::dvec3 point, off, normal;
  };
  const std::vector<Place> places{{{1.2, 0.0, 1.1}, {0, 1, 0}, {1, 2, 0}},    // tilted on the floor
                                  {{1.2, 0.0, 1.1}, {0, 1, 0}, {3, 0.3, 1}},  // almost along it
                                  {{5.0, 1.1, 1.7}, {-1, 0, 0}, {-1, 0, 1}},  // tilted on a wall
                                  {{3.0, 1.5, 0.0}, {0, 0, 1}, {0, 1, 0}},    // along a wall
                                  {{3.0, 0.0, 1.0}, {0, 1, 0}, {1, 0, 0}},    // along the floor
                                  {{2.0, 0.0, 0.0}, {0, 1, 1}, {0, 1, 0}},    // on an edge, along the other wall
                                  {{2.0, 0.0, 0.0}, {0, 1, 1}, {0.5, 1, 2}},  // on an edge, tilted
                                  {{0.0, 0.0, 0.0}, {1, 1, 1}, {1, 1, 1}},    // in a corner
                                  {{0.0, 2.5, 0.0}, {1, -1, 1}, {1, 0, 0}}};  // in a corner, along two walls
  for (const bool turn : {false, true}) {
    for (Case& one : in_all_tracers(closed_room(isotropic({2.3, 1.9, 2.1}, flux)))) {
      INFO(one.name << (turn ? ", turned" : ""));
      for (const double distance : {0.0, 1e-4}) {
        for (const Place& place : places)
          one.room.receivers.push_back(at(place.point + distance * place.off, place.normal));
      }
      const Room room = turn ? turned(one.room) : one.room;
      const Result result = simulate(room, receivers_only(one.engine, 18 * 25'000.0, 11));
      std::vector<Compared> figures;
      std::vector<Compared> without_own_surface;
      for (std::size_t k = 0; k < places.size(); ++k) {
        const ReceiverResult& on = result.receiver_results[k];
        const ReceiverResult& off = result.receiver_results[k + places.size()];
        CHECK(on.direct == Approx(off.direct).epsilon(2e-3));
        figures.push_back({on.indirect, on.standard_error, off.indirect, off.standard_error});
        // The part of the hemisphere below the horizon of the surface sees the surface itself. Without it (as for a
        // flight that leaves the room at once) the value would be lower by that fraction of about the mean.
        const double cosine = glm::dot(glm::normalize(places[k].normal), glm::normalize(places[k].off));
        without_own_surface.push_back(
            {on.indirect * 0.5 * (1.0 + cosine), on.standard_error, off.indirect, off.standard_error});
      }
      const Judgement verdict = compare(figures);
      INFO(verdict.text);
      CHECK(verdict.agrees);
      CHECK(verdict.smallest_bias < 0.05);
      CHECK_FALSE(compare(without_own_surface).agrees);
    }
  }
}

TEST_CASE("on a surface: a receiver that looks out of the closed room has no light") {
  for (Case& one : in_all_tracers(closed_room(isotropic({2.5, 2.0, 2.0}, flux)))) {
    INFO(one.name);
    one.room.receivers = {at({1.2, 0.0, 1.1}, {0, -1, 0}), at({1.2, 0.0, 1.1}, {3, -1, 0}),
                          at({0.0, 1.0, 1.0}, {-1, 3, 0}), at({0.0, 0.0, 1.0}, {1, -0.1, 0})};
    const Result result = simulate(one.room, receivers_only(one.engine, 4000, 3));
    for (const ReceiverResult& receiver : result.receiver_results) CHECK(receiver.irradiance == 0.0);
    CHECK(result.warnings.empty());  // a point on a wall is not outside
  }
}

TEST_CASE(
    "on a surface: a receiver that looks along a wall is in the room, also if faces are reversed or a wall is "
    "missing") {
  const std::vector<std::pair<bool, bool>> kinds{{false, false}, {true, false}, {false, true}, {true, true}};
  for (const auto& [reversed, open] : kinds) {
    Room room = with_crate(closed_room(isotropic({2.3, 1.9, 2.1}, flux)));
    for (Surface& surface : room.surfaces) {
      for (glm::uvec3& t : surface.triangles) {
        if (reversed) std::swap(t.y, t.z);
      }
    }
    if (open) room = without_surface(std::move(room), "wall_x0");
    // On a wall of the room, and on a side of the crate.
    room.receivers = {at({3.0, 1.5, 0.0}, {0, 1, 0}), at({4.4, 0.3, 3.6}, {0, 1, 0}), at({3.0, 1.5, 1e-4}, {0, 1, 0}),
                      at({4.4 - 1e-4, 0.3, 3.6}, {0, 1, 0})};
    const Result result = simulate(room, receivers_only(Engine::embree, 400'000, 5));
    std::vector<Compared> figures;
    for (std::size_t k = 0; k < 2; ++k) {
      const ReceiverResult& on = result.receiver_results[k];
      const ReceiverResult& off = result.receiver_results[k + 2];
      CHECK(on.direct == Approx(off.direct).epsilon(1e-3));
      figures.push_back({on.indirect, on.standard_error, off.indirect, off.standard_error});
    }
    const Judgement verdict = compare(figures);
    INFO(verdict.text);
    CHECK(verdict.agrees);
  }
}

TEST_CASE("outside: run and check name receivers and emitters in the notch of an L-shaped room, not those on walls") {
  // Floor and ceiling of the L are two rectangles each, which meet the walls at their corners.
  Room room;
  Surface shell;
  shell.name = "shell";
  const std::vector<glm::dvec3> outline{{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {2, 0, 2}, {2, 0, 4}, {0, 0, 4}};
  const glm::dvec3 up(0.0, 2.5, 0.0);
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const glm::dvec3& next = outline[(k + 1) % outline.size()];
    add_quad(shell, outline[k], next - outline[k], up);
  }
  for (const glm::dvec3& level : {glm::dvec3(0.0), up}) {
    add_triangle(shell, level + outline[0], level + outline[1], level + outline[3]);
    add_triangle(shell, level + outline[1], level + outline[2], level + outline[3]);
    add_triangle(shell, level + outline[0], level + outline[3], level + outline[4]);
    add_triangle(shell, level + outline[0], level + outline[4], level + outline[5]);
  }
  room.source = "L";
  room.surfaces.push_back(shell);
  room.emitters.push_back(isotropic({1.0, 2.0, 1.0}, flux));
  room.receivers = {at({1.0, 0.8, 1.0}, {0, 1, 0}), at({2.0, 0.8, 3.0}, {-1, 0, 0}), at({4.0, 2.5, 0.0}, {-1, 0, 0})};
  CHECK(simulate(room, receivers_only(Engine::automatic, 300, 1)).warnings.empty());
  for (const Finding& finding : inspect(room).findings) CHECK_THAT(finding.text, !ContainsSubstring("outside"));

  room.receivers.push_back(at({3.0, 0.8, 3.0}, {0, 1, 0}));
  const Result result = simulate(room, receivers_only(Engine::automatic, 400, 1));
  CHECK(result.receiver_results[3].irradiance == 0.0);
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings[0], ContainsSubstring("Receiver 'at' at (3, 0.8, 3) m lies outside the closed walls"));
  const auto count = [](const Room& in, const std::string& words) {
    std::size_t n = 0;
    for (const Finding& finding : inspect(in).findings) n += finding.text.find(words) != std::string::npos ? 1U : 0U;
    return n;
  };
  CHECK(count(room, "outside the closed walls around the emitters") == 1);
  // A second emitter beside it lights it, and is named itself.
  room.emitters.push_back(isotropic({3.0, 2.0, 3.0}, flux));
  CHECK(count(room, "outside the closed walls around the emitters") == 0);
  CHECK(count(room, "lies outside the walls of the closed room") == 1);
  // Many are named together.
  for (int k = 0; k < 5; ++k) room.emitters.push_back(isotropic({3.0, 1.0, 3.0}, flux));
  const std::string warning = simulate(room, receivers_only(Engine::automatic, 400, 1)).warnings.at(0);
  CHECK_THAT(warning, ContainsSubstring("6 emitters of 7 lie outside the room or on its boundary. The first: Emitter"));
}

TEST_CASE("outside: a building of solid walls with a window is no closed room, and nothing in it is outside") {
  // Floor, ceiling and walls 0.3 m thick, in one shell: an outer and an inner box, joined around a window.
  Room room;
  Surface solid;
  solid.name = "solid";
  const auto box = [&solid](const glm::dvec3& low, const glm::dvec3& high, bool inwards) {
    Surface sides = make_box(high - low);
    for (std::size_t n = 0; n < sides.triangles.size(); ++n) {
      const glm::uvec3 t = sides.triangles[n];
      const glm::dvec3 a = low + sides.positions[t.x];
      const glm::dvec3 b = low + sides.positions[t.y];
      const glm::dvec3 c = low + sides.positions[t.z];
      if (a.x == high.x && b.x == high.x && c.x == high.x) continue;  // where the window is
      inwards ? add_triangle(solid, a, c, b) : add_triangle(solid, a, b, c);
    }
  };
  box({0, 0, 0}, {5.6, 3.1, 4.6}, false);
  box({0.3, 0.3, 0.3}, {5.3, 2.8, 4.3}, true);
  const std::vector<glm::dvec2> outer{{0, 0}, {3.1, 0}, {3.1, 4.6}, {0, 4.6}};
  const std::vector<glm::dvec2> inner{{0.3, 0.3}, {2.8, 0.3}, {2.8, 4.3}, {0.3, 4.3}};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    const auto point = [](double x, const glm::dvec2& yz) { return glm::dvec3(x, yz.x, yz.y); };
    add_triangle(solid, point(5.6, outer[k]), point(5.6, outer[next]), point(5.3, inner[next]));
    add_triangle(solid, point(5.6, outer[k]), point(5.3, inner[next]), point(5.3, inner[k]));
  }
  room.surfaces.push_back(solid);
  room.emitters.push_back(isotropic({2.5, 2.0, 2.0}, flux));
  room.receivers = {at({2.5, 1.0, 2.0}, {0, 1, 0}), at({7.0, 1.5, 2.0}, {-1, 0, 0})};
  CHECK(simulate(room, receivers_only(Engine::automatic, 300, 1)).warnings.empty());
  room.receivers.push_back(at({0.15, 1.0, 2.0}, {1, 0, 0}));  // within a wall
  const std::vector<std::string> warnings = simulate(room, receivers_only(Engine::automatic, 300, 1)).warnings;
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], ContainsSubstring("(0.15, 1, 2) m lies inside closed walls or bodies without an emitter"));
}

TEST_CASE("outside: walls that meet in T-junctions, and luminous walls that shine outwards") {
  // A cuboid of which one wall is divided and the others are not.
  Room room = without_surface(closed_room(isotropic({2.5, 2.0, 2.0}, flux)), "wall_z0");
  Surface wall;
  wall.name = "wall";
  add_quad(wall, {0, 0, 0}, {2, 0, 0}, {0, 2.5, 0});
  add_quad(wall, {2, 0, 0}, {3, 0, 0}, {0, 2.5, 0});
  room.surfaces.push_back(wall);
  room.receivers = {at({1.0, 1.0, -0.1}, {0, 0, 1}), at({1.0, 1.0, 0.1}, {0, 0, 1})};
  const Result result = simulate(room, receivers_only(Engine::automatic, 200, 1));
  CHECK(result.receiver_results[0].irradiance == 0.0);
  CHECK(result.receiver_results[1].irradiance > 1.0);
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings[0], ContainsSubstring("at (1, 1, -0.1) m lies outside"));

  // A ceiling with its front outside lights a receiver above, by the polygon formula or not.
  Room shining = closed_room(surface_emitter(1, flux));
  for (glm::uvec3& t : shining.surfaces[1].triangles) std::swap(t.y, t.z);
  shining.receivers = {at({2.5, 3.5, 2.0}, {0, -1, 0}), at({2.5, 1.0, 2.0}, {0, 1, 0})};
  const Result lit = simulate(shining, receivers_only(Engine::automatic, 200, 1));
  const double exitance = flux / (size.x * size.z);
  const ReceiverResult& above = lit.receiver_results[0];
  const Judgement verdict = compare(
      {{above.direct, above.standard_error, exitance * element_to_parallel_rectangle(1.0, 2.5, 2.5, 2.0, 2.0)}});
  INFO(verdict.text);
  CHECK(verdict.agrees);
  CHECK(verdict.smallest_bias < 0.02);
  CHECK(lit.receiver_results[1].irradiance == 0.0);
  CHECK_THAT(lit.warnings.at(0), ContainsSubstring("emits outside the walls of the closed room"));
}
