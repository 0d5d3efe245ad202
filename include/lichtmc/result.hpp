// The result of a simulation: irradiance of every tile with its standard error, balance of the power, report of the
// walks.
//
// Power means radiant flux (W) or luminous flux (lm), as Result::quantity states; irradiance then means irradiance
// (W/m²) or illuminance (lx).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lichtmc/area.hpp"
#include "lichtmc/channel.hpp"
#include "lichtmc/cover.hpp"
#include "lichtmc/emitter_parts.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/state.hpp"
#include "lichtmc/tiles.hpp"

namespace lichtmc {

// Why a run ended.
enum class StopReason { photons, target_error, max_time, interrupt };

// "photons", "target-error", "max-time" or "interrupt".
std::string_view to_string(StopReason reason);

// One tile. A tile without hits has irradiance 0 and the standard error of 1.148 hits: the true value is between 0 and
// that with the probability of one standard error, 68 %. With fewer than two batches of 1024 histories the standard
// errors of tiles with hits are NaN (unknown).
struct TileResult {
  double power = 0.0;           // incident power in W or lm
  double irradiance = 0.0;      // power / area in W/m² or lx
  double standard_error = 0.0;  // of the irradiance, in W/m² or lx
  std::uint64_t hits = 0;       // impacts that scored here; in a backward walk: walks that started here
  // Direct part of the irradiance (by the emitters, without reflection), in W/m² or lx. NaN if photons scored direct
  // and reflected light together (Direct::sampled).
  double direct = std::numeric_limits<double>::quiet_NaN();
};

// One tile map: a surface, or the back of a two-sided one.
struct SurfaceResult {
  std::string name;
  std::string material;
  double reflectance = 0.0;  // with a reflectance map: its mean over the surface
  double area_m2 = 0.0;
  std::uint64_t tiles = 0;
  double mean_irradiance = 0.0;  // power / (area − unreached area) in W/m² or lx
  double min_irradiance = 0.0;   // of the tiles that light can reach
  double max_irradiance = 0.0;
  double standard_error = 0.0;  // of the mean
  double power = 0.0;           // incident power in W or lm
  double behind_share = 0.0;    // fraction of the power on the back, 0 … 1 (0 or 1 if each side has a tile map)
  std::uint64_t hits = 0;
  double mean_direct = std::numeric_limits<double>::quiet_NaN();  // as TileResult::direct
  // Absorbed power in W or lm: the incident power times (1 − reflectance). In a forward walk through a room with
  // reflectance maps it is counted photon by photon, and adds up to Balance::absorbed. NaN (unknown) for a surface with
  // a reflectance map in backward walks.
  double absorbed = std::numeric_limits<double>::quiet_NaN();
  // m², part of the area that no light can reach, by the shape of the room: outer faces of thick walls, undersides of
  // slabs. The means and the lowest irradiance are of the rest.
  double unreached_area_m2 = 0.0;
  double covered_m2 = 0.0;  // the part of the area that other surfaces in its plane cover, see Cover
};

// One receiver.
struct ReceiverResult {
  double irradiance = 0.0;      // direct + indirect, W/m² or lx
  double direct = 0.0;          // by the emitters, without reflection
  double indirect = 0.0;        // reflected at least once
  double standard_error = 0.0;  // of the irradiance; NaN with a single history
  double gain = 0.0;            // H = irradiance · area · optical_gain() / emitted power
};

// An error check of a run.
struct ConvergencePoint {
  std::uint64_t histories = 0;
  double seconds = 0.0;             // as WalkReport::seconds
  double rms_relative_error = 0.0;  // as WalkReport::rms_relative_error
};

// How the results of one walk were computed.
struct WalkReport {
  Estimator estimator = Estimator::collision;  // as used
  std::string choice;                          // reason, if it was chosen automatically; else empty
  // For receivers: the walk as used; the number of rounds, from whose differences the standard errors follow; the
  // histories of a round.
  ReceiverWalk receiver_walk = ReceiverWalk::backward;
  std::uint64_t rounds = 0;
  std::uint64_t photons_per_round = 0;  // from the emitters, for all receivers together
  std::uint64_t walks_per_round = 0;    // from each receiver
  StopReason stopped_by = StopReason::photons;
  std::uint64_t histories = 0;    // for receivers: of all together; a photon counts for each receiver that it serves
  std::uint64_t impacts = 0;      // flights that ended on a surface
  std::uint64_t rays = 0;         // flights traced, including those traced again and shadow rays
  std::uint64_t connections = 0;  // of impacts of photons with receivers
  std::uint64_t shadow_rays = 0;  // rays that test whether an emitter is visible; none if nothing casts a shadow
  std::uint64_t retraced = 0;     // flights that hit no surface and were traced again by the slower rule
  std::uint64_t undecided = 0;    // flights that ended where no rule decides between surfaces in one plane, see Cover
  double seconds = 0.0;           // wall-clock time, s, including that of direct light
  double direct_seconds = 0.0;    // part of it for direct light, s
  // Rms of the relative standard errors: of the tiles that light can reach, weighted by area, or of the receivers. Each
  // error is relative to the irradiance or to the error floor, whichever is greater. Tiles of one surface side without
  // hits count as one tile. See Settings::error_floor_share. With calculation areas: the largest relative standard
  // error of their means and minima, or that of the other receivers, if it is larger.
  double rms_relative_error = 0.0;
  // The same without a floor: of the tiles or receivers with an irradiance above 0, relative to it.
  double rms_relative_error_without_floor = 0.0;
  double error_floor = 0.0;      // as used, W/m² or lx
  double figure_of_merit = 0.0;  // 1 / (rms_relative_error² · seconds), 1/s
  // Forecast of the histories that Settings::target_error requires, from the error checks; NaN without a target, or if
  // no error is known.
  double histories_to_target = std::numeric_limits<double>::quiet_NaN();
  std::vector<ConvergencePoint> convergence;  // all error checks; the last is the end
};

// Balance of the emitted power, in W or lm: emitted = absorbed + escaped + residual + lost. Only a forward walk
// determines it; without one all except `emitted` are NaN.
struct Balance {
  double emitted = 0.0;
  double absorbed = 0.0;
  double escaped = 0.0;   // through openings
  double residual = 0.0;  // cut off by max_bounces; for weight with Russian roulette: removed minus added, 0 on average
  double lost = 0.0;      // numerical errors: photons that left a closed room
};

struct Result {
  std::string room;  // Room::source
  Quantity quantity = Quantity::photometric;
  Settings settings;                 // as requested
  Engine engine = Engine::embree;    // as used
  WalkReport walk;                   // of the walk that measured the tiles
  WalkReport receiver_walk;          // of the walk that measured the receivers
  std::vector<std::string> choices;  // the choices of Estimator::automatic for both, with the reason; a sentence each
  unsigned threads = 1;              // as used, per rank
  unsigned processes = 1;            // ranks that shared the run, see Control::communicator
  double checkpoint_seconds = 0.0;   // s, time of Control::checkpoint in this session
  std::uint64_t lost_histories = 0;  // number of histories of Balance::lost

  Balance balance;
  double incident = 0.0;                 // incident power of all tiles in W or lm
  double incident_standard_error = 0.0;  // NaN if unknown (too few histories)
  std::uint64_t tiles_without_hits = 0;  // tiles of irradiance 0 that light can reach
  std::vector<bool> unreached;           // of each tile: no light can reach its point; empty if light reaches all
  std::uint64_t unreached_tiles = 0;     // tiles whose point no light can reach, see SurfaceResult::unreached_area_m2

  std::vector<Cover> covers;            // surfaces that cover others in their plane, in the order of these
  std::vector<TileResult> tiles;        // as Tiling::tiles; empty if only receivers were measured
  std::vector<SurfaceResult> surfaces;  // as Tiling::maps
  Tiling tiling;
  std::vector<Receiver> receivers;               // the room's
  std::vector<ReceiverResult> receiver_results;  // of each; empty if only tiles were measured
  std::vector<AreaResult> areas;                 // as Room::areas; empty if only tiles were measured
  std::optional<EmitterParts> parts;             // if Settings::per_emitter asks for them
  std::optional<ImpulseResponses> channels;      // if Settings::channel asks for them
  std::vector<Ignored> ignored;                  // Room::ignored, and parts of the room that this run did not use
  std::vector<std::string> overrides;            // Room::overrides
  State state;                                   // to continue from, or to merge with others
  std::vector<std::string> warnings;  // conditions that affect the meaning of the figures; one or two sentences each
};

// Whether the direct light of tiles was computed separately: TileResult::direct is a number.
bool direct_is_apart(const Result& result);

// What the error of the tiles, or of the receivers, means, in a sentence: "In about two of three places …".
std::string error_text(const Result& result, Measured what);

// If the clock or the user ended the walk for the tiles, or for the receivers: the options that repeat its figures to
// the last digit, in place of the stop rules and the estimator: "--histories 0:4194304 --estimator collision"; else
// empty.
std::string options_to_repeat(const Result& result, Measured what);

// What the means leave out: "12.4 m² of 5 surfaces cannot be reached by light …"; empty if light can reach all.
std::string unreached_text(const Result& result);

}  // namespace lichtmc
