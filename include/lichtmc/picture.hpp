// Pictures of results in false colour: the room from outside, and plans of its surfaces.
//
// The ceiling and the nearer walls do not hide the room: sides of surfaces that receive no light are not drawn, and
// light reaches only the inner sides of ceiling and walls.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "lichtmc/prepared_room.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Lightness increases uniformly in both, also for colour-deficient vision (S. van der Walt, N. Smith, mpl colormaps,
// 2015).
enum class ColourMap {
  viridis,  // dark violet → green → yellow
  inferno,  // black → red → pale yellow
};

enum class ScaleType { automatic, linear, logarithmic };

// Range of the value at the top of a scale. Outside of it, the legend would lose digits.
inline constexpr double least_scale_top = 1e-300;
inline constexpr double greatest_scale_top = 1e300;

struct ScaleOptions {
  ColourMap colours = ColourMap::viridis;
  ScaleType type = ScaleType::automatic;  // automatic: logarithmic if the irradiance of the brightest tiles exceeds 10
                                          // times the median
  std::optional<double> high;             // W/m² or lx of the top colour, 1e-300 to 1e300; default: from the tiles
};

// The colour of each irradiance.
struct ColourScale {
  ColourMap colours = ColourMap::viridis;
  bool logarithmic = false;
  double low = 0.0;   // W/m² or lx; the bottom colour, also of lower values; > 0 if logarithmic
  double high = 1.0;  // W/m² or lx; the top colour, also of higher values; > low

  // Position on the scale, 0 … 1.
  double share(double irradiance) const;
};

// The scale for all pictures of a result. Its top is a round number, not exceeded on 98 % of the lit area. Throws
// InputError if options.high is out of range.
ColourScale choose_scale(const Result& result, const ScaleOptions& options = {});

// sRGB, 0 … 255.
using Colour = std::array<std::uint8_t, 3>;
Colour colour_at(ColourMap colours, double share);
inline Colour colour_of(const ColourScale& scale, double irradiance) {
  return colour_at(scale.colours, scale.share(irradiance));
}

// "viridis" or "inferno".
std::string_view to_string(ColourMap colours);

// The sides of a triangle that receive light.
struct SideLight {
  bool front = true;
  bool back = true;
};
using LitSides = std::vector<std::vector<SideLight>>;  // [surface][triangle]

// The view of a room.
enum class View {
  corner,  // oblique from above, from the direction that shows the largest lit area; see Picture for what can differ
  above,   // plan view: +x to the right, +z downwards, to scale
};

struct Picture {
  std::size_t width = 0;  // pixels
  std::size_t height = 0;
  // Row by row from the top left: red, green and blue (linear, Rec. 709), premultiplied by alpha; and alpha, the
  // covered share of the pixel.
  std::vector<glm::vec4> colour;
  std::vector<float> irradiance;  // W/m² or lx, mean over the surfaces in the pixel; NaN without a surface
  glm::dmat4 to_pixel{1.0};  // point (m, 1) → (x, y, ·, w): pixel x/w from the left, y/w from the top; w > 0 in front
  // Rooms of which a view from outside shows too little are cut open at a height, or drawn from inside (View::corner).
  std::optional<double> cut_y_m;  // what lies above is not drawn
  bool from_inside = false;
};

// The oblique view of a whole room, for other drawings: Picture::to_pixel of such a picture.
glm::dmat4 view_onto(const Room& room, std::size_t width, std::size_t height);

// Draws a room with the irradiance of a result, by ray tracing with Embree; in grey if its tiles were not measured.
// Room and result must outlive the painter. threads 0: one per processor. prepared: see prepare(). Throws InputError if
// the result has no tiling, RuntimeError if memory or the tracing device fails.
class RoomPainter {
 public:
  RoomPainter(const Room& room, const Result& result, unsigned threads = 0,
              std::shared_ptr<PreparedRoom> prepared = nullptr);
  ~RoomPainter();
  RoomPainter(const RoomPainter&) = delete;
  RoomPainter& operator=(const RoomPainter&) = delete;

  // Determined with photons that are never absorbed; deterministic for a room.
  const LitSides& lit_sides() const;

  // Anti-aliased: nine rays per pixel at edges and at borders of tiles. Dark lines are edges of the room. width,
  // height: 16 … 16 384 pixels; throws InputError otherwise.
  Picture draw(View view, const ColourScale& scale, std::size_t width, std::size_t height) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// A line of equal irradiance on a plan, in pixels; closed if its first and last points are equal.
struct Isoline {
  double level = 0.0;  // W/m² or lx
  std::vector<glm::dvec2> points;
};

// A plan of a large coplanar part of a surface, to scale: walls from their lit side, floors and ceilings from above (+x
// to the right, +z downwards). For a curved surface: its tile map, by column and row, if that has few, large parts.
struct SurfacePlan {
  std::size_t map = 0;     // index into Tiling::maps
  bool flat = true;        // false: a tile map; then the three vectors are 0
  Picture picture;         // every pixel has the opaque colour of one tile, or is transparent
  glm::dvec3 corner{0.0};  // m, top left corner of the picture
  glm::dvec3 across{0.0};  // m, step of one pixel to the right
  glm::dvec3 down{0.0};    // m, step of one pixel down
  double area_m2 = 0.0;
  double mean_irradiance = 0.0;  // of its tiles, area-weighted
  double min_irradiance = 0.0;
  double max_irradiance = 0.0;
  std::vector<Isoline> isolines;
  double smoothing_m = 0.0;     // standard deviation of the Gaussian that smooths the irradiance for the isolines
  std::string why_no_isolines;  // a sentence, if there are none
};

struct SurfacePlans {
  std::vector<SurfacePlan> plans;
  std::vector<std::string> left_out;  // sentences: which large surfaces have no plan, and why
};

// Plans of the parts with at least 2 % of the room's surface area each, the largest first, at most `max_plans`. No
// plan: parts with the bottom colour of the scale nearly everywhere; curved surfaces in many or small parts, and bodies
// of small flat parts, of which the tile map shows what nobody can find in the room. `longer_side`: in pixels, 16 …
// 4096; throws InputError otherwise.
SurfacePlans draw_plans(const Room& room, const Result& result, const LitSides& lit, const ColourScale& scale,
                        std::size_t max_plans = 12, std::size_t longer_side = 640);

}  // namespace lichtmc
