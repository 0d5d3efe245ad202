// The rooms of a building that light reaches, with their floors, found on a raster of vertical lines.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

#include "run/columns.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

inline constexpr std::size_t no_number = static_cast<std::size_t>(-1);

// A gap of a line of the raster.
struct LitGap {
  std::size_t column = 0;
  Gap gap;
  std::size_t room = no_number;   // number in LitRooms::rooms
  std::size_t floor = no_number;  // number in LitRooms::floors if its lower end is a floor
};

// A connected floor: steps up to the height of a stair's riser belong to it.
struct Floor {
  std::size_t room = no_number;
  double lowest = 0.0;  // m
};

// A space that light reaches; spaces that are connected by doors are one room.
struct LitRoom {
  glm::dvec2 low{0.0};  // m, (x, z), up to its walls
  glm::dvec2 high{0.0};
};

// A room without light: closed on all sides, at least 4 m² and 1 m wide, high enough to stand in.
struct DarkRoom {
  glm::dvec2 middle{0.0};  // m, (x, z)
  double area_m2 = 0.0;
  double floor_m = 0.0;  // lowest
};

// What light reaches is found by some flights of photons from the emitters, and from there to all places that are
// connected with it: so the insides of walls, furniture and the ground do not count, whatever the winding of their
// faces, nor do closed rooms without an emitter. Under the open sky outside a roofed building nothing counts.
//
// A floor is the lower end of such a gap where a person could stand (1.9 m, in small models half of the greatest
// height) somewhere on it, except the tops of furniture: of what has a gap below that is too low to stand in, and of
// closed bodies on a floor that are higher than 1.2 m or smaller than 6 m² (a quarter of the largest floor, if that is
// less). The others are podiums.
class LitRooms {
 public:
  LitRooms(const Scene& scene, ColumnTracer& tracer);

  const std::vector<LitRoom>& rooms() const { return rooms_; }
  const std::vector<Floor>& floors() const { return floors_; }
  const std::vector<LitGap>& gaps() const { return gaps_; }
  double spacing() const { return spacing_; }

  // Rooms under a roof that no light reaches, with surfaces whose fronts face into them: so the insides of bodies do
  // not count. Only for those who ask: none are known before find_dark_rooms().
  void find_dark_rooms();
  const std::vector<DarkRoom>& dark_rooms() const { return dark_rooms_; }
  // Whether a gap of another line belongs to one of them.
  bool is_dark(const Column& column, const Gap& gap) const;

  // The gap with this floor closest to (x, z), no_number if it is farther than `within_m`.
  std::size_t nearest_on_floor(std::size_t floor, const glm::dvec2& at, double within_m) const;
  // From a gap to (x, z), in m.
  double distance(std::size_t gap, const glm::dvec2& at) const;
  // Whether light reaches a gap of another line in this room: it is connected with one of the raster nearby.
  bool is_lit(const Column& column, const Gap& gap, std::size_t room) const;
  // Whether floors of a room lie on both sides of a point, along x or z.
  bool is_between_floors(const glm::dvec2& at, std::size_t room) const;
  // The raster: this many lines along x, and rows of them along z, row by row; each with its gaps.
  std::size_t lines_along_x() const { return columns_; }
  std::size_t lines_along_z() const { return rows_; }
  const Column& line(std::size_t k) const { return raster_[k]; }
  std::size_t first_gap(std::size_t k) const { return first_gap_[k]; }
  std::size_t nearest_line(const glm::dvec2& at) const { return column_at(at); }
  // The difference in height between a floor's neighbouring points.
  double step() const { return step_; }

 private:
  void make_raster();
  void light_gaps(const Scene& scene);
  void leave_out_the_sky();
  void connect();
  bool is_closed(const LitGap& gap) const;
  // Whether a gap of another line is connected with one of the raster nearby to which a test applies.
  template <class Applies>
  bool is_connected(const Column& column, const Gap& gap, const Applies& applies) const;
  bool connected(const glm::dvec2& a, const Gap& gap_a, const glm::dvec2& b, const Gap& gap_b) const;
  void find_floors();
  void measure_rooms();
  void use_floors(const std::vector<std::size_t>& patch_of, const std::vector<char>& is_floor);
  std::size_t column_at(const glm::dvec2& at) const;
  template <class Use>
  void for_each_neighbour(std::size_t column, const Use& use) const;

  ColumnTracer& tracer_;
  double spacing_ = 0.0;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  glm::dvec2 first_{0.0};
  double step_ = 0.0;
  double standing_ = 0.0;
  std::vector<Column> raster_;
  std::vector<std::size_t> first_gap_;  // of each column in gaps_; the last is their number
  std::vector<LitGap> gaps_;
  std::vector<char> lit_;  // of each gap
  std::vector<char> outdoors_;
  std::vector<LitRoom> rooms_;
  std::vector<Floor> floors_;
  std::vector<DarkRoom> dark_rooms_;
  std::vector<char> dark_;  // of each gap: part of a dark room
};

template <class Use>
void LitRooms::for_each_neighbour(std::size_t column, const Use& use) const {
  const std::size_t x = column % columns_;
  const std::size_t y = column / columns_;
  if (x > 0) use(column - 1);
  if (x + 1 < columns_) use(column + 1);
  if (y > 0) use(column - columns_);
  if (y + 1 < rows_) use(column + columns_);
}

template <class Applies>
bool LitRooms::is_connected(const Column& column, const Gap& gap, const Applies& applies) const {
  const std::size_t middle = column_at(column.at);
  bool found = false;
  const auto test = [&](std::size_t other) {
    for (std::size_t g = first_gap_[other]; !found && g < first_gap_[other + 1]; ++g)
      found = applies(g) && connected(column.at, gap, raster_[other].at, gaps_[g].gap);
  };
  test(middle);
  for_each_neighbour(middle, [&](std::size_t other) {
    test(other);
    if (found) return;
    for_each_neighbour(other, test);
  });
  return found;
}

}  // namespace lichtmc
