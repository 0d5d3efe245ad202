// The walks for receivers: next-event estimation, backward walks and both combined have the same mean.
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"
#include "support/two_sided_wall.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

const std::vector<Estimator> estimators{Estimator::weight, Estimator::collision, Estimator::absorption};
const std::vector<ReceiverWalk> walks{ReceiverWalk::next_event, ReceiverWalk::two_way};

Receiver at(const glm::dvec3& position, const glm::dvec3& normal, double half_angle_deg = 90.0, double area_m2 = 1.0) {
  return {"at", position, normal, half_angle_deg, area_m2};
}

Settings receivers_by(ReceiverWalk walk, Estimator estimator, double photons, std::uint64_t seed) {
  Settings settings = settings_of(estimator, Engine::automatic, photons, seed);
  settings.measured = Measured::receivers;
  settings.receiver_walk = walk;
  return settings;
}

// Receivers all over a box, in many directions, some with a narrow field of view.
std::vector<Receiver> spread(const glm::dvec3& low, const glm::dvec3& high, int n) {
  std::vector<Receiver> receivers;
  for (int k = 0; k < n; ++k) {
    const glm::dvec3 share(std::fmod(0.618 * k + 0.11, 1.0), std::fmod(0.755 * k + 0.37, 1.0),
                           std::fmod(0.570 * k + 0.71, 1.0));
    const glm::dvec3 normal(std::cos(2.4 * k), 1.0 - 2.0 * std::fmod(0.382 * k, 1.0), std::sin(2.4 * k));
    receivers.push_back(at(low + share * (high - low), normal, k % 5 == 4 ? 40.0 : 90.0));
  }
  return receivers;
}

std::vector<Compared> against_reference(const Result& result, const Result& reference, double factor = 1.0) {
  std::vector<Compared> figures;
  for (std::size_t k = 0; k < result.receiver_results.size(); ++k) {
    const ReceiverResult& one = result.receiver_results[k];
    const ReceiverResult& other = reference.receiver_results[k];
    figures.push_back({one.indirect, one.standard_error, factor * other.indirect, factor * other.standard_error});
  }
  return figures;
}

// All walks with all estimators against one long backward walk. largest_bias: that may pass, for the weight estimator;
// the others have larger errors.
void check_all(const std::string& name, const Room& room, double photons, double largest_bias) {
  const Result reference = simulate(room, receivers_by(ReceiverWalk::backward, Estimator::weight, 8.0 * photons, 11));
  CHECK(reference.receiver_walk.receiver_walk == ReceiverWalk::backward);
  for (const ReceiverWalk walk : walks) {
    for (const Estimator estimator : estimators) {
      const Result result = simulate(room, receivers_by(walk, estimator, photons, 12));
      CHECK(result.receiver_walk.receiver_walk == walk);
      const double bias = estimator == Estimator::weight ? largest_bias : 5.0 * largest_bias;
      const Judgement verdict = compare(against_reference(result, reference), Deviations::correlated);
      INFO(name << ", " << to_string(walk) << ", " << to_string(estimator) << ": " << verdict.text);
      WARN(name << ", " << to_string(walk) << ", " << to_string(estimator) << ": " << verdict.text);
      CHECK(verdict.agrees);
      CHECK(verdict.smallest_bias < bias);
      // One z-score of the allowed size is exceeded by a figure of average deviation, twice of it by any likely one.
      CHECK_FALSE(compare(against_reference(result, reference, 1.0 + 2.0 * bias), Deviations::correlated).agrees);
    }
  }
}

// The room with a two-sided wall, with emitters of all laws.
Room partitioned() {
  Room room = room_with_two_sided_wall();
  room.emitters = {isotropic({3.0, 2.0, 1.0}, 100.0),
                   lambert({1.0, 2.8, 1.0}, {0, -1, 0}, 3.0, 200.0),
                   {"spot", 150.0, SpotEmitter{{2.0, 2.5, 3.0}, {0.2, -1, 0.1}, 0.2, 0.6}},
                   surface_emitter(room.surfaces.size() - 1, 300.0)};
  return room;
}

}  // namespace

TEST_CASE("receiver walks: the same means in a convex room, by all estimators") {
  Room room = make_cuboid({2.0, 1.5, 3.0}, {0.3, 0.8, 0.5, 0.6, 0.7, 0.2});
  room.emitters = {isotropic({0.5, 1.2, 1.0}, 3.0), lambert({1.2, 1.4, 2.0}, {0, -1, 0}, 5.0, 5.0)};
  room.receivers = spread({0.1, 0.1, 0.1}, {1.9, 1.4, 2.9}, 30);
  check_all("cuboid", room, 3e5, 0.04);
}

TEST_CASE("receiver walks: independent receivers, chi-square") {
  // A run for each receiver.
  Room room = partitioned();
  const std::vector<Receiver> receivers = spread({0.4, 0.3, 0.3}, {3.6, 2.6, 1.7}, 40);
  for (const ReceiverWalk walk : {ReceiverWalk::next_event, ReceiverWalk::two_way}) {
    std::vector<Compared> figures;
    for (std::size_t k = 0; k < receivers.size(); ++k) {
      room.receivers = {receivers[k]};
      const Result one = simulate(room, receivers_by(walk, Estimator::weight, 5e3, 100 + k));
      const Result other = simulate(room, receivers_by(ReceiverWalk::backward, Estimator::weight, 2e4, 200 + k));
      figures.push_back(against_reference(one, other).front());
    }
    const Judgement verdict = compare(figures);
    INFO(to_string(walk) << ": " << verdict.text);
    WARN(to_string(walk) << ": " << verdict.text);
    CHECK(verdict.agrees);
    CHECK(verdict.smallest_bias < 0.045);
    for (Compared& figure : figures) figure.expected *= 1.07;
    CHECK_FALSE(compare(figures).agrees);
  }
}

TEST_CASE("receiver walks: the same means behind a partition, by all estimators and emitter laws") {
  Room room = partitioned();
  room.receivers = spread({0.2, 0.2, 0.2}, {3.8, 2.8, 4.8}, 40);
  check_all("partition", room, 2e5, 0.08);
}

TEST_CASE("receiver walks: the same means with five emitters, one of which is sampled at a time") {
  Room room = partitioned();
  room.emitters.push_back(isotropic({3.5, 0.5, 4.5}, 50.0));
  room.receivers = spread({0.2, 0.2, 0.2}, {3.8, 2.8, 4.8}, 40);
  check_all("five emitters", room, 1.5e5, 0.1);
}

TEST_CASE("receiver walks: scenes from files") {
  for (const char* scene : {"l_room.gltf", "living_room.glb"}) {
    Room room = read_gltf(std::string(LICHTMC_SCENES) + "/" + scene);
    // A few centimetres from their shades: rare large scores of backward walks, whose errors few samples do not show.
    std::erase_if(room.emitters, [](const Emitter& e) { return e.name == "floor_lamp" || e.name == "reading_lamp"; });
    room.receivers.clear();
    for (int k = 0; k < 60; ++k)
      room.receivers.push_back(at({0.4 + 0.11 * (k % 20), 0.4 + 0.3 * (k / 20), 0.6 + 0.09 * (k % 17)}, {0, 1, 0}));
    const Result reference = simulate(room, receivers_by(ReceiverWalk::backward, Estimator::weight, 1e6, 21));
    for (const ReceiverWalk walk : walks) {
      const Result result = simulate(room, receivers_by(walk, Estimator::weight, 5e5, 22));
      const Judgement verdict = compare(against_reference(result, reference), Deviations::correlated);
      INFO(scene << ", " << to_string(walk) << ": " << verdict.text);
      WARN(scene << ", " << to_string(walk) << ": " << verdict.text);
      CHECK(verdict.agrees);
    }
  }
}

TEST_CASE("receiver walks: Barry's room") {
  // J. R. Barry et al., IEEE J. Sel. Areas Commun. 11 (1993) 367, configuration A: 5 × 5 × 3 m, ρ of the walls and the
  // ceiling 0.8, of the floor 0.3. H(0) over all orders by radiosity, with an error below 2·10⁻⁶ of it.
  Room room = make_cuboid({5.0, 3.0, 5.0}, {0.3, 0.8, 0.8, 0.8, 0.8, 0.8});
  room.quantity = Quantity::radiometric;
  room.emitters = {lambert({2.5, 3.0, 2.5}, {0, -1, 0}, 1.0)};
  room.receivers = {at({0.5, 0.0, 1.0}, {0, 1, 0}, 85.0, 1e-4), at({0.5, 0.0, 1.0}, {0, 1, 0}, 90.0, 1e-4)};
  const std::vector<double> expected{2.964687e-6, 2.977991e-6};
  for (const ReceiverWalk walk : {ReceiverWalk::next_event, ReceiverWalk::two_way, ReceiverWalk::backward}) {
    const Result result = simulate(room, receivers_by(walk, Estimator::weight, 8e5, 31));
    std::vector<Compared> figures;
    for (std::size_t k = 0; k < 2; ++k) {
      const ReceiverResult& one = result.receiver_results[k];
      figures.push_back({one.gain, one.standard_error * 1e-4, expected[k], 2e-6 * expected[k]});
    }
    const Judgement verdict = compare(figures);
    INFO(to_string(walk) << ": " << verdict.text);
    WARN(to_string(walk) << ": " << verdict.text);
    CHECK(verdict.agrees);
    CHECK(verdict.smallest_bias < 0.01);
  }
}

TEST_CASE("receiver walks: close to surfaces two-way walks have no rare large scores") {
  // A receiver 1 mm from a wall that it faces: a photon that lands beside it would score 10⁴ times the mean.
  Room room = unit_cube(0.6, paper_emitter());
  room.receivers = {at({0.001, 0.5, 0.4}, {-1, 0, 0})};
  const Result close = simulate(room, receivers_by(ReceiverWalk::two_way, Estimator::weight, 2e5, 41));
  const Result reference = simulate(room, receivers_by(ReceiverWalk::backward, Estimator::weight, 2e6, 42));
  const Judgement verdict = compare(against_reference(close, reference));
  INFO(verdict.text);
  CHECK(verdict.agrees);
  CHECK(close.receiver_results[0].standard_error < 0.02 * close.receiver_results[0].indirect);

  // A lamp 1 cm over the floor: backward walks would score 10³ times the mean where they land below it.
  room.emitters = {lambert({0.3, 0.01, 0.6}, {0, -1, 0}, 5.0)};
  room.receivers = {at({0.5, 1.0, 0.5}, {0, -1, 0})};
  const Result below = simulate(room, receivers_by(ReceiverWalk::two_way, Estimator::weight, 2e5, 43));
  const Result photons = simulate(room, receivers_by(ReceiverWalk::next_event, Estimator::weight, 2e6, 44));
  const Judgement low = compare(against_reference(below, photons));
  INFO(low.text);
  CHECK(low.agrees);
  CHECK(below.receiver_results[0].standard_error < 0.005 * below.receiver_results[0].indirect);
}

TEST_CASE("receiver walks: a cell has the mean over its area, by all walks") {
  // No edge of a shadow crosses the cell, so that the middles of strata have the mean of the cell within 10⁻⁴.
  Room room = partitioned();
  room.emitters = {isotropic({2.0, 2.6, 3.4}, 100.0)};
  const glm::dvec3 u(0.9, 0.0, 0.3);
  const glm::dvec3 v(-0.2, 0.0, 0.6);
  const glm::dvec3 middle(2.0, 0.8, 3.2);
  // The mean of points in strata of the cell.
  constexpr int n = 12;
  for (int i = 0; i < n * n; ++i)
    room.receivers.push_back(at(middle + ((i % n + 0.5) / n - 0.5) * u + ((i / n + 0.5) / n - 0.5) * v, {0, 1, 0}));
  const Result points = simulate(room, receivers_by(ReceiverWalk::backward, Estimator::weight, 6e5, 51));
  Compared mean;
  for (const ReceiverResult& one : points.receiver_results) {
    mean.expected += one.irradiance / (n * n);
    mean.expected_error = std::hypot(mean.expected_error, one.standard_error / (n * n));
  }
  room.receivers = {at(middle, {0, 1, 0})};
  room.receivers[0].cell_u = u;
  room.receivers[0].cell_v = v;
  const double at_middle = points.receiver_results[n / 2 * n + n / 2].irradiance;
  for (const ReceiverWalk walk : {ReceiverWalk::next_event, ReceiverWalk::two_way, ReceiverWalk::backward}) {
    const Result cell = simulate(room, receivers_by(walk, Estimator::weight, 2e5, 52));
    mean.value = cell.receiver_results[0].irradiance;
    mean.standard_error = cell.receiver_results[0].standard_error;
    const Judgement verdict = compare({mean});
    INFO(to_string(walk) << ": " << verdict.text << "; at the middle " << at_middle);
    WARN(to_string(walk) << ": " << verdict.text << "; at the middle " << at_middle);
    CHECK(verdict.agrees);
    CHECK(verdict.smallest_bias < 0.02);
    Compared of_point = mean;
    of_point.expected = at_middle;
    CHECK_FALSE(compare({of_point}).agrees);
  }
}

TEST_CASE("receiver walks: cells without two edges at right angles to the normal are refused") {
  Room room = unit_cube(0.5, paper_emitter());
  room.receivers = {at({0.5, 0.2, 0.5}, {0, 1, 0})};
  room.receivers[0].cell_u = {0.1, 0.0, 0.0};
  CHECK_THROWS_WITH(check_room(room), ContainsSubstring("edges of the cell"));
  room.receivers[0].cell_v = {0.0, 0.1, 0.0};
  CHECK_THROWS_WITH(check_room(room), ContainsSubstring("right angles"));
  room.receivers[0].cell_v = {0.0, 0.0, 0.1};
  CHECK_NOTHROW(check_room(room));
}
