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
  CHECK(find(facts, "duplicates", Severity::warning) != nullptr);
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
