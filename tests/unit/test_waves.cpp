// The vectorised steps of the kernel compared with the same steps for one photon at a time.
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "base/lanes.hpp"
#include "support/catch.hpp"
#include "support/luminaires.hpp"
#include "support/rooms.hpp"
#include "walk/cell_finder.hpp"
#include "walk/estimators.hpp"
#include "walk/launcher.hpp"
#include "walk/scene.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr std::size_t sizes[] = {1, 5, 8, 16, 17, 1000, 1023, 1024};

// Photons on the surfaces of a room of six reflectances, among them 0 and 1.
struct OnSurfaces {
  Room room = make_cuboid({1, 1, 1}, {0.0, 1.0, 0.3, 0.6, 0.999999999, 0x1p-50});
  Tiling tiling;
  std::unique_ptr<Scene> scene;
  Wave wave;

  explicit OnSurfaces(std::size_t n) {
    room.emitters.push_back(paper_emitter());
    tiling = make_tiling(room, 0.1);
    scene = std::make_unique<Scene>(room, tiling, Engine::cuboid);
    std::mt19937 bits(static_cast<unsigned>(n));
    wave.rays.size = n;
    for (std::uint32_t i = 0; i < n; ++i) {
      wave.photon[i] = i;
      wave.polar[i] = static_cast<std::uint32_t>(bits());
      wave.azimuth[i] = static_cast<std::uint32_t>(bits());
      wave.chance[i] = std::uint64_t{bits()} << 32 | bits();
      if (i % 11 == 3) wave.chance[i] = 0;
      if (i % 11 == 4) wave.chance[i] = ~std::uint64_t{0};
      wave.rays.facet[i] = static_cast<std::uint32_t>(bits() % 6);
      wave.surface[i] = scene->surface_of[wave.rays.facet[i]];
      wave.rays.s[i] = static_cast<float>(i);
      wave.rays.t[i] = -static_cast<float>(i);
      wave.rays.behind[i] = static_cast<std::uint32_t>(bits() % 2);
      wave.weight[i] = std::ldexp(1.0, -static_cast<int>(bits() % 30));
    }
  }
};

// A policy's choice for the wave compared with its choice for one photon at a time.
template <class Policy>
void check_policy(std::size_t n) {
  OnSurfaces together(n);
  const OnSurfaces before(n);
  Ends ends;
  Survivors survivors;
  Policy::choose(*together.scene, together.wave, ends, survivors);

  Ends ends_of_one;
  std::vector<std::uint32_t> flying;
  std::vector<std::uint32_t> ended;
  for (std::uint32_t i = 0; i < n; ++i) {
    double weight = before.wave.weight[i];
    const double chance = static_cast<double>(before.wave.chance[i] >> 11) * 0x1p-53;
    const double reflectance = before.scene->surface_reflectance(before.wave.rays, i);
    const bool survives = Policy::survive(reflectance, chance, weight, ends_of_one);
    (survives ? flying : ended).push_back(i);
    if (survives && Policy::carries_weight) REQUIRE(together.wave.weight[i] == weight);
  }
  REQUIRE(survivors.count == flying.size());
  CHECK(ends.absorbed == ends_of_one.absorbed);
  CHECK(ends.residual == ends_of_one.residual);
  if (survivors.count == n) return;

  list_ended(n, survivors);
  for (std::size_t k = 0; k < ended.size(); ++k) REQUIRE(survivors.ended_at[k] == ended[k]);
  compact_wave(together.wave, survivors);
  for (std::size_t k = 0; k < flying.size(); ++k) {
    const std::uint32_t i = flying[k];
    REQUIRE(together.wave.photon[k] == i);
    REQUIRE(together.wave.polar[k] == before.wave.polar[i]);
    REQUIRE(together.wave.azimuth[k] == before.wave.azimuth[i]);
    REQUIRE(together.wave.rays.facet[k] == before.wave.rays.facet[i]);
    REQUIRE(together.wave.rays.s[k] == before.wave.rays.s[i]);
    REQUIRE(together.wave.rays.t[k] == before.wave.rays.t[i]);
    REQUIRE(together.wave.rays.behind[k] == before.wave.rays.behind[i]);
  }
}

}  // namespace

TEST_CASE("photons of a wave survive as they do one by one") {
  for (const std::size_t n : sizes) {
    check_policy<CollisionPolicy>(n);
    check_policy<RouletteWeightPolicy>(n);
    check_policy<TruncatedWeightPolicy>(n);
  }
}

TEST_CASE("photons of a wave start as they do one by one") {
  const auto skew_luminaire = test::skew_luminaire();
  Room room = make_cuboid({2, 3, 4}, uniform_reflectance(0.5));
  // Successive emitters with one law are launched together, also where one of them touches a surface or emits nothing.
  room.emitters = {lambert({1, 2, 3}, {1, 1, 1}, 1e6, 0.5),
                   lambert({1, 1, 1}, {0, 1, 1}, 1e6, 0.25),
                   lambert({1, 1, 2}, {1, 0, -1}, 1e6, 0.0),
                   lambert({0.5, 1, 2}, {1, 0, 0}, 1e6, 0.75),
                   lambert({0.5, 2, 2}, {1, 0, 0}, 2.0, 0.75),
                   isotropic({0.5, 0.5, 0.5}, 2.0),
                   isotropic({1.5, 0.5, 0.5}, 1.0),
                   {"spot", 1.0, SpotEmitter{{1, 1, 1}, {0, -1, 0}, 0.1, 0.5}},
                   {"none", 0.0, IsotropicEmitter{{1, 1, 2}}},
                   surface_emitter(1, 1.5, 2.0),
                   isotropic({0.3, 2.0, 1.0}),
                   isotropic({1.0, 0.0, 1.0})};  // on the floor
  // Luminaires with one table, one of them with an opening, one on the floor.
  for (const double height : {2.0, 1.0, 0.0}) {
    MeasuredEmitter luminaire{skew_luminaire, {1.0, height, 2.0}};
    if (height == 1.0) luminaire.opening = skew_luminaire->opening;
    room.emitters.push_back({"luminaire", 1.0, luminaire});
  }
  const Stream stream(5);
  for (std::size_t emitters = room.emitters.size(); emitters > 0; --emitters) {
    room.emitters.resize(emitters);
    if (room.emitters.back().power == 0.0) continue;
    for (const Engine engine : {Engine::cuboid, Engine::embree}) {
      const Tiling tiling = make_tiling(room, 1.0);
      const Scene scene(room, tiling, engine);
      for (const std::uint32_t n : {1U, 100U, batch_histories}) {
        Rays together(batch_histories);
        Rays single(batch_histories);
        std::vector<std::uint32_t> photon(batch_histories);
        scene.launcher->launch_all(stream, 4000, n, together, photon.data());
        std::vector<bool> invocation(n);
        for (std::uint32_t i = 0; i < n; ++i) {
          REQUIRE(photon[i] < n);
          REQUIRE_FALSE(invocation[photon[i]]);
          invocation[photon[i]] = true;
          scene.launcher->launch(stream, 4000 + photon[i], single, i);
          REQUIRE(together.facet[i] == single.facet[i]);
          if (single.facet[i] == no_facet) {
            REQUIRE(together.start(i) == single.start(i));
          } else {
            REQUIRE(together.s[i] == single.s[i]);
            REQUIRE(together.t[i] == single.t[i]);
            REQUIRE(together.behind[i] == single.behind[i]);
          }
          // Directions in float: some roundings of a component near 1.
          const glm::vec3 difference = together.direction(i) - single.direction(i);
          REQUIRE(std::max({std::abs(difference.x), std::abs(difference.y), std::abs(difference.z)}) <
                  16.0F * 0x1p-24F);
        }
      }
    }
  }
}

TEST_CASE("look-up in registers and in memory gives the same cells, outside the grid too") {
  // Six facets fit into a register, twenty never do; the first six are the same.
  std::mt19937 bits(3);
  std::vector<Facet> facets(20);
  std::vector<SurfaceGrid> grids;
  for (std::uint32_t k = 0; k < facets.size(); ++k) {
    const auto number = [&] { return static_cast<double>(bits() % 2001) / 100.0 - 10.0; };
    facets[k].surface = k;
    facets[k].cell_0 = {number(), number()};
    facets[k].cell_s = {number(), number()};
    facets[k].cell_t = {number(), number()};
    grids.push_back({static_cast<std::uint32_t>(1 + bits() % 9), static_cast<std::uint32_t>(1 + bits() % 9), 100 * k});
  }
  facets[2].cell_s = {1e30, -1e30};
  const CellFinder few(std::vector<Facet>(facets.begin(), facets.begin() + 6), grids);
  const CellFinder many(facets, grids);
  constexpr std::size_t n = 1000;
  const std::size_t whole = whole_lanes(n);
  std::vector<std::uint32_t> facet(whole), cell(whole), surface(whole), cell_many(whole), surface_many(whole);
  std::vector<float> s(whole), t(whole);
  for (std::size_t i = 0; i < n; ++i) {
    facet[i] = static_cast<std::uint32_t>(bits() % 6);
    s[i] = static_cast<float>(bits()) * 0x1p-32F;
    t[i] = static_cast<float>(bits()) * 0x1p-32F;
  }
  few.find(n, facet.data(), s.data(), t.data(), cell.data(), surface.data());
  many.find(n, facet.data(), s.data(), t.data(), cell_many.data(), surface_many.data());
  for (std::size_t i = 0; i < n; ++i) {
    REQUIRE(cell[i] == cell_many[i]);
    REQUIRE(surface[i] == surface_many[i]);
    REQUIRE(surface[i] == facet[i]);
    REQUIRE(cell[i] >= 100 * facet[i]);
    REQUIRE(cell[i] < 100 * facet[i] + grids[facet[i]].columns * grids[facet[i]].rows);
  }
}
