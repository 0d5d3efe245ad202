// How to simulate: estimator, when to stop, how fine the tiles, which engine and how many threads.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "lichtmc/walk_direction.hpp"

namespace lichtmc {

// What a photon scores on its way (Wasow 1950; Forsythe and Leibler 1950). All three estimate the same irradiance.
enum class Estimator {
  weight,      // never absorbed; impact k scores the weight Π ρ of the surfaces before it
  collision,   // survives a surface with probability ρ; every impact scores 1
  absorption,  // as collision, but only the last impact scores, with 1/(1 − ρ)
  automatic,   // the one that a short pilot of each finds to buy most accuracy per flight in this room
};

// How flights are traced.
enum class Engine {
  automatic,    // the closed form where the room is an empty cuboid, else Embree
  cuboid,       // closed form of the cuboid
  embree,       // any room
  embree_fast,  // as embree, somewhat faster; a photon may slip between triangles that share an edge
};

// What is measured.
enum class Measured {
  all,        // tiles; and receivers, where there are any
  tiles,      // tiles only
  receivers,  // receivers only
};

// How the light that comes to a tile straight from the emitters is found.
enum class Direct {
  sampled,   // by the photons, as all other light
  analytic,  // integrated over the tile, outside the statistics; the photons count what was reflected at least once
};

// "weight", "collision", "absorption", "auto"; "auto", "cuboid", "embree", "embree-fast"; "all", "tiles", "receivers";
// "sampled", "analytic".
std::string_view to_string(Estimator estimator);
std::string_view to_string(Engine engine);
std::string_view to_string(Measured measured);
std::string_view to_string(Direct direct);

// For Settings::photons: other stop rules alone end the run.
inline constexpr std::uint64_t no_photon_limit = std::uint64_t{1} << 62;

// The first stop rule to be met ends the run.
struct Settings {
  Estimator estimator = Estimator::collision;
  std::uint64_t photons = 1'000'000;  // histories, ≥ 1: so many for the tiles; and so many, shared, for the receivers
  std::uint64_t first_history = 0;    // simulate those from this one on: a multiple of State::batch
  bool part = false;  // these histories are a part of a run that merge() completes: receivers get their share alone
  std::optional<double> target_error;  // stop when the rms_relative_error of the walk is at most this, > 0
  std::optional<double> max_seconds;   // stop after this wall-clock time, > 0; half of it each for tiles and receivers
  Measured measured = Measured::all;
  WalkDirection tile_walk = WalkDirection::forward;  // of the walk that measures the tiles
  Direct direct = Direct::sampled;  // of forward tiles; that of backward tiles and receivers is always computed
  // weight only: end every history after this many flights, ≥ 1; none: Russian roulette. (A bounce is a flight: the
  // first one, from the emitter, counts.)
  std::optional<std::uint32_t> max_bounces;
  double tile_edge_m = 0.1;  // m, > 0
  std::uint64_t seed = 1;
  unsigned threads = 0;  // 0: one per processor
  Engine engine = Engine::automatic;
};

}  // namespace lichtmc
