// What a simulation found: irradiance of every tile with its standard error, the balance of powers, and how it was got.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/state.hpp"
#include "lichtmc/tiles.hpp"

namespace lichtmc {

// Why a run ended.
enum class StopReason { photons, target_error, max_time, interrupt };

// "photons", "target-error", "max-time" or "interrupt".
std::string_view to_string(StopReason reason);

// One tile. A tile that nothing hit has irradiance 0 and the standard error of 1.148 hits: the truth lies between 0 and
// that with the probability of one standard error, 68 %. Where fewer than two batches of 1024 histories were simulated
// the standard errors of tiles that were hit are NaN: unknown.
struct TileResult {
  double power = 0.0;           // incident power in W or lm
  double irradiance = 0.0;      // power / area in W/m² or lx
  double standard_error = 0.0;  // of the irradiance, in W/m² or lx
  std::uint64_t hits = 0;  // impacts that scored here; walks that started here where tiles are walked from backward
  // The part of the irradiance that came straight from the emitters, in W/m² or lx; the rest was reflected. NaN where
  // photons counted both together (Direct::sampled).
  double direct = std::numeric_limits<double>::quiet_NaN();
};

// One tile map: a surface, or the back of a two-sided one.
struct SurfaceResult {
  std::string name;
  std::string material;
  double reflectance = 0.0;  // with a map: its mean over the surface
  double area_m2 = 0.0;
  std::uint64_t tiles = 0;
  double mean_irradiance = 0.0;  // power / area in W/m² or lx
  double min_irradiance = 0.0;   // of the tiles
  double max_irradiance = 0.0;
  double standard_error = 0.0;  // of the mean
  double power = 0.0;           // incident power in W or lm
  double behind_share =
      0.0;  // share of the power that came from behind, 0 … 1 (always 0 or 1 where each side has a map)
  std::uint64_t hits = 0;
  double mean_direct = std::numeric_limits<double>::quiet_NaN();  // as TileResult::direct
};

// One receiver.
struct ReceiverResult {
  double irradiance = 0.0;      // direct + indirect, W/m² or lx
  double direct = 0.0;          // straight from the emitters
  double indirect = 0.0;        // reflected at least once
  double standard_error = 0.0;  // of the irradiance; NaN where a single history was simulated
  double gain = 0.0;            // H = irradiance · area / emitted power
};

// How far a run had come at some time.
struct ConvergencePoint {
  std::uint64_t histories = 0;
  double seconds = 0.0;             // as WalkReport::seconds
  double rms_relative_error = 0.0;  // as WalkReport::rms_relative_error
};

// How the results of one walk were computed.
struct WalkReport {
  Estimator estimator = Estimator::collision;  // as used
  std::string choice;                          // why, where Estimator::automatic has chosen it; else empty
  StopReason stopped_by = StopReason::photons;
  std::uint64_t histories = 0;  // of all receivers together, where they were measured
  std::uint64_t impacts = 0;    // flights that ended on a surface
  std::uint64_t rays = 0;       // flights traced, with those traced again and shadow rays
  std::uint64_t shadow_rays =
      0;                        // rays that only asked whether an emitter is visible; none where nothing casts a shadow
  std::uint64_t retraced = 0;   // flights that met no surface and were traced again by the slower rule
  double seconds = 0.0;         // wall-clock time, with that of direct light
  double direct_seconds = 0.0;  // of that, computing direct light
  // Rms of the relative standard errors: of the tiles that got light, weighted by area; or of the receivers that got
  // light.
  double rms_relative_error = 0.0;
  double figure_of_merit = 0.0;  // 1 / (rms_relative_error² · seconds), 1/s
  // Histories that Settings::target_error is forecast to take, from the errors on the way; NaN where none was asked for
  // or no error is known.
  double histories_to_target = std::numeric_limits<double>::quiet_NaN();
  std::vector<ConvergencePoint> convergence;  // errors on the way, the end as the last
};

// Where the emitted power went, in W or lm: emitted = absorbed + escaped + residual + lost. Only photons from the
// emitters tell: where none were followed all but `emitted` are NaN.
struct Balance {
  double emitted = 0.0;
  double absorbed = 0.0;
  double escaped = 0.0;   // through openings
  double residual = 0.0;  // cut off by max_bounces; for weight with roulette: removed less added by it, 0 on average
  double lost = 0.0;      // numerical faults: photons that left a closed room
};

struct Result {
  std::string room;  // Room::source
  Quantity quantity = Quantity::photometric;
  Settings settings;                 // as asked for
  Engine engine = Engine::embree;    // as used
  WalkReport walk;                   // of the walk that measured the tiles
  WalkReport receiver_walk;          // of the walk that measured the receivers
  std::vector<std::string> choices;  // of both, what Estimator::automatic has chosen and why, a sentence each
  unsigned threads = 1;              // as used, of each process
  unsigned processes = 1;            // that have shared the run, see Control::team
  double checkpoint_seconds = 0.0;   // that all walks of this session have waited for Control::checkpoint
  std::uint64_t lost_histories = 0;  // histories behind Balance::lost

  Balance balance;
  double incident = 0.0;                 // incident power of all tiles in W or lm
  double incident_standard_error = 0.0;  // NaN where too little was simulated to tell
  std::uint64_t tiles_without_hits = 0;  // that no photon hit, or no walk found light from

  std::vector<TileResult> tiles;        // as Tiling::tiles; none where only the backward walk was run
  std::vector<SurfaceResult> surfaces;  // as Tiling::maps
  Tiling tiling;
  std::vector<Receiver> receivers;               // the room's
  std::vector<ReceiverResult> receiver_results;  // of each; none where only the forward walk was run
  std::vector<Ignored> ignored;                  // Room::ignored, and what of the room this run did not use
  std::vector<std::string> overrides;            // Room::overrides
  State state;                                   // to go on from, or to merge with others
  std::vector<std::string>
      warnings;  // what may make the figures mean something else than is thought, a sentence or two each
};

// Whether the tiles' direct light was found apart from the rest: TileResult::direct is a number.
bool direct_is_apart(const Result& result);

}  // namespace lichtmc
