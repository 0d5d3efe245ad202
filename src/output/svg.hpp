// SVG elements of charts and pictures.
//
// Pictures follow the light or dark colour scheme of the browser: text and lines get their colours from the classes in
// the style element of svg_head(). The class "lichtmc" of the root element limits them to these pictures.
#pragma once

#include <string>
#include <string_view>

namespace lichtmc {

// Escapes the characters with a meaning in XML and HTML; characters that XML does not allow, or that change the order
// of the text, become visible as by visible_text(). Tabs and line ends stay.
std::string escaped(std::string_view text);

// A length in units of the picture, with one decimal.
std::string fixed(double value);

// `more`: further attributes, beginning with a space.
std::string svg_text(double x, double y, std::string_view text, std::string_view more = "");
std::string svg_line(double x1, double y1, double x2, double y2, std::string_view attributes);

// The start of the root element: size in units, style, background and title.
std::string svg_head(double width, double height, std::string_view title, double title_x = 0.0);

}  // namespace lichtmc
