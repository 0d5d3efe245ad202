// Findings in rooms with known faults.
#include <algorithm>
#include <cmath>
#include <string>

#include "inspect/guesses.hpp"
#include "lichtmc/lichtmc.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

const Finding* find(const Inspection& facts, const std::string& topic, Severity severity) {
  const auto found = std::find_if(facts.findings.begin(), facts.findings.end(), [&](const Finding& finding) {
    return finding.topic == topic && finding.severity == severity;
  });
  return found == facts.findings.end() ? nullptr : &*found;
}

Room office() {
  Room room = make_cuboid({5.0, 2.6, 4.0}, uniform_reflectance(0.6));
  room.source = "office";
  room.emitters.push_back({"lamp", 2000.0, IsotropicEmitter{{2.5, 2.4, 2.0}}});
  return room;
}

}  // namespace

TEST_CASE("the unit of length is guessed from a room's size") {
  CHECK(!guess_unit({5.0, 2.6, 4.0}));
  CHECK(!guess_unit({1.0, 1.0, 1.0}));
  CHECK(!guess_unit({150.0, 20.0, 80.0}));
  CHECK(guess_unit({500.0, 260.0, 400.0})->metres == 0.01);
  CHECK(guess_unit({5000.0, 2600.0, 4000.0})->metres == 0.001);
  // 30 m × 2.5 m × 20 m in inches.
  CHECK(guess_unit({1181.0, 98.4, 787.0})->metres == 0.0254);
  CHECK(!guess_unit({0.5, 0.2, 0.5}));  // no common unit is longer than a metre
  // Rooms of 5 m and 4 m in inches are short enough for metres, but too high.
  CHECK(guess_unit({196.9, 102.4, 157.5})->metres == 0.0254);
  CHECK(guess_unit({157.5, 102.4, 157.5})->metres == 0.0254);
  CHECK(guess_unit({130.0, 190.0, 150.0})->metres == 0.01);  // a bathroom in centimetres
  CHECK(!guess_unit({150.0, 45.0, 60.0}));                   // a cathedral
  CHECK(!guess_unit({16.4, 8.5, 13.1}));                     // a room in feet or a hall in metres: not decidable
}

TEST_CASE("an office has no findings") {
  const Inspection facts = inspect(office());
  CHECK(facts.count(Severity::fault) == 0);
  CHECK(facts.count(Severity::warning) == 0);
  CHECK(facts.cuboid);
  CHECK(facts.convex);
  CHECK(facts.closed);
  CHECK(facts.triangles == 12);
  CHECK(facts.tiles == 2 * (50 * 26 + 50 * 40 + 26 * 40));
  CHECK(facts.surfaces[0].seen_from_behind == 0.0);
  // Each finding says what to do.
  for (const Finding& finding : facts.findings) CHECK(!finding.advice.empty());
}

TEST_CASE("an opening is found on its side, with the share of light that escapes") {
  Room room = without_surface(office(), "wall_x1");
  const Inspection facts = inspect(room);
  CHECK_FALSE(facts.closed);
  CHECK(facts.open_edges == 4);
  REQUIRE(facts.openings.size() == 1);
  CHECK(facts.openings[0].side == "+x");
  CHECK(facts.openings[0].place.x == Approx(5.0).margin(1e-3));
  CHECK(find(facts, "openings", Severity::warning) != nullptr);
  // A wall of 2.6 × 4 m in a room of 86.8 m² gets about its share of the flights.
  const double share = static_cast<double>(facts.flights_that_left) / static_cast<double>(facts.flights);
  CHECK(share > 0.08);
  CHECK(share < 0.2);
}

TEST_CASE("faces that face outwards are noted, and an emissive one is a warning") {
  Room room = office();
  for (Surface& wall : room.surfaces) {
    for (glm::uvec3& t : wall.triangles) std::swap(t.y, t.z);
  }
  Inspection facts = inspect(room);
  for (const SurfaceFacts& surface : facts.surfaces) CHECK(surface.seen_from_behind == 1.0);
  CHECK(find(facts, "behind", Severity::note) != nullptr);
  CHECK(find(facts, "behind", Severity::warning) == nullptr);
  room.emitters.push_back(surface_emitter(1, 100.0));
  facts = inspect(room);
  REQUIRE(find(facts, "behind", Severity::warning) != nullptr);
  CHECK_THAT(find(facts, "behind", Severity::warning)->text, ContainsSubstring("'ceiling'"));
}

TEST_CASE("conditions that would prevent a simulation are faults") {
  Room room = office();
  room.emitters.clear();
  Inspection facts = inspect(room);
  REQUIRE(find(facts, "emitters", Severity::fault) != nullptr);
  CHECK_THAT(find(facts, "emitters", Severity::fault)->advice, ContainsSubstring("--light point:2.5,1.3,2:1000lm"));
  CHECK(facts.flights > 0);  // tested with an emitter of its own

  room = office();
  for (Surface& wall : room.surfaces) wall.reflectance = 1.0;
  CHECK(find(inspect(room), "trapped-light", Severity::fault) != nullptr);

  room = office();
  room.emitters[0].power = std::nan("");
  CHECK(find(inspect(room), "emitters", Severity::fault) != nullptr);
  facts = inspect(office(), 1e-6);
  CHECK(find(facts, "tiles", Severity::fault) != nullptr);
  CHECK(find(facts, "tiles", Severity::note) == nullptr);  // nothing is said of tiles that there are not
  CHECK(facts.tiles == 0);

  room = office();
  room.surfaces[0].reflectance = 2.0;
  CHECK_THROWS_AS(inspect(room), InputError);
  CHECK_THROWS_AS(inspect(Room{}), InputError);
  CHECK_THROWS_AS(inspect(office(), -1.0), InputError);
}

TEST_CASE("copies and triangles without area are counted") {
  Room room = office();
  room.surfaces.push_back(room.surfaces[0]);
  room.surfaces.back().name = "floor again";
  room.surfaces.back().without_area = 7;
  const Inspection facts = inspect(room);
  CHECK(facts.duplicate_triangles == 2);
  CHECK(facts.triangles_without_area == 7);
  REQUIRE(find(facts, "one-plane", Severity::warning) != nullptr);
  CHECK_THAT(find(facts, "one-plane", Severity::warning)->text,
             ContainsSubstring("'floor' covers 20 m² of 'floor again'"));
  CHECK(find(facts, "zero-area", Severity::note) != nullptr);
  CHECK(facts.closed);  // the copy blocks light once
}

TEST_CASE("properties that are not modelled are a warning if results depend on them") {
  Room room = office();
  room.ignored = {{"The camera of node 'view' is not used.", Effect::none},
                  {"Material 'glass': the extension KHR_materials_transmission is not modelled.", Effect::figures}};
  const Inspection facts = inspect(room);
  CHECK_THAT(find(facts, "not-modelled", Severity::warning)->text, ContainsSubstring("'glass'"));
  CHECK_THAT(find(facts, "not-modelled", Severity::note)->text, ContainsSubstring("camera"));
}

TEST_CASE("a room of a million metres is a warning, though no unit is likely") {
  Room room = make_cuboid({1e6, 5e5, 1e6}, uniform_reflectance(0.6));
  room.emitters.push_back({"lamp", 2000.0, IsotropicEmitter{{5e5, 2e5, 5e5}}});
  const Inspection facts = inspect(room, 1e5);
  REQUIRE(find(facts, "size", Severity::warning) != nullptr);
  CHECK_THAT(find(facts, "size", Severity::warning)->text, ContainsSubstring("1000000 × 500000 × 1000000 m"));
}

TEST_CASE("a crack is a note, an opening a warning") {
  // A slit along one edge of the ceiling: the share of its area among all surfaces, 86.8 m², is about the share of the
  // flights that leave. 0.1 % of 1 − ρ = 0.4 is 4·10⁻⁴ of them.
  const auto with_slit = [](double width) {
    Room room = office();
    for (glm::dvec3& p : room.surfaces[surface_number(room, "ceiling")].positions) {
      if (p.x > 2.0) p.x -= width;
    }
    return inspect(room);
  };
  const Inspection crack = with_slit(1e-3);  // 5·10⁻⁵
  CHECK(crack.flights_that_left > 0);
  CHECK(crack.count(Severity::warning) == 0);
  CHECK(find(crack, "openings", Severity::note) != nullptr);
  const Inspection opening = with_slit(0.05);  // 2·10⁻³
  CHECK(find(opening, "openings", Severity::warning) != nullptr);
  CHECK(find(opening, "open-edges", Severity::warning) != nullptr);
}

TEST_CASE("a run repeats the gravest warnings in a few lines") {
  Room room = office();
  CHECK(warning_lines(room, inspect(room)).empty());
  room.ignored = {{"Material 'glass' is glass.", Effect::figures}, {"Material 'window' is glass.", Effect::figures}};
  for (Surface& wall : room.surfaces) wall.reflectance = 0.97;
  const std::vector<std::string> lines = warning_lines(room, inspect(room));
  REQUIRE(lines.size() == 2);
  CHECK_THAT(lines[0], ContainsSubstring("'glass'") && ContainsSubstring("(1 more like this: lichtmc check office.)"));
  CHECK_THAT(lines[1], ContainsSubstring("more than 95 %"));
  // More topics than lines: the last says where the others are.
  room = without_surface(room, "wall_x1");
  room.emitters.push_back({"dark", 0.0, IsotropicEmitter{{2.5, 2.4, 2.0}}});
  room.surfaces.push_back(room.surfaces[0]);
  room.surfaces.back().name = "floor again";
  const Inspection facts = inspect(room);
  const std::vector<std::string> few = warning_lines(room, facts, 3);
  REQUIRE(few.size() == 3);
  CHECK_THAT(few[0], ContainsSubstring("power 0"));
  CHECK_THAT(few[2], ContainsSubstring("more warnings: lichtmc check office"));
}

namespace {

// A square panel of 0.6 m that shines upwards or downwards, with 1000 lm, at this height in the office.
Room office_with_panel(double height, bool upwards) {
  Room room = office();
  Surface panel;
  panel.name = "panel";
  const glm::dvec3 x(0.6, 0.0, 0.0);
  const glm::dvec3 z(0.0, 0.0, 0.6);
  add_quad(panel, {2.2, height, 1.7}, upwards ? z : x, upwards ? x : z);
  panel.reflectance = 0.6;
  room.surfaces.push_back(panel);
  room.emitters = {surface_emitter(room.surfaces.size() - 1, 1000.0)};
  room.emitters[0].name = "panel";
  return room;
}

// A solid body: its faces look outwards.
Surface solid(const char* name, const glm::dvec3& corner, const glm::dvec3& size) {
  Surface body = make_box(size);
  for (glm::dvec3& p : body.positions) p += corner;
  for (glm::uvec3& t : body.triangles) std::swap(t.y, t.z);
  body.name = name;
  return body;
}

// An office with its lamp in a cube of this edge, with the faces outwards.
Room lamp_in_a_box(double edge, double reflectance) {
  Room room = office();
  Surface box = solid("bulb", glm::dvec3(2.5, 2.3, 2.0) - 0.5 * edge, glm::dvec3(edge));
  box.reflectance = reflectance;
  room.surfaces.push_back(box);
  room.emitters = {{"lamp", 1000.0, IsotropicEmitter{{2.5, 2.3, 2.0}}}};
  return room;
}

}  // namespace

TEST_CASE("an emitter whose light gets nowhere is a warning with its share") {
  const Inspection up = inspect(office_with_panel(2.59, true));
  REQUIRE(find(up, "emitter-light", Severity::warning) != nullptr);
  CHECK_THAT(find(up, "emitter-light", Severity::warning)->text,
             ContainsSubstring("'panel' lights hardly more than what is next to it") && ContainsSubstring("'ceiling'"));
  const Inspection boxed = inspect(lamp_in_a_box(0.2, 0.6));
  REQUIRE(find(boxed, "emitter-light", Severity::warning) != nullptr);
  CHECK_THAT(find(boxed, "emitter-light", Severity::warning)->text,
             ContainsSubstring("'lamp' is shut in") && ContainsSubstring("'bulb', on the back of its faces"));
  // A globe of 2 m in a hall, that shines inwards.
  Room hall = make_cuboid({20.0, 8.0, 15.0}, uniform_reflectance(0.6));
  Surface globe = make_sphere(16);
  for (glm::dvec3& p : globe.positions) p += glm::dvec3(10.0, 5.0, 7.0);
  for (const bool inwards : {false, true}) {
    Room lit = hall;
    if (inwards) {
      for (glm::uvec3& t : globe.triangles) std::swap(t.y, t.z);
    }
    lit.surfaces.push_back(globe);
    lit.emitters = {surface_emitter(lit.surfaces.size() - 1, 1000.0)};
    const Inspection facts = inspect(lit);
    const glm::uvec3 t = globe.triangles[globe.triangles.size() / 2];
    const glm::dvec3 a = globe.positions[t.x];
    const bool shines_in =
        glm::dot(glm::cross(globe.positions[t.y] - a, globe.positions[t.z] - a), a - glm::dvec3(10.0, 5.0, 7.0)) < 0.0;
    CHECK((find(facts, "emitter-light", Severity::warning) != nullptr) == shines_in);
  }
  // A box of which one side is missing lets out less than a third of the light if it is black, more if it is white.
  for (const double reflectance : {0.0, 0.8}) {
    Room room = lamp_in_a_box(0.2, reflectance);
    auto& triangles = room.surfaces.back().triangles;
    triangles.erase(triangles.begin(), triangles.begin() + 2);  // below
    CHECK((find(inspect(room), "emitter-light", Severity::warning) != nullptr) == (reflectance == 0.0));
  }
}

TEST_CASE("usual luminaires are no warning: panels, uplights, lamps close to a ceiling") {
  for (const Room& room : {office_with_panel(2.59, false), office_with_panel(2.3, true), office_with_panel(1.5, true)})
    CHECK(find(inspect(room), "emitter-light", Severity::warning) == nullptr);
  Room room = office();
  room.emitters = {{"bulb under the ceiling", 1000.0, IsotropicEmitter{{2.5, 2.5, 2.0}}}};
  CHECK(find(inspect(room), "emitter-light", Severity::warning) == nullptr);
}

TEST_CASE("light that nothing absorbs: the fault names the emitter and the body about it") {
  const Inspection facts = inspect(lamp_in_a_box(0.2, 1.0));
  REQUIRE(find(facts, "trapped-light", Severity::fault) != nullptr);
  CHECK_THAT(find(facts, "trapped-light", Severity::fault)->text,
             ContainsSubstring("'lamp'") && ContainsSubstring("'bulb'"));
  CHECK_THROWS_WITH(simulate(lamp_in_a_box(0.2, 1.0)), ContainsSubstring("'lamp'") && ContainsSubstring("'bulb'"));
}

TEST_CASE("a lamp is proposed in the room, not in its walls or in the ground") {
  // A room of 4 × 2.5 × 3 m in a house of solid walls, on ground of 40 × 3 × 40 m.
  Room room;
  room.source = "house";
  room.surfaces = {solid("ground", {-20, -3, -20}, {40, 3, 40}),     solid("roof", {-0.5, 2.5, -0.5}, {5, 0.5, 4}),
                   solid("wall x0", {-0.5, 0, -0.5}, {0.5, 2.5, 4}), solid("wall x1", {4, 0, -0.5}, {0.5, 2.5, 4}),
                   solid("wall z0", {0, 0, -0.5}, {4, 2.5, 0.5}),    solid("wall z1", {0, 0, 3}, {4, 2.5, 0.5})};
  const Inspection facts = inspect(room);
  REQUIRE(facts.inside_is_sure);
  CHECK((facts.inside.x > 0.0 && facts.inside.x < 4.0));
  CHECK((facts.inside.y > 0.0 && facts.inside.y < 2.5));
  CHECK((facts.inside.z > 0.0 && facts.inside.z < 3.0));
  CHECK(facts.flights_that_left == 0);
  // Nothing encloses a point above a single floor.
  Room open;
  open.source = "floor";
  open.surfaces = {make_floor(4.0, 3.0)};
  const Inspection unknown = inspect(open);
  CHECK_FALSE(unknown.inside_is_sure);
  CHECK_THAT(find(unknown, "emitters", Severity::fault)->advice,
             ContainsSubstring("does not tell where the inside is"));
}

TEST_CASE("receivers outside the bounds of the room are a warning, also where a lamp may emit outwards") {
  Room room = office();
  const auto receiver = [](const char* name, const glm::dvec3& position) {
    Receiver one;
    one.name = name;
    one.position = position;
    return one;
  };
  // In the plane of the ceiling: the closed walls do not tell on which side the light is. It emits downwards.
  room.emitters = {{"lamp", 2000.0, LambertEmitter{{2.5, 2.6, 2.0}}}};
  room.receivers = {receiver("inside", {1.0, 0.8, 1.0}), receiver("at the wall", {5.0 + 1e-7, 1.0, 1.0})};
  CHECK(find(inspect(room), "receivers", Severity::warning) == nullptr);
  room.receivers.push_back(receiver("far", {10.0, 1.0, 1.0}));
  room.receivers.push_back(receiver("below", {1.0, -0.5, 1.0}));
  const std::string text =
      "2 receivers of 4 lie outside the room, which extends from x, y, z = 0 to 5, 0 to 2.6, 0 to 4 m. The first: "
      "'far' at (10, 1, 1) m.";
  const Inspection facts = inspect(room);
  REQUIRE(find(facts, "receivers", Severity::warning) != nullptr);
  CHECK(find(facts, "receivers", Severity::warning)->text == text);
  Settings settings;
  settings.photons = 1000;
  settings.measured = Measured::receivers;
  CHECK_THAT(simulate(room, settings).warnings.at(0), ContainsSubstring(text));
  // Above a single floor, outside of its bounds, a receiver gets light: the result has no warning of it.
  Room open;
  open.source = "floor";
  open.surfaces = {make_floor(4.0, 3.0)};
  open.emitters = {{"lamp", 2000.0, LambertEmitter{{2.0, 2.6, 1.5}}}};
  open.receivers = {receiver("above", {2.0, 1.0, 1.5})};
  CHECK_THAT(find(inspect(open), "receivers", Severity::warning)->text,
             ContainsSubstring("Receiver 'above' at (2, 1, 1.5) m lies outside the room"));
  for (const std::string& warning : simulate(open, settings).warnings)
    CHECK_THAT(warning, !ContainsSubstring("Receiver 'above'"));
}

TEST_CASE("advice that goes together works together") {
  // 5 × 2.6 × 4 m in inches, Z up.
  Room room = make_cuboid(glm::dvec3(5.0, 4.0, 2.6) / 0.0254, uniform_reflectance(0.5));
  room.source = "inches.glb";
  const Inspection facts = inspect(room, 10.0);
  CHECK_THAT(find(facts, "emitters", Severity::fault)->advice,
             ContainsSubstring("lichtmc run inches.glb --scale 0.0254 --up z --light point:2.5,1.3,-2:1000lm"));
}
