#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "lichtmc/lichtmc.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

Room room_of(std::vector<Surface> surfaces, std::vector<Emitter> emitters) {
  Room room;
  room.source = "test";
  room.surfaces = std::move(surfaces);
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) room.surfaces[k].name += std::to_string(k);
  room.emitters = std::move(emitters);
  return room;
}

Surface moved(Surface surface, const glm::dvec3& by) {
  for (glm::dvec3& p : surface.positions) p += by;
  return surface;
}

// A surface from a grid of n × m points that closes along its first parameter.
template <class F>
Surface swept(const F& point, int n, int m) {
  Surface surface;
  surface.name = "swept";
  for (int j = 0; j <= m; ++j) {
    for (int i = 0; i < n; ++i) surface.positions.push_back(point(double(i) / n, double(j) / m));
  }
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<std::uint32_t>(j * n + i);
      const auto b = static_cast<std::uint32_t>(j * n + (i + 1) % n);
      const auto up = static_cast<std::uint32_t>(n);
      for (const glm::uvec3& t : {glm::uvec3(a, b, a + up), glm::uvec3(b, b + up, a + up)}) {
        const auto same = [&](int k, int l) { return surface.positions[t[k]] == surface.positions[t[l]]; };
        if (!same(0, 1) && !same(1, 2) && !same(2, 0)) surface.triangles.push_back(t);  // not at a pole
      }
    }
  }
  return surface;
}

// A round cave with a mouth towards +z in a rock 1.5 m thick: one smooth skin, from the inside (v < 0.45) over the rim
// of the mouth to the outside (v > 0.55).
glm::dvec3 skin_of_cave(double u, double v) {
  constexpr double pi = std::numbers::pi;
  constexpr double mouth = 0.55;
  const double turn = std::clamp((v - 0.45) / 0.1, 0.0, 1.0) * pi;
  const double radius = 5.75 - 0.75 * std::cos(turn);
  const double polar = v < 0.45   ? v / 0.45 * (pi - mouth)
                       : v > 0.55 ? (1.0 - v) / 0.45 * (pi - mouth)
                                  : pi - mouth + 0.13 * std::sin(turn);
  const double bumps = 0.2 * std::sin(7.0 * polar) * std::sin(10.0 * pi * u);
  return (radius + bumps) * glm::dvec3(std::sin(polar) * std::cos(2.0 * pi * u),
                                       std::sin(polar) * std::sin(2.0 * pi * u), -std::cos(polar));
}

// A vault of radius 3 m and thickness 0.5 m along z, 12 m long, open at both ends.
Surface make_vault() {
  return swept(
      [](double u, double v) {
        const bool inner = u < 0.5;
        const double angle = std::numbers::pi * (inner ? 2.0 * u : 2.0 - 2.0 * u);
        const double radius = inner ? 3.0 : 3.5;
        return glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), 12.0 * v - 6.0);
      },
      64, 1);
}

Surface make_ground(double half) {
  return moved(make_floor(2.0 * half, 2.0 * half), {-half, 0.0, -half});
}

struct Drawn {
  Room room;
  Result result;
  RoomPainter painter;
  ColourScale scale;
  explicit Drawn(Room the_room, double tile_edge_m = 0.5)
      : room(std::move(the_room)),
        result(simulate(room, settings_of(Estimator::collision, Engine::automatic, 1e5, 3, tile_edge_m))),
        painter(room, result, 1),
        scale(choose_scale(result)) {}
  Picture draw(View view) const { return painter.draw(view, scale, 240, 164); }
};

// Whether the picture shows the irradiance of the tiles of a floor in the middle of the room.
bool shows(const Drawn& drawn, const Picture& picture, std::size_t surface) {
  std::size_t shown = 0;
  std::size_t all = 0;
  for (std::size_t t = 0; t < drawn.result.tiles.size(); ++t) {
    const Tile& tile = drawn.result.tiling.tiles[t];
    if (drawn.result.tiling.maps[tile.map].surface != surface) continue;
    const glm::dvec4 at = picture.to_pixel * glm::dvec4(tile.point, 1.0);
    const double x = at.x / at.w;
    const double y = at.y / at.w;
    if (std::hypot(tile.point.x, tile.point.z) > 2.0 || tile.point.y > 1.0 || x < 0.0 || y < 0.0 || x >= 240.0 ||
        y >= 164.0)
      continue;
    ++all;
    const float seen = picture.irradiance[static_cast<std::size_t>(y) * picture.width + static_cast<std::size_t>(x)];
    if (std::abs(seen - drawn.result.tiles[t].irradiance) <= 1e-3 * seen) ++shown;
  }
  return all > 0 && 2 * shown > all;
}

}  // namespace

TEST_CASE("views: the outer skin of a cave is not drawn, though the lit inside goes on in it without an edge") {
  const Drawn drawn(room_of({swept(skin_of_cave, 96, 96)}, {isotropic({0.0, 0.0, -1.0})}));
  std::size_t inside = 0;
  std::size_t outside = 0;
  for (std::size_t n = 0; n < drawn.room.surfaces[0].triangles.size(); ++n) {
    const glm::uvec3& t = drawn.room.surfaces[0].triangles[n];
    const double v = static_cast<double>(std::min({t.x, t.y, t.z}) / 96) / 96.0;
    const SideLight side = drawn.painter.lit_sides()[0][n];
    if (v < 0.4) inside += side.front != side.back ? 1U : 0U;
    if (v > 0.75) outside += side.front || side.back ? 1U : 0U;
  }
  CHECK(inside == 96 + 38 * 192);
  CHECK(outside == 0);
}

TEST_CASE("views: a floor under a vault is shown by cutting the vault open") {
  // The ground outside is lit, and from there the top of the vault: nothing is transparent.
  const Drawn drawn(
      room_of({make_ground(8.0), make_vault()}, {isotropic({0.0, 2.0, 0.0}, 1.0), isotropic({6.0, 8.0, 5.0}, 3.0)}));
  const Picture above = drawn.draw(View::above);
  REQUIRE(above.cut_y_m.has_value());
  CHECK(*above.cut_y_m < 3.5);
  CHECK(shows(drawn, above, 0));
}

TEST_CASE("views: a hall in a lit shell is cut open, one in a dark shell is seen through it") {
  const Surface hall = moved(make_box({10.0, 4.0, 8.0}), {-5.0, 0.5, -4.0});
  const Surface shell = moved(make_box({12.0, 5.5, 10.0}), {-6.0, 0.0, -5.0});
  const Emitter lamp = isotropic({0.0, 4.0, 0.0});
  const Drawn dark(room_of({hall, shell}, {lamp}));
  for (const View view : {View::corner, View::above}) {
    const Picture picture = dark.draw(view);
    CHECK_FALSE(picture.cut_y_m.has_value());
    CHECK_FALSE(picture.from_inside);
    CHECK(shows(dark, picture, 0));
  }
  const Drawn lit(
      room_of({hall, shell, moved(make_ground(12.0), {0.0, -0.2, 0.0})}, {lamp, isotropic({9.0, 12.0, 8.0}, 0.3)}));
  const Picture open = lit.draw(View::above);
  REQUIRE(open.cut_y_m.has_value());
  CHECK(*open.cut_y_m < 5.5);
  CHECK(shows(lit, open, 0));
}

TEST_CASE("views: an ordinary room is drawn whole") {
  const Drawn drawn(unit_cube(0.5, paper_emitter()), 0.1);
  for (const View view : {View::corner, View::above}) {
    CHECK_FALSE(drawn.draw(view).cut_y_m.has_value());
    CHECK_FALSE(drawn.draw(view).from_inside);
  }
}

TEST_CASE("views: small things in the dark are not drawn, those in the light are") {
  std::vector<Surface> surfaces{make_box({6.0, 3.0, 5.0})};
  for (int k = 0; k < 10; ++k) {
    surfaces.push_back(moved(make_box(glm::dvec3(0.02)), {9.0 + 0.1 * k, 0.0, 2.0}));
    surfaces.push_back(moved(make_box(glm::dvec3(0.02)), {2.0 + 0.1 * k, 1.0, 2.0}));
  }
  const Drawn drawn(room_of(surfaces, {isotropic({3.0, 2.8, 2.5})}));
  for (std::size_t s = 1; s < surfaces.size(); ++s) {
    const bool outside = s % 2 == 1;
    for (const SideLight& side : drawn.painter.lit_sides()[s]) CHECK((side.front || side.back) == !outside);
  }
}

TEST_CASE("plans: bodies with plane sides and surfaces in many pieces have no tile map, curved surfaces have") {
  Surface leaves;
  leaves.name = "leaves";
  for (int k = 0; k < 200; ++k) {
    const double angle = 2.4 * k;
    const glm::dvec3 s(0.3 * std::cos(angle), 0.0, 0.3 * std::sin(angle));
    add_quad(leaves, {1.0 + 0.02 * k, 0.5 + 0.01 * k, 1.0 + 0.3 * (k % 10)}, s, {0.1 * std::sin(angle), 0.3, 0.0});
  }
  const auto sphere = [](double u, double v) {
    const double azimuth = 2.0 * std::numbers::pi * u;
    const double r = v > 0.0 && v < 1.0 ? std::sin(std::numbers::pi * v) : 0.0;
    return glm::dvec3(1.5 + r * std::cos(azimuth), 1.2 - std::cos(std::numbers::pi * v), 3.5 + r * std::sin(azimuth));
  };
  const Surface ball = swept(sphere, 24, 12);
  const Drawn drawn(
      room_of({make_box({6.0, 3.0, 5.0}), leaves, moved(make_box({0.8, 2.0, 0.6}), {4.0, 0.01, 0.3}), ball},
              {isotropic({3.0, 2.8, 2.5})}),
      0.1);
  const SurfacePlans drawings = draw_plans(drawn.room, drawn.result, drawn.painter.lit_sides(), drawn.scale, 24);
  std::vector<std::string> maps;
  for (const SurfacePlan& plan : drawings.plans) {
    if (!plan.flat) maps.push_back(drawn.result.tiling.maps[plan.map].name);
  }
  CHECK(maps == std::vector<std::string>{"swept3"});
  REQUIRE(drawings.left_out.size() == 1);
  CHECK(drawings.left_out[0] == "In many or small parts, therefore without a plan: leaves1, box2.");
}
