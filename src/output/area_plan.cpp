#include "output/area_plan.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "base/png.hpp"
#include "output/area_numbers.hpp"
#include "output/area_words.hpp"
#include "output/isoline_marks.hpp"
#include "output/picture_parts.hpp"
#include "output/svg.hpp"

namespace lichtmc {

namespace {

// Units of the sheet: at a width of 17 cm on paper one unit is a pixel of CSS, 0.265 mm.
constexpr double sheet_width = 642.0;
constexpr double greatest_height = 560.0;  // of the drawing
constexpr double dimension_space = 26.0;   // above and to the left of the drawing
constexpr double number_size = 10.5;       // font size
constexpr double number_halo = 6.0;        // width of its stroke: a line that ends at a number is no minus sign
constexpr double label_size = 11.0;        // of the isolines' values
constexpr double label_gap = 1.5;          // from the numbers
constexpr double arrow_length = 30.0;
const std::string no_break = "\u00a0";         // blank
constexpr std::size_t most_rectangles = 4000;  // more cells are an image

std::string ordinal(std::size_t n) {
  return n == 2 ? "2nd" : n == 3 ? "3rd" : std::to_string(n) + "th";
}

// Cuts a line to a box; false if nothing is left (Liang and Barsky, 1984).
bool cut_to_box(const SheetLine& box, SheetLine& line) {
  double begin = 0.0;
  double end = 1.0;
  const glm::dvec2 step = line[1] - line[0];
  for (int axis = 0; axis < 2; ++axis) {
    double enter = (box[0][axis] - line[0][axis]) / step[axis];
    double leave = (box[1][axis] - line[0][axis]) / step[axis];
    if (step[axis] == 0.0) {
      if (line[0][axis] < box[0][axis] || line[0][axis] > box[1][axis]) return false;
      continue;
    }
    if (enter > leave) std::swap(enter, leave);
    begin = std::max(begin, enter);
    end = std::min(end, leave);
  }
  if (begin > end) return false;
  line = {line[0] + begin * step, line[0] + end * step};
  return true;
}

class AreaPlan {
 public:
  AreaPlan(const Result& result, std::size_t area, const AreaDrawing& drawing, const ColourScale& scale)
      : result_(&result),
        figures_(&result.areas[area]),
        scale_(&scale),
        drawing_(drawing),
        form_(drawing_, result.quantity) {
    choose_view();
    choose_places();
  }

  std::string svg() {
    std::string body = headings();
    y_ += dimension_space;
    const glm::dvec2 size = unit_ * (view_[1] - view_[0]);
    origin_ = {picture_side + dimension_space, y_};
    body += cells() + dimensions() + room_lines() + isoline_strokes(drawing_.isolines, unit_, at({0.0, 0.0}));
    body += numbers();
    body += places_.isoline_labels(with_more_points(), unit_, at({0.0, 0.0}), label_size, {4.0, label_gap});
    const double legend_height = std::clamp(size.y - 20.0, 130.0, 300.0);
    body += colour_legend(*scale_, written_irradiance_unit(result_->quantity), origin_.x + size.x, y_ + 14.0,
                          legend_height);
    y_ += std::max(size.y, legend_height + 14.0) + 12.0;
    body += arrow_and_scale_bar(size.x);
    body += svg_notes(notes(), picture_side, y_, sheet_width - 2.0 * picture_side);
    return svg_head(sheet_width, y_, area_title(figures_->area), picture_side) + body + "</svg>\n";
  }

 private:
  // The area with the walls next to it.
  void choose_view() {
    const SheetLine box = drawing_.box();
    const glm::dvec2 last = drawing_.corner + drawing_.cell * glm::dvec2(static_cast<double>(drawing_.columns),
                                                                         static_cast<double>(drawing_.rows));
    const glm::dvec2 low = glm::min(box[0], drawing_.corner);
    const glm::dvec2 high = glm::max(box[1], last);
    const double longer = std::max(high.x - low.x, high.y - low.y);
    constexpr double least_share = 0.06;
    const double wide = drawing_.section.empty() ? 0.0 : figures_->area.margin_m + least_share * longer;
    SheetLine seen{low, high};
    const SheetLine window{low - wide, high + wide};
    for (SheetLine line : drawing_.section) {
      if (!cut_to_box(window, line)) continue;
      seen = {glm::min(seen[0], glm::min(line[0], line[1])), glm::max(seen[1], glm::max(line[0], line[1]))};
    }
    constexpr double rim = 0.01;  // for the width of the lines
    view_ = {seen[0] - rim * longer, seen[1] + rim * longer};
    const glm::dvec2 size = view_[1] - view_[0];
    const double width = sheet_width - picture_side - dimension_space - legend_width(*scale_, 130.0);
    unit_ = std::min(width / size.x, greatest_height / size.y);
  }

  // Texts lie in the grid; a grid narrower than a number is no limit.
  void choose_places() {
    constexpr double least = 60.0;
    const glm::dvec2 size =
        unit_ * drawing_.cell * glm::dvec2(static_cast<double>(drawing_.columns), static_cast<double>(drawing_.rows));
    const glm::dvec2 more = glm::max(glm::dvec2(0.0), 0.5 * (glm::dvec2(least, number_size) - size));
    places_low_ = unit_ * drawing_.corner - more;
    places_high_ = unit_ * drawing_.corner + size + more;
    places_ = LabelPlaces(places_low_ + glm::dvec2(0.0, 0.4 * number_size),
                          places_high_ - glm::dvec2(0.0, 0.4 * number_size));
  }

  glm::dvec2 at(const glm::dvec2& p) const { return origin_ + unit_ * (p - view_[0]); }

  std::string headings() {
    std::string svg;
    y_ = 50.0;
    const std::string target = area_target_text(*figures_, result_->quantity);
    const std::string figures = area_figures_text(*figures_, result_->quantity) + (target.empty() ? "" : ", " + target);
    for (const std::string& line : text_lines(figures, 14.0, sheet_width - 2.0 * picture_side)) {
      svg += svg_text(picture_side, y_, line, " font-size=\"14\"");
      y_ += 19.0;
    }
    const std::string maintained = has_maintenance(*figures_) ? "maintained " : "";
    svg += svg_text(picture_side, y_, maintained + area_quantity_text(figures_->area, result_->quantity),
                    " class=\"muted\" font-size=\"" + fixed(note_size) + "\"");
    y_ += 8.0;
    return svg;
  }

  bool has_point(std::size_t k) const { return drawing_.has_point[k]; }
  Colour colour(std::size_t k) const { return colour_of(*scale_, drawing_.values[k]); }

  std::string cells() {
    const glm::dvec2 low = at(drawing_.corner);
    const glm::dvec2 cell = unit_ * drawing_.cell;
    std::string svg;
    if (drawing_.values.size() > most_rectangles) {
      std::vector<std::uint8_t> pixels;
      for (std::size_t k = 0; k < drawing_.values.size(); ++k) {
        const Colour c = has_point(k) ? colour(k) : Colour{0, 0, 0};
        pixels.insert(pixels.end(), {c[0], c[1], c[2], static_cast<std::uint8_t>(has_point(k) ? 255 : 0)});
      }
      return svg_image(png_file(drawing_.columns, drawing_.rows, 4, pixels), low.x, low.y,
                       cell.x * static_cast<double>(drawing_.columns), cell.y * static_cast<double>(drawing_.rows),
                       true);
    }
    std::string hatching;
    for (std::size_t k = 0; k < drawing_.values.size(); ++k) {
      // Neighbours share their rounded edges.
      const glm::dvec2 from =
          low + cell * glm::dvec2(static_cast<double>(k % drawing_.columns), static_cast<double>(k / drawing_.columns));
      const std::string left = fixed(from.x);
      const std::string top = fixed(from.y);
      const std::string right = fixed(from.x + cell.x);
      const std::string bottom = fixed(from.y + cell.y);
      if (has_point(k)) {
        svg += "<path fill=\"" + css(colour(k)) + "\" d=\"M" + left + " " + top + "H" + right + "V" + bottom + "H" +
               left + "Z\"/>\n";
      } else if (drawing_.inside[k]) {
        hatching += "M" + left + " " + bottom + "L" + right + " " + top;
      }
    }
    svg = "<g shape-rendering=\"crispEdges\">\n" + svg + "</g>\n";
    hatched_ = !hatching.empty();
    if (hatched_) svg += "<path class=\"frame\" stroke-width=\"0.7\" d=\"" + hatching + "\"/>\n";
    return svg;
  }

  // The lines without those that cannot be seen: shorter than a tenth of a unit, or in the place of another.
  std::string path_of(const std::vector<SheetLine>& lines, const char* attributes) const {
    std::set<std::pair<std::string, std::string>> drawn;
    for (SheetLine line : lines) {
      if (!cut_to_box(view_, line)) continue;
      const glm::dvec2 a = at(line[0]);
      const glm::dvec2 b = at(line[1]);
      std::string from = fixed(a.x) + " " + fixed(a.y);
      std::string to = fixed(b.x) + " " + fixed(b.y);
      if (from == to) continue;
      if (to < from) std::swap(from, to);
      drawn.emplace(std::move(from), std::move(to));
    }
    if (drawn.empty()) return {};
    std::string path = "<path class=\"line\" " + std::string(attributes) + " d=\"";
    for (const auto& [from, to] : drawn) path += "M" + from + "L" + to;
    return path + "\"/>\n";
  }

  std::string room_lines() const {
    return path_of(drawing_.outline_or_grid(), "stroke-width=\"0.8\" stroke-dasharray=\"6 3\"") +
           path_of(drawing_.section, "stroke-width=\"2\" stroke-opacity=\"0.6\" stroke-linecap=\"round\"");
  }

  // Width and height of the area, with ticks at their ends.
  std::string dimensions() const {
    const SheetLine box = drawing_.box();
    const glm::dvec2 low = at(box[0]);
    const glm::dvec2 high = at(box[1]);
    const std::string style = "class=\"frame\"";
    const double top = origin_.y - 8.0;
    const double left = origin_.x - 8.0;
    const std::string more = " class=\"muted\" font-size=\"11\" text-anchor=\"middle\"";
    std::string svg = svg_line(low.x, top, high.x, top, style) + svg_line(left, low.y, left, high.y, style);
    for (const double x : {low.x, high.x}) svg += svg_line(x - 3.0, top + 3.0, x + 3.0, top - 3.0, style);
    for (const double y : {low.y, high.y}) svg += svg_line(left - 3.0, y + 3.0, left + 3.0, y - 3.0, style);
    svg += svg_text(0.5 * (low.x + high.x), top - 5.0, decimal(box[1].x - box[0].x, 2) + " m", more);
    const glm::dvec2 side(left - 5.0, 0.5 * (low.y + high.y));
    svg += svg_text(side.x, side.y, decimal(box[1].y - box[0].y, 2) + " m",
                    more + " transform=\"rotate(-90 " + fixed(side.x) + " " + fixed(side.y) + ")\"");
    return svg;
  }

  // A value at a point of the sheet, in its cell's colour: white on dark colours, black on bright ones.
  std::string number(std::size_t k, const glm::dvec2& at_sheet, bool framed) const {
    const std::string text = form_.text(drawing_.values[k]);
    const glm::dvec2 p = at(at_sheet);
    const Colour own = colour(k);
    const bool dark = 0.299 * own[0] + 0.587 * own[1] + 0.114 * own[2] < 128.0;
    const std::string ink = dark ? "#fff" : "#000";
    std::string svg;
    if (framed) {
      const glm::dvec2 size = frame_size(k);
      svg += "<rect x=\"" + fixed(p.x - 0.5 * size.x) + "\" y=\"" + fixed(p.y - 0.5 * size.y) + "\" width=\"" +
             fixed(size.x) + "\" height=\"" + fixed(size.y) + "\" rx=\"2\" fill=\"" + css(own) + "\" stroke=\"" + ink +
             "\" stroke-width=\"1.2\"/>\n";
    }
    return svg + "<text x=\"" + fixed(p.x) + "\" y=\"" + fixed(p.y + 3.7) + "\" fill=\"" + ink +
           (framed ? std::string("\"")
                   : "\" stroke=\"" + css(own) + "\" stroke-width=\"" + fixed(number_halo) +
                         "\" stroke-linejoin=\"round\" paint-order=\"stroke\"") +
           ">" + text + "</text>\n";
  }

  double number_width(std::size_t k) const { return text_width(form_.text(drawing_.values[k]), number_size); }
  glm::dvec2 frame_size(std::size_t k) const { return {number_width(k) + 4.0, number_size + 4.5}; }

  // The numbers of the lowest and the highest value, and as many of the others as have space in the grid.
  std::string numbers() {
    if (figures_->area.cells.empty()) return {};
    double width = 0.0;
    for (std::size_t k = 0; k < drawing_.values.size(); ++k) {
      if (has_point(k)) width = std::max(width, number_width(k));
    }
    const glm::dvec2 cell = unit_ * drawing_.cell;
    constexpr double gap_x = 6.0;
    constexpr double gap_y = label_size + 2.0 * label_gap;  // a label has space between two rows
    const auto step = [](double needed, double size) {
      return static_cast<std::size_t>(std::max(1.0, std::ceil(needed / size)));
    };
    column_step_ = step(width + gap_x, cell.x);
    row_step_ = step(number_size + gap_y, cell.y);
    // Centred; but the first numbers must not stick out.
    const auto first = [&](std::size_t count, std::size_t by, double needed, double size) {
      const auto least = static_cast<std::size_t>(std::max(0.0, std::ceil(0.5 * needed / size - 0.5)));
      return std::min(std::max((count - 1) % by / 2, least), (count - 1) / 2);
    };
    const std::size_t first_column = first(drawing_.columns, column_step_, width, cell.x);
    const std::size_t first_row = first(drawing_.rows, row_step_, number_size, cell.y);
    std::string framed = extreme(drawing_.lowest_cell);
    if (drawing_.highest_cell != drawing_.lowest_cell) framed += extreme(drawing_.highest_cell);
    std::string svg;
    for (std::size_t row = first_row; row < drawing_.rows; row += row_step_) {
      for (std::size_t column = first_column; column < drawing_.columns; column += column_step_) {
        const std::size_t k = row * drawing_.columns + column;
        const glm::dvec2 p = drawing_.centre(k);
        if (has_point(k) && places_.take(unit_ * p, {number_width(k), number_size}, {3.0, 0.0}))
          svg += number(k, p, false);
      }
    }
    return "<g text-anchor=\"middle\" font-size=\"" + fixed(number_size) + "\">\n" + svg + framed + "</g>\n";
  }

  // Moved into the grid if its cell at the border is smaller than the frame.
  std::string extreme(std::size_t k) {
    const glm::dvec2 margin = 0.5 * frame_size(k) / unit_;
    const glm::dvec2 low = places_low_ / unit_ + margin;
    const glm::dvec2 p = glm::clamp(drawing_.centre(k), low, glm::max(low, places_high_ / unit_ - margin));
    return places_.take(unit_ * p, frame_size(k), {1.0, 0.0}) ? number(k, p, true) : std::string();
  }

  // Labels may lie everywhere on a line, not only at its bends.
  std::vector<Isoline> with_more_points() const {
    constexpr double step = 4.0;  // units
    std::vector<Isoline> lines;
    for (const Isoline& line : drawing_.isolines) {
      Isoline& more = lines.emplace_back();
      more.level = line.level;
      for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
        const glm::dvec2 way = line.points[k + 1] - line.points[k];
        const int parts = 1 + static_cast<int>(unit_ * glm::length(way) / step);
        for (int i = 0; i < parts; ++i) more.points.push_back(line.points[k] + static_cast<double>(i) / parts * way);
      }
      if (!line.points.empty()) more.points.push_back(line.points.back());
    }
    return lines;
  }

  std::string arrow_and_scale_bar(double width) {
    const glm::dvec2 middle(picture_side + 0.5 * arrow_length, y_ + 0.5 * arrow_length);
    const glm::dvec2 ahead = drawing_.arrow;
    const glm::dvec2 aside(-ahead.y, ahead.x);
    const glm::dvec2 tip = middle + 0.5 * arrow_length * ahead;
    const glm::dvec2 tail = middle - 0.5 * arrow_length * ahead;
    const auto corner = [&](double side) {
      const glm::dvec2 p = tip - 10.0 * ahead + side * aside;
      return fixed(p.x) + "," + fixed(p.y) + " ";
    };
    std::string svg = svg_line(tail.x, tail.y, tip.x, tip.y, "class=\"line\" stroke-width=\"1.4\"");
    svg += "<polygon class=\"ink\" points=\"" + fixed(tip.x) + "," + fixed(tip.y) + " " + corner(5.0) + corner(-5.0) +
           "\"/>\n";
    svg += svg_text(middle.x + 16.0, middle.y + 4.5, drawing_.level ? "−z" : "up");
    double end = 0.0;
    svg += scale_bar(unit_, std::max(width, 160.0), picture_side + arrow_length + 50.0, middle.y, end);
    y_ += arrow_length + 20.0;
    return svg;
  }

  std::string notes() const {
    const Area& area = figures_->area;
    std::string text = "Numbers: " + std::string(irradiance_word(result_->quantity)) + " in " + form_.unit() +
                       (area.properties.cells ? ", the mean over each cell" : " at the centre of each cell");
    if (column_step_ > 1 && row_step_ == column_step_)
      text += ", of every " + ordinal(column_step_) + " cell in both directions";
    else if (column_step_ > 1 || row_step_ > 1)
      text += ", of every " + (column_step_ > 1 ? ordinal(column_step_) + " column" : std::string()) +
              (column_step_ > 1 && row_step_ > 1 ? " and " : "") +
              (row_step_ > 1 ? ordinal(row_step_) + " row" : std::string());
    text += "; framed: the lowest and the highest. ";
    if (!drawing_.isolines.empty())
      text += std::string("Lines: ") + (result_->quantity == Quantity::photometric ? "isolux lines" : "isolines") +
              ", linear between the points. ";
    else if (!drawing_.why_no_isolines.empty())
      text += drawing_.why_no_isolines + " ";
    text += to_text(area.cells.size(), "point") + ", spacing " + decimal(glm::length(area.u), 3) + no_break + "m" +
            no_break + "×" + no_break + decimal(glm::length(area.v), 3) + no_break + "m" +
            (area.margin_m > 0.0 ? ", margin " + decimal(area.margin_m, 2) + no_break + "m. " : ". ");
    if (const std::string left_out = area_left_out_text(area); !left_out.empty())
      text += left_out + (hatched_ ? " (hatched inside the area). " : ". ");
    for (const std::string& note : area.notes) text += note + " ";
    if (!drawing_.section.empty())
      text += "Grey lines: the room cut at this height. The arrow −z points north where the model is drawn so.";
    return text;
  }

  const Result* result_;
  const AreaResult* figures_;
  const ColourScale* scale_;
  const AreaDrawing& drawing_;
  AreaNumbers form_;
  SheetLine view_{};
  double unit_ = 1.0;  // units of the picture per metre
  glm::dvec2 origin_{0.0};
  double y_ = 0.0;
  glm::dvec2 places_low_{0.0};  // of texts; a point p of the sheet is at unit_ · p
  glm::dvec2 places_high_{0.0};
  LabelPlaces places_{glm::dvec2(0.0), glm::dvec2(0.0)};
  std::size_t column_step_ = 1;
  std::size_t row_step_ = 1;
  bool hatched_ = false;
};

}  // namespace

std::string area_plan_svg(const Room& room, const Result& result, std::size_t area, const ColourScale& scale) {
  return area_plan_svg(result, area, draw_area(room, result, area), scale);
}

std::string area_plan_svg(const Result& result, std::size_t area, const AreaDrawing& drawing,
                          const ColourScale& scale) {
  return AreaPlan(result, area, drawing, scale).svg();
}

}  // namespace lichtmc
