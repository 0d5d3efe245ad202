// Rooms that no light reaches.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/disjoint_sets.hpp"
#include "run/lit_rooms.hpp"

namespace lichtmc {

bool LitRooms::is_dark(const Column& column, const Gap& gap) const {
  return !dark_rooms_.empty() && is_connected(column, gap, [this](std::size_t g) { return dark_[g] != 0; });
}

bool LitRooms::is_closed(const LitGap& gap) const {
  const glm::dvec2& at = raster_[gap.column].at;
  const glm::dvec3 point(at.x, gap.gap.low + std::min(1.0, 0.5 * gap.gap.height()), at.y);
  constexpr std::array<glm::dvec3, 6> axes{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  return std::all_of(axes.begin(), axes.end(),
                     [&](const glm::dvec3& axis) { return tracer_.meets_front(point, axis); });
}

namespace {

// The members of squares of `side` × `side` members.
std::vector<char> in_squares(const std::vector<char>& members, std::size_t columns, std::size_t side) {
  const std::size_t rows = members.size() / columns;
  std::vector<char> found(members.size(), 0);
  for (std::size_t y = 0; y + side <= rows; ++y) {
    for (std::size_t x = 0; x + side <= columns; ++x) {
      bool all = true;
      for (std::size_t k = 0; all && k < side * side; ++k) all = members[(y + k / side) * columns + x + k % side] != 0;
      for (std::size_t k = 0; all && k < side * side; ++k) found[(y + k / side) * columns + x + k % side] = 1;
    }
  }
  return found;
}

}  // namespace

void LitRooms::find_dark_rooms() {
  constexpr double least_m2 = 4.0;
  constexpr double least_width_m = 1.0;
  dark_.assign(gaps_.size(), 0);
  const auto may_be = [this](std::size_t g) {
    return lit_[g] == 0 && outdoors_[g] == 0 && !gaps_[g].gap.open_above && gaps_[g].gap.height() >= standing_;
  };
  DisjointSets<std::size_t> sets(gaps_.size());
  for (std::size_t g = 0; g < gaps_.size(); ++g) {
    if (!may_be(g)) continue;
    const std::size_t column = gaps_[g].column;
    for_each_neighbour(column, [&](std::size_t other) {
      for (std::size_t h = first_gap_[other]; other > column && h < first_gap_[other + 1]; ++h) {
        if (may_be(h) && sets.find(g) != sets.find(h) &&
            connected(raster_[column].at, gaps_[g].gap, raster_[other].at, gaps_[h].gap))
          sets.join(g, h);
      }
    });
  }
  std::map<std::size_t, std::vector<std::size_t>> parts;
  for (std::size_t g = 0; g < gaps_.size(); ++g) {
    if (may_be(g)) parts[sets.find(g)].push_back(g);
  }
  const double cell_m2 = spacing_ * spacing_;
  const auto side = static_cast<std::size_t>(std::max(1.0, std::ceil(least_width_m / spacing_ - 1e-9)));
  for (const auto& [root, part] : parts) {
    if (static_cast<double>(part.size()) * cell_m2 < least_m2) continue;
    std::vector<char> members(raster_.size(), 0);
    for (const std::size_t g : part) members[gaps_[g].column] = 1;
    const std::vector<char> wide = in_squares(members, columns_, side);
    DarkRoom room;
    room.floor_m = std::numeric_limits<double>::infinity();
    std::size_t closed = 0;
    std::size_t cells = 0;
    for (const std::size_t g : part) {
      if (wide[gaps_[g].column] == 0) continue;
      ++cells;
      closed += is_closed(gaps_[g]) ? 1U : 0U;
      room.middle += raster_[gaps_[g].column].at;
      room.floor_m = std::min(room.floor_m, gaps_[g].gap.low);
    }
    room.area_m2 = static_cast<double>(cells) * cell_m2;
    if (room.area_m2 < least_m2 || 2 * closed < cells) continue;
    room.middle /= static_cast<double>(cells);
    for (const std::size_t g : part) dark_[g] = 1;
    dark_rooms_.push_back(room);
  }
}

}  // namespace lichtmc
