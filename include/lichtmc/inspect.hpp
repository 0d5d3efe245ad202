// Checks a room before the simulation: what will be modelled, what is probably wrong, and what to do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/cover.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/prepared_room.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"

namespace lichtmc {

enum class Severity {
  note,     // information; no influence on the figures
  warning,  // the figures may not have the meaning that the user expects
  fault,    // the room cannot be simulated
};

// One finding. `topic` is a stable word for programs: "size", "up-axis", "emitters", "receivers", "areas",
// "not-modelled", "open-edges", "openings", "behind", "one-plane", "zero-area", "reflectance", "texture-coordinates",
// "tiles", "shape", "trapped-light", "emitter-light", "luminaires", "luminaire-housing", "luminaire-size",
// "maintenance", "room".
struct Finding {
  Severity severity = Severity::note;
  std::string topic;
  std::string text;    // what was found, and where
  std::string advice;  // what to do
};

struct SurfaceFacts {
  std::string name;
  std::string material;
  double reflectance = 0.0;          // with a reflectance map: its mean
  double highest_reflectance = 0.0;  // of any point of the surface
  ReflectanceSource reflectance_source = ReflectanceSource::given;
  double area_m2 = 0.0;  // one side
  std::size_t triangles = 0;
  std::size_t triangles_without_area = 0;  // left out
  Sides sides = Sides::one;
  ChartSource chart = ChartSource::file;
  std::string chart_reason;      // why the engine made the chart
  std::uint64_t tiles = 0;       // of both sides
  double cells_over_area = 1.0;  // area of the chart's cells / area of the surface: 1 if no cell is empty
  std::uint64_t impacts = 0;     // of the test photons, on either side
  double seen_from_behind = std::numeric_limits<double>::quiet_NaN();  // share of the impacts on the back face, 0 … 1;
                                                                       // NaN without impacts
};

// The source in words, for tables and JSON: "given" (by an option or a program), "property", "base colour", "texture",
// "vertex colours", "default (white)".
std::string_view reflectance_source_word(ReflectanceSource source);

// Light leaves the room through this side of the room's bounding box.
struct Opening {
  std::string side;       // "-x", "+x", "-y" (below), "+y" (above), "-z" or "+z"
  double share = 0.0;     // of all flights that leave the room
  glm::dvec3 place{0.0};  // m, point where the first of them crosses the bounding box
  std::string from;       // the surface where that flight began; empty: an emitter
};

// Where the light of an emitter is absorbed: shares of its power, 0 … 1, from some photons that are followed with the
// reflectances of the room.
struct EmitterFacts {
  std::string name;
  double near_m = 0.0;           // m
  double absorbed_near = 0.0;    // no farther than near_m from where it started
  double about_m = 0.0;          // m
  double absorbed_about = 0.0;   // no farther than about_m
  double wide_m = 0.0;           // m
  double absorbed_wide = 0.0;    // no farther than wide_m
  double absorbed_itself = 0.0;  // by the emitting surface itself, if that is smaller than half of the room
  double level_m = 0.0;          // m
  double absorbed_level = 0.0;   // no more than level_m above or below
  double first_behind = 0.0;     // first meets the back of a face
  std::string first_surface;     // the surface that most of it meets first; empty: none
};

// The luminaires of one photometric file. Shares are of some photons that are followed to where they land first.
struct LuminaireFacts {
  std::string file;  // its name, without folder
  std::string version;
  std::size_t count = 0;  // luminaires
  double power = 0.0;     // of all, in lm or W
  double watts = 0.0;     // input of one, as the file states; 0: it does not
  LuminousOpening opening;
  std::string housed;            // the luminaire of which most light ends within housing_m of its centre; empty: none
  double housing_m = 0.0;        // half the diagonal of the opening and 0.02 m
  double in_housing = 0.0;       // share of its light that ends there, on surfaces of small triangles
  std::size_t as_points = 0;     // luminaires whose light starts at one point although the file states an opening
  double limit_m = 0.0;          // five times the largest dimension of the opening
  double near = 0.0;             // share of the light of these luminaires that lands nearer than that
  double elsewhere = 0.0;        // part of that share that would land elsewhere if it started all over the opening
  std::string nearest_receiver;  // that gets direct light of one of these luminaires nearer than limit_m; empty: none
  double nearest_m = 0.0;        // its distance
  double excess_there = 0.0;     // direct light of the point over that of the opening, without shadows, minus 1
};

struct Inspection {
  glm::dvec3 low{0.0};  // m, bounding box of all surfaces
  glm::dvec3 high{0.0};
  std::size_t triangles = 0;                 // with an area
  std::size_t triangles_without_area = 0;    // left out
  std::size_t duplicate_triangles = 0;       // with the same corners as another triangle
  std::size_t open_edges = 0;                // edges of only one triangle
  std::vector<glm::dvec3> open_edge_places;  // m, midpoints of the first few
  bool cuboid = false;
  bool convex = false;
  bool closed = false;  // every emitter is inside a watertight mesh: no light can leave the room

  // Flights of photons that are never absorbed, from the emitters of the room; if the room cannot be simulated, from an
  // isotropic emitter at `inside`.
  glm::dvec3 inside{0.0};      // m, a point inside the room, enclosed by surfaces
  bool inside_is_sure = true;  // false: the geometry does not tell what is inside; then there are no flights without
                               // emitters of the room's own
  std::uint64_t flights = 0;
  std::uint64_t flights_that_left = 0;
  std::vector<Opening> openings;           // in descending order of `share`
  std::vector<EmitterFacts> emitters;      // those with at least 64 of the 32 768 photons; empty without own emitters
  std::vector<LuminaireFacts> luminaires;  // one for each photometric file; empty without own emitters

  std::uint64_t tiles = 0;       // 0 if they need more memory than there is: a fault
  double memory_bytes = 0.0;     // estimate for a run with two threads and its report, see memory_needed()
  double suggested_scale = 1.0;  // factor on ReadOptions::scale; 1 if the size is plausible
  bool probably_z_up = false;    // the vertical axis of the file is probably Z

  std::vector<Cover> covers;            // surfaces that cover others in their plane, in the order of these
  std::vector<Cover> opposites;         // pairs of one-sided surfaces that look in opposite directions in one place
  std::uint64_t undecided_flights = 0;  // of `flights`: ended where no rule decides, see Cover

  std::vector<SurfaceFacts> surfaces;
  std::vector<Finding> findings;  // faults first, then warnings, then notes

  std::size_t count(Severity severity) const;
};

// Checks a room with tiles of this edge. Traces some 10⁵ rays; takes seconds for rooms of 10⁶ triangles.
// Throws InputError if its surfaces or reflectance maps are invalid (check_room()) or no triangle has an area. Other
// reasons why the room cannot be simulated are findings. prepared: see prepare(); it keeps the tiles for simulate().
Inspection inspect(const Room& room, double tile_edge_m = 0.1, std::shared_ptr<PreparedRoom> prepared = nullptr);
// The same with the result of make_tiling(room, tile_edge_m): avoids a second copy of the tiles in memory.
Inspection inspect(const Room& room, const Tiling& tiling, double tile_edge_m,
                   std::shared_ptr<PreparedRoom> prepared = nullptr);

// The faults and warnings of an inspection in at most `most` (≥ 2) sentences, the gravest first: of each topic the
// first, with the number of others like it; if there are more topics, the last sentence says how to see the rest.
// Without those about tiles: an inspection with one tile per surface is enough. `lichtmc run` prints them before it
// starts; simulate() does not inspect its room.
std::vector<std::string> warning_lines(const Room& room, const Inspection& inspection, std::size_t most = 5);

// All results of an inspection, with the emitters and receivers of the room, as JSON.
std::string inspection_json(const Room& room, const Inspection& inspection);

}  // namespace lichtmc
