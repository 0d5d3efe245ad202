// Runs that are stopped, at any moment and for any reason: results are kept, and a resumed run ends with the same
// figures as an uninterrupted one.
#include <atomic>
#include <filesystem>
#include <mutex>
#include <stop_token>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/split_runs.hpp"
#include "support/thread_communicator.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// Requests a stop at the first report of a stage.
class StopAt {
 public:
  explicit StopAt(Progress::Stage stage) : stage_(stage) {}

  Control control() {
    Control control;
    control.stop = source_.get_token();
    control.progress = [this](const Progress& progress) {
      if (progress.stage == stage_) source_.request_stop();
    };
    return control;
  }
  bool came() const { return source_.stop_requested(); }

 private:
  Progress::Stage stage_;
  std::stop_source source_;
};

// A room in which every history takes a million flights, so that a stop occurs within one.
Room bright_room() {
  Room room = room_to_split(Furniture::board);
  for (Surface& surface : room.surfaces) surface.reflectance = 1.0 - 1e-6;
  return room;
}

}  // namespace

TEST_CASE("a stopped run that is resumed has the figures of an uninterrupted run") {
  const Room room = room_to_split(Furniture::board);
  Settings settings = settings_of(Estimator::weight, Engine::embree, 300'001, 3);
  settings.measured = Measured::all;
  const Result whole = simulate(room, settings);
  Settings stopped_early = settings;
  stopped_early.max_seconds = 0.05;
  const Result stopped = simulate(room, stopped_early);
  REQUIRE(stopped.walk.stopped_by == StopReason::max_time);
  CHECK(same_figures(whole, resume(room, stopped.state, settings)));
  // By the caller, at the first report of progress.
  StopAt tiles(Progress::Stage::tiles);
  Settings longer = settings;
  longer.photons = 1'000'000;
  const Result interrupted = simulate(room, longer, tiles.control());
  REQUIRE(tiles.came());
  CHECK(interrupted.walk.histories < longer.photons);
  CHECK(interrupted.walk.stopped_by == StopReason::interrupt);
  CHECK(same_figures(simulate(room, longer), resume(room, interrupted.state, longer)));
}

TEST_CASE("a stop within the first backward walks from the receivers keeps the tiles and their state") {
  const Room room = bright_room();
  Settings settings = settings_of(Estimator::collision, Engine::embree, 1, 3);
  settings.measured = Measured::all;
  StopAt receivers(Progress::Stage::receivers);
  const Result stopped = simulate(room, settings, receivers.control());
  REQUIRE(receivers.came());
  CHECK(stopped.walk.histories == 1);
  CHECK(stopped.receiver_results.empty());
  REQUIRE_FALSE(stopped.warnings.empty());
  CHECK_THAT(stopped.warnings.back(), ContainsSubstring("were not measured"));
  const State state = written_and_read(stopped.state);
  CHECK(state.histories() == std::vector<HistoryRange>{{0, 1}});
  CHECK(state.receiver_histories() == 0);
}

TEST_CASE("if the time limit is already reached, resume returns all results of the state") {
  for (const SplitRun& split : split_runs()) {
    const Room room = room_to_split(split.kind);
    const Result whole = simulate(room, split.settings);
    Settings over = split.settings;
    over.max_seconds = 1e-9;
    CHECK(same_figures(whole, resume(room, whole.state, over)));
  }
}

TEST_CASE("sessions share one time limit") {
  const Room room = room_to_split(Furniture::none);
  Settings settings = settings_of(Estimator::collision, Engine::cuboid, 200'000, 3);
  settings.measured = Measured::all;
  const State first = simulate(room, settings).state;
  Settings rules = settings;
  rules.photons = 300'000;
  rules.max_seconds = 1000.0;
  // A state has the limit of all sessions together, from which a later one subtracts the time that they took.
  const State second = resume(room, first, rules).state;
  CHECK(*second.settings().max_seconds == first.seconds() + 1000.0);
  rules.photons = 400'000;
  rules.max_seconds = *second.settings().max_seconds - second.seconds();
  const State third = resume(room, second, rules).state;
  CHECK(*third.settings().max_seconds == Approx(*second.settings().max_seconds).epsilon(1e-12));
}

TEST_CASE("a stop before the choice of the estimator does not affect the choice of the resumed run") {
  // Twenty flights in a history: a pilot of 262 144 takes longer than the 0.1 s until the first report of its progress,
  // up to 50 million flights per second.
  Room room = room_to_split(Furniture::board);
  for (Surface& surface : room.surfaces) surface.reflectance = 0.95;
  Settings settings = settings_of(Estimator::automatic, Engine::embree, 20'000'000, 4, 0.3);
  settings.measured = Measured::tiles;
  StopAt pilots(Progress::Stage::pilot);
  const Result stopped = simulate(room, settings, pilots.control());
  REQUIRE(pilots.came());
  CHECK(stopped.walk.histories > 0);
  REQUIRE(stopped.choices.size() == 1);
  CHECK_THAT(stopped.choices.front(), ContainsSubstring("restarts these walks"));
  const State state = written_and_read(stopped.state);
  CHECK(state.histories().empty());
  CHECK_THROWS_WITH(result_of(room, state), ContainsSubstring("The state contains no walk"));
  settings.photons = 500'000;
  CHECK(same_figures(simulate(room, settings), resume(room, state, settings)));
}

TEST_CASE("a merge of a single state has the figures of its run, for any target error") {
  // With a small target error direct light is integrated more finely.
  const Room room = room_to_split(Furniture::board);
  Settings settings = settings_of(Estimator::collision, Engine::embree, 30'000, 4);
  settings.direct = Direct::analytic;
  settings.target_error = 1e-3;
  const Result run = simulate(room, settings);
  CHECK(same_figures(run, result_of(room, merge({run.state}, {"one.h5"}), 1)));
  settings.target_error.reset();
  CHECK_FALSE(same_figures(run, simulate(room, settings)));
}

TEST_CASE("all ranks stop together when the time limit is reached") {
  const Room room = room_to_split(Furniture::board);
  Settings settings = settings_of(Estimator::collision, Engine::embree, 1e12, 3);
  settings.max_seconds = 0.5;
  settings.measured = Measured::tiles;
  std::vector<std::uint64_t> histories(3);
  State state;
  run_ranks(3, [&](Communicator& communicator) {
    Control control;
    control.communicator = &communicator;
    Result result = simulate(room, settings, control);
    histories[communicator.rank()] = result.walk.histories;
    if (communicator.rank() == 0) state = result.state;
  });
  CHECK(histories[0] > 0);
  CHECK(histories == std::vector<std::uint64_t>(3, histories[0]));
  settings.max_seconds.reset();
  settings.photons = histories[0];
  CHECK(same_figures(simulate(room, settings), result_of(room, state)));
}

TEST_CASE("a stop request to any rank stops all ranks together, in any stage") {
  const Room room = room_to_split(Furniture::board);
  Settings settings = settings_of(Estimator::collision, Engine::embree, 1e12, 3, 0.05);
  settings.direct = Direct::analytic;
  for (const auto& [tiles, ways] :
       {std::pair(WalkDirection::forward, Measured::tiles), std::pair(WalkDirection::backward, Measured::tiles),
        std::pair(WalkDirection::forward, Measured::receivers)}) {
    settings.tile_walk = tiles;
    settings.measured = ways;
    std::stop_source source;
    std::vector<State> states(3);
    std::vector<StopReason> reasons(3);
    run_ranks(3, [&](Communicator& communicator) {
      Control control;
      control.communicator = &communicator;
      if (communicator.rank() == 1) control.stop = source.get_token();
      control.checkpoint_seconds = 0.0;
      if (communicator.rank() == 0) control.checkpoint = [&](const State& /*state*/) { source.request_stop(); };
      const Result result = simulate(room, settings, control);
      states[communicator.rank()] = result.state;
      reasons[communicator.rank()] =
          ways == Measured::receivers ? result.receiver_walk.stopped_by : result.walk.stopped_by;
    });
    CHECK(reasons == std::vector<StopReason>(3, StopReason::interrupt));
    Settings as_far = settings;
    as_far.photons = 1;
    const Result first = resume(room, states[0], as_far);
    CHECK(same_figures(first, resume(room, states[2], as_far)));
    as_far.photons = ways == Measured::receivers ? first.receiver_walk.histories : first.walk.histories;
    CHECK(same_figures(first, simulate(room, as_far)));
  }
}

TEST_CASE("ranks with different inputs are refused, by all ranks") {
  const Room room = room_to_split(Furniture::none);
  Room darker = room;
  darker.surfaces[0].reflectance = 0.31;
  const Settings settings = settings_of(Estimator::collision, Engine::cuboid, 100'000, 1);
  const State state = simulate(room, settings).state;
  Settings longer = settings;
  longer.photons = 110'000;
  const State other_state = resume(room, state, longer).state;
  longer.photons = 200'000;
  const auto refused = [](const std::string& says, const auto& run) {
    std::atomic<int> refusals{0};
    run_ranks(3, [&](Communicator& communicator) {
      Control control;
      control.communicator = &communicator;
      try {
        run(communicator.rank() == 1, control);
      } catch (const InputError& error) {
        if (std::string(error.what()).find("1 of 3 processes have " + says) != std::string::npos) ++refusals;
      }
    });
    CHECK(refusals == 3);
  };
  refused("another room", [&](bool odd, const Control& control) { simulate(odd ? darker : room, settings, control); });
  refused("other settings", [&](bool odd, const Control& control) {
    Settings own = settings;
    own.seed = odd ? 2 : 1;
    simulate(room, own, control);
  });
  refused("other settings",
          [&](bool odd, const Control& control) { resume(room, odd ? other_state : state, longer, control); });
}
