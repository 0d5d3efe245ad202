// The parts of emitters: they add up to the run to the last digit, and dimmed scenes agree with runs of their own.
#include <array>
#include <cmath>
#include <cstring>
#include <mutex>
#include <string>
#include <vector>

#include "support/areas.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/split_runs.hpp"
#include "support/surfaces.hpp"
#include "support/thread_communicator.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// Three groups: two downlights of one name, a pendant, a shining panel; with `many` further lamps, so that light
// samples choose among them. A board casts shadows.
Room room_of_groups(bool board, int many = 0) {
  Room room = make_cuboid({4.0, 2.5, 3.0}, uniform_reflectance(0.5));
  room.emitters = {lambert({1.0, 2.4, 1.0}, {0, -1, 0}, 1.0, 500.0), lambert({3.0, 2.4, 2.0}, {0, -1, 0}, 2.0, 700.0),
                   isotropic({2.0, 1.8, 1.5}, 300.0)};
  room.emitters[0].name = room.emitters[1].name = "downlights";
  room.emitters[2].name = "pendant";
  if (board) {
    Surface panel;
    panel.name = "panel";
    panel.reflectance = 0.4;
    panel.positions = {{1.2, 1.3, 1.0}, {2.0, 1.3, 1.0}, {2.0, 1.3, 1.8}, {1.2, 1.3, 1.8}};
    panel.triangles = {{0, 1, 2}, {0, 2, 3}};
    room.surfaces.push_back(panel);
    room.emitters.push_back(surface_emitter(room.surfaces.size() - 1, 400.0));
    room.emitters.back().name = "panel";
  }
  for (int k = 0; k < many; ++k) {
    room.emitters.push_back(isotropic({0.3 + 0.5 * k, 2.0, 2.6}, 50.0 + 10.0 * k));
    room.emitters.back().name = "row";
  }
  add_area(room, "desk", {0.5, 0.75, 0.5}, {0.75, 0, 0}, {0, 0, 0.5}, 4, 4, {0, 1, 0});
  room.receivers.push_back({"eye", {2.6, 1.2, 0.4}, {0, 0, 1}});
  return room;
}

Settings parts_by(ReceiverWalk walk, Estimator estimator, double photons, std::uint64_t seed,
                  Engine engine = Engine::automatic) {
  Settings settings = settings_of(estimator, engine, photons, seed);
  settings.measured = Measured::receivers;
  settings.receiver_walk = walk;
  settings.per_emitter = true;
  return settings;
}

const std::vector<ReceiverWalk> walks{ReceiverWalk::next_event, ReceiverWalk::two_way, ReceiverWalk::backward};
const std::vector<Estimator> estimators{Estimator::weight, Estimator::collision, Estimator::absorption};

bool same(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool same_parts(const EmitterParts& a, const EmitterParts& b) {
  const auto same_lists = [](const std::vector<double>& x, const std::vector<double>& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
  };
  return a.rounds == b.rounds && a.group_rounds == b.group_rounds && same_lists(a.direct, b.direct) &&
         same_lists(a.direct_error, b.direct_error) && same_lists(a.reflected, b.reflected) &&
         same_lists(a.of_groups, b.of_groups) && same_lists(a.covariance, b.covariance);
}

}  // namespace

TEST_CASE("parts of emitters: they add up to the run exactly, and its errors are those of all parts") {
  for (const ReceiverWalk walk : walks) {
    for (const Estimator estimator : estimators) {
      for (const int many : {0, 6}) {
        const Room room = room_of_groups(true, many);
        INFO(to_string(walk) << ", " << to_string(estimator) << ", " << many);
        const Settings settings = parts_by(walk, estimator, 2e4, 5);
        const Result result = simulate(room, settings);
        REQUIRE(result.parts);
        const EmitterParts& parts = *result.parts;
        REQUIRE(parts.parts.size() == (many > 0 ? 4 : 3));
        const DimmedScene undimmed =
            dim(parts, room.receivers, room.areas, std::vector<double>(parts.parts.size(), 1.0));
        for (std::size_t k = 0; k < room.receivers.size(); ++k) {
          const ReceiverResult& one = result.receiver_results[k];
          double direct = 0.0;
          double reflected = 0.0;
          for (std::size_t p = 0; p < parts.parts.size(); ++p) {
            direct += parts.direct[parts.at(k, p)];
            reflected += parts.reflected[parts.at(k, p)];
          }
          CHECK(same(one.irradiance, direct + reflected));
          CHECK(same(one.irradiance, undimmed.receivers[k].irradiance));
          CHECK(same(one.standard_error, undimmed.receivers[k].standard_error));
        }
        CHECK(same(result.areas[0].mean.value, undimmed.areas[0].mean.value));
        CHECK(same(result.areas[0].uniformity.standard_error, undimmed.areas[0].uniformity.standard_error));
        // The same walks as without parts, whose scores are rounded to units of 2⁻²⁴ of the mean irradiance: once for
        // each part.
        Settings plain = settings;
        plain.per_emitter = false;
        const Result together = simulate(room, plain);
        double power = 0.0;
        double surface = 0.0;
        for (const Emitter& emitter : room.emitters) power += emitter.power;
        for (const Surface& one : room.surfaces) surface += surface_area(one);
        const double rounding = static_cast<double>(parts.parts.size() + 1) * 0x1p-25 * power / surface;
        for (std::size_t k = 0; k < room.receivers.size(); ++k) {
          const ReceiverResult& one = result.receiver_results[k];
          const ReceiverResult& other = together.receiver_results[k];
          CHECK(std::abs(one.indirect - other.indirect) < rounding);
          CHECK(std::abs(one.direct - other.direct) < 1e-12 * other.direct);
          CHECK(std::abs(one.standard_error - other.standard_error) < 1e-4 * other.standard_error);
        }
      }
    }
  }
}

TEST_CASE("parts of emitters: dimmed scenes agree with runs of dimmed emitters") {
  for (const bool board : {false, true}) {
    for (const ReceiverWalk walk : walks) {
      const Room room = room_of_groups(board, 6);
      const Result result = simulate(room, parts_by(walk, Estimator::weight, 3e5, 21));
      const EmitterParts& parts = *result.parts;
      std::vector<double> factors;
      Room dimmed = room;
      for (const EmitterParts::Part& part : parts.parts) {
        factors.push_back(part.name == "downlights" ? 0.3 : part.name == "pendant" ? 0.0 : 1.5);
        for (Emitter& emitter : dimmed.emitters) {
          if (emitter.name == part.name) emitter.power *= factors.back();
        }
      }
      const DimmedScene scene = dim(parts, room.receivers, room.areas, factors);
      Settings own = parts_by(walk, Estimator::collision, 3e5, 22);
      own.per_emitter = false;
      const Result separate = simulate(dimmed, own);
      std::vector<Compared> figures;
      for (std::size_t k = 0; k < scene.receivers.size(); ++k)
        figures.push_back({scene.receivers[k].irradiance, scene.receivers[k].standard_error,
                           separate.receiver_results[k].irradiance, separate.receiver_results[k].standard_error});
      const auto add = [&](const Figure& a, const Figure& b) {
        figures.push_back({a.value, a.standard_error, b.value, b.standard_error});
      };
      add(scene.areas[0].mean, separate.areas[0].mean);
      add(scene.areas[0].minimum, separate.areas[0].minimum);
      add(scene.areas[0].uniformity, separate.areas[0].uniformity);
      const Judgement judgement = compare(figures, Deviations::correlated);
      INFO(to_string(walk) << (board ? ", board: " : ": ") << judgement.text);
      CHECK(judgement.agrees);
      CHECK(judgement.smallest_bias < 0.05);
      CHECK(std::abs(scene.power - total_power(dimmed)) < 1e-9 * scene.power);
      // The errors follow from the covariances of the parts.
      const std::vector<double> covariance = covariances(parts);
      const std::size_t count = factors.size();
      REQUIRE(covariance.size() == parts.receivers * count * count);
      for (std::size_t k = 0; k < parts.receivers; ++k) {
        double variance = 0.0;
        for (std::size_t pair = 0; pair < count * count; ++pair)
          variance += factors[pair / count] * factors[pair % count] * covariance[k * count * count + pair];
        CHECK(std::abs(std::sqrt(variance) - scene.receivers[k].standard_error) <
              1e-9 * scene.receivers[k].standard_error);
      }
      // Factors of the wrong lamps.
      std::swap(factors[0], factors[1]);
      const DimmedScene wrong = dim(parts, room.receivers, room.areas, factors);
      for (std::size_t k = 0; k < wrong.receivers.size(); ++k) {
        figures[k].value = wrong.receivers[k].irradiance;
        figures[k].standard_error = wrong.receivers[k].standard_error;
      }
      CHECK_FALSE(compare(figures, Deviations::correlated).agrees);
    }
  }
}

TEST_CASE("parts of emitters: errors of dimmed scenes cover the truth") {
  constexpr int runs = 200;
  const Room room = room_of_groups(false, 2);
  const std::vector<double> factors{0.3, 0.0, 1.0};
  for (const ReceiverWalk walk : walks) {
    const double photons = 2e4;
    const Result longer = simulate(room, parts_by(walk, Estimator::weight, 100.0 * photons, 999));
    const DimmedScene truth = dim(*longer.parts, room.receivers, room.areas, factors);
    // |z| > 1 of Em, U0 and three receivers; |z| > 1 with the errors of independent parts.
    std::array<int, 5> beyond{};
    double squares = 0.0;
    for (int run = 0; run < runs; ++run) {
      const Result result =
          simulate(room, parts_by(walk, Estimator::weight, photons, 3000 + static_cast<std::uint64_t>(run)));
      const DimmedScene scene = dim(*result.parts, room.receivers, room.areas, factors);
      const auto z = [](double value, double error, double expected, double its_error) {
        return (value - expected) / std::hypot(error, its_error);
      };
      const auto of_figure = [&](const Figure& a, const Figure& b) {
        return z(a.value, a.standard_error, b.value, b.standard_error);
      };
      const auto of_receiver = [&](std::size_t k) {
        return z(scene.receivers[k].irradiance, scene.receivers[k].standard_error, truth.receivers[k].irradiance,
                 truth.receivers[k].standard_error);
      };
      const std::array<double, 5> all{of_figure(scene.areas[0].mean, truth.areas[0].mean),
                                      of_figure(scene.areas[0].uniformity, truth.areas[0].uniformity), of_receiver(0),
                                      of_receiver(7), of_receiver(16)};
      for (std::size_t k = 0; k < all.size(); ++k) beyond[k] += std::abs(all[k]) > 1.0 ? 1 : 0;
      squares += all[0] * all[0];
    }
    INFO(to_string(walk) << ": |z| > 1 of " << runs << ": " << beyond[0] << ", " << beyond[1] << ", " << beyond[2]
                         << ", " << beyond[3] << ", " << beyond[4] << "; mean z² of Em " << squares / runs);
    // 200 trials with 0.3173 each: more than this in one case of a million.
    for (const int count : beyond) CHECK(count <= 200 * 0.3173 + 4.75 * std::sqrt(200 * 0.3173 * 0.6827) + 1.0);
    CHECK(squares / runs > 1.0 - 4.75 * std::sqrt(2.0 / runs));
  }
}

TEST_CASE("parts of emitters: the same bits for threads, sessions, parts and ranks") {
  for (const ReceiverWalk walk : walks) {
    INFO(to_string(walk));
    const Room room = room_of_groups(true, 3);
    Settings settings = parts_by(walk, Estimator::collision, 30'001, 31);
    settings.threads = 1;
    const Result alone = simulate(room, settings);
    settings.threads = 3;
    CHECK(same_parts(*alone.parts, *simulate(room, settings).parts));
    Settings shorter = settings;
    shorter.photons = 10'240;
    const Result begun = simulate(room, shorter);
    CHECK(same_parts(*alone.parts, *resume(room, written_and_read(begun.state), settings).parts));
    const State first = written_and_read(part(room, settings, 0, 15'360).state);
    const State second = written_and_read(part(room, settings, 15'360, 30'001).state);
    CHECK(same_parts(*alone.parts, *result_of(room, merge({second, first}, {"b", "a"})).parts));
    CHECK_FALSE(same_parts(*alone.parts, *result_of(room, first).parts));
    std::mutex mutex;
    std::vector<Result> results;
    run_ranks(2, [&](Communicator& communicator) {
      Control control;
      control.communicator = &communicator;
      Result result = simulate(room, settings, control);
      const std::lock_guard lock(mutex);
      results.push_back(std::move(result));
    });
    for (const Result& result : results) CHECK(same_parts(*alone.parts, *result.parts));
  }
}

TEST_CASE("parts of emitters: cells have parts too; initial values follow from maintenance factors") {
  Room room = room_of_groups(true);
  room.areas.clear();
  room.receivers.clear();
  add_area(room, "cells", {0.5, 0.75, 0.5}, {1.5, 0, 0}, {0, 0, 1.0}, 2, 2, {0, 1, 0}, true);
  room.emitters[0].maintenance_factor = room.emitters[1].maintenance_factor = 0.8;
  room.emitters[2].maintenance_factor = 0.5;
  Settings settings = parts_by(ReceiverWalk::two_way, Estimator::weight, 2e4, 3);
  const Result kept = simulate(room, settings);
  settings.per_emitter = false;
  const Result result = simulate(room, settings);
  CHECK_FALSE(result.parts);
  CHECK(std::abs(result.areas[0].mean.value - kept.areas[0].mean.value) < 1e-6 * kept.areas[0].mean.value);
  const DimmedScene when_new = dim(*kept.parts, room.receivers, room.areas, {1.0 / 0.8, 1.0 / 0.5, 1.0});
  const double expected = when_new.areas[0].mean.value;
  CHECK(std::abs(result.areas[0].initial_mean.value - expected) < 1e-6 * expected);
  CHECK(result.areas[0].initial_minimum.value > result.areas[0].minimum.value);
}
