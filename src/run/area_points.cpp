#include "run/area_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "run/area_places.hpp"
#include "run/lit_rooms.hpp"

namespace lichtmc {

namespace {

[[noreturn]] void refuse_property(const AreaProperties& properties, const char* what, const std::string& value,
                                  const char* allowed, const char* remedy) {
  throw InputError("The " + std::string(what) + " of the calculation area " + in_quotes(properties.name) + " is " +
                   value + " (allowed: " + allowed + "). " + remedy);
}

void check_numbers(const AreaProperties& p) {
  const auto above_0 = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (p.spacing_m && !above_0(*p.spacing_m))
    refuse_property(p, "spacing in m", to_text(*p.spacing_m), "a finite number above 0",
                    "Give it the greatest distance of two points, or none for the grid of EN 12464-1.");
  if (p.margin_m && !(*p.margin_m >= 0.0 && std::isfinite(*p.margin_m)))
    refuse_property(p, "margin in m", to_text(*p.margin_m), "a finite number, 0 or more",
                    "Give the width of the band along walls that is left out.");
  if (p.target_lx && !above_0(*p.target_lx))
    refuse_property(p, "target (target_lx)", to_text(*p.target_lx), "a finite number above 0",
                    "Give the maintained illuminance that is asked for, or none.");
  if (p.target_uniformity && !(*p.target_uniformity >= 0.0 && *p.target_uniformity <= 1.0))
    refuse_property(p, "target of the uniformity (target_uniformity)", to_text(*p.target_uniformity), "0 to 1",
                    "Give the ratio of the lowest to the mean illuminance that is asked for, or none.");
}

bool is_direction(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && (v.x != 0.0 || v.z != 0.0);
}

void check_quantity(const AreaProperties& p) {
  const std::string_view quantity = p.quantity ? to_string(*p.quantity) : "";
  if (p.quantity == AreaQuantity::semicylindrical && !p.direction)
    refuse_property(p, "direction", "not given", "a direction that is not vertical",
                    "Semicylindrical illuminance is that of a half cylinder that faces a direction: give it, for "
                    "example 1,0,0.");
  if (p.direction && p.quantity != AreaQuantity::semicylindrical)
    refuse_property(p, "quantity", quantity.empty() ? "not given" : in_quotes(quantity),
                    "semicylindrical where a direction is given", "Leave the direction out, or give that quantity.");
  if (p.direction && !is_direction(*p.direction))
    refuse_property(p, "direction",
                    to_text(p.direction->x) + "," + to_text(p.direction->y) + "," + to_text(p.direction->z),
                    "finite numbers, x or z other than 0", "Give a direction that is not vertical.");
}

Receiver receiver_of(const Area& area, const glm::dvec3& point) {
  Receiver receiver;
  receiver.position = point;
  switch (area.quantity) {
    case AreaQuantity::normal:
      receiver.normal = area.normal;
      break;
    case AreaQuantity::horizontal:
      break;
    case AreaQuantity::cylindrical:
      receiver.law = ReceiverLaw::cylindrical;
      break;
    case AreaQuantity::semicylindrical:
      receiver.law = ReceiverLaw::semicylindrical;
      receiver.facing = glm::normalize(glm::dvec3(area.properties.direction->x, 0.0, area.properties.direction->z));
      break;
  }
  if (area.properties.cells) {
    receiver.cell_u = area.u;
    receiver.cell_v = area.v;
  }
  return receiver;
}

void count_left_out(Area& area, const std::string& why) {
  const auto found = std::find_if(area.left_out.begin(), area.left_out.end(),
                                  [&why](const AreaLeftOut& one) { return one.why == why; });
  if (found != area.left_out.end()) {
    ++found->points;
  } else {
    area.left_out.push_back({why, 1});
  }
}

std::string list_of(const std::vector<AreaLeftOut>& left_out) {
  std::string text;
  for (const AreaLeftOut& one : left_out)
    text += (text.empty() ? "" : ", ") + to_text(static_cast<std::size_t>(one.points), "point") + " " + one.why;
  return text;
}

GridSize grid_for(const AreaProperties& properties, const glm::dvec2& size) {
  try {
    return properties.spacing_m ? grid_with_spacing(size.x, size.y, *properties.spacing_m)
                                : grid_of_en_12464(size.x, size.y);
  } catch (const InputError& error) {
    throw InputError("The calculation area " + in_quotes(properties.name) + " has too many points. " + error.what());
  }
}

// The mean over a cell is that of the irradiance of its own plane.
void check_cells_of(const Area& area) {
  if (!area.properties.cells) return;
  const bool planar = area.quantity == AreaQuantity::normal ||
                      (area.quantity == AreaQuantity::horizontal && area.normal == glm::dvec3(0.0, 1.0, 0.0));
  if (planar) return;
  throw InputError("The calculation area " + in_quotes(area.properties.name) +
                   " asks for means over its cells of the " + std::string(to_string(area.quantity)) +
                   " illuminance (allowed: of the illuminance on its own plane). Leave out 'cells', or give it the "
                   "quantity normal.");
}

}  // namespace

void check_properties(const Room& room, const AreaProperties& properties) {
  if (properties.name.empty())
    throw InputError(
        "A calculation area has no name (allowed: a name that no other area has). Give it a name: its files have it.");
  for (const Area& area : room.areas) {
    if (area.properties.name != properties.name) continue;
    throw InputError("There are two calculation areas with the name " + in_quotes(properties.name) + " in " +
                     room.source + " (allowed: one of each name). Rename one.");
  }
  check_numbers(properties);
  check_quantity(properties);
}

void refuse_empty(const AreaProperties& properties, double margin_m) {
  throw InputError("Nothing of the calculation area " + in_quotes(properties.name) + " is left inside its margin of " +
                   to_text(margin_m) + " m (allowed: a margin less than half of its width). Give it a smaller margin.");
}

Area area_in(const AreaPlane& plane, const PlaneRectangle& rectangle, const AreaProperties& properties,
             AreaQuantity quantity, double margin_m) {
  if (rectangle.empty()) refuse_empty(properties, margin_m);
  Area area;
  area.properties = properties;
  area.quantity = quantity;
  area.margin_m = margin_m;
  area.normal = plane.normal;
  const glm::dvec2 size = rectangle.size();
  const GridSize grid = grid_for(properties, size);
  area.columns = grid.columns;
  area.rows = grid.rows;
  area.corner = plane.in_space(rectangle.point(rectangle.low));
  const auto vector = [&plane](const glm::dvec2& p) { return p.x * plane.a + p.y * plane.b; };
  area.u = size.x / area.columns * vector(rectangle.along);
  area.v = size.y / area.rows * vector(rectangle.across());
  check_cells_of(area);
  return area;
}

void add_area(Room& room, Area area, const std::vector<AreaCell>& cells) {
  area.first_receiver = room.receivers.size();
  for (std::uint32_t k = 0; k < cells.size(); ++k) {
    if (!cells[k].left_out.empty()) {
      count_left_out(area, cells[k].left_out);
      continue;
    }
    Receiver receiver = receiver_of(area, cells[k].point);
    receiver.name =
        area.properties.name + "_" + std::to_string(k % area.columns) + "_" + std::to_string(k / area.columns);
    room.receivers.push_back(std::move(receiver));
    area.cells.push_back(k);
  }
  if (area.cells.empty()) {
    const bool dark = std::any_of(area.left_out.begin(), area.left_out.end(),
                                  [](const AreaLeftOut& one) { return one.why == no_light_gets_there; });
    throw InputError("No point of the calculation area " + in_quotes(area.properties.name) +
                     " lies in a space that light reaches (left out: " + list_of(area.left_out) + "). " +
                     (dark ? "Add a lamp there, or move the area."
                           : "Move it into a room with a lamp, or give it a smaller margin or spacing."));
  }
  room.areas.push_back(std::move(area));
}

namespace {

// Where an area looks that measures the illuminance on its own plane: "to −x"; empty for areas that look up.
std::string view_of(const Area& area) {
  constexpr double along = 0.9999;  // 0.8°
  if (area.quantity != AreaQuantity::normal || area.normal.y > along) return {};
  if (area.normal.y < -along) return "down";
  constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  for (int c = 0; c < 3; ++c) {
    if (std::abs(area.normal[c]) > along)
      return std::string("to ") + (area.normal[c] < 0.0 ? "−" : "+") + axes[static_cast<std::size_t>(c)];
  }
  return "to (" + decimal(area.normal.x, 2) + ", " + decimal(area.normal.y, 2) + ", " + decimal(area.normal.z, 2) + ")";
}

}  // namespace

namespace {

// Of the outline, along the sides of the grid, m.
glm::dvec2 drawn_size(const Area& area) {
  const auto extent = [&area](const glm::dvec3& edge) {
    const glm::dvec3 along = glm::normalize(edge);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const auto& line : area.outline) {
      for (const glm::dvec3& end : line) {
        low = std::min(low, glm::dot(end, along));
        high = std::max(high, glm::dot(end, along));
      }
    }
    return high - low;
  };
  return {extent(area.u), extent(area.v)};
}

glm::dvec2 grid_size(const Area& area) {
  return {area.columns * glm::length(area.u), area.rows * glm::length(area.v)};
}

// A thousandth may be the rounding of floats and of the raster on which the grid is fitted.
bool is_smaller_than_drawn(const Area& area) {
  constexpr double whole = 0.999;
  const glm::dvec2 drawn = drawn_size(area);
  const glm::dvec2 grid = grid_size(area);
  return grid.x < whole * drawn.x || grid.y < whole * drawn.y;
}

bool is_of_margin(const AreaLeftOut& left_out) {
  return left_out.why.starts_with("within ");
}

}  // namespace

void note_usual_margin(Area& area) {
  if (area.properties.margin_m || area.margin_m == 0.0 || !is_smaller_than_drawn(area)) return;
  const auto text = [](const glm::dvec2& size) { return rounded(size.x, 3) + " m × " + rounded(size.y, 3) + " m"; };
  area.notes.push_back("The usual margin of " + to_text(area.margin_m) + " m from walls leaves " +
                       text(grid_size(area)) + " of its " + text(drawn_size(area)) + ".");
}

bool is_cut_by_usual_margin(const Area& area) {
  if (area.properties.margin_m || area.margin_m == 0.0) return false;
  return is_smaller_than_drawn(area) || std::any_of(area.left_out.begin(), area.left_out.end(), is_of_margin);
}

std::uint64_t misplaced_points(const Area& area) {
  std::uint64_t points = 0;
  for (const AreaLeftOut& left_out : area.left_out) {
    if (left_out.why != outside_its_outline && !is_of_margin(left_out)) points += left_out.points;
  }
  return points;
}

std::string within(double margin_m, const char* of_what) {
  return "within " + to_text(margin_m) + " m of " + of_what;
}

std::string description_of(const Area& area) {
  constexpr int millimetres = 3;
  const auto length = [](double metres) { return rounded(metres, 3); };
  std::string text = "Area " + in_quotes(area.properties.name) + ": " + to_text(area.cells.size(), "point") + " of " +
                     std::to_string(area.columns) + " × " + std::to_string(area.rows) + ", spacing " +
                     length(glm::length(area.u)) + " m × " + length(glm::length(area.v)) + " m";
  if (area.above_floor_m) {
    text += ", " + decimal(*area.above_floor_m, millimetres) +
            " m above the floor at y = " + decimal(area.corner.y - *area.above_floor_m, millimetres + 1) + " m";
  }
  if (area.quantity == AreaQuantity::cylindrical || area.quantity == AreaQuantity::semicylindrical)
    text += ", " + std::string(to_string(area.quantity)) + " illuminance";
  if (const std::string view = view_of(area); !view.empty()) text += "; it looks " + view;
  text += area.left_out.empty() ? "." : ". Left out: " + list_of(area.left_out) + ".";
  for (const std::string& note : area.notes) text += " " + note;
  return text;
}

}  // namespace lichtmc
