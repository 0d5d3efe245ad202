// Settings of a simulation: estimator, stop rules, size of the tiles, engine, number of threads.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "lichtmc/channel.hpp"
#include "lichtmc/walk_direction.hpp"

namespace lichtmc {

// The scores of a photon (Wasow 1950; Forsythe and Leibler 1950). All three estimators have the same mean.
enum class Estimator {
  weight,      // never absorbed; impact k scores the weight Π ρ of the surfaces before it
  collision,   // survives a surface with probability ρ; every impact scores 1
  absorption,  // as collision, but only the last impact scores, with 1/(1 − ρ)
  automatic,   // the one with the smallest error per flight in this room, by a short pilot of each
};

// The tracing of flights.
enum class Engine {
  automatic,    // the closed form if the room is an empty cuboid, else Embree
  cuboid,       // closed form of the cuboid
  embree,       // any room
  embree_fast,  // as embree, somewhat faster; a photon may pass between triangles that share an edge
};

// What is measured.
enum class Measured {
  all,        // tiles; and receivers, if there are any
  tiles,      // tiles only
  receivers,  // receivers only
};

// The walk that measures receivers. All have the same mean.
enum class ReceiverWalk {
  automatic,   // the one with the smallest error per work for the receivers of this room, by a short pilot of each
  two_way,     // both of the following, combined by multiple importance sampling; the pilot chooses their shares
  next_event,  // photons from the emitters, whose every impact contributes to every receiver
  backward,    // walks from every receiver, which collect direct light at every surface
};

// The computation of direct light on tiles.
enum class Direct {
  sampled,   // scored by photons, as reflected light
  analytic,  // integrated over the tile; photons score reflected light only
};

// "weight", "collision", "absorption", "auto"; "auto", "cuboid", "embree", "embree-fast"; "all", "tiles", "receivers";
// "auto", "two-way", "next-event", "backward"; "sampled", "analytic".
std::string_view to_string(Estimator estimator);
std::string_view to_string(Engine engine);
std::string_view to_string(Measured measured);
std::string_view to_string(ReceiverWalk walk);
std::string_view to_string(Direct direct);

// For Settings::photons: other stop rules alone end the run.
inline constexpr std::uint64_t no_photon_limit = std::uint64_t{1} << 62;

// The first stop rule to be met ends the run.
struct Settings {
  Estimator estimator = Estimator::collision;
  // Histories, ≥ 1: for the tiles, and the same number for all receivers together. A photon that contributes to several
  // receivers counts for each of them.
  std::uint64_t photons = 1'000'000;
  std::uint64_t first_history = 0;  // number of the first history: a multiple of State::batch
  bool part = false;  // a part of a run that merge() completes: receivers get only their share of these histories
  // The error floor: an irradiance. Relative errors refer to it where the irradiance of a tile or receiver is lower, so
  // that dark places do not determine how long a run takes. It is a share of the mean irradiance (of the tiles that
  // light can reach, weighted by area; or of the receivers), ≥ 0, or, if given, `error_floor`.
  double error_floor_share = 0.01;
  std::optional<double> error_floor;   // W/m² or lx, ≥ 0
  std::optional<double> target_error;  // stop when WalkReport::rms_relative_error is at most this, > 0
  std::optional<double> max_seconds;   // s, wall-clock time limit, > 0; half of it each for tiles and receivers
  Measured measured = Measured::all;
  WalkDirection tile_walk = WalkDirection::forward;  // of the walk for the tiles
  ReceiverWalk receiver_walk = ReceiverWalk::automatic;
  Direct direct = Direct::sampled;  // for tiles and a forward walk; otherwise direct light is always integrated
  // Relative error of integrated direct light, > 0. Default: a part of the target error, see docs/physics.md.
  std::optional<double> direct_error;
  // weight only: end every history after this many flights, ≥ 1; none: Russian roulette. (A bounce is a flight: the
  // first one, from the emitter, counts.)
  std::optional<std::uint32_t> max_bounces;
  double tile_edge_m = 0.1;  // m, > 0
  std::uint64_t seed = 1;
  ChannelSettings channel;  // impulse responses at the receivers
  // Keeps the part of each emitter (of those of the same name together) in the irradiance of receivers and areas, see
  // lichtmc/emitter_parts.hpp. Not with impulse responses, which keep emitters apart by ChannelSettings::per_emitter.
  bool per_emitter = false;
  unsigned threads = 0;  // 0: one per processor
  Engine engine = Engine::automatic;
};

}  // namespace lichtmc
