// The trade of speed against accuracy in one room: every way to measure its tiles, held against a reference.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc {

// Where a study stands.
struct StudyProgress {
  std::string what;         // the run that is on: "forward, collision, tiles of 0.1 m"
  std::size_t done = 0;     // runs that have ended
  std::size_t of = 0;       // that there will be; 0 while that is not known
  double seconds = 0.0;     // since the study began
  double of_seconds = 0.0;  // StudyOptions::seconds
};

struct StudyOptions {
  double seconds = 600.0;             // wall-clock time for all of it, about; ≥ 5
  std::optional<double> tile_edge_m;  // default: 0.1 m, or so much longer that there are about 2000 tiles
  std::uint64_t seed = 1;             // the reference has another one
  unsigned threads = 0;               // 0: one per processor
  // Called before each run and some times a second while it goes on, from one thread at a time.
  std::function<void(const StudyProgress&)> progress;
  std::stop_token stop;  // ends the study early; what was measured so far is returned
};

// One run. Errors are relative, of the tiles' irradiance, area-weighted, over the tiles whose reference is known to
// 10 % or better.
struct StudyRow {
  WalkDirection direction = WalkDirection::forward;
  Estimator estimator = Estimator::collision;
  Engine engine = Engine::embree;
  std::uint64_t histories = 0;
  std::optional<std::uint32_t> max_bounces;
  double tile_edge_m = 0.0;
  Direct direct = Direct::sampled;
  double seconds = 0.0;          // of the walk, with that of integrating direct light
  double direct_seconds = 0.0;   // of that, integrating direct light
  double rms_error = 0.0;        // rms difference from the reference
  double bias = 0.0;             // of the power on all these tiles together
  double standard_error = 0.0;   // rms of what the run itself states
  double figure_of_merit = 0.0;  // 1 / (rms_error² · seconds), 1/s
};

// What rows of one tile size are held against: walks of the collision estimator with a seed of their own.
struct StudyReference {
  double tile_edge_m = 0.0;
  std::size_t tiles = 0;
  std::uint64_t histories = 0;  // ≥ 30 times those of any forward row
  double standard_error = 0.0;  // rms, relative, as in the rows
  double area_share = 0.0;      // of the area that light falls on: tiles whose reference is known to 10 % or better
};

// The cheapest setting for one accuracy.
struct Advice {
  double error = 0.0;  // 0.1, 0.01, 0.001
  StudyRow setting;    // the row that it is drawn from
  double histories = 0.0;
  double seconds = 0.0;  // forecast from the row's figure of merit
  std::string sentence;
};

struct Study {
  std::string room;
  unsigned threads = 1;
  std::vector<StudyReference> references;  // the first is that of the main tile size
  std::vector<StudyRow> rows;
  std::vector<Advice> advice;
  std::vector<std::string> left_out;  // what there was no time for, or what the room does not allow; a sentence each
};

// Runs every estimator, forward (direct light sampled and integrated, each engine that serves the room) and backward,
// with growing numbers of histories; the weight estimator cut off after 2 … 50 flights; and other tile sizes. Throws
// what simulate() throws, and InputError where the time is too short for a reference.
Study study(const Room& room, const StudyOptions& options = {});

}  // namespace lichtmc
