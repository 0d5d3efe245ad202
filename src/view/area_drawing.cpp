#include "lichtmc/area_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "room/plane_section.hpp"
#include "view/isolines.hpp"
#include "view/scale.hpp"

namespace lichtmc {

namespace {

constexpr glm::dvec3 upwards(0.0, 1.0, 0.0);

// The section of the room lies this far below a level area: one that lies on a table shows the table.
constexpr double below_area_m = 1e-3;
// cos of the angle to the vertical up to which an area is level for a drawing: seen from above, it is as long as it is.
constexpr double least_level_cosine = 0.999;

void choose_directions(const Area& area, AreaDrawing& drawing) {
  drawing.level = std::abs(area.normal.y) >= least_level_cosine;
  const glm::dvec3 towards_eye = drawing.level ? (area.normal.y > 0.0 ? area.normal : -area.normal) : area.normal;
  const glm::dvec3 wanted = drawing.level ? glm::dvec3(1.0, 0.0, 0.0) : glm::cross(upwards, area.normal);
  const glm::dvec3 u = glm::normalize(area.u);
  const glm::dvec3 v = glm::normalize(area.v);
  drawing.right = u;
  for (const glm::dvec3& side : {-u, v, -v}) {
    if (glm::dot(side, wanted) > glm::dot(drawing.right, wanted) + 1e-9) drawing.right = side;
  }
  drawing.down = glm::cross(drawing.right, towards_eye);
  const glm::dvec3 arrow = drawing.level ? glm::dvec3(0.0, 0.0, -1.0) : upwards;
  drawing.arrow = glm::normalize(drawing.on_sheet(arrow));
}

// Numbers of the grid's cells on the sheet: their columns are the rows of the area where it lies on its side.
class CellNumbers {
 public:
  CellNumbers(const Area& area, const AreaDrawing& drawing) : area_(&area) {
    turned_ = std::abs(glm::dot(area.v, drawing.right)) > std::abs(glm::dot(area.u, drawing.right));
    const glm::dvec3& across = turned_ ? area.v : area.u;
    const glm::dvec3& along = turned_ ? area.u : area.v;
    from_right_ = glm::dot(across, drawing.right) < 0.0;
    from_bottom_ = glm::dot(along, drawing.down) < 0.0;
  }
  std::size_t columns() const { return turned_ ? area_->rows : area_->columns; }
  std::size_t rows() const { return turned_ ? area_->columns : area_->rows; }
  std::size_t operator()(std::uint32_t cell) const {
    const std::size_t column = turned_ ? cell / area_->columns : cell % area_->columns;
    const std::size_t row = turned_ ? cell % area_->columns : cell / area_->columns;
    return (from_bottom_ ? rows() - 1 - row : row) * columns() + (from_right_ ? columns() - 1 - column : column);
  }

 private:
  const Area* area_;
  bool turned_ = false;
  bool from_right_ = false;
  bool from_bottom_ = false;
};

// Whether a point is inside of closed lines: a ray to the right crosses them an odd number of times.
bool is_inside(const std::vector<SheetLine>& lines, const glm::dvec2& p) {
  bool inside = false;
  for (const auto& [a, b] : lines) {
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

void lay_out_grid(const Result& result, const AreaResult& figures, AreaDrawing& drawing) {
  const Area& area = figures.area;
  const CellNumbers number(area, drawing);
  drawing.columns = number.columns();
  drawing.rows = number.rows();
  const std::size_t cells = drawing.columns * drawing.rows;
  drawing.has_point.assign(cells, false);
  drawing.values.assign(cells, 0.0);
  drawing.errors.assign(cells, 0.0);
  for (std::size_t k = 0; k < area.cells.size(); ++k) {
    const ReceiverResult& one = result.receiver_results[area.first_receiver + k];
    const std::size_t cell = number(area.cells[k]);
    drawing.has_point[cell] = true;
    drawing.values[cell] = one.irradiance;
    drawing.errors[cell] = one.standard_error;
  }
  drawing.lowest_cell = number(figures.lowest_cell);
  drawing.highest_cell = number(figures.highest_cell);
  const glm::dvec2 one = drawing.on_sheet(area.corner);
  const glm::dvec2 other = drawing.on_sheet(area.corner + static_cast<double>(area.columns) * area.u +
                                            static_cast<double>(area.rows) * area.v);
  drawing.corner = glm::min(one, other);
  drawing.cell = (glm::max(one, other) - drawing.corner) /
                 glm::dvec2(static_cast<double>(drawing.columns), static_cast<double>(drawing.rows));
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// An open piece of a line that is shorter than a cell is the corner of one, not the course of the values.
bool is_scrap(const Isoline& line, const glm::dvec2& cell) {
  if (line.points.size() < 2) return true;
  if (line.points.front() == line.points.back()) return false;
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < line.points.size(); ++k) length += glm::length(line.points[k + 1] - line.points[k]);
  return length < 0.5 * (cell.x + cell.y);
}

// Steps between lines of less than this many standard errors of a value would follow the noise.
constexpr double least_step_in_errors = 3.0;
// Above this ratio of the highest value to the lowest, even steps leave the darker part without lines.
constexpr double ratio_for_logarithm = 12.0;

void draw_isolines(const Result& result, const AreaResult& figures, AreaDrawing& drawing) {
  const Area& area = figures.area;
  std::vector<double> values;
  std::vector<double> errors;
  for (std::size_t k = 0; k < area.cells.size(); ++k) {
    const ReceiverResult& one = result.receiver_results[area.first_receiver + k];
    values.push_back(one.irradiance);
    if (std::isfinite(one.standard_error)) errors.push_back(one.standard_error);
  }
  if (values.empty()) return;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double error = median(errors);
  const double least_range = 6.0 * least_step_in_errors * error;  // of about six lines
  if (!(*high - *low > least_step_in_errors * error)) {
    drawing.why_no_isolines = "No isolines: the values differ by no more than their errors.";
    return;
  }
  IrradianceField field{drawing.columns, drawing.rows, drawing.values, {}};
  for (const bool has_point : drawing.has_point) field.weight.push_back(has_point ? 1.0 : 0.0);
  const bool logarithmic = *low > 0.0 ? *high > ratio_for_logarithm * *low : false;
  for (const double level : round_levels(*low, std::max(*high, *low + least_range), logarithmic)) {
    if (!(level < *high)) break;
    for (Isoline& line : lines_of(field, level)) {
      for (glm::dvec2& p : line.points) p = drawing.corner + drawing.cell * (p + 0.5);
      if (!is_scrap(line, drawing.cell)) drawing.isolines.push_back(std::move(line));
    }
  }
  if (drawing.isolines.empty())
    drawing.why_no_isolines = drawing.columns < 2 || drawing.rows < 2 ? "No isolines: the points lie in one row."
                                                                      : "No isolines: the values differ too little.";
}

}  // namespace

glm::dvec3 AreaDrawing::upper_left(const Area& area) const {
  const glm::dvec3 across = static_cast<double>(area.columns) * area.u;
  const glm::dvec3 along = static_cast<double>(area.rows) * area.v;
  const glm::dvec3 direction = right + down;
  // The first of the four corners from the upper left: the sides of the grid are parallel to the sheet's.
  glm::dvec3 first = area.corner;
  for (const glm::dvec3& other : {area.corner + across, area.corner + along, area.corner + across + along}) {
    if (glm::dot(other - first, direction) < 0.0) first = other;
  }
  return first;
}

std::vector<SheetLine> AreaDrawing::outline_or_grid() const {
  if (!outline.empty()) return outline;
  const glm::dvec2 last = end();
  const glm::dvec2 upper_right(last.x, corner.y);
  const glm::dvec2 lower_left(corner.x, last.y);
  return {{corner, upper_right}, {upper_right, last}, {last, lower_left}, {lower_left, corner}};
}

SheetLine AreaDrawing::box() const {
  const std::vector<SheetLine> lines = outline_or_grid();
  SheetLine box{lines.front()[0], lines.front()[0]};
  for (const SheetLine& line : lines) {
    for (const glm::dvec2& end : line) box = {glm::min(box[0], end), glm::max(box[1], end)};
  }
  return box;
}

AreaDrawing draw_area(const Room& room, const Result& result, std::size_t k) {
  const AreaResult& figures = result.areas[k];
  const Area& area = figures.area;
  AreaDrawing drawing;
  choose_directions(area, drawing);
  lay_out_grid(result, figures, drawing);
  const auto add = [&drawing](const std::vector<std::array<glm::dvec3, 2>>& lines, std::vector<SheetLine>& to) {
    for (const auto& [a, b] : lines) to.push_back({drawing.on_sheet(a), drawing.on_sheet(b)});
  };
  add(area.outline, drawing.outline);
  if (drawing.level) add(section_of(room, area.corner - below_area_m * upwards, area.normal), drawing.section);
  for (std::size_t c = 0; c < drawing.values.size(); ++c)
    drawing.inside.push_back(drawing.outline.empty() || is_inside(drawing.outline, drawing.centre(c)));
  draw_isolines(result, figures, drawing);
  return drawing;
}

ColourScale choose_area_scale(const Result& result, std::size_t area, const ScaleOptions& options) {
  const Area& own = result.areas[area].area;
  std::vector<std::pair<double, double>> lit;
  for (std::size_t k = 0; k < own.cells.size(); ++k) {
    const double value = result.receiver_results[own.first_receiver + k].irradiance;
    if (value > 0.0) lit.emplace_back(value, 1.0);
  }
  return scale_of(std::move(lit), result.quantity, options);
}

}  // namespace lichtmc
