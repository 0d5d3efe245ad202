// Calculation areas: Em, Emin, Emax, U0 and Ud against exact cases, and the coverage of their errors.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/areas.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

Settings areas_by(ReceiverWalk walk, Estimator estimator, double photons, std::uint64_t seed) {
  Settings settings = settings_of(estimator, Engine::automatic, photons, seed);
  settings.measured = Measured::receivers;
  settings.receiver_walk = walk;
  return settings;
}

// The area of CIE 171:2006, 5.2: 4 m × 4 m, the lamp 3 m above its centre; the grid has points at ±0.5, ±1.5 m.
Room lamp_over_plane(const Emitter& lamp) {
  Room room = make_cuboid({4.0, 4.0, 4.0}, uniform_reflectance(0.0));
  room.emitters = {lamp};
  add_area(room, "plane", {0, 0.5, 0}, {1, 0, 0}, {0, 0, 1}, 4, 4, {0, 1, 0});
  return room;
}

}  // namespace

TEST_CASE("areas: figures of a lamp over a black plane are exact") {
  constexpr double height = 3.0;
  struct Case {
    std::string name;
    Emitter lamp;
    double exponent;  // E = I hⁿ/dⁿ⁺² ...
    double intensity;
  };
  const glm::dvec3 above{2.0, 3.5, 2.0};
  // CIE 171:2006, 5.2: Lambert, I₀ = 1000 cd; and an isotropic lamp of the same intensity.
  const std::vector<Case> cases{
      {"Lambert", lambert(above, {0, -1, 0}, 1.0, 1000.0 * 3.14159265358979323846), 2.0, 1000.0},
      {"isotropic", isotropic(above, 4000.0 * 3.14159265358979323846), 1.0, 1000.0}};
  for (const Case& one : cases) {
    INFO(one.name);
    const Room room = lamp_over_plane(one.lamp);
    const Result result = simulate(room, areas_by(ReceiverWalk::automatic, Estimator::weight, 1e4, 1));
    REQUIRE(result.areas.size() == 1);
    const AreaResult& area = result.areas.front();
    const auto at = [&](double x, double y) {
      const double d = std::sqrt(height * height + x * x + y * y);
      return one.intensity * std::pow(height / d, one.exponent) / (d * d);
    };
    // Four points each of these distances from the centre, eight of the middle one.
    const double mean = (at(0.5, 0.5) + 2.0 * at(0.5, 1.5) + at(1.5, 1.5)) / 4.0;
    const double lowest = at(1.5, 1.5);
    const double highest = at(0.5, 0.5);
    if (one.name == "Lambert") {  // the values that the report prints
      CHECK(std::abs(lowest - 49.382716) < 1e-6);
      CHECK(std::abs(highest - 99.722992) < 1e-6);
    }
    constexpr double rounding = 1e-9;
    CHECK(std::abs(area.mean.value - mean) < rounding * mean);
    CHECK(std::abs(area.minimum.value - lowest) < rounding * mean);
    CHECK(std::abs(area.maximum.value - highest) < rounding * mean);
    CHECK(std::abs(area.uniformity.value - lowest / mean) < rounding);
    CHECK(std::abs(area.diversity.value - lowest / highest) < rounding);
    for (const Figure* figure : {&area.mean, &area.minimum, &area.maximum, &area.uniformity, &area.diversity})
      CHECK(figure->standard_error < rounding * mean);
  }
}

// CIE 171:2006, 5.8: a cube of 4 m, an isotropic lamp of 10 000 lm at its centre. The mean over all surfaces of the
// reflected light is exact, Φρ/(S(1 − ρ)), and that of each face is the same by symmetry; so is the direct mean, Φ/S.
// Grids of cells give means over the faces.
TEST_CASE("areas: means of cells over the faces of a cube, CIE 171 5.8") {
  constexpr double side = 4.0;
  constexpr double flux = 10'000.0;
  constexpr double surface = 6.0 * side * side;
  for (const double rho : {0.3, 0.8}) {
    Room room = make_cuboid({side, side, side}, uniform_reflectance(rho));
    room.emitters = {isotropic({2, 2, 2}, flux)};
    const glm::dvec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    add_area(room, "floor", {0, 0, 0}, x, z, 4, 4, y, true);
    add_area(room, "ceiling", {0, side, 0}, x, z, 4, 4, -y, true);
    add_area(room, "left", {0, 0, 0}, y, z, 4, 4, x, true);
    add_area(room, "right", {side, 0, 0}, y, z, 4, 4, -x, true);
    add_area(room, "front", {0, 0, 0}, x, y, 4, 4, z, true);
    add_area(room, "back", {0, 0, side}, x, y, 4, 4, -z, true);
    const double expected = flux / surface * (1.0 + rho / (1.0 - rho));
    for (const ReceiverWalk walk : {ReceiverWalk::next_event, ReceiverWalk::two_way, ReceiverWalk::backward}) {
      const Result result = simulate(room, areas_by(walk, Estimator::weight, 4e5, 7));
      std::vector<Compared> figures;
      for (const AreaResult& area : result.areas)
        figures.push_back({area.mean.value, area.mean.standard_error, expected, 0.0});
      const Judgement judgement = compare(figures, Deviations::correlated);
      INFO(to_string(walk) << ", " << rho << ": " << judgement.text);
      CHECK(judgement.agrees);
      CHECK(judgement.smallest_bias < 0.035);
      // A direct mean that is taken at the centres of the cells is 1.2 % too high.
      for (Compared& one : figures) one.expected *= 1.05;
      CHECK_FALSE(compare(figures, Deviations::correlated).agrees);
    }
  }
}

namespace {

// A room with a board and two lamps, so that the lowest place is not a corner by symmetry; 48 points.
Room coverage_room() {
  Room room = make_cuboid({4.0, 2.5, 3.0}, uniform_reflectance(0.6));
  room.emitters = {lambert({1.0, 2.4, 1.0}, {0, -1, 0}, 1.0, 600.0), lambert({3.0, 2.4, 2.0}, {0, -1, 0}, 3.0, 400.0)};
  add_area(room, "desk", {0, 0.75, 0}, {0.5, 0, 0}, {0, 0, 0.5}, 8, 6, {0, 1, 0});
  return room;
}

// A cube whose six central points on a small ring have nearly the same value: the noise decides which is the lowest.
Room level_room() {
  Room room = make_cuboid({2.0, 2.0, 2.0}, uniform_reflectance(0.8));
  room.emitters = {isotropic({1.0, 1.0, 1.0}, 100.0)};
  add_area(room, "ceiling", {0.9, 1.99, 0.9}, {0.02, 0, 0}, {0, 0, 0.02}, 10, 10, {0, -1, 0});
  return room;
}

// Counts of |z| > 1 and > 2 among runs.
struct Beyond {
  int one = 0;
  int two = 0;
  double squares = 0.0;

  void add(const Figure& figure, const Figure& truth) {
    const double z = (figure.value - truth.value) / std::hypot(figure.standard_error, truth.standard_error);
    one += std::abs(z) > 1.0 ? 1 : 0;
    two += std::abs(z) > 2.0 ? 1 : 0;
    squares += z * z;
  }
};

// A count of n runs with probability p each: at most this, but for one case in a million.
double most_of(int n, double p) {
  return n * p + 4.75 * std::sqrt(n * p * (1.0 - p)) + 1.0;
}

}  // namespace

TEST_CASE("areas: errors cover the truth as often as they say") {
  constexpr int runs = 200;
  for (const bool level : {false, true}) {
    const Room room = level ? level_room() : coverage_room();
    for (const ReceiverWalk walk : {ReceiverWalk::two_way, ReceiverWalk::next_event, ReceiverWalk::backward}) {
      const double photons = level ? 8e4 : 2e4;
      const Result reference = simulate(room, areas_by(walk, Estimator::weight, 100.0 * photons, 999));
      const AreaResult& truth = reference.areas.front();
      Beyond mean, minimum, maximum, uniformity, diversity, uncorrected;
      for (int run = 0; run < runs; ++run) {
        const Result result =
            simulate(room, areas_by(walk, Estimator::weight, photons, 1000 + static_cast<std::uint64_t>(run)));
        const AreaResult& area = result.areas.front();
        mean.add(area.mean, truth.mean);
        minimum.add(area.minimum, truth.minimum);
        maximum.add(area.maximum, truth.maximum);
        uniformity.add(area.uniformity, truth.uniformity);
        diversity.add(area.diversity, truth.diversity);
        // The mutation: the lowest value as it is, with the error of its point.
        const auto lowest = std::find(area.area.cells.begin(), area.area.cells.end(), area.lowest_cell);
        const auto receiver = static_cast<std::size_t>(lowest - area.area.cells.begin()) + area.area.first_receiver;
        uncorrected.add({area.lowest, result.receiver_results[receiver].standard_error}, truth.minimum);
      }
      INFO((level ? "level, " : "desk, ")
           << to_string(walk) << ": |z| > 1 and 2, mean z²: Em " << mean.one << ", " << mean.two << ", "
           << mean.squares / runs << "; Emin " << minimum.one << ", " << minimum.two << ", " << minimum.squares / runs
           << "; Emax " << maximum.one << ", " << maximum.two << "; U0 " << uniformity.one << ", " << uniformity.two
           << ", " << uniformity.squares / runs << "; Ud " << diversity.one << ", " << diversity.two << "; uncorrected "
           << uncorrected.one << ", " << uncorrected.two);
      for (const Beyond* figure : {&mean, &minimum, &maximum, &uniformity, &diversity}) {
        CHECK(figure->one <= most_of(runs, 0.3173));
        CHECK(figure->two <= most_of(runs, 0.0455));
      }
      // Errors of means are neither too large: the mean of 200 squares of normal variables is 1 ± 0.1.
      CHECK(mean.squares / runs > 1.0 - 4.75 * std::sqrt(2.0 / runs));
      // Points that share photons deviate together: only walks of their own make the lowest point one of chance.
      if (level && walk == ReceiverWalk::backward) CHECK(uncorrected.one > most_of(runs, 0.3173));
    }
  }
}
