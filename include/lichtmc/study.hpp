// Speed against accuracy in one room: all methods to measure its tiles, compared with a reference.
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

// Progress of a study.
struct StudyProgress {
  std::string what;         // the current run: "forward, collision, tiles of 0.1 m"
  std::size_t done = 0;     // runs that have ended
  std::size_t of = 0;       // runs in total; 0 while unknown
  double seconds = 0.0;     // s, since the study began
  double of_seconds = 0.0;  // StudyOptions::seconds
};

struct StudyOptions {
  double seconds = 600.0;             // s, approximate wall-clock time of the study; ≥ 5
  std::optional<double> tile_edge_m;  // default: 0.1 m, or the larger length that gives about 2000 tiles
  std::uint64_t seed = 1;             // the reference has another seed
  unsigned threads = 0;               // 0: one per processor
  double error_floor_share = 0.01;    // as Settings::error_floor_share
  std::optional<double> error_floor;  // W/m² or lx, as Settings::error_floor
  // Called before each run and some times a second during it, from one thread at a time.
  std::function<void(const StudyProgress&)> progress;
  std::stop_token stop;  // ends the study early; what was measured so far is returned
};

// One run. Errors are relative to the tiles' irradiance or to the error floor, whichever is greater, area-weighted,
// over the tiles whose reference is known to 10 % or better.
struct StudyRow {
  WalkDirection direction = WalkDirection::forward;
  Estimator estimator = Estimator::collision;
  Engine engine = Engine::embree;
  std::uint64_t histories = 0;
  std::optional<std::uint32_t> max_bounces;
  double tile_edge_m = 0.0;
  Direct direct = Direct::sampled;
  double seconds = 0.0;          // s, of the walk, including integration of direct light
  double direct_seconds = 0.0;   // s, part of it for the integration
  double rms_error = 0.0;        // rms difference from the reference
  double bias = 0.0;             // of the incident power of all these tiles together
  double standard_error = 0.0;   // rms of the standard errors that the run reports
  double figure_of_merit = 0.0;  // 1 / (rms_error² · seconds), 1/s
};

// The reference of the rows of one tile size: a run of the collision estimator with another seed.
struct StudyReference {
  double tile_edge_m = 0.0;
  std::size_t tiles = 0;
  std::uint64_t histories = 0;  // ≥ 30 times those of any forward row
  double standard_error = 0.0;  // rms, relative, as in the rows
  double area_share = 0.0;      // fraction of the lit area on tiles whose reference is known to 10 % or better
};

// The setting with the lowest cost for one accuracy.
struct Advice {
  double error = 0.0;  // 0.1, 0.01, 0.001
  StudyRow setting;    // the row from which it is derived
  double histories = 0.0;
  double seconds = 0.0;  // forecast from the row
  std::string sentence;
};

struct Study {
  std::string room;
  unsigned threads = 1;
  std::vector<StudyReference> references;  // the first is that of the main tile size
  std::vector<StudyRow> rows;
  std::vector<Advice> advice;
  std::vector<std::string> left_out;  // runs without enough time, or not possible in the room; a sentence each
};

// Runs every estimator, forward (direct light sampled and integrated, each engine that serves the room) and backward,
// with growing numbers of histories; the weight estimator cut off after 2 … 50 flights; and other tile sizes. Throws
// as simulate() does, and InputError if the time is too short for a reference.
Study study(const Room& room, const StudyOptions& options = {});

}  // namespace lichtmc
