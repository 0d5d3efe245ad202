// Impulse responses, their errors and what is derived from them are the same to the last bit for any split of a run
// into threads, sessions, parts and ranks.
#include <mutex>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/channel_bins.hpp"
#include "support/rooms.hpp"
#include "support/split_runs.hpp"
#include "support/thread_communicator.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

struct Split {
  std::string name;
  Room room;
  Settings settings;
};

// All walks and estimators; one channel or one for each emitter; a few receivers; with a board that
// shines, and in an open room.
std::vector<Split> splits() {
  std::vector<Split> all;
  const auto add = [&](Furniture furniture, ReceiverWalk walk, Estimator estimator, std::uint64_t seed) -> Split& {
    Split split{std::string(to_string(walk)) + ", " + std::string(to_string(estimator)), room_to_split(furniture),
                settings_of(estimator, Engine::automatic, 30'001, seed)};
    split.settings.measured = Measured::receivers;
    split.settings.receiver_walk = walk;
    split.settings.channel.bin_width_s = 0.4e-9;
    split.settings.channel.time_span_s = 30e-9;
    split.settings.channel.orders = 2;
    split.settings.channel.per_emitter = true;
    split.room.emitters[1].delay_s = 1.3e-9;
    all.push_back(split);
    return all.back();
  };
  add(Furniture::none, ReceiverWalk::two_way, Estimator::weight, 41).settings.channel.frequencies = {1e6, 41e6, 10e6};
  add(Furniture::none, ReceiverWalk::next_event, Estimator::collision, 42).settings.channel.per_emitter = false;
  add(Furniture::board, ReceiverWalk::backward, Estimator::absorption, 43).settings.channel.squared_weights = true;
  Split& open = add(Furniture::textured_board, ReceiverWalk::two_way, Estimator::collision, 44);
  open.room.emitters.push_back(surface_emitter(open.room.surfaces.size() - 1, 2.0));
  open.settings.channel.squared_weights = true;
  open.settings.channel.orders = 0;
  for (int k = 0; k < 5; ++k)
    open.room.receivers.push_back({"row_" + std::to_string(k), {0.1 + 0.15 * k, 0.3, 0.6}, {0, 1, 0}, 80.0, 1e-4});
  return all;
}

}  // namespace

TEST_CASE("channels: a resumed run ends with the bits of one without interruption") {
  for (const Split& split : splits()) {
    INFO(split.name);
    const Result whole = simulate(split.room, split.settings);
    REQUIRE(whole.channels);
    for (const std::uint64_t first : {std::uint64_t{1}, std::uint64_t{10'240}, std::uint64_t{23'333}}) {
      Settings shorter = split.settings;
      shorter.photons = first;
      const Result begun = simulate(split.room, shorter);
      // Runs end with whole rounds.
      if (begun.receiver_walk.rounds < whole.receiver_walk.rounds) CHECK_FALSE(same_channels(whole, begun));
      const Result resumed = resume(split.room, written_and_read(begun.state), split.settings);
      CHECK(same_channels(whole, resumed));
      CHECK(same_channels(whole, result_of(split.room, resumed.state)));
    }
  }
}

TEST_CASE("channels: parts add up to the bits of one run, in any order") {
  for (const Split& split : splits()) {
    INFO(split.name);
    const Result whole = simulate(split.room, split.settings);
    const std::uint64_t rounds_first = 15'360;
    std::vector<State> parts;
    std::uint64_t first = 0;
    for (const std::uint64_t last : {rounds_first, std::uint64_t{16'384}, split.settings.photons}) {
      parts.push_back(written_and_read(part(split.room, split.settings, first, last).state));
      first = last;
    }
    const Result forward = result_of(split.room, merge(parts, {"a", "b", "c"}));
    const Result backward = result_of(split.room, merge({parts[2], parts[0], parts[1]}, {"c", "a", "b"}));
    CHECK(same_channels(whole, forward));
    CHECK(same_channels(whole, backward));
    CHECK_FALSE(same_channels(whole, result_of(split.room, merge({parts[0], parts[1]}, {"a", "b"}))));
    Settings longer = split.settings;
    longer.photons = 50'000;
    CHECK(same_channels(simulate(split.room, longer), resume(split.room, merge(parts, {"a", "b", "c"}), longer)));
  }
}

TEST_CASE("channels: any number of threads and ranks gives the same bits, on all ranks") {
  for (const Split& split : splits()) {
    INFO(split.name);
    Settings settings = split.settings;
    settings.threads = 1;
    const Result alone = simulate(split.room, settings);
    for (const unsigned threads : {2U, 3U}) {
      settings.threads = threads;
      CHECK(same_channels(alone, simulate(split.room, settings)));
    }
    for (const unsigned size : {3U}) {
      std::mutex mutex;
      std::vector<Result> results;
      run_ranks(size, [&](Communicator& communicator) {
        Control control;
        control.communicator = &communicator;
        Settings own = split.settings;
        own.threads = 1 + communicator.rank();
        Result result = simulate(split.room, own, control);
        const std::lock_guard lock(mutex);
        results.push_back(std::move(result));
      });
      REQUIRE(results.size() == size);
      for (const Result& result : results) CHECK(same_channels(alone, result));
    }
  }
}
