// Paths of single photons, to look at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc {

// In PathPoint::surface: the point lies on none.
inline constexpr std::size_t no_surface = std::numeric_limits<std::size_t>::max();

// Where a flight began or ended.
struct PathPoint {
  glm::dvec3 place{0.0};             // m, to about a millionth of the room
  std::size_t surface = no_surface;  // index into Room::surfaces; none at a point emitter and where light left the room
  double weight = 1.0;               // that the photon came with; below 1 with the weight estimator only
};

// What became of a photon.
enum class PathEnd {
  absorbed,  // by the surface of its last point; with the weight estimator: removed by the roulette
  escaped,   // through an opening: its last point lies outside, where it left the box about the room
  cut_off,   // by Settings::max_bounces, or after 10 000 flights
  lost,      // to rounding, in a closed room: its last point is where it was last seen
};

// "absorbed", "escaped", "cut off" or "lost".
std::string_view to_string(PathEnd end);

struct PhotonPath {
  std::uint64_t history = 0;      // its number, from 0
  std::vector<PathPoint> points;  // the start, then the end of each flight
  PathEnd end = PathEnd::absorbed;
};

// The paths of the first `count` (1 … 10⁶) photons of a run with these settings: the same random numbers, surfaces and
// ends. Settings::estimator automatic is taken for collision; what says when a run stops or how it measures tiles does
// not matter. Throws InputError as simulate() does, and for another count.
std::vector<PhotonPath> trace_paths(const Room& room, const Settings& settings, std::uint64_t count);

}  // namespace lichtmc
