// Looking a room over before it is simulated: what will be modelled, what looks wrong, and what to do about it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/gltf.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"

namespace lichtmc {

enum class Severity {
  note,     // as it should be, or without consequence
  warning,  // figures may mean something else than is thought
  fault,    // the room cannot be simulated as it is
};

// Something that was found. `topic` is a stable word for programs: "size", "up-axis", "emitters", "receivers",
// "not-modelled", "open-edges", "openings", "behind", "duplicates", "zero-area", "reflectance", "texture-coordinates",
// "tiles", "shape", "trapped-light", "room".
struct Finding {
  Severity severity = Severity::note;
  std::string topic;
  std::string text;    // what is there, and where
  std::string advice;  // what to do
};

struct SurfaceFacts {
  std::string name;
  std::string material;
  double reflectance = 0.0;          // its mean, where a texture says it
  double highest_reflectance = 0.0;  // anywhere on it
  double area_m2 = 0.0;              // one side
  std::size_t triangles = 0;
  std::size_t triangles_without_area = 0;  // left out
  Sides sides = Sides::one;
  ChartSource chart = ChartSource::file;
  std::string chart_reason;      // why the engine made the chart
  std::uint64_t tiles = 0;       // of both sides
  double cells_over_area = 1.0;  // area of the chart's cells over that of the surface: how much of the grid is waste
  double seen_from_behind = std::numeric_limits<double>::quiet_NaN();  // share of the light that came from behind, 0 …
                                                                       // 1; NaN where none fell on it
};

// Where light leaves the room: the side of the room's bounding box that it passes.
struct Opening {
  std::string side;       // "-x", "+x", "-y" (below), "+y" (above), "-z" or "+z"
  double share = 0.0;     // of all flights that leave the room
  glm::dvec3 place{0.0};  // m, where the first one passed
  std::string from;       // the surface it came from; empty: straight from an emitter
};

struct Inspection {
  glm::dvec3 low{0.0};  // m, bounds of all surfaces
  glm::dvec3 high{0.0};
  std::size_t triangles = 0;                 // with an area
  std::size_t triangles_without_area = 0;    // left out
  std::size_t duplicate_triangles = 0;       // with the corners of another
  std::size_t open_edges = 0;                // that one triangle alone has
  std::vector<glm::dvec3> open_edge_places;  // m, the middle of the first few
  bool cuboid = false;
  bool convex = false;
  bool closed = false;  // light from inside cannot leave: all of it starts in closed shells

  // Flights of light that is never absorbed, from the emitters; where there are none, from a place inside.
  glm::dvec3 inside{0.0};  // m, a place inside with a wide view
  std::uint64_t flights = 0;
  std::uint64_t flights_that_left = 0;
  std::vector<Opening> openings;  // the widest first

  std::uint64_t tiles = 0;
  double memory_bytes = 0.0;     // about what a run with one thread takes for the tiles
  double suggested_scale = 1.0;  // for ReadOptions::scale, beside what was given; 1 where the size is plausible
  bool looks_z_up = false;

  std::vector<SurfaceFacts> surfaces;
  std::vector<Finding> findings;  // faults first, then warnings, then notes

  std::size_t count(Severity severity) const;
};

// Looks over a room as run() would take it, with tiles of this edge. Shoots some hundred thousand rays; takes seconds
// for rooms of 10⁵ triangles. Throws InputError where the room has no triangle with an area or its numbers do not fit
// (check_room()); what else would stop a simulation is a finding.
Inspection inspect(const Room& room, double tile_edge_m = 0.1);
// The same where make_tiling(room, tile_edge_m) is at hand: tiles may be more than memory holds twice.
Inspection inspect(const Room& room, const Tiling& tiling, double tile_edge_m);

// Everything that an inspection found, with the room's emitters and receivers, as JSON.
std::string inspection_json(const Room& room, const Inspection& inspection);

}  // namespace lichtmc
