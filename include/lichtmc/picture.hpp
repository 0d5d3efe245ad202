// Pictures of results: irradiance as false colour, on the room as seen from outside and on its surfaces laid flat.
//
// A ceiling and the walls between the eye and the room would hide it. They need no list: light gets to their inner
// sides only, and a side that no light gets to is drawn as if it were not there.
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

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Both rise evenly in lightness, for any colour vision (S. van der Walt, N. Smith, mpl colormaps, 2015).
enum class ColourMap {
  viridis,  // dark violet → green → yellow
  inferno,  // black → red → pale yellow
};

enum class ScaleType { automatic, linear, logarithmic };

// What the top of a scale may stand for: beyond, its legend would not have all its digits.
inline constexpr double least_scale_top = 1e-300;
inline constexpr double greatest_scale_top = 1e300;

struct ScaleOptions {
  ColourMap colours = ColourMap::viridis;
  ScaleType type = ScaleType::automatic;  // logarithmic where the bright tiles would leave the others in the dark
  std::optional<double> high;  // W/m² or lx that the top colour stands for, 1e-300 to 1e300; default: from the tiles
};

// Which irradiance has which colour.
struct ColourScale {
  ColourMap colours = ColourMap::viridis;
  bool logarithmic = false;
  double low = 0.0;   // W/m² or lx; the bottom colour and all below; > 0 where logarithmic
  double high = 1.0;  // the top colour and all above; > low

  // Place on the scale, 0 … 1.
  double share(double irradiance) const;
};

// A scale for the tiles of a result, and the same for all its pictures: up to a round number that all but a fiftieth
// of the lit area stays below. Throws InputError where the asked top is out of its range.
ColourScale choose_scale(const Result& result, const ScaleOptions& options = {});

// sRGB, 0 … 255.
using Colour = std::array<std::uint8_t, 3>;
Colour colour_at(ColourMap colours, double share);
inline Colour colour_of(const ColourScale& scale, double irradiance) {
  return colour_at(scale.colours, scale.share(irradiance));
}

// "viridis" or "inferno".
std::string_view to_string(ColourMap colours);

// Which sides of a triangle light gets to.
struct SideLight {
  bool front = true;
  bool back = true;
};
using LitSides = std::vector<std::vector<SideLight>>;  // [surface][triangle]

// From where a room is drawn.
enum class View {
  corner,  // from above, at an angle, through the nearer walls: the side from which most of the lit surface is seen
  above,   // straight down: +x to the right, +z downwards, to scale
};

struct Picture {
  std::size_t width = 0;  // pixels
  std::size_t height = 0;
  // Row by row from the top left: light in red, green and blue (linear, Rec. 709) times the share of the pixel that is
  // covered, and that share.
  std::vector<glm::vec4> colour;
  std::vector<float> irradiance;  // W/m² or lx, mean over what the pixel shows; NaN where that is nothing
  glm::dmat4 to_pixel{1.0};  // a place in the room (m, 1) → (x, y, ·, w): pixel x/w from the left, y/w from the top
};

// From above at an angle onto the whole of a room, for drawings of one's own: Picture::to_pixel of such a picture.
glm::dmat4 view_onto(const Room& room, std::size_t width, std::size_t height);

// Draws a room with the irradiance that a run has found. Sets up the same ray tracing as the run; room and result must
// outlive the painter. threads 0: one per processor. Throws RuntimeError where memory or the tracing device fails.
class RoomPainter {
 public:
  RoomPainter(const Room& room, const Result& result, unsigned threads = 0);
  ~RoomPainter();
  RoomPainter(const RoomPainter&) = delete;
  RoomPainter& operator=(const RoomPainter&) = delete;

  // Found by photons that are never absorbed: the same for the same room.
  const LitSides& lit_sides() const;

  // Anti-aliased: nine rays a pixel wherever colours or edges meet. Dark lines are edges of the room. width, height: 16
  // … 16 384 pixels, or InputError.
  Picture draw(View view, const ColourScale& scale, std::size_t width, std::size_t height) const;

 private:
  struct Studio;
  std::unique_ptr<Studio> studio_;
};

// A line of equal irradiance on a plan, in pixels; closed where its ends meet.
struct Isoline {
  double level = 0.0;  // W/m² or lx
  std::vector<glm::dvec2> points;
};

// A large flat piece of a surface, drawn to scale: a wall as seen from where the light is, floors and ceilings as seen
// from above (+x to the right, +z downwards). Or a curved surface's tile map, laid out as its tiles are counted.
struct SurfacePlan {
  std::size_t map = 0;     // index into Tiling::maps
  bool flat = true;        // false: a tile map; then the three vectors are 0
  Picture picture;         // every pixel is one tile's colour, and opaque, or transparent
  glm::dvec3 corner{0.0};  // m, the picture's top left
  glm::dvec3 across{0.0};  // m, a pixel to the right
  glm::dvec3 down{0.0};    // m, a pixel down
  double area_m2 = 0.0;
  double mean_irradiance = 0.0;  // of its tiles, by area
  double min_irradiance = 0.0;
  double max_irradiance = 0.0;
  std::vector<Isoline> isolines;
  double smoothing_m = 0.0;     // radius that irradiance was averaged over for the isolines
  std::string why_no_isolines;  // a sentence, where there are none
};

// The pieces that make up at least 2 % of the room's surface each, the largest first, at most `most`. `longest`: their
// longer side in pixels, 16 … 4096, or InputError.
std::vector<SurfacePlan> draw_plans(const Room& room, const Result& result, const LitSides& lit,
                                    const ColourScale& scale, std::size_t most = 12, std::size_t longest = 640);

}  // namespace lichtmc
