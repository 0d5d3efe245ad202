// Reflectance maps: values between pixels, beyond the edges, and over a surface.
#include <algorithm>
#include <cmath>
#include <vector>

#include "lichtmc/error.hpp"
#include "lichtmc/overrides.hpp"
#include "lichtmc/room.hpp"
#include "room/reflectance.hpp"
#include "support/catch.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

ReflectanceMap four_pixels(Wrap wrap) {
  return {"four", 2, 2, {0.0F, 0.25F, 0.5F, 1.0F}, wrap, wrap};
}

// A floor of 2 m × 1 m with a reflectance map that repeats `times` times.
Room floor_with_map(ReflectanceMap map, double times) {
  Room room;
  Surface floor = make_floor(2.0, 1.0, 3, times);
  floor.material = "tiles";
  floor.reflectance_uvs = floor.uvs;
  floor.reflectance_map = 0;
  room.reflectance_maps.push_back(std::move(map));
  room.surfaces.push_back(std::move(floor));
  room.emitters.push_back({"lamp", 1.0, IsotropicEmitter{{1.0, 1.0, 0.5}}});
  room.surfaces[0].reflectance = mean_reflectance(room, room.surfaces[0]);
  return room;
}

}  // namespace

TEST_CASE("a reflectance map has its values at the centres of its pixels and is linear between them") {
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
    const ReflectanceMap map = four_pixels(wrap);
    CHECK(reflectance_at(map, 0.25, 0.25) == 0.0);
    CHECK(reflectance_at(map, 0.75, 0.25) == 0.25);
    CHECK(reflectance_at(map, 0.25, 0.75) == 0.5);
    CHECK(reflectance_at(map, 0.75, 0.75) == 1.0);
    CHECK(reflectance_at(map, 0.5, 0.25) == 0.125);
    CHECK(reflectance_at(map, 0.5, 0.5) == 0.4375);
    CHECK(reflectance_at(map, 0.375, 0.25) == 0.0625);
  }
}

TEST_CASE("beyond its edges a reflectance map continues by its wrap mode") {
  // Half a pixel beyond the edge: between the two opposite edges of a repeated image; the edge itself for the others.
  CHECK(reflectance_at(four_pixels(Wrap::repeat), 0.0, 0.25) == 0.125);
  CHECK(reflectance_at(four_pixels(Wrap::clamp), 0.0, 0.25) == 0.0);
  CHECK(reflectance_at(four_pixels(Wrap::mirror), 0.0, 0.25) == 0.0);
  CHECK(reflectance_at(four_pixels(Wrap::repeat), 1.0, 0.25) == 0.125);
  CHECK(reflectance_at(four_pixels(Wrap::clamp), 1.0, 0.25) == 0.25);
  // The next repetition.
  CHECK(reflectance_at(four_pixels(Wrap::repeat), 1.25, -0.75) == 0.0);
  CHECK(reflectance_at(four_pixels(Wrap::clamp), 1.25, -0.75) == 0.25);
  CHECK(reflectance_at(four_pixels(Wrap::mirror), 1.25, 0.25) == 0.25);
  CHECK(reflectance_at(four_pixels(Wrap::mirror), 1.75, 0.25) == 0.0);
  CHECK(reflectance_at(four_pixels(Wrap::mirror), -0.25, 0.25) == 0.0);
  // At the largest numbers.
  for (const double far : {1e300, -1e300, 1e17, -1e-300}) {
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
      const double rho = reflectance_at(four_pixels(wrap), far, far);
      CHECK((rho >= 0.0 && rho <= 1.0));
    }
  }
  const ReflectanceMap one{"one", 1, 1, {0.3F}, Wrap::repeat, Wrap::clamp};
  CHECK(reflectance_at(one, 0.9, 17.0) == double{0.3F});
}

TEST_CASE("the mean reflectance of a surface is that of its reflectance map over its area") {
  // A reflectance map repeated over whole periods has the mean of its values, whatever the interpolation.
  CHECK(floor_with_map(four_pixels(Wrap::repeat), 3.0).surfaces[0].reflectance == Approx(0.4375).margin(0.002));
  // Clamped, a linear ramp from 0.25 to 0.75 of the way: 0 on a quarter, 1 on a quarter, ½ on average between.
  const ReflectanceMap ramp{"ramp", 2, 1, {0.0F, 1.0F}, Wrap::clamp, Wrap::clamp};
  CHECK(floor_with_map(ramp, 1.0).surfaces[0].reflectance == Approx(0.5).margin(1e-9));
  // A constant value is exact.
  const ReflectanceMap even{"even", 3, 5, std::vector<float>(15, 0.75F), Wrap::repeat, Wrap::mirror};
  CHECK(floor_with_map(even, 7.0).surfaces[0].reflectance == Approx(0.75).epsilon(1e-12));
}

TEST_CASE("a reflectance map whose numbers do not fit the room is refused") {
  const auto refusal = [](const Room& room) -> std::string {
    try {
      check_room(room);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const Room sound = floor_with_map(four_pixels(Wrap::repeat), 1.0);
  CHECK(refusal(sound).empty());
  Room room = sound;
  room.reflectance_maps[0].values[2] = 1.5F;
  CHECK_THAT(refusal(room), ContainsSubstring("reflectance map 'four'") && ContainsSubstring("1.5"));
  room = sound;
  room.reflectance_maps[0].columns = 3;
  CHECK_THAT(refusal(room), ContainsSubstring("number of values"));
  room = sound;
  room.surfaces[0].reflectance_map = 1;
  CHECK_THAT(refusal(room), ContainsSubstring("surface 'floor'") && ContainsSubstring("below 1"));
  room = sound;
  room.surfaces[0].reflectance_uvs.pop_back();
  CHECK_THAT(refusal(room), ContainsSubstring("one per position"));
  room = sound;
  room.surfaces[0].reflectance_uvs[0].x = std::nan("");
  CHECK_THAT(refusal(room), ContainsSubstring("finite"));
}

TEST_CASE("input overrides change reflectance maps") {
  Room room = floor_with_map(four_pixels(Wrap::repeat), 1.0);
  limit_reflectance(room, 0.9);
  CHECK(reflectance_at(room.reflectance_maps[0], 0.75, 0.75) <= 0.9);
  CHECK(reflectance_at(room.reflectance_maps[0], 0.75, 0.75) == Approx(0.9).epsilon(1e-6));
  CHECK(room.surfaces[0].reflectance == Approx((0.25 + 0.5 + 0.9) / 4.0).margin(0.002));
  CHECK(room.overrides.size() == 1);
  limit_reflectance(room, 0.9);
  CHECK(room.overrides.size() == 1);  // nothing is above the limit any more
  set_reflectance(room, "tiles", 0.4);
  CHECK(!room.surfaces[0].reflectance_map);
  CHECK(room.surfaces[0].reflectance == 0.4);
}

TEST_CASE("input overrides change vertex colours") {
  Room room = floor_with_map(four_pixels(Wrap::repeat), 1.0);
  room.surfaces.push_back(room.surfaces[0]);
  room.surfaces[1].name = "coloured";
  room.surfaces[1].vertex_colours.assign(room.surfaces[1].positions.size(), glm::dvec3(0.95));
  // The limit applies to the product; the map of the other surface becomes its own.
  limit_reflectance(room, 0.9);
  REQUIRE(room.reflectance_maps.size() == 2);
  CHECK(room.surfaces[0].reflectance_map == 1);
  CHECK(double{*std::max_element(room.reflectance_maps[1].values.begin(), room.reflectance_maps[1].values.end())} <=
        0.9);
  const Surface& coloured = room.surfaces[1];
  CHECK(coloured.highest_reflectance == 0.9);
  const auto at = [&](double u, double v) {
    return coloured_reflectance(coloured.vertex_colours[0], &room.reflectance_maps[0], {u, v},
                                coloured.highest_reflectance);
  };
  CHECK(at(0.75, 0.75) == 0.9);
  CHECK(at(0.25, 0.25) == Approx(0.95 * reflectance_at(room.reflectance_maps[0], 0.25, 0.25)));
  set_reflectance(room, "tiles", 0.4);
  CHECK(room.surfaces[1].vertex_colours.empty());
  CHECK(mean_reflectance(room, room.surfaces[1]) == 0.4);
}

TEST_CASE("the mean of vertex colours is that of the corners, unless a limit cuts them") {
  Room room;
  room.surfaces.push_back(make_floor(1.0, 1.0));
  Surface& floor = room.surfaces[0];
  for (const glm::dvec3& p : floor.positions) floor.vertex_colours.emplace_back(p.x);
  CHECK(mean_reflectance(room, floor) == Approx(0.5).epsilon(1e-12));
  // ∫ min(x, ½) dx = 3/8.
  floor.highest_reflectance = 0.5;
  CHECK(mean_reflectance(room, floor) == Approx(0.375).margin(1e-4));
}
