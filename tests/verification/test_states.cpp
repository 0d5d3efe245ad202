// However a run is split (into sessions, parts, members of a team), its figures are the same to the last bit. Nothing
// here is a matter of chance: one history counted twice, or not at all, changes bits.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <stop_token>
#include <vector>

#include <unistd.h>

#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/thread_team.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

// Everything that comes from tallies.
bool same_figures(const Result& a, const Result& b) {
  if (a.tiles.size() != b.tiles.size() || a.receiver_results.size() != b.receiver_results.size()) return false;
  for (std::size_t i = 0; i < a.tiles.size(); ++i) {
    if (!same_bits(a.tiles[i].power, b.tiles[i].power) || a.tiles[i].hits != b.tiles[i].hits ||
        !same_bits(a.tiles[i].standard_error, b.tiles[i].standard_error))
      return false;
  }
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    if (!same_bits(a.surfaces[i].standard_error, b.surfaces[i].standard_error) ||
        !same_bits(a.surfaces[i].behind_share, b.surfaces[i].behind_share))
      return false;
  }
  for (std::size_t i = 0; i < a.receiver_results.size(); ++i) {
    if (!same_bits(a.receiver_results[i].irradiance, b.receiver_results[i].irradiance) ||
        !same_bits(a.receiver_results[i].standard_error, b.receiver_results[i].standard_error))
      return false;
  }
  return a.histories == b.histories && a.impacts == b.impacts && a.backward.histories == b.backward.histories &&
         same_bits(a.incident, b.incident) && same_bits(a.incident_standard_error, b.incident_standard_error) &&
         same_bits(a.balance.absorbed, b.balance.absorbed) && same_bits(a.balance.residual, b.balance.residual);
}

// Two emitters, different walls, two receivers; with a board in the middle it is no cuboid any more.
Room room_to_split(bool furnished) {
  Room room = make_cuboid({1.0, 2.0, 1.5}, {0.3, 0.8, 0.5, 0.6, 0.7, 0.4});
  room.emitters.push_back(lambert({0.4, 1.5, 0.7}, {0.1, -1, 0.2}, 2.0, 3.0));
  room.emitters.push_back(isotropic({0.6, 0.5, 0.5}, 1.0));
  room.receivers.push_back({"desk", {0.5, 0.8, 0.7}, {0, 1, 0}, 90.0, 1.0});
  room.receivers.push_back({"eye", {0.2, 1.2, 1.1}, {1, 0.2, 0}, 60.0, 1.0});
  if (furnished) {
    Surface board;
    board.name = "board";
    board.positions = {{0.2, 1.0, 0.2}, {0.8, 1.0, 0.2}, {0.8, 1.0, 1.2}, {0.2, 1.0, 1.2}};
    board.triangles = {{0, 1, 2}, {0, 2, 3}};
    room.surfaces.push_back(board);
  }
  return room;
}

struct Way {
  bool furnished = false;
  Settings settings;
};

// Both tracers, all estimators, cut off or not, few tiles and many, direct light counted and integrated, tiles walked
// from backward.
std::vector<Way> ways() {
  std::vector<Way> all;
  for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption})
    all.push_back({false, settings_of(estimator, Engine::cuboid, 50'001, 7)});
  for (const Estimator estimator : {Estimator::weight, Estimator::collision})
    all.push_back({true, settings_of(estimator, Engine::embree, 50'001, 7, 0.02)});
  all.push_back({true, settings_of(Estimator::collision, Engine::embree, 50'001, 8)});
  all.back().settings.direct = Direct::analytic;
  all.push_back({false, settings_of(Estimator::weight, Engine::cuboid, 50'001, 9)});
  all.back().settings.max_bounces = 4;
  all.push_back({true, settings_of(Estimator::collision, Engine::embree, 50'001, 10, 0.3)});
  all.back().settings.tiles = TileWalk::backward;
  for (Way& way : all) way.settings.ways = Ways::all;
  return all;
}

// The state as another process finds it.
State written_and_read(const State& state) {
  const auto file = std::filesystem::temp_directory_path() / ("lichtmc_state_" + std::to_string(::getpid()) + ".h5");
  write_state(state, file);
  State read = read_state(file);
  std::filesystem::remove(file);
  return read;
}

Result part(const Room& room, Settings settings, std::uint64_t first, std::uint64_t last) {
  settings.first_history = first;
  settings.photons = last - first;
  settings.part = true;
  return simulate(room, settings);
}

}  // namespace

TEST_CASE("a run that is resumed, from within a batch too, ends as one without interruption") {
  for (const Way& way : ways()) {
    const Room room = room_to_split(way.furnished);
    const Result whole = simulate(room, way.settings);
    for (const std::uint64_t first : {std::uint64_t{1}, std::uint64_t{10'240}, std::uint64_t{33'333}}) {
      Settings shorter = way.settings;
      shorter.photons = first;
      Result begun = simulate(room, shorter);
      CHECK_FALSE(same_figures(whole, begun));
      const Result resumed = resume(room, written_and_read(begun.state), way.settings);
      CHECK(same_figures(whole, resumed));
      // And the state that it leaves is that of the whole.
      CHECK(same_figures(whole, result_of(room, resumed.state)));
    }
  }
}

TEST_CASE("every checkpoint of a run is a state that ends as the run does") {
  for (const Way& way : ways()) {
    const Room room = room_to_split(way.furnished);
    Settings settings = way.settings;
    settings.photons = 400'000;
    const Result whole = simulate(room, settings);
    std::vector<State> states;
    Control control;
    control.checkpoint_seconds = 0.0;
    control.checkpoint = [&](const State& state) { states.push_back(state); };
    CHECK(same_figures(whole, simulate(room, settings, control)));
    REQUIRE_FALSE(states.empty());
    // States that are kept do not change when the run goes on.
    CHECK(same_figures(whole, resume(room, states.front(), settings)));
    CHECK(same_figures(whole, resume(room, states[states.size() / 2], settings)));
    CHECK(same_figures(whole, resume(room, std::move(states.back()), settings)));
  }
}

TEST_CASE("a run that was stopped goes on as if it had not been") {
  const Room room = room_to_split(true);
  Settings settings = settings_of(Estimator::weight, Engine::embree, 300'001, 3);
  settings.ways = Ways::all;
  const Result whole = simulate(room, settings);
  Settings stopped_early = settings;
  stopped_early.max_seconds = 0.05;
  const Result stopped = simulate(room, stopped_early);
  REQUIRE(stopped.stopped_by == StopReason::max_time);
  CHECK(same_figures(whole, resume(room, stopped.state, settings)));
  // By the caller, at the first report of progress.
  std::stop_source source;
  Control control;
  control.stop = source.get_token();
  control.progress = [&](const Progress& progress) {
    if (progress.stage == Progress::Stage::tiles) source.request_stop();
  };
  Settings longer = settings;
  longer.photons = 3'000'000;
  const Result interrupted = simulate(room, longer, control);
  if (interrupted.histories < longer.photons) CHECK(interrupted.stopped_by == StopReason::interrupt);
  CHECK(same_figures(simulate(room, longer), resume(room, interrupted.state, longer)));
}

TEST_CASE("a smaller target error ends where a run with it from the start ends") {
  const Room room = room_to_split(false);
  Settings settings = settings_of(Estimator::collision, Engine::cuboid, 1e12, 4);
  settings.ways = Ways::all;
  settings.target_error = 0.06;
  const Result begun = simulate(room, settings);
  REQUIRE(begun.stopped_by == StopReason::target_error);
  // Nothing is left to do.
  const Result again = resume(room, begun.state, settings);
  CHECK(again.stopped_by == StopReason::target_error);
  CHECK(same_figures(begun, again));
  settings.target_error = 0.03;
  const Result whole = simulate(room, settings);
  CHECK(whole.histories > begun.histories);
  CHECK(same_figures(whole, resume(room, begun.state, settings)));
}

TEST_CASE("a run whose estimator was chosen keeps its choice and its looks") {
  const Room room = room_to_split(true);
  Settings settings = settings_of(Estimator::automatic, Engine::embree, 1e12, 4, 0.3);
  settings.ways = Ways::all;
  settings.target_error = 0.005;
  const Result whole = simulate(room, settings);
  std::optional<State> first;
  Control control;
  control.checkpoint_seconds = 0.0;
  control.checkpoint = [&](const State& state) {
    if (!first) first = state;
  };
  CHECK(same_figures(whole, simulate(room, settings, control)));
  REQUIRE(first);
  const Result resumed = resume(room, *first, settings);
  CHECK(same_figures(whole, resumed));
  CHECK(resumed.estimator == whole.estimator);
  CHECK(resumed.backward.estimator == whole.backward.estimator);
}

TEST_CASE("parts add up to one run, in any order and grouping") {
  for (const Way& way : ways()) {
    const Room room = room_to_split(way.furnished);
    const Result whole = simulate(room, way.settings);
    std::vector<State> parts;
    std::uint64_t first = 0;
    for (const std::uint64_t last :
         {std::uint64_t{20'480}, std::uint64_t{21'504}, std::uint64_t{40'960}, way.settings.photons}) {
      parts.push_back(written_and_read(part(room, way.settings, first, last).state));
      first = last;
    }
    const std::vector<std::string> names{"a", "b", "c", "d"};
    CHECK(same_figures(whole, result_of(room, merge(parts, names))));
    CHECK(same_figures(whole, result_of(room, merge({parts[2], parts[0], parts[3], parts[1]}, names))));
    const State ends = merge({parts[3], parts[0]}, {"d", "a"});
    const State middle = merge({parts[2], parts[1]}, {"c", "b"});
    const State sum = written_and_read(merge({ends, middle}, {"da", "cb"}));
    CHECK(same_figures(whole, result_of(room, sum)));
    if (way.settings.tiles == TileWalk::forward)
      CHECK(sum.histories() == std::vector<HistoryRange>{{0, way.settings.photons}});
    // And the sum goes on.
    Settings longer = way.settings;
    longer.photons = 70'000;
    CHECK(same_figures(simulate(room, longer), resume(room, sum, longer)));
    // One part less is another result.
    CHECK_FALSE(same_figures(whole, result_of(room, merge({parts[0], parts[1], parts[3]}, {"a", "b", "d"}))));
  }
}

TEST_CASE("states that do not belong together are refused by what sets them apart") {
  const Room room = room_to_split(false);
  const Settings settings = settings_of(Estimator::collision, Engine::cuboid, 10'240, 1);
  const State one = simulate(room, settings).state;
  const auto refused = [&](const State& other, const std::string& says) {
    INFO(says);
    CHECK_THROWS_WITH(merge({one, other}, {"one.h5", "two.h5"}), ContainsSubstring(says));
    CHECK_THROWS_WITH(merge({other, one}, {"two.h5", "one.h5"}), ContainsSubstring("two.h5"));
  };
  const auto after = [&](const Room& other_room, Settings other) {
    return part(other_room, other, 10'240, 20'480).state;
  };
  refused(one, "overlap");
  Settings other = settings;
  other.seed = 2;
  refused(after(room, other), "seeds 1 and 2");
  other = settings;
  other.tile_edge_m = 0.2;
  refused(after(room, other), "tiles of 0.1 m and 0.2 m");
  other = settings;
  other.estimator = Estimator::weight;
  refused(after(room, other), "estimators collision and weight");
  other = settings;
  other.engine = Engine::embree;
  refused(after(room, other), "engines cuboid and embree");
  other = settings;
  other.direct = Direct::analytic;
  refused(after(room, other), "--direct");
  other = settings;
  other.ways = Ways::all;
  refused(after(room, other), "--only");
  Room darker = room;
  darker.surfaces[0].reflectance = 0.31;
  refused(after(darker, settings), "different rooms");
  // Within a batch only the last may end.
  const State uneven = part(room, settings, 0, 10'000).state;
  CHECK_THROWS_WITH(merge({uneven, after(room, settings)}, {"one.h5", "two.h5"}), ContainsSubstring("batch of 1024"));
  // To go on there must be the same room, and no gap.
  CHECK_THROWS_WITH(resume(darker, one, settings), ContainsSubstring("another room"));
  const State gap = merge({one, part(room, settings, 20'480, 30'720).state}, {"one.h5", "two.h5"});
  CHECK_THROWS_WITH(resume(room, gap, settings), ContainsSubstring("gaps: nothing is there of 10240 … 20479"));
  CHECK(result_of(room, gap).histories == 20'480);
  // A part begins with a batch.
  CHECK_THROWS_WITH(part(room, settings, 1000, 20'480), ContainsSubstring("Begin at 0 or 1024"));
  other = settings;
  other.estimator = Estimator::automatic;
  CHECK_THROWS_WITH(part(room, other, 1024, 20'480), ContainsSubstring("'auto'"));
}

TEST_CASE("a team of any size finds the same figures, and all its members do") {
  std::vector<Way> all = ways();
  Way chosen{true, settings_of(Estimator::automatic, Engine::embree, 200'000, 4, 0.3)};
  chosen.settings.target_error = 0.05;
  chosen.settings.ways = Ways::all;
  all.push_back(chosen);
  for (const Way& way : all) {
    const Room room = room_to_split(way.furnished);
    const Result alone = simulate(room, way.settings);
    for (const unsigned size : {1U, 2U, 3U}) {
      std::mutex mutex;
      std::vector<Result> results;
      std::vector<State> states;
      run_team(size, [&](Team& team) {
        Control control;
        control.team = &team;
        control.checkpoint_seconds = 0.0;
        if (team.rank() == 0) control.checkpoint = [&](const State& state) { states.push_back(state); };
        Settings settings = way.settings;
        settings.threads = 1 + team.rank();
        Result result = simulate(room, settings, control);
        const std::lock_guard lock(mutex);
        results.push_back(std::move(result));
      });
      REQUIRE(results.size() == size);
      for (const Result& result : results) CHECK(same_figures(alone, result));
      REQUIRE_FALSE(states.empty());
      CHECK(same_figures(alone, resume(room, states.front(), way.settings)));
    }
  }
}

TEST_CASE("a team stops together when the first is asked to") {
  const Room room = room_to_split(true);
  Settings settings = settings_of(Estimator::collision, Engine::embree, 1e12, 3);
  settings.max_seconds = 0.5;
  settings.ways = Ways::forward;
  std::vector<std::uint64_t> histories(3);
  State state;
  run_team(3, [&](Team& team) {
    Control control;
    control.team = &team;
    Result result = simulate(room, settings, control);
    histories[team.rank()] = result.histories;
    if (team.rank() == 0) state = result.state;
  });
  CHECK(histories[0] > 0);
  CHECK(histories == std::vector<std::uint64_t>(3, histories[0]));
  settings.max_seconds.reset();
  settings.photons = histories[0];
  CHECK(same_figures(simulate(room, settings), result_of(room, state)));
}
