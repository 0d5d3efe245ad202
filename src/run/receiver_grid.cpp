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
#include "run/columns.hpp"
#include "run/lit_rooms.hpp"
#include "walk/inside.hpp"
#include "walk/scene.hpp"

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

// The room, with an emitter if it has none.
Room lit_room(const Room& room, const Tiling& tiling, const Bounds& bounds) {
  Room lit = room;
  lit.receivers.clear();
  if (lit.emitters.empty()) {
    const InsidePoint inside = find_inside(room, *make_embree_tracer(room, tiling), bounds.low, bounds.high);
    lit.emitters = {{"inside", 1.0, IsotropicEmitter{inside.place}}};
  }
  check_room(lit);
  return lit;
}

// What a point of a grid is.
enum class PointPlace { free, on_surface, in_furniture, in_wall, no_floor };

// The grids of all rooms.
class GridMaker {
 public:
  GridMaker(const Scene& scene, ColumnTracer& tracer, double height_m, double spacing_m)
      : tracer_(tracer), lit_(scene, tracer), height_(height_m), spacing_(spacing_m) {}

  ReceiverGrid make() {
    number_rooms();
    for (const std::size_t room : order_) add_room(room);
    std::sort(grid_.floors_m.begin(), grid_.floors_m.end());
    constexpr double same_m = 1e-3;
    const auto same = [](double a, double b) { return b - a <= same_m; };
    grid_.floors_m.erase(std::unique(grid_.floors_m.begin(), grid_.floors_m.end(), same), grid_.floors_m.end());
    return std::move(grid_);
  }

 private:
  // Rooms with a floor, from below, then by position.
  void number_rooms() {
    floors_of_.resize(lit_.rooms().size());
    for (std::size_t f = 0; f < lit_.floors().size(); ++f) floors_of_[lit_.floors()[f].room].push_back(f);
    for (std::size_t r = 0; r < floors_of_.size(); ++r) {
      std::vector<std::size_t>& floors = floors_of_[r];
      if (floors.empty()) continue;
      std::sort(floors.begin(), floors.end(),
                [this](std::size_t a, std::size_t b) { return lit_.floors()[a].lowest < lit_.floors()[b].lowest; });
      order_.push_back(r);
    }
    const auto key = [this](std::size_t r) {
      const LitRoom& room = lit_.rooms()[r];
      return std::tuple(std::round(lit_.floors()[floors_of_[r].front()].lowest / lit_.step()), room.low.y, room.low.x);
    };
    std::sort(order_.begin(), order_.end(), [&key](std::size_t a, std::size_t b) { return key(a) < key(b); });
  }

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
    for (std::size_t f = 0; f < floors_of_[number].size(); ++f) {
      for (std::size_t k = 0; k < lines.size(); ++k) {
        const std::string name =
            "grid" + tag(number, f) + "_" + std::to_string(k % columns) + "_" + std::to_string(k / columns);
        if (add_point(lines[k], number, floors_of_[number][f], name)) used[k] = true;
      }
    }
    grid_.without_floor += static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
    if (grid_.receivers.size() > before) ++grid_.rooms;
  }

  std::string tag(std::size_t room, std::size_t floor) const {
    const bool several_floors = floors_of_[room].size() > 1;
    std::string text;
    if (order_.size() > 1 || several_floors) {
      const auto place = std::find(order_.begin(), order_.end(), room);
      text += std::to_string(place - order_.begin() + 1);
    }
    if (several_floors) text += "f" + std::to_string(floor + 1);
    return text;
  }

  // A floor at a line.
  struct FloorHere {
    double height = 0.0;    // m; beside the line if the line does not meet it
    double distance = 0.0;  // m, from the line to the nearest one of the raster on this floor
    bool under = false;     // the line meets it, and light gets there
    bool covered = false;   // the line meets it below a body
  };

  std::optional<FloorHere> floor_at(const Column& line, std::size_t room, std::size_t floor) const {
    constexpr double reach_m = 2.5;  // over furniture, the floor beside it counts
    const std::size_t near = lit_.nearest_on_floor(floor, line.at, std::max(reach_m, 2.0 * lit_.spacing()));
    if (near == no_number) return std::nullopt;
    const double beside = lit_.gaps()[near].gap.low;
    FloorHere here{beside, lit_.distance(near, line.at)};
    double least = lit_.step();
    for (const Gap& gap : line.gaps) {
      if (std::abs(gap.low - beside) > least) continue;
      least = std::abs(gap.low - beside);
      here.height = gap.low;
      here.under = here.distance <= 2.0 * lit_.spacing() && lit_.is_lit(line, gap, room);
      here.covered = !here.under;
    }
    return here;
  }

  // Whether another floor of the room is the one below a line that does not meet this one: a podium, or a nearer floor
  // less than a storey higher or lower.
  bool is_over_other_floor(const Column& line, std::size_t room, std::size_t floor, const FloorHere& here) const {
    const double storey = 8.0 * lit_.step();
    return std::any_of(floors_of_[room].begin(), floors_of_[room].end(), [&](std::size_t other) {
      if (other == floor) return false;
      const std::optional<FloorHere> there = floor_at(line, room, other);
      return there && std::abs(there->height - here.height) <= storey &&
             (there->under || there->distance < here.distance);
    });
  }

  // Whether there is a floor at a line; a point above it that is free becomes a receiver.
  bool add_point(const Column& line, std::size_t room, std::size_t floor, const std::string& name) {
    const std::optional<FloorHere> here = floor_at(line, room, floor);
    if (!here || (!here->under && is_over_other_floor(line, room, floor, *here))) return false;
    const double floor_height = here->height;
    const bool floor_under = here->under || here->covered;
    double y = floor_height + height_;
    switch (place_of(line, room, floor_height, floor_under, y)) {
      case PointPlace::no_floor:
        return false;
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
    grid_.floors_m.push_back(floor_height);
    grid_.receivers.push_back({name, {line.at.x, y, line.at.y}, {0.0, 1.0, 0.0}, 90.0, 1.0});
    return true;
  }

  // y: becomes the height of the surface if the point lies on one.
  PointPlace place_of(const Column& line, std::size_t room, double floor_height, bool floor_under, double& y) const {
    const double rounding = tracer_.rounding();
    const auto under = std::find_if(line.gaps.rbegin(), line.gaps.rend(),
                                    [&](const Gap& gap) { return y >= gap.low - rounding && y < gap.high - rounding; });
    const PointPlace closed = floor_under || lit_.is_between_floors(line.at, room) ? PointPlace::in_furniture : PointPlace::in_wall;
    if (under == line.gaps.rend()) return line.gaps.empty() ? PointPlace::no_floor : closed;
    if (!lit_.is_lit(line, *under, room)) return under->open_above ? PointPlace::no_floor : closed;
    // Over a stairwell, the next surface below is that of another floor.
    if (under->low < floor_height - lit_.step()) return PointPlace::no_floor;
    if (std::abs(y - under->low) <= rounding) {
      const bool on_floor = std::abs(under->low - floor_height) <= rounding;
      y = under->low;
      return on_floor ? PointPlace::free : PointPlace::on_surface;
    }
    return tracer_.on_surface({line.at.x, y, line.at.y}) ? PointPlace::in_wall : PointPlace::free;
  }

  ColumnTracer& tracer_;
  LitRooms lit_;
  double height_;
  double spacing_;
  std::vector<std::vector<std::size_t>> floors_of_;  // of each room, from below
  std::vector<std::size_t> order_;                   // rooms with floors
  ReceiverGrid grid_;
};

}  // namespace

ReceiverGrid lay_receiver_grid(const Room& room, double height_m, double spacing_m) {
  check_surfaces(room);
  const Bounds bounds = bounds_of(room);
  check_grid(height_m, spacing_m, bounds.high - bounds.low);
  const Tiling tiling = make_tiling(room, std::numeric_limits<double>::max());
  const Room lit = lit_room(room, tiling, bounds);
  const Scene scene(lit, tiling, Engine::embree);
  ColumnTracer tracer(lit, *scene.tracer);
  ReceiverGrid grid = GridMaker(scene, tracer, height_m, spacing_m).make();
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
