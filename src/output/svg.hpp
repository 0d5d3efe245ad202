// Pieces of SVG: what charts and pictures are put together from.
//
// Pictures follow the reader's choice of light or dark: text and lines take their colour from the classes of
// svg_style(), which the root element's class "lichtmc" limits to these pictures.
#pragma once

#include <string>
#include <string_view>

namespace lichtmc {

// Text with the characters that XML and HTML take for their own escaped; characters that XML does not allow are
// replaced.
std::string escaped(std::string_view text);

// A length in the picture's units, to a tenth.
std::string fixed(double value);

// `more`: further attributes, beginning with a space.
std::string svg_text(double x, double y, std::string_view text, std::string_view more = "");
std::string svg_line(double x1, double y1, double x2, double y2, std::string_view attributes);

// The root element's beginning: size in units, style, background and title.
std::string svg_head(double width, double height, std::string_view title, double title_x = 0.0);

}  // namespace lichtmc
