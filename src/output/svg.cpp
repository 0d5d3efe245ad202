#include "output/svg.hpp"

#include <algorithm>
#include <cstdio>

#include "base/utf8.hpp"
#include "lichtmc/visible_text.hpp"

namespace lichtmc {

namespace {

// ink: text; paper: background; rule: grid lines and frames; halo: text on pictures.
constexpr std::string_view style =
    "<style>.lichtmc .ink{fill:#1b1b1b}.lichtmc .muted{fill:#5a5a5a}.lichtmc .paper{fill:#fff}"
    ".lichtmc .rule{stroke:#ddd}.lichtmc .frame{stroke:#888;fill:none}.lichtmc .mark{stroke:#1b1b1b;fill:#fff}"
    ".lichtmc .halo{fill:#000;stroke:#fff;stroke-width:3px;paint-order:stroke;stroke-linejoin:round}"
    "@media screen and (prefers-color-scheme:dark){.lichtmc .ink{fill:#ececec}.lichtmc .muted{fill:#a8a8a8}"
    ".lichtmc .paper{fill:#1a1b1e}.lichtmc .rule{stroke:#3a3c40}.lichtmc .frame{stroke:#888}}</style>\n";

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::string_view piece = text.substr(0, std::max<std::size_t>(character.bytes, 1));
    text.remove_prefix(piece.size());
    switch (piece.front()) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\t':
      case '\n':
      case '\r':
        out += piece;
        break;
      default:
        out += visible_text(piece);
    }
  }
  return out;
}

std::string fixed(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string svg_text(double x, double y, std::string_view text, std::string_view more) {
  const bool has_class = more.find("class=") != std::string_view::npos;
  return "<text x=\"" + fixed(x) + "\" y=\"" + fixed(y) + "\"" + (has_class ? "" : " class=\"ink\"") +
         std::string(more) + ">" + escaped(text) + "</text>\n";
}

std::string svg_line(double x1, double y1, double x2, double y2, std::string_view attributes) {
  return "<line x1=\"" + fixed(x1) + "\" y1=\"" + fixed(y1) + "\" x2=\"" + fixed(x2) + "\" y2=\"" + fixed(y2) + "\" " +
         std::string(attributes) + "/>\n";
}

std::string svg_head(double width, double height, std::string_view title, double title_x) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"lichtmc\" viewBox=\"0 0 " + fixed(width) + " " +
         fixed(height) + "\" font-family=\"sans-serif\" font-size=\"13\">\n" + std::string(style) +
         "<rect width=\"100%\" height=\"100%\" class=\"paper\"/>\n" +
         svg_text(title_x, 28.0, title, " font-size=\"17\"");
}

}  // namespace lichtmc
