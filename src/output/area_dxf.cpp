// DXF, Release 12: pairs of a group code and a value, a line each. Source: AutoCAD Release 12 Customization Manual,
// chapter 11 (Autodesk, 1992).
#include "output/area_dxf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string_view>
#include <vector>

#include <glm/common.hpp>

#include "base/message.hpp"
#include "base/utf8.hpp"
#include "output/area_numbers.hpp"
#include "output/area_words.hpp"

namespace lichtmc {

namespace {

// Colour numbers of AutoCAD: 7 is black or white, whichever is not the background; 8 grey. The others can be seen on
// both: red, orange, dark green, light blue, blue, magenta.
constexpr int dxf_ink = 7;
constexpr int dxf_grey = 8;
constexpr std::array<int, 6> dxf_colours{1, 30, 94, 140, 5, 6};

// A text: characters beyond ASCII by their numbers, which readers since Release 13 understand, except "±".
std::string dxf_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Character c = first_character(text);
    const std::size_t bytes = std::max<std::size_t>(c.bytes, 1);
    const char32_t code = c.bytes > 0 ? c.code : U'?';
    std::array<char, 16> number{};
    std::snprintf(number.data(), number.size(), "\\U+%04X", static_cast<unsigned>(code));
    if (code == U'±')
      out += "%%p";
    else if (code < 0x20)
      out += ' ';
    else if (code < 0x7F)
      out += static_cast<char>(code);
    else
      out += number.data();
    text.remove_prefix(bytes);
  }
  return out;
}

class DxfFile {
 public:
  void pair(int code, std::string_view value) {
    text_ += std::to_string(code) + '\n';
    text_ += value;
    text_ += '\n';
  }
  void pair(int code, int value) { pair(code, std::to_string(value)); }
  void pair(int code, double value) {
    std::array<char, 400> digits{};
    std::snprintf(digits.data(), digits.size(), "%.6f", value);
    pair(code, digits.data());
  }
  // A point at codes `code` (x), `code` + 10 (y) and `code` + 20 (z = 0).
  void point(int code, const glm::dvec2& p) {
    pair(code, p.x);
    pair(code + 10, p.y);
    pair(code + 20, 0.0);
  }
  void begin_section(std::string_view name) {
    pair(0, "SECTION");
    pair(2, name);
  }
  void end_section() { pair(0, "ENDSEC"); }
  void begin_table(std::string_view name, int entries) {
    pair(0, "TABLE");
    pair(2, name);
    pair(70, entries);
  }
  void end_table() { pair(0, "ENDTAB"); }
  void line(std::string_view layer, const glm::dvec2& a, const glm::dvec2& b) {
    entity("LINE", layer);
    point(10, a);
    point(11, b);
  }
  void polyline(std::string_view layer, const std::vector<glm::dvec2>& points) {
    const bool closed = points.size() > 2 && points.front() == points.back();
    entity("POLYLINE", layer);
    pair(66, 1);  // vertices follow
    point(10, {0.0, 0.0});
    pair(70, closed ? 1 : 0);
    for (std::size_t k = 0; k + (closed ? 1 : 0) < points.size(); ++k) {
      entity("VERTEX", layer);
      point(10, points[k]);
    }
    entity("SEQEND", layer);
  }
  // centred: about p; else p is the left end of the base line.
  void text(std::string_view layer, const glm::dvec2& p, double height, double angle_deg, std::string_view words,
            bool centred) {
    entity("TEXT", layer);
    point(10, p);
    pair(40, height);
    pair(1, dxf_text(words));
    if (angle_deg != 0.0) pair(50, angle_deg);
    if (!centred) return;
    pair(72, 1);
    point(11, p);
    pair(73, 2);
  }
  const std::string& content() const { return text_; }

 private:
  void entity(std::string_view kind, std::string_view layer) {
    pair(0, kind);
    pair(8, layer);
  }
  std::string text_;
};

struct Layer {
  std::string name;
  int colour = dxf_ink;
  const char* line_type = "CONTINUOUS";
};

// Release 12 allows letters, digits, "_", "-" and "$" in names.
std::string isolux_layer(double level) {
  std::string name = "ISOLUX_" + to_text(level);
  std::replace(name.begin(), name.end(), '.', '_');
  std::replace(name.begin(), name.end(), '+', '_');
  std::replace(name.begin(), name.end(), 'e', 'E');
  return name;
}

void write_tables(DxfFile& dxf, const std::vector<Layer>& layers) {
  dxf.begin_section("TABLES");
  dxf.begin_table("LTYPE", 2);
  const auto line_type = [&dxf](const char* name, const char* picture, const std::vector<double>& dashes) {
    dxf.pair(0, "LTYPE");
    dxf.pair(2, name);
    dxf.pair(70, 0);
    dxf.pair(3, picture);
    dxf.pair(72, 65);
    dxf.pair(73, static_cast<int>(dashes.size()));
    double length = 0.0;
    for (const double dash : dashes) length += std::abs(dash);
    dxf.pair(40, length);
    for (const double dash : dashes) dxf.pair(49, dash);
  };
  line_type("CONTINUOUS", "Solid line", {});
  line_type("DASHED", "__ __ __", {0.1, -0.05});
  dxf.end_table();
  dxf.begin_table("LAYER", static_cast<int>(layers.size()));
  for (const Layer& layer : layers) {
    dxf.pair(0, "LAYER");
    dxf.pair(2, layer.name);
    dxf.pair(70, 0);
    dxf.pair(62, layer.colour);
    dxf.pair(6, layer.line_type);
  }
  dxf.end_table();
  dxf.begin_table("STYLE", 1);
  dxf.pair(0, "STYLE");
  dxf.pair(2, "STANDARD");
  dxf.pair(70, 0);
  dxf.pair(40, 0.0);
  dxf.pair(41, 1.0);
  dxf.pair(50, 0.0);
  dxf.pair(71, 0);
  dxf.pair(42, 0.2);
  dxf.pair(3, "txt");
  dxf.pair(4, "");
  dxf.end_table();
  dxf.end_section();
}

// The place of a line's value, farthest from the numbers: between two rows of them, if it gets there.
glm::dvec2 label_place(const AreaDrawing& drawing, const Isoline& line) {
  glm::dvec2 best = line.points.front();
  double farthest = -1.0;
  const auto consider = [&](const glm::dvec2& p) {
    const glm::dvec2 cells = (p - drawing.corner) / drawing.cell - 0.5;
    const glm::dvec2 away = glm::abs(cells - glm::round(cells));
    const double distance = away.y + 0.5 * away.x;
    if (distance <= farthest) return;
    farthest = distance;
    best = p;
  };
  for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
    for (const double share : {0.0, 0.25, 0.5, 0.75}) consider(glm::mix(line.points[k], line.points[k + 1], share));
  }
  return best;
}

// From the sheet to the coordinates of the drawing.
class DrawingPlaces {
 public:
  explicit DrawingPlaces(const AreaDrawing& drawing) : drawing_(&drawing) {
    if (drawing.level) angle_ = std::atan2(-drawing.right.z, drawing.right.x);
  }
  glm::dvec2 operator()(const glm::dvec2& p) const {
    if (!drawing_->level) return {p.x, -p.y};
    const glm::dvec3 place = p.x * drawing_->right + p.y * drawing_->down;
    return {place.x, -place.z};
  }
  double angle_deg() const { return angle_ * 57.29577951308232; }

 private:
  const AreaDrawing* drawing_;
  double angle_ = 0.0;
};

}  // namespace

std::string area_dxf(const Result& result, std::size_t k, const AreaDrawing& drawing) {
  const AreaResult& figures = result.areas[k];
  const DrawingPlaces places(drawing);
  const AreaNumbers numbers(drawing, result.quantity);

  std::vector<Layer> layers{{"0"}, {"ROOM"}, {"AREA", dxf_grey, "DASHED"}, {"NUMBERS"}, {"TITLE"}};
  std::map<double, std::string> layer_of_level;
  for (const Isoline& line : drawing.isolines) {
    if (!layer_of_level.emplace(line.level, isolux_layer(line.level)).second) continue;
    layers.push_back({layer_of_level[line.level], dxf_colours[(layer_of_level.size() - 1) % dxf_colours.size()]});
  }

  DxfFile dxf;
  dxf.pair(999, "lichtmc: a calculation area; lengths in m");
  dxf.begin_section("HEADER");
  dxf.pair(9, "$ACADVER");
  dxf.pair(1, "AC1009");
  dxf.end_section();
  write_tables(dxf, layers);
  dxf.begin_section("ENTITIES");
  for (const SheetLine& line : drawing.section) dxf.line("ROOM", places(line[0]), places(line[1]));
  for (const SheetLine& line : drawing.outline_or_grid()) dxf.line("AREA", places(line[0]), places(line[1]));
  const double cell = std::min(drawing.cell.x, drawing.cell.y);
  const double height = 0.25 * cell;
  for (const Isoline& line : drawing.isolines) {
    const std::string& layer = layer_of_level[line.level];
    std::vector<glm::dvec2> points;
    for (const glm::dvec2& p : line.points) points.push_back(places(p));
    dxf.polyline(layer, points);
    dxf.text(layer, places(label_place(drawing, line)), 0.8 * height, places.angle_deg(), short_number(line.level),
             true);
  }
  for (std::size_t c = 0; c < drawing.values.size(); ++c) {
    if (drawing.has_point[c])
      dxf.text("NUMBERS", places(drawing.centre(c)), height, places.angle_deg(), numbers.text(drawing.values[c]), true);
  }
  const SheetLine box = drawing.box();
  const double title_height = std::clamp(0.03 * (box[1].x - box[0].x), 0.02, 0.5);
  double below = box[1].y;
  const std::string target = area_target_text(figures, result.quantity);
  for (const std::string& line : {area_title(figures.area), area_figures_text(figures, result.quantity), target,
                                  "Numbers in " + numbers.unit() + "; lengths in m"}) {
    if (line.empty()) continue;
    below += 2.0 * title_height;
    dxf.text("TITLE", places({box[0].x, below}), title_height, places.angle_deg(), line, false);
  }
  dxf.end_section();
  dxf.pair(0, "EOF");
  return dxf.content();
}

}  // namespace lichtmc
