#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/message.hpp"
#include "lichtmc/cuboid.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/room.hpp"
#include "run/warnings.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Room sound_room() {
  Room room = make_cuboid({4.0, 3.0, 5.0}, uniform_reflectance(0.5));
  room.source = "hall.glb";
  room.emitters.push_back({"lamp", 100.0, IsotropicEmitter{{2.0, 2.0, 2.0}}});
  room.receivers.push_back({"desk", {1.0, 0.8, 1.0}, {0.0, 1.0, 0.0}, 90.0, 1.0});
  return room;
}

Room with_emitter(Emitter emitter) {
  Room room = sound_room();
  room.emitters = {std::move(emitter)};
  return room;
}

// A valid room with one fault must be refused, and the message must contain all of these.
void refuses(const Room& room, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    CAPTURE(part);
    REQUIRE_THROWS_AS(check_room(room), InputError);
    CHECK_THROWS_WITH(check_room(room), ContainsSubstring(part));
  }
}

void refuses(const std::function<void(Room&)>& spoil, const std::vector<std::string>& parts) {
  Room room = sound_room();
  spoil(room);
  refuses(room, parts);
}

}  // namespace

TEST_CASE("check_room accepts a valid room and values at the limits of their ranges") {
  CHECK_NOTHROW(check_room(sound_room()));
  Room room = sound_room();
  room.surfaces[0].reflectance = 0.0;
  room.surfaces[1].reflectance = 1.0;
  room.surfaces[2].uvs.clear();
  room.receivers[0].half_angle_deg = 0.0;
  room.receivers[0].area_m2 = 0.0;
  room.emitters.push_back({"off", 0.0, LambertEmitter{{1.0, 1.0, 1.0}, {0.0, -1e-9, 0.0}, 0.0}});
  room.emitters.push_back({"spot", 1.0, SpotEmitter{{1.0, 1.0, 1.0}, {0.0, 5.0, 0.0}, 0.0, std::acos(0.0)}});
  room.emitters.push_back({"panel", 1.0, SurfaceEmitter{1, 1.0}});
  CHECK_NOTHROW(check_room(room));
}

TEST_CASE("check_room refuses rooms that cannot be simulated") {
  refuses([](Room& r) { r.surfaces.clear(); }, {"hall.glb", "triangle", "area"});
  refuses([](Room& r) { r.emitters.clear(); }, {"hall.glb", "emitter", "--light"});
  refuses(
      [](Room& r) {
        for (Surface& s : r.surfaces) s.triangles = {{0, 1, 1}};
      },
      {"hall.glb", "triangle with an area"});
}

TEST_CASE("check_room names the surface and the value that is wrong") {
  refuses([](Room& r) { r.surfaces[3].reflectance = 1.25; },
          {"hall.glb", "'wall_x1'", "1.25", "0 to 1", "reflectance"});
  refuses([](Room& r) { r.surfaces[3].reflectance = -0.5; }, {"'wall_x1'", "-0.5"});
  refuses([](Room& r) { r.surfaces[3].reflectance = not_a_number; }, {"'wall_x1'", "nan"});
  refuses([](Room& r) { r.surfaces[1].triangles[1].y = 4; }, {"'ceiling'", " is 4 ", "below 4"});
  refuses([](Room& r) { r.surfaces[0].positions[2].z = infinity; }, {"'floor'", "inf", "finite"});
  refuses([](Room& r) { r.surfaces[0].uvs.pop_back(); }, {"'floor'", " is 3 ", "texture coordinates"});
}

TEST_CASE("check_room names the emitter and the value that is wrong") {
  const glm::dvec3 p(1.0);
  const glm::dvec3 down(0.0, -1.0, 0.0);
  refuses(with_emitter({"lamp", -2.0, IsotropicEmitter{p}}), {"hall.glb", "'lamp'", "-2", " lm "});
  refuses(with_emitter({"lamp", infinity, IsotropicEmitter{p}}), {"'lamp'", "inf"});
  refuses(with_emitter({"lamp", not_a_number, IsotropicEmitter{p}}), {"'lamp'", "nan"});
  refuses(with_emitter({"lamp", 0.0, IsotropicEmitter{p}}), {"sum of the emitters' powers", "above 0"});
  refuses(with_emitter({"lamp", 1.0, IsotropicEmitter{{not_a_number, 0.0, 0.0}}}), {"'lamp'", "(nan, 0, 0)"});
  refuses(with_emitter({"lamp", 1.0, LambertEmitter{p, glm::dvec3(0.0), 1.0}}), {"'lamp'", "(0, 0, 0)", "direction"});
  refuses(with_emitter({"lamp", 1.0, LambertEmitter{p, down, -0.5}}), {"'lamp'", "-0.5", "exponent"});
  refuses(with_emitter({"lamp", 1.0, LambertEmitter{p, down, not_a_number}}), {"'lamp'", "nan", "exponent"});
  refuses(with_emitter({"lamp", 1.0, SpotEmitter{p, down, 0.2, 1.6}}), {"'lamp'", "1.6", "outer"});
  refuses(with_emitter({"lamp", 1.0, SpotEmitter{p, down, 0.0, 0.0}}), {"'lamp'", "outer"});
  refuses(with_emitter({"lamp", 1.0, SpotEmitter{p, down, 0.6, 0.5}}), {"'lamp'", "0.6", "inner"});
  CHECK_NOTHROW(check_room(with_emitter({"lamp", 1.0, SpotEmitter{p, down, 0.5, 0.5}})));  // a hard edge
  refuses(with_emitter({"lamp", 1.0, SpotEmitter{p, down, -0.1, 0.5}}), {"'lamp'", "-0.1", "inner"});
  refuses(with_emitter({"lamp", 1.0, SurfaceEmitter{6, 1.0}}), {"'lamp'", " is 6 ", "below 6"});
  Room room = with_emitter({"lamp", 1.0, SurfaceEmitter{2, 1.0}});
  room.surfaces[2].triangles.clear();
  refuses(room, {"'lamp'", "area"});
}

TEST_CASE("check_room names the receiver and the value that is wrong") {
  refuses([](Room& r) { r.receivers[0].half_angle_deg = 90.5; }, {"'desk'", "90.5", "0 to 90"});
  refuses([](Room& r) { r.receivers[0].half_angle_deg = not_a_number; }, {"'desk'", "nan"});
  refuses([](Room& r) { r.receivers[0].area_m2 = -1.0; }, {"'desk'", "-1"});
  refuses([](Room& r) { r.receivers[0].normal = glm::dvec3(0.0); }, {"'desk'", "(0, 0, 0)"});
  refuses([](Room& r) { r.receivers[0].position.x = infinity; }, {"'desk'", "inf"});
}

TEST_CASE("the area of a surface is the sum of its triangles for any winding") {
  Surface surface;
  CHECK(surface_area(surface) == 0.0);
  // 3-4-5 right triangles: products and roots of small integers are exact.
  surface.positions = {{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {3.0, 4.0, 0.0}, {0.0, 0.0, 2.0}};
  surface.triangles = {{0, 1, 2}, {2, 1, 0}, {0, 1, 1}};
  CHECK(surface_area(surface) == 12.0);
  surface.triangles = {{0, 1, 3}};
  CHECK(surface_area(surface) == 3.0);
}

TEST_CASE("the power of a room is the sum of its emitters") {
  Room room;
  CHECK(total_power(room) == 0.0);
  room.emitters.push_back({"a", 1.5, IsotropicEmitter{}});
  room.emitters.push_back({"b", 2.25, SurfaceEmitter{}});
  CHECK(total_power(room) == 3.75);
}

TEST_CASE("an emitter well inside a room far from the origin is not reported as outside or on the boundary") {
  Room room = make_cuboid({4.0, 2.6, 5.0}, uniform_reflectance(0.5));
  const glm::dvec3 move(691608.2, 520.0, -5334760.4);
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& p : surface.positions) p += move;
  }
  const auto reported = [&](const glm::dvec3& place) {
    room.emitters = {{"lamp", 100.0, IsotropicEmitter{move + place}}};
    const std::vector<Advised> outside = emitters_outside(room);
    return outside.empty() ? std::string() : outside.front().what;
  };
  CHECK(reported({2.0, 2.0, 2.5}).empty());
  CHECK(reported({2.0, 2.599, 2.5}).empty());
  CHECK_THAT(reported({2.0, 2.6, 2.5}), ContainsSubstring("(691610.2, 522.6, -5334757.9) m lies on the boundary"));
  CHECK_THAT(reported({2.0, 2.61, 2.5}), ContainsSubstring("outside the room") && ContainsSubstring("520 to 522.6"));
}

TEST_CASE("coordinates are written to the millimetre, small ones to three digits") {
  CHECK(position_text(-5334760.4) == "-5334760.4");
  CHECK(position_text(12.34567) == "12.346");
  CHECK(position_text(2.0) == "2");
  CHECK(position_text(-1e-17) == "0");
  CHECK(position_text(0.000123456) == "0.000123");
}
