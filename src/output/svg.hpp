// SVG elements of charts and pictures.
//
// Pictures follow the light or dark colour scheme of the browser: text and lines get their colours from the classes in
// the style element of svg_head(). The class "lichtmc" of the root element limits them to these pictures.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lichtmc {

// Escapes the characters with a meaning in XML and HTML; characters that XML does not allow, or that change the order
// of the text, become visible as by visible_text(). Tabs and line ends stay.
std::string escaped(std::string_view text);

// A length in units of the picture, with one decimal.
std::string fixed(double value);

// `more`: further attributes, beginning with a space.
std::string svg_text(double x, double y, std::string_view text, std::string_view more = "");
std::string svg_line(double x1, double y1, double x2, double y2, std::string_view attributes);

// The greatest width, in units, that the text takes in a common sans-serif font (DejaVu Sans and Verdana are the
// widest).
double text_width(std::string_view text, double font_size);

// The text as visible_text() writes it, or its beginning, "…" and its end if it is wider than `width`.
std::string shortened(std::string_view text, double font_size, double width);

// The text in lines that are not wider than `width`, broken at blanks; longer words are shortened. Not empty.
std::vector<std::string> text_lines(std::string_view text, double font_size, double width);

// The start of the root element: size in units, style, background and title, shortened if it is too long.
std::string svg_head(double width, double height, std::string_view title, double title_x = 0.0);

}  // namespace lichtmc
