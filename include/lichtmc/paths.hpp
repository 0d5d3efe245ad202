// Paths of single photons, for display.
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

// Value of PathPoint::surface: the point is on no surface.
inline constexpr std::size_t no_surface = std::numeric_limits<std::size_t>::max();

// Start or end of a flight.
struct PathPoint {
  glm::dvec3 place{0.0};             // m, accurate to about 10⁻⁶ of the room's size
  std::size_t surface = no_surface;  // index into Room::surfaces; no_surface at a point emitter and after an escape
  double weight = 1.0;               // of the photon on arrival; below 1 with the weight estimator only
};

// How a history ended.
enum class PathEnd {
  absorbed,  // by the surface of its last point; with the weight estimator: by Russian roulette
  escaped,   // through an opening: its last point is where it left the bounding box of the room
  cut_off,   // by Settings::max_bounces, or after 10 000 flights
  lost,      // by rounding, in a closed room: its last point is the start of the lost flight
};

// "absorbed", "escaped", "cut off" or "lost".
std::string_view to_string(PathEnd end);

struct PhotonPath {
  std::uint64_t history = 0;      // its number, from 0
  std::vector<PathPoint> points;  // the start, then the end of each flight
  PathEnd end = PathEnd::absorbed;
};

// The paths of the first `count` (1 … 10⁶) photons of a run with these settings: the same random numbers, surfaces and
// ends. Settings::estimator automatic means collision here; stop rules and the measurement of tiles have no influence.
// Throws InputError as simulate() does, and for a count out of range.
std::vector<PhotonPath> trace_paths(const Room& room, const Settings& settings, std::uint64_t count);

}  // namespace lichtmc
