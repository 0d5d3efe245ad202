// A run has the same figures to the last bit for any split into sessions, parts and ranks. These tests are
// deterministic: one history counted twice, or not at all, changes bits.
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "run/state_data.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/split_runs.hpp"
#include "support/thread_communicator.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

TEST_CASE("a resumed run, also from within a batch, ends as one without interruption") {
  for (const SplitRun& split : split_runs()) {
    const Room room = room_to_split(split.kind);
    const Result whole = simulate(room, split.settings);
    for (const std::uint64_t first : {std::uint64_t{1}, std::uint64_t{10'240}, std::uint64_t{33'333}}) {
      Settings shorter = split.settings;
      shorter.photons = first;
      Result begun = simulate(room, shorter);
      CHECK_FALSE(same_figures(whole, begun));
      const Result resumed = resume(room, written_and_read(begun.state), split.settings);
      CHECK(same_figures(whole, resumed));
      // The state that it writes is that of the whole run.
      CHECK(same_figures(whole, result_of(room, resumed.state)));
    }
  }
}

TEST_CASE("resuming any checkpoint of a run ends with the figures of the run") {
  for (const SplitRun& split : split_runs()) {
    const Room room = room_to_split(split.kind);
    Settings settings = split.settings;
    settings.photons = 120'000;
    const Result whole = simulate(room, settings);
    std::vector<State> states;
    Control control;
    control.checkpoint_seconds = 0.0;
    control.checkpoint = [&](const State& state) { states.push_back(state); };
    CHECK(same_figures(whole, simulate(room, settings, control)));
    REQUIRE_FALSE(states.empty());
    // Stored states do not change when the run continues.
    CHECK(same_figures(whole, resume(room, states.front(), settings)));
    CHECK(same_figures(whole, resume(room, states[states.size() / 2], settings)));
    CHECK(same_figures(whole, resume(room, std::move(states.back()), settings)));
  }
}

TEST_CASE("a smaller target error ends where a run with it from the start ends") {
  const Room room = room_to_split(Furniture::none);
  Settings settings = settings_of(Estimator::collision, Engine::cuboid, 1e12, 4);
  settings.measured = Measured::all;
  settings.target_error = 0.06;
  const Result begun = simulate(room, settings);
  REQUIRE(begun.walk.stopped_by == StopReason::target_error);
  // Nothing is left to do.
  const Result repeated = resume(room, begun.state, settings);
  CHECK(repeated.walk.stopped_by == StopReason::target_error);
  CHECK(same_figures(begun, repeated));
  settings.target_error = 0.03;
  const Result whole = simulate(room, settings);
  CHECK(whole.walk.histories > begun.walk.histories);
  CHECK(same_figures(whole, resume(room, begun.state, settings)));
}

TEST_CASE("a run with an automatic estimator keeps its choice and its error checks") {
  const Room room = room_to_split(Furniture::board);
  Settings settings = settings_of(Estimator::automatic, Engine::embree, 1e12, 4, 0.3);
  settings.measured = Measured::all;
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
  CHECK(resumed.walk.estimator == whole.walk.estimator);
  CHECK(resumed.receiver_walk.estimator == whole.receiver_walk.estimator);
}

TEST_CASE("parts add up to one run, in any order and grouping") {
  for (const SplitRun& split : split_runs()) {
    const Room room = room_to_split(split.kind);
    const Result whole = simulate(room, split.settings);
    std::vector<State> parts;
    std::uint64_t first = 0;
    for (const std::uint64_t last :
         {std::uint64_t{20'480}, std::uint64_t{21'504}, std::uint64_t{40'960}, split.settings.photons}) {
      parts.push_back(written_and_read(part(room, split.settings, first, last).state));
      first = last;
    }
    const std::vector<std::string> names{"a", "b", "c", "d"};
    CHECK(same_figures(whole, result_of(room, merge(parts, names))));
    CHECK(same_figures(whole, result_of(room, merge({parts[2], parts[0], parts[3], parts[1]}, names))));
    const State ends = merge({parts[3], parts[0]}, {"d", "a"});
    const State middle = merge({parts[2], parts[1]}, {"c", "b"});
    const State sum = written_and_read(merge({ends, middle}, {"da", "cb"}));
    CHECK(same_figures(whole, result_of(room, sum)));
    if (split.settings.tile_walk == WalkDirection::forward)
      CHECK(sum.histories() == std::vector<HistoryRange>{{0, split.settings.photons}});
    // The sum can be resumed.
    Settings longer = split.settings;
    longer.photons = 70'000;
    CHECK(same_figures(simulate(room, longer), resume(room, sum, longer)));
    // With one part missing the result differs.
    CHECK_FALSE(same_figures(whole, result_of(room, merge({parts[0], parts[1], parts[3]}, {"a", "b", "d"}))));
  }
}

TEST_CASE("states that do not belong together are refused with their difference") {
  const Room room = room_to_split(Furniture::none);
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
  refused(after(room, other), "'seed' (--seed): 1 and 2");
  other = settings;
  other.tile_edge_m = 0.2;
  refused(after(room, other), "'edge of a tile' (--tile): 0.1 and 0.2");
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
  other.measured = Measured::all;
  refused(after(room, other), "--only");
  other = settings;
  other.tile_walk = WalkDirection::backward;
  refused(after(room, other), "--tiles");
  const State cut_off = [&] {
    Settings weights = settings;
    weights.estimator = Estimator::weight;
    weights.max_bounces = 4;
    return simulate(room, weights).state;
  }();
  other = settings;
  other.estimator = Estimator::weight;
  other.max_bounces = 5;
  CHECK_THROWS_WITH(merge({cut_off, after(room, other)}, {"one.h5", "two.h5"}), ContainsSubstring("--max-bounces"));
  Room darker = room;
  darker.surfaces[0].reflectance = 0.31;
  refused(after(darker, settings), "different rooms");
  // Only the last part may end within a batch.
  const State uneven = part(room, settings, 0, 10'000).state;
  CHECK_THROWS_WITH(merge({uneven, after(room, settings)}, {"one.h5", "two.h5"}), ContainsSubstring("batch of 1024"));
  // To resume, the room must be the same, and there must be no gap.
  CHECK_THROWS_WITH(resume(darker, one, settings), ContainsSubstring("another room"));
  const State gap = merge({one, part(room, settings, 20'480, 30'720).state}, {"one.h5", "two.h5"});
  CHECK_THROWS_WITH(resume(room, gap, settings),
                    ContainsSubstring("gaps: it does not contain histories 10240 … 20479"));
  CHECK(result_of(room, gap).walk.histories == 20'480);
  // A part begins with a batch.
  CHECK_THROWS_WITH(part(room, settings, 1000, 20'480), ContainsSubstring("Begin at 0 or 1024"));
  other = settings;
  other.estimator = Estimator::automatic;
  CHECK_THROWS_WITH(part(room, other, 1024, 20'480), ContainsSubstring("'auto'"));
}

TEST_CASE("a sum without the backward walks from the receivers cannot be resumed") {
  const Room room = room_to_split(Furniture::none);
  Settings settings = settings_of(Estimator::collision, Engine::cuboid, 10'240, 1);
  settings.measured = Measured::all;
  settings.receiver_walk = ReceiverWalk::backward;  // rounds of 32 walks from each of two receivers
  const std::vector<State> parts{part(room, settings, 0, 10'240).state, part(room, settings, 10'240, 20'480).state,
                                 part(room, settings, 20'480, 30'720).state};
  // One of them was stopped before the receivers.
  for (std::size_t missing = 0; missing < 2; ++missing) {
    std::vector<State> some = parts;
    StateData data = parts[missing].data();
    data.receivers.reset();
    some[missing] = State(std::make_shared<const StateData>(data));
    const State sum = merge(some, {"a", "b", "c"});
    CHECK(result_of(room, sum).walk.histories == 30'720);
    CHECK_THROWS_WITH(resume(room, sum, settings),
                      ContainsSubstring(missing == 0 ? "rounds 0 … 159" : "rounds 160 … 319"));
  }
  Settings longer = settings;
  longer.photons = 40'960;
  CHECK(same_figures(simulate(room, longer), resume(room, merge(parts, {"a", "b", "c"}), longer)));
}

TEST_CASE("any number of ranks gives the same figures, on all ranks") {
  std::vector<SplitRun> all = split_runs();
  SplitRun chosen{Furniture::board, settings_of(Estimator::automatic, Engine::embree, 200'000, 4, 0.3)};
  chosen.settings.target_error = 0.05;
  chosen.settings.measured = Measured::all;
  all.push_back(chosen);
  for (const SplitRun& split : all) {
    const Room room = room_to_split(split.kind);
    const Result alone = simulate(room, split.settings);
    for (const unsigned size : {1U, 2U, 3U}) {
      std::mutex mutex;
      std::vector<Result> results;
      std::vector<State> states;
      run_ranks(size, [&](Communicator& communicator) {
        Control control;
        control.communicator = &communicator;
        control.checkpoint_seconds = 0.0;
        if (communicator.rank() == 0) control.checkpoint = [&](const State& state) { states.push_back(state); };
        Settings settings = split.settings;
        settings.threads = 1 + communicator.rank();
        Result result = simulate(room, settings, control);
        const std::lock_guard lock(mutex);
        results.push_back(std::move(result));
      });
      REQUIRE(results.size() == size);
      for (const Result& result : results) CHECK(same_figures(alone, result));
      REQUIRE_FALSE(states.empty());
      CHECK(same_figures(alone, resume(room, states.front(), split.settings)));
    }
  }
}
