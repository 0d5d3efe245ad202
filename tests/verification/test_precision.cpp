// Errors of hit points, tallies, areas and paths in float and in double: this test prints the figures of
// docs/numerics.md (build/release/bin/verify_precision) and checks their bounds.
//
// The unit of lengths is one rounding: 2⁻²⁴ of the tracer's unit, in which the largest half extent of a room is ½ … 1.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "chance/moments.hpp"
#include "chance/stream.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"
#include "walk/launcher.hpp"
#include "walk/scene.hpp"
#include "walk/totals.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double rounding = 0x1p-24;

// Root mean square and largest of some errors.
struct Errors {
  double squares = 0.0;
  double largest = 0.0;
  double n = 0.0;

  void add(double error) {
    squares += error * error;
    largest = std::max(largest, std::abs(error));
    n += 1.0;
  }
  double rms() const { return std::sqrt(squares / n); }
  std::string text(double unit) const {
    std::ostringstream out;
    out.precision(3);
    out << "rms " << rms() / unit << ", largest " << largest / unit;
    return out.str();
  }
};

// The corners of the facets in the tracer's coordinates, rounded to float as Embree has them.
std::vector<std::array<glm::dvec3, 3>> corners_of(const Room& room, const Tracer& tracer) {
  std::vector<std::array<glm::dvec3, 3>> corners(tracer.facets().size());
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    const Surface& surface = room.surfaces[k];
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
      auto& facet = corners[tracer.locate(k, n).facet];
      for (int c = 0; c < 3; ++c)
        facet[static_cast<std::size_t>(c)] = glm::vec3(tracer.tracer_point(surface.positions[surface.triangles[n][c]]));
    }
  }
  return corners;
}

struct HitPoints {
  Errors float_off_plane;   // origin + length · direction, all in float
  Errors engine_off_plane;  // from the position on the facet, in double
  Errors float_beside;      // along the facet, from the hit point in double
  Errors engine_beside;
  std::uint64_t float_behind = 0;  // float points that lie behind their facet
  std::uint64_t hits = 0;
};

// Batches of flights through a room, `flights` each.
HitPoints hit_points(const Room& room, std::uint32_t flights) {
  const Tiling tiling = make_tiling(room, 1e6);
  const Scene scene(room, tiling, Engine::embree);
  const Tracer& tracer = *scene.tracer;
  const auto corners = corners_of(room, tracer);
  const Stream stream(1);
  HitPoints found;
  TraceCount count;
  for (std::uint64_t batch = 0; batch < 20; ++batch) {
    Rays rays(batch_histories);
    rays.size = batch_histories;
    for (std::uint32_t i = 0; i < batch_histories; ++i)
      scene.launcher->launch(stream, batch * batch_histories + i, rays, i);
    std::vector<std::uint32_t> polar(rays.x.size());
    std::vector<std::uint32_t> azimuth(rays.x.size());
    for (std::uint32_t flight = 0; flight < flights; ++flight) {
      tracer.trace(rays, scene.misses, count);
      for (std::size_t i = 0; i < rays.size; ++i) {
        if (rays.facet[i] == no_facet) continue;
        const auto& corner = corners[rays.facet[i]];
        const glm::dvec3 s = corner[1] - corner[0];
        const glm::dvec3 t = corner[2] - corner[0];
        const glm::dvec3 cross = glm::cross(s, t);
        const glm::dvec3 normal = glm::normalize(cross);
        const glm::dvec3 start(rays.start(i));
        const glm::dvec3 direction(rays.direction(i));
        const glm::dvec3 exact = start + glm::dot(corner[0] - start, normal) / glm::dot(direction, normal) * direction;
        const glm::dvec3 by_float(rays.start(i) + rays.length[i] * rays.direction(i));
        const glm::dvec3 by_place = corner[0] + double{rays.s[i]} * s + double{rays.t[i]} * t;
        const auto off = [&](const glm::dvec3& point) { return glm::dot(point - corner[0], normal); };
        const auto beside = [&](const glm::dvec3& point) { return glm::length(point - exact - off(point) * normal); };
        found.float_off_plane.add(off(by_float));
        found.engine_off_plane.add(off(by_place));
        found.float_beside.add(beside(by_float));
        found.engine_beside.add(beside(by_place));
        const double side = glm::dot(direction, normal) > 0.0 ? -1.0 : 1.0;
        if (side * off(by_float) < 0.0) ++found.float_behind;
        ++found.hits;
      }
      // Scatters by Lambert's law; a photon that left the room starts again.
      for (std::uint32_t i = 0; i < rays.size; ++i) {
        if (rays.facet[i] == no_facet) scene.launcher->launch(stream, batch * batch_histories + i, rays, i);
        const Words words = stream.draw(batch * batch_histories + i, flight + 1, Purpose::flight);
        polar[i] = words[0];
        azimuth[i] = words[1];
        if (rays.facet[i] == no_facet) rays.facet[i] = 0;
      }
      tracer.scatter(rays, polar.data(), azimuth.data(), nullptr);
    }
  }
  return found;
}

}  // namespace

TEST_CASE("precision: hit points in float and by their position on the facet") {
  for (const std::string scene : {"living_room.glb", "cube_paper.gltf"}) {
    const Room room = read_gltf(std::string(LICHTMC_SCENES) + "/" + scene);
    const HitPoints found = hit_points(room, 4);
    WARN(scene << ", " << found.hits
               << " hits, in roundings:\n  off the plane, float: " << found.float_off_plane.text(rounding)
               << "\n  off the plane, by the place on the facet: " << found.engine_off_plane.text(rounding)
               << "\n  along the facet, float: " << found.float_beside.text(rounding)
               << "\n  along the facet, by the place: " << found.engine_beside.text(rounding)
               << "\n  float points behind their facet: "
               << 100.0 * static_cast<double>(found.float_behind) / static_cast<double>(found.hits) << " %");
    // In the plane within the precision of double; float deviates by some roundings, to either side.
    CHECK(found.engine_off_plane.largest < 1e-6 * rounding);
    CHECK(found.float_off_plane.rms() > 0.01 * rounding);
    CHECK(found.float_off_plane.largest > 0.5 * rounding);
    // Tiles are millions of roundings wide: a hit counts on a neighbouring tile once in some hundred thousand times.
    CHECK(found.engine_beside.rms() < 4.0 * rounding);
    CHECK(found.float_behind > 0);
  }
}

TEST_CASE("precision: float tallies stop growing, double tallies drift, integer tallies are exact") {
  constexpr std::uint64_t hits = 20'000'000;
  float in_float = 0.0F;
  double in_double = 0.0;
  std::uint64_t in_units = 0;
  const auto units = static_cast<std::uint64_t>(0.6 * weight_units + 0.5);
  for (std::uint64_t i = 0; i < hits; ++i) {
    in_float += 0.6F;
    in_double += 0.6;
    in_units += units;
  }
  const double exact = 0.6 * hits;
  const double by_integers = static_cast<double>(in_units) / weight_units;
  float ones = 0.0F;
  for (std::uint64_t i = 0; i < hits; ++i) ones += 1.0F;
  WARN("20 000 000 times 0.6: float " << std::to_string(in_float) << " (" << 100.0 * (in_float / exact - 1.0)
                                      << " %), double " << in_double / exact - 1.0 << " relative, integers of 2^-24 "
                                      << by_integers / exact - 1.0
                                      << " relative; 20 000 000 ones in float: " << std::to_string(ones));
  CHECK(std::abs(in_float / exact - 1.0) > 0.01);
  CHECK(ones == 0x1p24F);
  CHECK(std::abs(in_double / exact - 1.0) < 1e-8);
  // Each weight is rounded once, by 3·10⁻⁸ at most; the rounding does not increase with the number of hits.
  CHECK(std::abs(by_integers / exact - 1.0) < 0.5 / weight_units / 0.6);
}

TEST_CASE("precision: areas in float and double") {
  // A tile of 1 cm × 1 cm, here and a kilometre from the origin.
  for (const double offset : {0.0, 10.0, 1000.0}) {
    Surface tile = make_floor(0.01, 0.01);
    for (glm::dvec3& position : tile.positions) position += glm::dvec3(offset);
    const glm::uvec3 corner = tile.triangles[0];
    const glm::vec3 a(tile.positions[corner.x]);
    const float in_float =
        glm::length(glm::cross(glm::vec3(tile.positions[corner.y]) - a, glm::vec3(tile.positions[corner.z]) - a));
    const double in_double = area_of(tile);
    WARN("1 cm² at " << offset << " m: float " << 100.0 * (in_float / 1e-4 - 1.0) << " %, double "
                     << in_double / 1e-4 - 1.0 << " relative");
    CHECK(std::abs(in_double / 1e-4 - 1.0) < 1e-9);
    if (offset == 0.0) CHECK(std::abs(in_float / 1e-4 - 1.0) < 1e-6);
    if (offset == 1000.0) CHECK(std::abs(in_float / 1e-4 - 1.0) > 1e-3);
  }
}

TEST_CASE("precision: lengths of paths in float and double") {
  const Room room = unit_cube(0.99, paper_emitter());
  const Tiling tiling = make_tiling(room, 1.0);
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    const Scene scene(room, tiling, engine);
    const Tracer& tracer = *scene.tracer;
    const Stream stream(1);
    constexpr std::uint32_t flights = 1000;
    Rays rays(batch_histories);
    rays.size = batch_histories;
    for (std::uint32_t i = 0; i < batch_histories; ++i) scene.launcher->launch(stream, i, rays, i);
    std::vector<float> in_float(batch_histories, 0.0F);
    std::vector<double> in_double(batch_histories, 0.0);
    std::vector<double> squares(batch_histories, 0.0);
    std::vector<std::uint32_t> polar(rays.x.size());
    std::vector<std::uint32_t> azimuth(rays.x.size());
    TraceCount count;
    Errors lengths;
    for (std::uint32_t flight = 0; flight <= flights; ++flight) {
      tracer.trace(rays, scene.misses, count);
      for (std::uint32_t i = 0; i < batch_histories && flight > 0; ++i) {
        REQUIRE(rays.facet[i] != no_facet);
        const glm::dvec3 segment = tracer.world_vector(double{rays.length[i]} * glm::dvec3(rays.direction(i)));
        const double metres = glm::length(segment);
        in_double[i] += metres;
        in_float[i] += static_cast<float>(metres);
        squares[i] += metres * metres;
        // A direction in float does not have exactly length 1.
        lengths.add(glm::length(tracer.world_vector(glm::dvec3(rays.direction(i)))) /
                        glm::length(tracer.world_vector({1.0, 0.0, 0.0})) -
                    1.0);
      }
      for (std::uint32_t i = 0; i < batch_histories; ++i) {
        const Words words = stream.draw(i, flight + 1, Purpose::flight);
        polar[i] = words[0];
        azimuth[i] = words[1];
      }
      tracer.scatter(rays, polar.data(), azimuth.data(), nullptr);
    }
    Errors sums;
    double mean = 0.0;
    double variance = 0.0;
    for (std::uint32_t i = 0; i < batch_histories; ++i) {
      sums.add(in_float[i] / in_double[i] - 1.0);
      const double of_one = in_double[i] / flights;
      mean += of_one / batch_histories;
      variance += of_one * of_one / batch_histories;
    }
    const double error = std::sqrt((variance - mean * mean) / (batch_histories - 1));
    WARN(to_string(engine) << ": 1000 flights added up in float, relative to double: " << sums.text(1.0)
                           << "\n  directions of float, relative to length 1: " << lengths.text(1.0)
                           << "\n  mean free flight " << mean << " ± " << error << " m, exact 4V/S = 0.66666667 m");
    CHECK(sums.largest < 1e-4);
    CHECK(lengths.largest < 1e-6);
    // From the second flight on the light is nearly uniform; 4V/S holds for exactly uniform light (1·10⁻³ covers the
    // first flights of the thousand).
    CHECK(std::abs(mean - 2.0 / 3.0) < 5.0 * error + 1e-3);
  }
}
