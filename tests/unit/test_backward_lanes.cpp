// The vectorised steps of backward walks compared with the same steps for one photon at a time.
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include "chance/stream.hpp"
#include "lichtmc/gltf.hpp"
#include "support/catch.hpp"
#include "support/luminaires.hpp"
#include "support/rooms.hpp"
#include "walk/backward.hpp"
#include "walk/first_flights.hpp"
#include "walk/point_lights.hpp"
#include "walk/roulette.hpp"
#include "walk/scene.hpp"
#include "walk/surface_light.hpp"
#include "walk/visibility.hpp"
#include "walk/wave.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

Room room_with_all_laws() {
  Room room = make_cuboid({1.0, 2.0, 0.7}, {0.5, 0.5, 0.5, 0.5, 0.5, 0.5});
  room.emitters = {isotropic({0.3, 1.2, 0.4}, 2.0),
                   lambert({0.6, 1.9, 0.2}, {0.1, -1, 0.2}, 3.0, 5.0),
                   surface_emitter(2, 1.0),
                   {"spot", 3.0, SpotEmitter{{0.5, 1.5, 0.5}, {0.3, -1, 0}, 0.2, 0.6}}};
  return room;
}

// Photons that have just been scattered by the walls.
struct OnWalls {
  Tiling tiling;
  Scene scene;
  Wave wave;

  OnWalls(const Room& room, Engine engine) : tiling(make_tiling(room, 1.0)), scene(room, tiling, engine) {
    const Stream stream(3);
    const std::size_t n = 1000;
    TraceCount count;
    wave.rays.size = n;
    for (std::uint32_t i = 0; i < n; ++i) {
      wave.photon[i] = i;
      wave.weight[i] = 1.0;
      wave.history[i] = i;
      scene.launcher->launch(stream, i, wave.rays, i);
    }
    scene.tracer->depart(wave.rays);
    scene.tracer->trace(wave.rays, Misses::retrace, count);
    std::mt19937 bits(4);
    for (std::size_t i = 0; i < n; ++i) {
      wave.polar[i] = static_cast<std::uint32_t>(bits());
      wave.azimuth[i] = static_cast<std::uint32_t>(bits());
    }
    scene.tracer->scatter(wave.rays, wave.polar.data(), wave.azimuth.data(), nullptr);
  }

  ReferencePoint reference(std::size_t i) const {
    const glm::dvec3 normal = world_normal(*scene.tracer, scene.tracer->facets()[wave.rays.facet[i]]);
    return {scene.tracer->world_point(glm::dvec3(wave.rays.start(i))), wave.rays.behind[i] != 0 ? -normal : normal,
            0.0};
  }
};

}  // namespace

namespace {

void check_lanes(const Room& room) {
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    const OnWalls walls(room, engine);
    const Tracer& tracer = *walls.scene.tracer;
    const DirectLight light(room, tracer);
    std::vector<const PointLight*> lights;
    for (std::size_t k = 0; k < light.sources(); ++k) lights.push_back(light.point_light(k));
    REQUIRE(lights.size() == 4);
    PointLights points(lights, tracer);
    LightSamples samples(batch_histories);
    for (std::size_t i = 0; i < walls.wave.rays.size; ++i) samples.source[i] = static_cast<std::uint32_t>(i % 4);
    points.sample(walls.wave.rays, samples);
    for (std::size_t i = 0; i < walls.wave.rays.size; ++i) {
      const PointLight* one = lights[i % 4];
      if (one == nullptr) {
        REQUIRE(samples.irradiance[i] == 0.0);
        continue;
      }
      const LightSample expected = one->sample_light(walls.reference(i));
      // Some tens of roundings; at the edge of the spot and at grazing angles differences are amplified.
      REQUIRE(samples.irradiance[i] == Approx(expected.irradiance).epsilon(1e-10).margin(1e-12));
      const auto segment = shadow_segment(tracer, glm::dvec3(walls.wave.rays.start(i)), one->position());
      REQUIRE((samples.within_reach[i] == 0) == segment.has_value());
      if (!segment) continue;
      REQUIRE(samples.dx[i] == Approx(segment->x).margin(1e-6));
      REQUIRE(samples.dy[i] == Approx(segment->y).margin(1e-6));
      REQUIRE(samples.dz[i] == Approx(segment->z).margin(1e-6));
    }
  }
}

}  // namespace

TEST_CASE("point lights in lanes have the irradiance and the segment of the same lights one by one") {
  Room room = room_with_all_laws();
  check_lanes(room);
  const auto skew = skew_luminaire();
  room.emitters[1].shape = MeasuredEmitter{skew, {0.6, 1.9, 0.2}};
  check_lanes(room);
  // Luminaires of one table alone, one of them mirrored, one turned.
  room.emitters[0].shape = MeasuredEmitter{skew, {0.3, 1.2, 0.4}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  room.emitters[2].shape = MeasuredEmitter{skew, {0.5, 0.5, 0.5}, {0, 0, 1}, {1, 0, 0}, {0, -1, 0}};
  room.emitters[3].shape = MeasuredEmitter{skew, {0.2, 0.1, 0.6}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  check_lanes(room);
}

TEST_CASE("shadow rays in packets are blocked as single ones are") {
  Room room = read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb");
  const Tiling tiling = make_tiling(room, 1.0);
  const Scene scene(room, tiling, Engine::embree);
  std::mt19937 bits(5);
  std::uniform_real_distribution<float> unit(-0.5F, 0.5F);
  for (const std::size_t n : {1U, 15U, 16U, 17U, 1000U}) {
    ShadowRays rays;
    for (std::size_t k = 0; k < n; ++k)
      rays.add({unit(bits), unit(bits), unit(bits)}, {unit(bits), unit(bits), unit(bits)});
    TraceCount count;
    scene.tracer->find_blocked(rays, count);
    CHECK(count.shadow_rays == n);
    std::size_t blocked = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const glm::vec3 start(rays.x[k], rays.y[k], rays.z[k]);
      const glm::vec3 segment(rays.dx[k], rays.dy[k], rays.dz[k]);
      REQUIRE((rays.blocked[k] != 0) == scene.tracer->is_blocked(start, segment, count));
      blocked += rays.blocked[k];
    }
    if (n == 1000) CHECK((blocked > 100 && blocked < 900));
  }
}

TEST_CASE("first flights of rounds of any size follow Lambert's law within the field of view") {
  const Stream stream(7);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  for (const std::uint32_t group : {1U, 3U, 32U}) {
    RoundPoints points(group, false);
    FirstFlights flights(group);
    Rays rays(group);
    std::vector<float> cosines(whole_lanes(group));
    const OriginView view{glm::vec3(normal), 0.5, std::nullopt};  // 60°
    // Equal parts of sin²θ and of the azimuth are equally likely.
    constexpr std::size_t rings = 8;
    constexpr std::size_t sectors = 6;
    std::vector<double> counts(rings * sectors, 0.0);
    const std::uint64_t sets = 48'000 / group;
    const glm::dvec3 across = glm::normalize(glm::cross(normal, glm::dvec3(1, 0, 0)));
    const glm::dvec3 along = glm::cross(normal, across);
    for (std::uint64_t set = 0; set < sets; ++set) {
      points.begin(stream, set);
      for (std::uint32_t i = 0; i < group; ++i) flights.set(i, view, points.polar(i), points.azimuth(i));
      flights.aim(group, glm::dmat3(1.0), rays, cosines.data());
      for (std::uint32_t i = 0; i < group; ++i) {
        const glm::dvec3 out(rays.direction(i));
        REQUIRE(glm::length(out) == Approx(1.0).margin(1e-6));
        const double cosine = glm::dot(out, normal);
        REQUIRE(cosine == Approx(cosines[i]).margin(1e-6));
        REQUIRE(cosine >= 0.5 - 1e-6);
        const double ring = std::min((1.0 - cosine * cosine) / 0.75, 1.0 - 1e-9) * rings;
        const double turns = std::atan2(glm::dot(out, along), glm::dot(out, across)) / (2.0 * 3.14159265358979) + 0.5;
        const double sector = std::min(turns, 1.0 - 1e-9) * sectors;
        counts[static_cast<std::size_t>(ring) * sectors + static_cast<std::size_t>(sector)] += 1.0;
      }
    }
    // Flights of a round are not independent, but spread more evenly: χ² is smaller than that of independent ones.
    const std::vector<double> expected(counts.size(), static_cast<double>(sets * group) / (rings * sectors));
    const Judgement verdict = compare_counts(counts, expected);
    INFO(group << " in a round: " << verdict.text);
    CHECK(verdict.agrees);
    if (group == 32) CHECK(verdict.chi_square < 12.0);  // independent flights: 47 ± 10
  }
}

TEST_CASE("the roulette of backward walks depends on how even direct light is") {
  const auto threshold = [](const Room& room) {
    const Tiling tiling = make_tiling(room, 1.0);
    const Scene scene(room, tiling, Engine::automatic);
    const DirectLight light(room, *scene.tracer);
    return roulette_threshold(scene, light, BackwardScale(room).mean_irradiance());
  };
  const Room even = unit_cube(0.5, isotropic({0.5, 0.5, 0.5}));
  const Room uneven = unit_cube(0.5, isotropic({0.5, 0.95, 0.5}));
  CHECK(threshold(even) == 0.15);
  CHECK(threshold(uneven) == 0.6);
}
