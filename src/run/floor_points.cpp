#include "run/floor_points.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace lichtmc {

FloorPoints::FloorPoints(const LitSpace& space) : tracer_(space.tracer), lit_(space.rooms) {
  number_rooms();
}

void FloorPoints::number_rooms() {
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

std::optional<FloorPoints::FloorHere> FloorPoints::floor_at(const Column& line, std::size_t room,
                                                            std::size_t floor) const {
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
bool FloorPoints::is_over_other_floor(const Column& line, std::size_t room, std::size_t floor,
                                      const FloorHere& here) const {
  const double storey = 8.0 * lit_.step();
  return std::any_of(floors_of_[room].begin(), floors_of_[room].end(), [&](std::size_t other) {
    if (other == floor) return false;
    const std::optional<FloorHere> there = floor_at(line, room, other);
    return there && std::abs(there->height - here.height) <= storey &&
           (there->under || there->distance < here.distance);
  });
}

FloorPoint FloorPoints::at(const Column& line, std::size_t room, std::size_t floor, double height_m) const {
  const std::optional<FloorHere> here = floor_at(line, room, floor);
  if (!here || (!here->under && is_over_other_floor(line, room, floor, *here))) return {};
  FloorPoint point{PointPlace::no_floor, here->height, here->height + height_m};
  point.place = place_of(line, room, here->height, here->under || here->covered, point.y);
  return point;
}

// y: becomes the height of the surface if the point lies on one.
PointPlace FloorPoints::place_of(const Column& line, std::size_t room, double floor_height, bool floor_under,
                                 double& y) const {
  const double rounding = tracer_.rounding();
  const auto under = std::find_if(line.gaps.rbegin(), line.gaps.rend(),
                                  [&](const Gap& gap) { return y >= gap.low - rounding && y < gap.high - rounding; });
  const PointPlace closed =
      floor_under || lit_.is_between_floors(line.at, room) ? PointPlace::in_furniture : PointPlace::in_wall;
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

FloorPoints::Level FloorPoints::at_level(const Column& line, double y) const {
  const double rounding = tracer_.rounding();
  const auto gap = std::find_if(line.gaps.rbegin(), line.gaps.rend(),
                                [&](const Gap& g) { return y >= g.low - rounding && y < g.high - rounding; });
  if (gap == line.gaps.rend()) return {PointPlace::no_floor, no_number, y};
  for (std::size_t room = 0; room < lit_.rooms().size(); ++room) {
    if (!lit_.is_lit(line, *gap, room)) continue;
    if (std::abs(y - gap->low) <= rounding) return {PointPlace::on_surface, room, gap->low};
    return {tracer_.on_surface({line.at.x, y, line.at.y}) ? PointPlace::in_wall : PointPlace::free, room, y};
  }
  if (gap->open_above) return {PointPlace::no_floor, no_number, y};
  return {lit_.is_dark(line, *gap) ? PointPlace::no_light : PointPlace::in_wall, no_number, y};
}

FloorPoints::FloorBelow FloorPoints::floor_below(const Column& line, std::size_t room, double y) const {
  FloorBelow below;
  for (const std::size_t floor : floors_of_[room]) {
    const std::optional<FloorHere> here = floor_at(line, room, floor);
    if (!here || here->height > y + tracer_.rounding()) continue;
    if (!here->under && !here->covered && is_over_other_floor(line, room, floor, *here)) continue;
    if (below.floor == no_number || here->height > below.height_m) below = {floor, here->height};
  }
  return below;
}

}  // namespace lichtmc
