#include "lichtmc/receivers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "room/bounds.hpp"
#include "room/room_check.hpp"
#include "run/floor_points.hpp"
#include "run/lit_space.hpp"

namespace lichtmc {

namespace {

constexpr double most_points = 1e7;

void check_grid(double height_m, double spacing_m, const glm::dvec3& size) {
  if (!std::isfinite(height_m)) {
    throw InputError(
        "The height of the grid is " + to_text(height_m) +
        " m (allowed: a finite number). Give --grid the height above the floor in metres, for example 0.85.");
  }
  if (!(spacing_m > 0.0) || !std::isfinite(spacing_m)) {
    throw InputError("The spacing of the grid is " + to_text(spacing_m) +
                     " m (allowed: a finite number above 0). Give --grid-spacing a length in metres, for example 0.5.");
  }
  const double points = (size.x / spacing_m + 1.0) * (size.z / spacing_m + 1.0);
  if (points > most_points) {
    throw InputError("A spacing of " + to_text(spacing_m) + " m makes a grid of " + short_number(points) +
                     " points (allowed: up to 1e7). Give --grid-spacing a greater length.");
  }
}

// The number of points on a length; the margins at both ends are equal. Lengths are differences of float coordinates: a
// room of 5 m may be a few millionths shorter.
std::size_t points_along(double length_m, double spacing_m) {
  return static_cast<std::size_t>(std::max(1.0, std::floor(length_m / spacing_m + 1e-5)));
}

// The grids of all rooms.
class GridMaker {
 public:
  GridMaker(LitSpace& space, double height_m, double spacing_m)
      : tracer_(space.tracer), lit_(space.rooms), points_(space), height_(height_m), spacing_(spacing_m) {}

  ReceiverGrid make() {
    for (const std::size_t room : points_.order()) add_room(room);
    std::sort(grid_.floors_m.begin(), grid_.floors_m.end());
    constexpr double same_m = 1e-3;
    const auto same = [](double a, double b) { return b - a <= same_m; };
    grid_.floors_m.erase(std::unique(grid_.floors_m.begin(), grid_.floors_m.end(), same), grid_.floors_m.end());
    return std::move(grid_);
  }

 private:
  // Walls are where the bounds of all surfaces are, if nearly: a room of single faces extends exactly over them.
  void add_room(std::size_t number) {
    LitRoom room = lit_.rooms()[number];
    const double nearly = 0.1 * spacing_;
    for (int k = 0; k < 2; ++k) {
      const double low = tracer_.low()[2 * k];
      const double high = tracer_.high()[2 * k];
      if (room.low[k] - low < nearly) room.low[k] = low;
      if (high - room.high[k] < nearly) room.high[k] = high;
    }
    const std::size_t columns = points_along(room.high.x - room.low.x, spacing_);
    const std::size_t rows = points_along(room.high.y - room.low.y, spacing_);
    const glm::dvec2 middle = 0.5 * (room.low + room.high);
    std::vector<glm::dvec2> places;
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < columns; ++column) {
        const double x = middle.x + (static_cast<double>(column) - 0.5 * static_cast<double>(columns - 1)) * spacing_;
        const double z = middle.y + (static_cast<double>(row) - 0.5 * static_cast<double>(rows - 1)) * spacing_;
        places.emplace_back(x, z);
      }
    }
    const std::vector<Column> lines = tracer_.columns(places);
    const std::size_t before = grid_.receivers.size();
    std::vector<bool> used(lines.size(), false);
    for (std::size_t f = 0; f < points_.floors_of(number).size(); ++f) {
      for (std::size_t k = 0; k < lines.size(); ++k) {
        const std::string name =
            "grid" + tag(number, f) + "_" + std::to_string(k % columns) + "_" + std::to_string(k / columns);
        if (add_point(lines[k], number, points_.floors_of(number)[f], name)) used[k] = true;
      }
    }
    grid_.without_floor += static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
    if (grid_.receivers.size() > before) ++grid_.rooms;
  }

  std::string tag(std::size_t room, std::size_t floor) const {
    const bool several_floors = points_.floors_of(room).size() > 1;
    std::string text;
    if (points_.order().size() > 1 || several_floors) {
      const auto place = std::find(points_.order().begin(), points_.order().end(), room);
      text += std::to_string(place - points_.order().begin() + 1);
    }
    if (several_floors) text += "f" + std::to_string(floor + 1);
    return text;
  }

  // Whether there is a floor at a line; a point above it that is free becomes a receiver.
  bool add_point(const Column& line, std::size_t room, std::size_t floor, const std::string& name) {
    const FloorPoint point = points_.at(line, room, floor, height_);
    switch (point.place) {
      case PointPlace::no_floor:
        return false;
      case PointPlace::no_light:  // of points over a floor with light: none
      case PointPlace::in_wall:
        ++grid_.inside_walls;
        return true;
      case PointPlace::in_furniture:
        ++grid_.inside_furniture;
        return true;
      case PointPlace::on_surface:
        ++grid_.on_surfaces;
        break;
      case PointPlace::free:
        break;
    }
    grid_.floors_m.push_back(point.floor_m);
    grid_.receivers.push_back({name, {line.at.x, point.y, line.at.y}, {0.0, 1.0, 0.0}, 90.0, 1.0});
    return true;
  }

  ColumnTracer& tracer_;
  const LitRooms& lit_;
  FloorPoints points_;
  double height_;
  double spacing_;
  ReceiverGrid grid_;
};

}  // namespace

ReceiverGrid lay_receiver_grid(const Room& room, double height_m, double spacing_m) {
  check_surfaces(room);
  const Bounds bounds = bounds_of(room);
  check_grid(height_m, spacing_m, bounds.high - bounds.low);
  LitSpace space(room);
  ReceiverGrid grid = GridMaker(space, height_m, spacing_m).make();
  if (grid.receivers.empty()) {
    throw InputError("No point of the grid " + to_text(height_m) + " m above the floors of " + room.source +
                     " lies in a space that light reaches. Give --grid another height, or --grid-spacing a smaller "
                     "length.");
  }
  return grid;
}

std::vector<Receiver> receiver_grid(const Room& room, double height_m, double spacing_m) {
  return lay_receiver_grid(room, height_m, spacing_m).receivers;
}

std::string description_of(const ReceiverGrid& grid, double height_m) {
  constexpr int millimetres = 4;
  std::string text = to_text(grid.receivers.size(), "receiver") + " of the grid " + to_text(height_m) + " m above the ";
  if (grid.floors_m.size() == 1) {
    text += "floor at y = " + decimal(grid.floors_m.front(), millimetres) + " m";
  } else {
    text += "floors between y = " + decimal(grid.floors_m.front(), millimetres) + " m and " +
            decimal(grid.floors_m.back(), millimetres) + " m";
  }
  if (grid.rooms > 1) text += ", in " + to_text(grid.rooms, "room");
  if (grid.on_surfaces > 0) text += "; " + std::to_string(grid.on_surfaces) + " of them on table tops or the like";
  std::string left_out;
  const auto add = [&left_out](std::size_t n, const char* where) {
    if (n > 0) left_out += (left_out.empty() ? "" : ", ") + to_text(n, "point") + " " + where;
  };
  add(grid.inside_furniture, "inside furniture or other bodies");
  add(grid.inside_walls, "inside walls or where no light gets");
  add(grid.without_floor, "with no floor below");
  return text + (left_out.empty() ? "." : ". Left out: " + left_out + ".");
}

}  // namespace lichtmc
