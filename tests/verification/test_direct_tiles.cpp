// The sampled direct light of tiles: unbiased, with honest standard errors, by runs with different seeds.
//
// All light that enters a closed room arrives somewhere: the direct light on both sides of all tiles, however they
// shade each other, adds up to the flux of the emitters exactly. The sum's error is that of its tiles, added in
// quadrature. A shadow that lies on one surface as a whole is known by solid angles too.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lichtmc/tiles.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"
#include "walk/direct_tiles.hpp"
#include "walk/scene.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;

Surface board(const glm::dvec3& corner, const glm::dvec3& s, const glm::dvec3& t) {
  Surface surface;
  surface.name = "board";
  add_quad(surface, corner, s, t);
  surface.reflectance = 0.5;
  return surface;
}

// A unit cube with two boards, without emitters.
Room with_boards() {
  Room room = unit_cube(0.5, isotropic({0.5, 0.5, 0.5}));
  room.emitters.clear();
  room.surfaces.push_back(board({0.3, 0.6, 0.35}, {0.4, 0, 0}, {0, 0, 0.3}));
  room.surfaces.push_back(board({0.15, 0.1, 0.2}, {0, 0.3, 0.1}, {0.1, 0, 0.5}));
  return room;
}

// Adds a panel that shines downwards, of n × n quads.
void add_panel(Room& room, double height, double x, double z, double size, int n, double exponent = 1.0) {
  Surface panel;
  panel.name = "panel";
  panel.reflectance = 0.5;
  const double edge = size / n;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) add_quad(panel, {x + i * edge, height, z + j * edge}, {edge, 0, 0}, {0, 0, edge});
  }
  room.emitters.push_back(surface_emitter(room.surfaces.size(), 1.0, exponent));
  room.surfaces.push_back(std::move(panel));
}

// A panel whose map is dark in one corner and bright in the other.
void add_mapped_panel(Room& room, double height) {
  add_panel(room, height, 0.2, 0.3, 0.5, 1);
  const Surface& panel = room.surfaces.back();
  auto& shape = std::get<SurfaceEmitter>(room.emitters.back().shape);
  shape.emission_map = 0;
  for (const glm::dvec3& p : panel.positions) shape.emission_uvs.emplace_back((p.x - 0.2) / 0.5, (p.z - 0.3) / 0.5);
  room.emission_maps.push_back({"uneven", 3, 2, {0.1F, 2.0F, 0.3F, 0.7F, 0.0F, 5.0F}, Wrap::clamp, Wrap::clamp});
}

struct Flux {
  double value = 0.0;
  double standard_error = 0.0;
};

// The direct light of a room's tiles by several seeds.
class Runs {
 public:
  Runs(const Room& room, double tile)
      : room_(room),
        tiling_(make_tiling(room, tile)),
        scene_(room, tiling_, Engine::embree),
        light_(room, *scene_.tracer),
        faces_(room, tiling_, *scene_.tracer) {}

  // The flux on a surface, or on all if the name is empty.
  Flux flux(std::uint64_t seed, const TileAccuracy& accuracy, const std::string& surface = "") {
    const DirectTiles tiles(light_, faces_, *scene_.tracer, Stream(seed), accuracy);
    Flux sum;
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      const TileMap& map = tiling_.maps[tiling_.tiles[faces_[face].tile].map];
      if (!surface.empty() && room_.surfaces[map.surface].name != surface) continue;
      const DirectIrradiance mean = tiles.mean(face, count_);
      sum.value += mean.value * faces_.area_m2(face);
      sum.standard_error = std::hypot(sum.standard_error, mean.standard_error * faces_.area_m2(face));
    }
    return sum;
  }

  const TraceCount& traced() const { return count_; }

 private:
  const Room& room_;
  Tiling tiling_;
  Scene scene_;
  DirectLight light_;
  TileFaces faces_;
  TraceCount count_;
};

// Compares the fluxes of many seeds with the expected one; a bias and wrong standard errors must be noticed.
void check_runs(const std::string& what, Runs& runs, const TileAccuracy& accuracy, double expected, double bias,
                const std::string& surface = "") {
  constexpr std::uint64_t seeds = 100;
  std::vector<Compared> figures;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Flux flux = runs.flux(seed, accuracy, surface);
    figures.push_back({flux.value, flux.standard_error, expected, 0.0});
  }
  const Judgement verdict = compare(figures);
  INFO(what << ": " << verdict.text);
  WARN(what << ": " << verdict.text);
  CHECK(verdict.agrees);
  CHECK(verdict.smallest_bias < bias);
  const auto mutated = [&figures](const std::function<void(Compared&)>& change) {
    std::vector<Compared> changed = figures;
    for (Compared& one : changed) change(one);
    return compare(changed).agrees;
  };
  CHECK_FALSE(mutated([bias](Compared& one) { one.value *= 1.0 + bias; }));
  CHECK_FALSE(mutated([](Compared& one) { one.standard_error *= 1.7; }));
  CHECK_FALSE(mutated([](Compared& one) { one.standard_error /= 1.7; }));
}

// The solid angle of the rectangle [x0, x1] × [z0, z1] at a distance, seen from the origin.
double solid_angle(double distance, double x0, double x1, double z0, double z1) {
  const auto corner = [distance](double x, double z) {
    return std::atan(x * z / (distance * std::sqrt(x * x + z * z + distance * distance)));
  };
  return corner(x1, z1) - corner(x0, z1) - corner(x1, z0) + corner(x0, z0);
}

}  // namespace

TEST_CASE("direct light of tiles: all of the emitters' light arrives, with honest errors") {
  struct Case {
    const char* name;
    std::function<void(Room&)> add;
    double bias;
  };
  const std::vector<Case> cases{
      {"a point",
       [](Room& room) {
         room.emitters.push_back(isotropic({0.45, 0.8, 0.4}));
       },
       0.002},
      {"a panel", [](Room& room) { add_panel(room, 0.95, 0.2, 0.3, 0.5, 1); }, 0.007},
      {"a panel that is not Lambertian", [](Room& room) { add_panel(room, 0.95, 0.2, 0.3, 0.5, 1, 3.0); }, 0.008},
      {"a panel with a map", [](Room& room) { add_mapped_panel(room, 0.95); }, 0.008},
      {"a panel at a board", [](Room& room) { add_panel(room, 0.62, 0.2, 0.3, 0.5, 1); }, 0.015},
      {"a panel with a map at a board", [](Room& room) { add_mapped_panel(room, 0.62); }, 0.016},
      {"a panel of 128 triangles from wall to wall", [](Room& room) { add_panel(room, 0.9, 0.0, 0.0, 1.0, 8); }, 0.007},
      {"all of them",
       [](Room& room) {
         room.emitters.push_back(isotropic({0.45, 0.8, 0.4}));
         room.emitters.push_back(lambert({0.1, 0.7, 0.9}, {1, -1, -1}, 20.0));
         add_panel(room, 0.95, 0.2, 0.3, 0.3, 1);
       },
       0.006}};
  for (const Case& one : cases) {
    Room room = with_boards();
    one.add(room);
    Runs runs(room, 0.26);
    check_runs(one.name, runs, {0.03, 0.2, {}}, total_power(room), one.bias);
  }
}

TEST_CASE("direct light of tiles: the shadow of a board on a floor") {
  Room room = unit_cube(0.5, isotropic({0.5, 0.9, 0.4}));
  room.surfaces.push_back(board({0.4, 0.5, 0.25}, {0.23, 0, 0}, {0, 0, 0.3}));
  Runs runs(room, 0.17);
  const double lit = solid_angle(0.9, -0.5, 0.5, -0.4, 0.6) - solid_angle(0.4, -0.1, 0.13, -0.15, 0.15);
  check_runs("shadow of a board", runs, {0.02, 0.0, {}}, lit / (4.0 * pi), 0.004, "floor");
}

TEST_CASE("direct light of tiles: a larger error is allowed, fewer rays are traced") {
  Room room = with_boards();
  add_panel(room, 0.95, 0.2, 0.3, 0.5, 1);
  room.emitters.push_back(isotropic({0.45, 0.8, 0.4}));
  std::vector<double> rays;
  std::vector<double> errors;
  for (const double relative : {0.003, 0.01, 0.03}) {
    Runs runs(room, 0.2);
    errors.push_back(runs.flux(1, {relative, 0.02, {}}).standard_error);
    rays.push_back(static_cast<double>(runs.traced().shadow_rays));
  }
  for (std::size_t k = 0; k + 1 < rays.size(); ++k) {
    CHECK(rays[k] > 1.5 * rays[k + 1]);
    CHECK(errors[k] < 0.7 * errors[k + 1]);
  }
}
