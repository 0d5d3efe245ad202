// Emission maps: bounds, mean, and the density of the points that are chosen.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "chance/philox.hpp"
#include "lichtmc/error.hpp"
#include "room/emission.hpp"
#include "room/value_bounds.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

TextureMap random_map(std::uint32_t columns, std::uint32_t rows, Wrap wrap_u, Wrap wrap_v, unsigned seed) {
  std::mt19937 random(seed);
  TextureMap map{"random", columns, rows, {}, wrap_u, wrap_v};
  for (std::uint32_t k = 0; k < columns * rows; ++k)
    map.values.push_back(static_cast<float>(random() % 3 == 0 ? random() % 1000 : 0) / 100.0F);
  return map;
}

SurfaceEmission emission_over(const Surface& surface, const EmissionMap& map, const std::vector<glm::dvec2>& uvs) {
  return {surface, map, uvs, ValueBounds(map), mean_emission(surface, map, uvs)};
}

Words words_of(std::uint32_t a, std::uint32_t b) {
  return philox4x32_10({a, b, 0, 0}, {7, 8});
}

}  // namespace

TEST_CASE("bounds of a map hold every value in the rectangle") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-3.0, 4.0);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Wrap wrap_u : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
    for (const Wrap wrap_v : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
      const TextureMap map = random_map(13, 6, wrap_u, wrap_v, 3);
      const ValueBounds bounds(map);
      for (int k = 0; k < 2000; ++k) {
        const glm::dvec2 low(place(random), place(random));
        const double size = std::pow(10.0, -3.0 * unit(random));
        const glm::dvec2 high = low + size * glm::dvec2(unit(random), unit(random));
        const ValueRange range = bounds.over(low, high);
        for (int n = 0; n < 10; ++n) {
          const glm::dvec2 uv = low + (high - low) * glm::dvec2(unit(random), unit(random));
          const double value = value_at(map, uv.x, uv.y);
          REQUIRE(value >= double{range.low} - 1e-6);
          REQUIRE(value <= double{range.high} * (1.0 + 1e-12));
        }
      }
    }
  }
  // Not wider than necessary in small rectangles: between two pixels of one value.
  const TextureMap two{"two", 4, 1, {1.0F, 1.0F, 0.0F, 0.0F}, Wrap::clamp, Wrap::clamp};
  CHECK(ValueBounds(two).over({0.15, 0.5}, {0.3, 0.5}).low == 1.0F);
  // At one point, here the centre of a pixel, or between the centres of two.
  CHECK(ValueBounds(two).over({0.375, 0.5}, {0.375, 0.5}).low == Approx(1.0F).epsilon(1e-6));
  CHECK(ValueBounds(two).over({0.4375, 0.5}, {0.5, 0.5}).high == Approx(0.75F).epsilon(1e-6));
}

TEST_CASE("the mean of an emission map is exact") {
  const Surface floor = make_floor(2.0, 3.0);
  // Half black, half white.
  const EmissionMap half{"half", 2, 2, {0.0F, 1.0F, 0.0F, 1.0F}, Wrap::repeat, Wrap::clamp};
  CHECK(mean_emission(floor, half, floor.uvs) == Approx(0.5).epsilon(1e-12));
  // A ramp from 0 to 1 between u = ¼ and ¾, over u = 0 … ½: ∫ = (¼)²/2 · 2.
  std::vector<glm::dvec2> left;
  for (const glm::dvec2& uv : floor.uvs) left.emplace_back(0.5 * uv.x, uv.y);
  CHECK(mean_emission(floor, {"ramp", 2, 1, {0.0F, 1.0F}, Wrap::clamp, Wrap::clamp}, left) ==
        Approx(0.125).epsilon(1e-12));
  // Many repetitions: parts of the triangles.
  std::vector<glm::dvec2> many;
  for (const glm::dvec2& uv : floor.uvs) many.emplace_back(400.0 * uv.x, 300.0 * uv.y);
  CHECK(mean_emission(floor, half, many) == Approx(0.5).epsilon(1e-3));
}

TEST_CASE("points are chosen with the density of the map") {
  const Surface floor = make_floor(1.0, 1.0);
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
    const EmissionMap map = random_map(5, 4, wrap, wrap, 11);
    std::vector<glm::dvec2> uvs;
    for (const glm::dvec2& uv : floor.uvs) uvs.emplace_back(1.7 * uv.x - 0.4, uv.y + 0.3);
    const SurfaceEmission emission = emission_over(floor, map, uvs);
    CHECK_FALSE(emission.uniform());
    constexpr int n = 8;  // bins along each side
    constexpr int photons = 200'000;
    std::vector<double> counts(n * n, 0.0);
    for (std::uint32_t k = 0; k < photons; ++k) {
      const Words words = words_of(k, 0);
      const EmissionPlace place =
          emission.choose_place(unit_fine(words[0], words[1]), unit_open(words[2]), unit_open(words[3]),
                                [&](std::uint32_t attempt) { return words_of(k, attempt + 1); });
      const glm::uvec3 t = floor.triangles[place.triangle];
      const glm::dvec3 p = floor.positions[t.x] + place.weights.x * (floor.positions[t.y] - floor.positions[t.x]) +
                           place.weights.y * (floor.positions[t.z] - floor.positions[t.x]);
      const auto bin = [](double x) { return std::clamp(static_cast<int>(x * n), 0, n - 1); };
      counts[static_cast<std::size_t>(bin(p.x) * n + bin(p.z))] += 1.0;
      REQUIRE(place.relative == Approx(emission.relative(place.triangle, place.weights)));
    }
    // The integral over each bin by midpoints; the map has kinks: 400 × 400 points.
    std::vector<double> expected(n * n, 0.0);
    double sum = 0.0;
    constexpr int fine = 400 * n;
    for (int i = 0; i < fine; ++i) {
      for (int j = 0; j < fine; ++j) {
        const double value = value_at(map, 1.7 * (i + 0.5) / fine - 0.4, (j + 0.5) / fine + 0.3);
        expected[static_cast<std::size_t>(i / 400 * n + j / 400)] += value;
        sum += value;
      }
    }
    for (double& one : expected) one *= photons / sum;
    const Judgement verdict = compare_counts(counts, expected);
    INFO(verdict.text);
    CHECK(verdict.agrees);
    // The mutation: points uniform over the surface.
    CHECK_FALSE(compare_counts(std::vector<double>(n * n, double{photons} / (n * n)), expected).agrees);
  }
}

TEST_CASE("a map with one value on the surface is uniform") {
  const Surface floor = make_floor(1.0, 1.0);
  const EmissionMap map{"half", 4, 1, {0.0F, 0.5F, 0.5F, 0.5F}, Wrap::clamp, Wrap::clamp};
  std::vector<glm::dvec2> right;
  for (const glm::dvec2& uv : floor.uvs) right.emplace_back(0.4 + 0.5 * uv.x, uv.y);
  CHECK(emission_over(floor, map, right).uniform());
  CHECK_FALSE(emission_over(floor, map, floor.uvs).uniform());
  // A palette: all corners at the centre of one pixel, beside darker ones.
  const EmissionMap palette{"palette", 3, 1, {0.01F, 0.5F, 1.0F}, Wrap::clamp, Wrap::clamp};
  for (const float u : {0.5F / 3.0F, 1.5F / 3.0F, 2.5F / 3.0F})
    CHECK(emission_over(floor, palette, std::vector<glm::dvec2>(floor.uvs.size(), {u, 0.5})).uniform());
}

TEST_CASE("texture coordinates of any size are harmless") {
  const Surface floor = make_floor(1.0, 1.0);
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
    const EmissionMap map = random_map(5, 4, wrap, wrap, 11);
    for (const double size : {1e6, 1e12, 1e20, 1e300}) {
      std::vector<glm::dvec2> uvs;
      for (const glm::dvec2& uv : floor.uvs) uvs.push_back(size * (uv - 0.3));
      const double mean = mean_emission(floor, map, uvs);
      CHECK(mean >= 0.0);
      CHECK(mean <= 10.0);
      if (mean > 0.0) CHECK(emission_over(floor, map, uvs).highest() >= 1.0);
    }
  }
}

TEST_CASE("damaged emission maps are refused") {
  const auto refused = [](const std::function<void(Room&, SurfaceEmitter&)>& damage) -> std::string {
    Room room = unit_cube(0.5, surface_emitter(1, 1.0));
    auto& shape = std::get<SurfaceEmitter>(room.emitters[0].shape);
    shape.emission_map = 0;
    shape.emission_uvs = room.surfaces[1].uvs;
    room.emission_maps.push_back({"panel", 2, 1, {0.0F, 1.0F}, Wrap::clamp, Wrap::clamp});
    damage(room, shape);
    try {
      check_room(room);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(refused([](Room&, SurfaceEmitter&) {}).empty());
  CHECK_THAT(refused([](Room& room, SurfaceEmitter&) { room.emission_maps[0].values[1] = -1.0F; }),
             ContainsSubstring("'panel'") && ContainsSubstring("0 or more"));
  CHECK_THAT(refused([](Room& room, SurfaceEmitter&) { room.emission_maps[0].rows = 3; }), ContainsSubstring("2 × 3"));
  CHECK_THAT(refused([](Room&, SurfaceEmitter& shape) { shape.emission_map = 1; }), ContainsSubstring("below 1"));
  CHECK_THAT(refused([](Room&, SurfaceEmitter& shape) { shape.emission_uvs.pop_back(); }),
             ContainsSubstring("one per position"));
  CHECK_THAT(refused([](Room& room, SurfaceEmitter&) { room.emission_maps[0].values[1] = 0.0F; }),
             ContainsSubstring("not black"));
}
