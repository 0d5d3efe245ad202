// A state with a valid seal, but with contents that no run can write: it is refused, and the message says what is
// wrong.
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lichtmc/error.hpp"
#include "room/reflectance.hpp"
#include "run/state_data.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/state_files.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// The shared sums, to be changed.
Totals& totals_of(StateData& data) {
  const auto own = std::make_shared<Totals>(*data.photons->totals);
  data.photons->totals = own;
  return *own;
}
struct Change {
  std::string says;
  std::function<void(StateData&)> make;
};

// Each change alone makes the state invalid, with this message.
void check_refused(const StateData& good, const std::vector<Change>& changes) {
  const Scratch scratch;
  write(good, scratch.file());
  REQUIRE_NOTHROW(read_state(scratch.file()));
  for (const Change& change : changes) {
    INFO(change.says);
    StateData bad = good;
    change.make(bad);
    write(bad, scratch.file());
    CHECK_THROWS_AS(read_state(scratch.file()), InputError);
    CHECK_THROWS_WITH(read_state(scratch.file()), ContainsSubstring(change.says));
  }
}

// A room with a window, a board with light on both sides, and, if requested, a floor with a texture.
Room uneven_room(bool open, bool textured) {
  Room room = small_room();
  Surface board;
  board.name = "board";
  board.positions = {{0.2, 0.3, 0.2}, {0.8, 0.3, 0.2}, {0.8, 0.3, 0.8}, {0.2, 0.3, 0.8}};
  board.triangles = {{0, 1, 2}, {0, 2, 3}};
  board.reflectance = 0.6;
  room.surfaces.push_back(board);
  room.emitters.push_back(isotropic({0.5, 0.15, 0.5}, 2.0));
  if (textured) {
    Surface& floor = room.surfaces[0];
    floor.reflectance_map = room.reflectance_maps.size();
    floor.reflectance_uvs = floor.uvs;
    room.reflectance_maps.push_back({"uneven", 3, 2, {0.1F, 0.9F, 0.3F, 0.7F, 0.2F, 0.6F}, Wrap::clamp, Wrap::repeat});
    floor.reflectance = mean_reflectance(room, floor);
  }
  if (open) room.surfaces.erase(room.surfaces.begin() + 3);
  return room;
}

bool comes_back(const State& state, const Scratch& scratch) {
  write_state(state, scratch.file());
  read_state(scratch.file());  // throws if it is refused
  return true;
}

}  // namespace

// The identities that are checked below hold for the state of every run.
TEST_CASE("states of all estimators, rooms and ways of measuring are read again") {
  const Scratch scratch;
  for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption}) {
    for (const unsigned kind : {0U, 1U, 2U, 3U}) {
      const Room room = uneven_room((kind & 1) != 0, (kind & 2) != 0);
      Settings settings = settings_of(estimator, Engine::embree, 5500, 3, 0.3);
      settings.measured = Measured::all;
      CHECK(comes_back(simulate(room, settings).state, scratch));
      settings.direct = Direct::analytic;
      CHECK(comes_back(simulate(room, settings).state, scratch));
      settings.tile_walk = WalkDirection::backward;
      CHECK(comes_back(simulate(room, settings).state, scratch));
      settings.tile_walk = WalkDirection::forward;
      settings.tile_edge_m = 0.03;  // thousands of tiles: another kind of tally
      settings.measured = Measured::tiles;
      CHECK(comes_back(simulate(room, settings).state, scratch));
      settings.direct = Direct::sampled;
      settings.engine = Engine::embree_fast;
      settings.part = true;
      settings.first_history = 4096;
      CHECK(comes_back(simulate(room, settings).state, scratch));
      settings.measured = Measured::receivers;
      CHECK(comes_back(simulate(room, settings).state, scratch));
    }
  }
  Settings settings = small_settings(Estimator::weight);
  settings.max_bounces = 3;
  CHECK(comes_back(simulate(small_room(), settings).state, scratch));
  settings.photons = 5;  // no complete batch
  CHECK(comes_back(simulate(small_room(), settings).state, scratch));
  CHECK(comes_back(simulate(small_room(), small_settings(Estimator::automatic)).state, scratch));
}

TEST_CASE("a checkpoint before the first batch, and a sum with it, are read again") {
  const Scratch scratch;
  Settings settings = small_settings(Estimator::collision);
  settings.measured = Measured::tiles;
  settings.part = true;
  StateData data = small_state(settings);
  settings.first_history = 40'960;
  StateData nothing = small_state(settings);
  nothing.photons->ranges = {{40'960, 40'960}};
  nothing.photons->totals = std::make_shared<Totals>(24, 6, Hits::are_the_score);
  CHECK(comes_back(State(std::make_shared<const StateData>(nothing)), scratch));
  settings.first_history = 0;
  settings.photons = 20'480;
  data = small_state(settings);
  const State sum = merge(
      {State(std::make_shared<const StateData>(data)), State(std::make_shared<const StateData>(nothing))}, {"a", "b"});
  CHECK(sum.histories().size() == 2);
  CHECK(comes_back(sum, scratch));
}

TEST_CASE("a state with impossible settings is refused") {
  check_refused(
      small_state(small_settings(Estimator::weight)),
      {{"The number of photons is 0", [](StateData& d) { d.settings.photons = 0; }},
       {"The tile edge is -1 m", [](StateData& d) { d.settings.tile_edge_m = -1.0; }},
       {"The tile edge is nan m", [](StateData& d) { d.settings.tile_edge_m = not_a_number; }},
       {"The target error is -0.1", [](StateData& d) { d.settings.target_error = -0.1; }},
       {"The time limit is inf s", [](StateData& d) { d.settings.max_seconds = infinity; }},
       {"The histories end at", [](StateData& d) { d.settings.photons = ~std::uint64_t{0}; }},
       {"The first history is 1024 and the run is no part", [](StateData& d) { d.settings.first_history = 1024; }},
       {"does not begin at first_history, 1024",
        [](StateData& d) {
          d.settings.part = true;
          d.settings.first_history = 1024;
        }},
       {"A number of bounces is given for the estimator 'collision'",
        [](StateData& d) {
          d.settings.estimator = Estimator::collision;
          d.settings.max_bounces = 3;
        }},
       {"request backward walks from tiles, and no tiles",
        [](StateData& d) {
          d.settings.measured = Measured::receivers;
          d.settings.tile_walk = WalkDirection::backward;
        }},
       {"the engine that was used is given as 'auto'", [](StateData& d) { d.engine = Engine::automatic; }}});
}

TEST_CASE("a state with other walks than its settings require is refused") {
  check_refused(small_state(small_settings(Estimator::weight)),
                {{"it has /photons, which", [](StateData& d) { d.settings.measured = Measured::receivers; }},
                 {"it has /photons, which", [](StateData& d) { d.settings.tile_walk = WalkDirection::backward; }},
                 {"it has /receivers, which", [](StateData& d) { d.settings.measured = Measured::tiles; }},
                 {"it has no /photons, which", [](StateData& d) { d.photons.reset(); }},
                 {"it has /tile_walks, which", [](StateData& d) { d.tile_walks = d.receivers; }},
                 {"it contains no walks",
                  [](StateData& d) {
                    d.photons.reset();
                    d.receivers.reset();
                    d.settings.measured = Measured::receivers;
                  }},
                 {"the estimator that /photons used is given as 'auto'",
                  [](StateData& d) { d.photons->estimator = Estimator::automatic; }},
                 {"the estimator that /receivers used is given as 'auto'",
                  [](StateData& d) { d.receivers->estimator = Estimator::automatic; }},
                 {"/photons has the estimator 'weight', its settings have 'collision'",
                  [](StateData& d) { d.settings.estimator = Estimator::collision; }},
                 {"/receivers has the estimator 'collision', and its settings a number of bounces",
                  [](StateData& d) {
                    d.settings.max_bounces = 1000;
                    d.receivers->estimator = Estimator::collision;
                  }},
                 {"/photons has a pilot of 1024", [](StateData& d) { d.photons->pilot = 1024; }},
                 {"/photons took nan s", [](StateData& d) { d.photons->seconds = not_a_number; }},
                 {"/receivers took -1 s", [](StateData& d) { d.receivers->seconds = -1.0; }},
                 {"in convergence of /photons is an error of -1 after 1 s",
                  [](StateData& d) {
                    d.photons->convergence = {{1024, 1.0, -1.0}};
                  }},
                 {"in convergence of /receivers is an error of 1 after inf s", [](StateData& d) {
                    d.receivers->convergence = {{1024, infinity, 1.0}};
                  }}});
}

TEST_CASE("a state whose ranges do not match its sums is refused") {
  const auto ranges = [](std::vector<HistoryRange> those) {
    return [those = std::move(those)](StateData& d) { d.photons->ranges = those; };
  };
  const std::uint64_t far = std::uint64_t{1} << 63;
  check_refused(
      small_state(small_settings(Estimator::collision)),
      {{"sums 19456 histories, its ranges have 20480", ranges({{0, 20'480}})},
       {"sums 19456 histories, its ranges have 0", ranges({{0, 0}})},
       {"sums 20480 histories, its ranges have 19456", [](StateData& d) { totals_of(d).histories += 1024; }},
       {"ranges of /photons are missing", ranges({})},
       {"the range 1024:0 of /photons does not end between", ranges({{1024, 0}})},
       {"9223372036854775809 of /photons does not end between", ranges({{0, far + 1}})},
       {"the range 1:20000 of /photons is not one of whole batches", ranges({{1, 20'000}})},
       {"the range 0:9500 of /photons is not one of whole batches", ranges({{0, 9500}, {10'240, 20'480}})},
       {"the ranges 0:10240 and 9216:20480 of /photons overlap or touch", ranges({{0, 10'240}, {9216, 20'480}})},
       {"the ranges 0:10240 and 10240:20000 of /photons overlap or touch", ranges({{0, 10'240}, {10'240, 20'000}})},
       {"the ranges 10240:20480 and 0:9216 of /photons overlap or touch", ranges({{10'240, 20'480}, {0, 9216}})}});
}

TEST_CASE("a state whose arrays have different lengths is refused") {
  check_refused(small_state(small_settings(Estimator::weight)),
                {{"hits of 23 rows and tiles of 24", [](StateData& d) { totals_of(d).hits.pop_back(); }},
                 {"hits of 0 rows and tiles of 24", [](StateData& d) { totals_of(d).hits.clear(); }},
                 {"hits of 24 rows and tiles of 25", [](StateData& d) { totals_of(d).tiles.emplace_back(); }},
                 {"behind of 5 rows and tile_maps of 6", [](StateData& d) { totals_of(d).behind.pop_back(); }},
                 {"behind of 6 rows and tile_maps of 7", [](StateData& d) { totals_of(d).tile_maps.emplace_back(); }}});
  check_refused(small_state(small_settings(Estimator::collision)),
                {{"hits beside the scores of 'collision'", [](StateData& d) { totals_of(d).hits.assign(24, 1); }}});
  check_refused(small_state(small_settings(Estimator::absorption)),
                {{"hits of 7 rows and tiles of 24", [](StateData& d) { totals_of(d).hits.assign(7, 1); }}});
}

TEST_CASE("a state whose surfaces absorb another power than its balance is refused") {
  check_refused(
      small_state(small_settings(Estimator::collision)),
      {{"absorbed_by of 5 rows and tile_maps of 6", [](StateData& d) { totals_of(d).absorbed_by.assign(5, 0); }},
       {"absorbed_by does not add up to absorbed", [](StateData& d) { totals_of(d).absorbed_by.assign(6, 1); }}});
}

TEST_CASE("a state whose balance does not hold is refused") {
  for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption}) {
    check_refused(
        small_state(small_settings(estimator)),
        {{"do not add up to what was emitted", [](StateData& d) { totals_of(d).ends.absorbed += 1; }},
         {"do not add up to what was emitted", [](StateData& d) { totals_of(d).ends.residual -= 1; }},
         {"more absorbed, or escaped, than",
          [](StateData& d) {
            totals_of(d).ends.absorbed += totals_of(d).ends.absorbed << 90;
            totals_of(d).ends.residual -= d.photons->totals->ends.absorbed;
            totals_of(d).ends.residual += small_state(d.settings).photons->totals->ends.absorbed;
          }},
         {"lost does not fit 1 lost_histories", [](StateData& d) { totals_of(d).ends.lost_histories = 1; }},
         {"more absorbed, or escaped, than", [](StateData& d) { totals_of(d).impacts = 1'000; }},
         {"rays, fewer than of some kinds", [](StateData& d) { totals_of(d).traced.retraced = ~std::uint64_t{0}; }}});
  }
  check_refused(small_state(small_settings(Estimator::absorption)),
                {{"a residual that its estimator does not leave", [](StateData& d) {
                    totals_of(d).ends.residual += 1;
                    totals_of(d).ends.absorbed -= 1;
                  }}});
}

TEST_CASE("a state with impossible backward walks is refused") {
  Settings settings = small_settings(Estimator::collision);
  settings.tile_walk = WalkDirection::backward;
  const std::vector<Change> of_receivers{
      {"/receivers has rounds of 3 histories from the emitters and 1 walks, which no run has",
       [](StateData& d) { d.receivers->plan = {3, 1}; }},
      {"/receivers has rounds of 0 histories from the emitters and 0 walks, which no run has",
       [](StateData& d) { d.receivers->plan = {0, 0}; }},
      {"/receivers has no origin, or no round",
       [](StateData& d) { d.receivers->sums = std::make_shared<std::vector<BackwardSums>>(); }},
      {"/receivers has no origin, or no round",
       [](StateData& d) {
         d.receivers->ranges = {{0, 0}};
       }},
      {"ranges of /receivers are missing", [](StateData& d) { d.receivers->ranges.clear(); }},
      {"the ranges 0:5 and 4:6 of /receivers overlap",
       [](StateData& d) {
         d.receivers->ranges = {{0, 5}, {4, 6}};
       }},
      {"impacts of 10 rays", [](StateData& d) { d.receivers->count.traced.rays = 10; }},
      {"/tile_walks has rounds of 0 histories from the emitters and 1 walks, not of 0 and 4",
       [](StateData& d) { d.tile_walks->plan = {0, 1}; }},
      {"rounds from 24 origins, too many to count",
       [](StateData& d) {
         d.tile_walks->ranges = {{0, std::uint64_t{1} << 62}};
       }},
      {"/tile_walks has the estimator 'weight', its settings have 'collision'",
       [](StateData& d) { d.tile_walks->estimator = Estimator::weight; }}};
  check_refused(small_state(settings), of_receivers);
}
