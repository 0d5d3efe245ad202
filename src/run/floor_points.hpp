// Points at a height above the floors of a room's lit spaces: whether they are free.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "run/lit_space.hpp"

namespace lichtmc {

// What a point above a floor is.
// no_light: in a room that no light reaches.
enum class PointPlace { free, on_surface, in_furniture, in_wall, no_light, no_floor };

struct FloorPoint {
  PointPlace place = PointPlace::no_floor;
  double floor_m = 0.0;  // m, height of the floor under it; beside it if the line does not meet the floor
  double y = 0.0;        // m, of the point: of the surface that it lies on
};

class FloorPoints {
 public:
  // `space` must outlive it.
  explicit FloorPoints(const LitSpace& space);

  // Rooms with a floor, from below, then by position.
  const std::vector<std::size_t>& order() const { return order_; }
  // The numbers of a room's floors, from below.
  const std::vector<std::size_t>& floors_of(std::size_t room) const { return floors_of_[room]; }

  // The point of a line at a height above a floor of a room. no_floor: also if another floor lies below it.
  FloorPoint at(const Column& line, std::size_t room, std::size_t floor, double height_m) const;

  // The point of a line at a height y (m); a point on a surface is on its upper side. in_wall: in any closed body.
  struct Level {
    PointPlace place = PointPlace::no_floor;
    std::size_t room = no_number;  // in which it is free or on a surface
    double y = 0.0;
  };
  Level at_level(const Column& line, double y) const;

  // The height of the highest floor of a room not above a point of a line, at or beside the line; none: there is none.
  struct FloorBelow {
    std::size_t floor = no_number;
    double height_m = 0.0;
  };
  FloorBelow floor_below(const Column& line, std::size_t room, double y) const;

 private:
  // A floor at a line.
  struct FloorHere {
    double height = 0.0;    // m; beside the line if the line does not meet it
    double distance = 0.0;  // m, from the line to the nearest one of the raster on this floor
    bool under = false;     // the line meets it, and light gets there
    bool covered = false;   // the line meets it below a body
  };

  void number_rooms();
  std::optional<FloorHere> floor_at(const Column& line, std::size_t room, std::size_t floor) const;
  bool is_over_other_floor(const Column& line, std::size_t room, std::size_t floor, const FloorHere& here) const;
  PointPlace place_of(const Column& line, std::size_t room, double floor_height, bool floor_under, double& y) const;

  const ColumnTracer& tracer_;
  const LitRooms& lit_;
  std::vector<std::vector<std::size_t>> floors_of_;  // of each room, from below
  std::vector<std::size_t> order_;                   // rooms with floors
};

}  // namespace lichtmc
