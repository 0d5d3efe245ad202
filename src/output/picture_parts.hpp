// Parts that SVG pictures of rooms, surfaces and paths have in common. Lengths are units of the picture.
#pragma once

#include <string>
#include <string_view>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/picture.hpp"

namespace lichtmc {

inline constexpr double picture_top = 46.0;   // of the picture, below the title
inline constexpr double picture_side = 14.0;  // margin
inline constexpr double note_size = 12.0;     // font size of notes below the picture
inline constexpr double text_size = 13.0;     // of other text

// A PNG file as an element; `pixelated`: enlarged without interpolation.
std::string svg_image(const std::string& png, double x, double y, double width, double height, bool pixelated);

// A disc whose title browsers show when the pointer is on it.
std::string svg_circle(const glm::dvec2& at, double radius, const std::string& attributes, const std::string& title);

// "#rrggbb"
std::string css(const Colour& colour);

// Where a point of the room (m) is in the picture; `to_pixel` as in Picture.
glm::dvec2 pixel_of(const glm::dmat4& to_pixel, const glm::dvec3& place);

// A bar with all colours and their values, with its unit above it.
std::string colour_legend(const ColourScale& scale, std::string_view unit, double x, double y, double height);

// The width that the legend needs, with its distance from the picture and the margin.
double legend_width(const ColourScale& scale, double height);

// A scale bar with a round length of at most a quarter of `width`; `end`: where its text ends.
std::string scale_bar(double units_per_metre, double width, double x, double y, double& end);

// Lines of notes from (x, y) downwards, not wider than `width`; moves y below them.
std::string svg_notes(const std::string& text, double x, double& y, double width);

}  // namespace lichtmc
