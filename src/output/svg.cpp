#include "output/svg.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>

#include "base/utf8.hpp"
#include "lichtmc/visible_text.hpp"

namespace lichtmc {

namespace {

// ink: text; paper: background; rule: grid lines and frames; line: walls; halo: text on pictures.
constexpr std::string_view style =
    "<style>.lichtmc .ink{fill:#1b1b1b}.lichtmc .muted{fill:#5a5a5a}.lichtmc .paper{fill:#fff}"
    ".lichtmc .rule{stroke:#ddd}.lichtmc .frame{stroke:#888;fill:none}.lichtmc .mark{stroke:#1b1b1b;fill:#fff}"
    ".lichtmc .line{stroke:#1b1b1b;fill:none}"
    ".lichtmc .halo{fill:#000;stroke:#fff;stroke-width:3px;paint-order:stroke;stroke-linejoin:round}"
    "@media screen and (prefers-color-scheme:dark){.lichtmc .ink{fill:#ececec}.lichtmc .muted{fill:#a8a8a8}"
    ".lichtmc .paper{fill:#1a1b1e}.lichtmc .rule{stroke:#3a3c40}.lichtmc .frame{stroke:#888}.lichtmc .line{stroke:#ececec}}</style>\n";

constexpr double title_size = 17.0;

// Advance of a character as a part of the font size; at least that of DejaVu Sans, measured. Characters beyond ASCII
// count as full squares, as Chinese ones are.
double advance_of(char c) {
  constexpr std::string_view narrow = " ijlI.,:;'|!/\\()[]{}-fr\"`t";
  constexpr std::string_view wide = "mwMW@%+=<>#~^&";
  if (static_cast<unsigned char>(c) >= 0x80) return 1.0;
  if (narrow.find(c) != std::string_view::npos) return c == 'i' || c == 'j' || c == 'l' || c == 'I' ? 0.3 : 0.47;
  if (wide.find(c) != std::string_view::npos) return 1.0;
  return c >= 'A' && c <= 'Z' ? 0.79 : 0.64;
}

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;  // of UTF-8
}

std::vector<std::string_view> characters_of(std::string_view text) {
  std::vector<std::string_view> characters;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at + 1;
    while (end < text.size() && continues_character(text[end])) ++end;
    characters.push_back(text.substr(at, end - at));
    at = end;
  }
  return characters;
}

}  // namespace

double text_width(std::string_view text, double font_size) {
  double width = 0.0;
  for (const char c : text) width += continues_character(c) ? 0.0 : advance_of(c);
  return font_size * width;
}

std::string shortened(std::string_view any_text, double font_size, double width) {
  const std::string text = visible_text(any_text);
  if (text_width(text, font_size) <= width) return text;
  const std::vector<std::string_view> characters = characters_of(text);
  std::string begin;
  std::string end;
  double left = width - font_size;  // after the "…"
  for (std::size_t k = 0, first = 0, last = characters.size(); first < last; ++k) {
    const std::string_view next = k % 2 == 0 ? characters[first++] : characters[--last];
    left -= text_width(next, font_size);
    if (left < 0.0) break;
    if (k % 2 == 0)
      begin += next;
    else
      end.insert(0, next);
  }
  return begin + "…" + end;
}

std::vector<std::string> text_lines(std::string_view text, double font_size, double width) {
  std::vector<std::string> lines{""};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = shortened(text.substr(at, end - at), font_size, width);
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (text_width(longer, font_size) <= width || lines.back().empty())
      lines.back() = longer;
    else
      lines.push_back(word);
    at = end + 1;
  }
  return lines;
}

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
         svg_text(title_x, 28.0, shortened(title, title_size, width - 2.0 * title_x),
                  " font-size=\"" + fixed(title_size) + "\"");
}

}  // namespace lichtmc
