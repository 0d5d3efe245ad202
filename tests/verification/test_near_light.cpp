// Receivers close to an area light: their standard errors cover the exact values.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/catch.hpp"
#include "support/form_factors.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"
#include "walk/direct_light.hpp"
#include "walk/scene.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double panel_luminance = 1000.0;

// A panel of 1 m × 1 m at 2.5 m, facing down, and a crate that makes the room cast shadows. Everything is black.
Room room_with_panel(double exponent) {
  Room room;
  Surface panel;
  panel.name = "panel";
  panel.reflectance = 0.0;
  add_quad(panel, {-0.5, 2.5, -0.5}, {1, 0, 0}, {0, 0, 1});
  Surface crate = make_box({0.2, 0.2, 0.2});
  crate.reflectance = 0.0;
  for (glm::dvec3& p : crate.positions) p += glm::dvec3(-2.0, 0.0, -2.0);
  room.surfaces = {panel, crate};
  room.emitters.push_back(surface_emitter(0, pi * panel_luminance, exponent));
  return room;
}

// The largest |z| and the number of |z| above 3 in many runs.
struct Coverage {
  std::size_t runs = 0;
  std::size_t beyond_3 = 0;
  double mean_error = 0.0;
};

Coverage coverage(const Room& room, const ReferencePoint& reference, double exact, std::size_t runs) {
  const Tiling tiling = make_tiling(room, 1.0);
  const Scene scene(room, tiling, Engine::embree);
  const DirectLight light(room, *scene.tracer);
  Coverage found{runs, 0, 0.0};
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    TraceCount count;
    const DirectIrradiance one = light.irradiance_at(reference, Stream(seed, WalkDirection::backward), 0, count);
    // 1e-5: the float coordinates of the tracer.
    if (std::abs(one.value - exact) > 3.0 * one.standard_error + 1e-5 * exact) ++found.beyond_3;
    found.mean_error += one.standard_error / exact / static_cast<double>(runs);
  }
  return found;
}

// |z| > 3 has a probability of 0.27 %: of 400 runs, 9 or more are beyond it with a probability below 10⁻⁵.
constexpr std::size_t runs = 400;
constexpr std::size_t most_beyond = 8;

void check_covers(const Coverage& found, double largest_error = 2e-3) {
  INFO(found.beyond_3 << " of " << found.runs << " beyond 3, mean error " << found.mean_error);
  CHECK(found.beyond_3 <= most_beyond);
  CHECK(found.mean_error < largest_error);
}

ReferencePoint under_panel(double height, double least_cosine = 0.0) {
  ReferencePoint reference{{0.1, 2.5 - height, -0.2}, {0, 1, 0}};
  reference.least_cosine = least_cosine;
  return reference;
}

}  // namespace

TEST_CASE("near light: errors cover at 0.3 mm to 0.2 m from a panel") {
  const Room room = room_with_panel(1.0);
  for (const double height : {0.0003, 0.001, 0.002, 0.005, 0.02, 0.05, 0.06, 0.1, 0.2}) {
    INFO(height << " m");
    const double exact = pi * panel_luminance * element_to_parallel_rectangle(height, 0.6, 0.4, 0.3, 0.7);
    check_covers(coverage(room, under_panel(height), exact, runs));
  }
}

TEST_CASE("near light: errors cover for a narrow field of view") {
  const Room room = room_with_panel(1.0);
  const double half_angle = 40.0 * pi / 180.0;
  for (const double height : {0.001, 0.005, 0.05}) {
    INFO(height << " m");
    const double exact = pi * panel_luminance * std::pow(std::sin(half_angle), 2);
    check_covers(coverage(room, under_panel(height, std::cos(half_angle)), exact, runs));
  }
}

TEST_CASE("near light: errors cover for an emitter that is not Lambertian") {
  // Under a panel without end the irradiance is the exitance, by any law. What is missing beyond the edges, at angles
  // with cos θ < 0.005, is below 0.005⁴.
  const Room room = room_with_panel(3.0);
  for (const double height : {0.0003, 0.001}) {
    INFO(height << " m");
    check_covers(coverage(room, under_panel(height), pi * panel_luminance, runs));
  }
}

TEST_CASE("near light: errors cover with a plate in between, and a figure without its shadow is rejected") {
  Room room = room_with_panel(1.0);
  Surface plate;
  plate.name = "plate";
  add_quad(plate, {-0.5, 2.498, -0.5}, {0.5, 0, 0}, {0, 0, 1});
  room.surfaces.push_back(plate);
  // From a point 5 mm below the panel's middle, 3 mm below the edge of the plate: it hides the directions in which the
  // panel lies behind it, up to 0.3 m on the plate.
  const double panel = element_to_parallel_rectangle(0.005, 0.5, 0.5, 0.5, 0.5);
  const double hidden = element_to_parallel_rectangle(0.003, 0.3, 0.0, 0.3, 0.3);
  const ReferencePoint reference{{0.0, 2.495, 0.0}, {0, 1, 0}};
  const Coverage found = coverage(room, reference, pi * panel_luminance * (panel - hidden), runs);
  // About a half of the flights arrives: √(p(1 − p)/16384)/p is 0.8 %.
  check_covers(found, 1e-2);
  CHECK(coverage(room, reference, pi * panel_luminance * panel, 20).beyond_3 == 20);
}
