#include "run/lit_rooms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/disjoint_sets.hpp"
#include "run/flight_points.hpp"

namespace lichtmc {

namespace {

constexpr double raster_m = 0.25;
constexpr double most_columns = 2.5e5;

// A stair's riser is up to 0.2 m high.
constexpr double riser_m = 0.25;
constexpr double standing_m = 1.9;
constexpr double podium_height_m = 1.2;
constexpr double podium_area_m2 = 6.0;

double overlap(const Gap& a, const Gap& b) {
  return std::min(a.high, b.high) - std::max(a.low, b.low);
}

// A floor and what lies on it, in numbers of gaps.
struct Patch {
  std::size_t gaps = 0;
  std::size_t standing = 0;    // high enough to stand in
  std::size_t over_low = 0;    // above a gap that is too low to stand in
  std::size_t over_space = 0;  // above another gap of the same line
  double lowest = std::numeric_limits<double>::infinity();
  bool furniture = false;
};

}  // namespace

LitRooms::LitRooms(const Scene& scene, ColumnTracer& tracer) : tracer_(tracer) {
  const glm::dvec3 size = tracer.high() - tracer.low();
  constexpr double part = 0.05;  // of the shorter side, in small rooms and models
  spacing_ = std::min(raster_m, part * std::min(size.x, size.z));
  spacing_ = std::max(spacing_, std::sqrt(size.x * size.z / most_columns));
  make_raster();
  light_gaps(scene);
  leave_out_the_sky();
  connect();
  find_floors();
  measure_rooms();
}

void LitRooms::make_raster() {
  const glm::dvec3 size = tracer_.high() - tracer_.low();
  const auto along = [this](double length) {
    return static_cast<std::size_t>(std::max(1.0, std::floor(length / spacing_)));
  };
  columns_ = along(size.x);
  rows_ = along(size.z);
  const glm::dvec3 middle = 0.5 * (tracer_.low() + tracer_.high());
  // Not exactly in the middle: walls often stand at round distances, and a line within a wall would connect its sides.
  constexpr glm::dvec2 aside(0.0173, -0.0119);
  first_ = glm::dvec2(middle.x, middle.z) + spacing_ * aside -
           0.5 * spacing_ * glm::dvec2(static_cast<double>(columns_ - 1), static_cast<double>(rows_ - 1));
  std::vector<glm::dvec2> places;
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::size_t column = 0; column < columns_; ++column)
      places.push_back(first_ + spacing_ * glm::dvec2(static_cast<double>(column), static_cast<double>(row)));
  }
  raster_ = tracer_.columns(places);
  for (std::size_t k = 0; k < raster_.size(); ++k) {
    first_gap_.push_back(gaps_.size());
    for (const Gap& gap : raster_[k].gaps) gaps_.push_back({k, gap, no_number, no_number});
  }
  first_gap_.push_back(gaps_.size());
  lit_.assign(gaps_.size(), 0);
  outdoors_.assign(gaps_.size(), 0);
}

std::size_t LitRooms::column_at(const glm::dvec2& at) const {
  const glm::dvec2 place = (at - first_) / spacing_;
  const auto clamped = [](double x, std::size_t n) {
    return static_cast<std::size_t>(std::clamp(std::lround(x), 0L, static_cast<long>(n) - 1));
  };
  return clamped(place.y, rows_) * columns_ + clamped(place.x, columns_);
}

// A point that light passes is connected with a gap of the line next to it if nothing is between them.
void LitRooms::light_gaps(const Scene& scene) {
  constexpr int attempts = 64;
  std::vector<int> tested(gaps_.size(), 0);
  for (const glm::dvec3& point : flight_points(scene)) {
    const std::size_t column = column_at({point.x, point.z});
    for (std::size_t g = first_gap_[column]; g < first_gap_[column + 1]; ++g) {
      const Gap& gap = gaps_[g].gap;
      if (lit_[g] != 0 || tested[g] >= attempts || point.y <= gap.low || point.y >= gap.high) continue;
      ++tested[g];
      const glm::dvec2& at = raster_[column].at;
      if (tracer_.sees(point, {at.x, point.y, at.y})) lit_[g] = 1;
    }
  }
}

// In a roofed building, gaps under the open sky are outside unless walls are around them (a hole in the roof).
void LitRooms::leave_out_the_sky() {
  std::size_t roofed = 0;
  std::size_t open = 0;
  double tallest = 0.0;
  for (std::size_t g = 0; g < gaps_.size(); ++g) {
    if (lit_[g] == 0) continue;
    ++(gaps_[g].gap.open_above ? open : roofed);
    if (!gaps_[g].gap.open_above) tallest = std::max(tallest, gaps_[g].gap.height());
  }
  if (tallest == 0.0) tallest = tracer_.high().y - tracer_.low().y;
  standing_ = std::min(standing_m, 0.5 * tallest);
  step_ = std::min(riser_m, 0.1 * tallest);
  if (open > roofed) return;
  for (std::size_t g = 0; g < gaps_.size(); ++g) {
    const LitGap& here = gaps_[g];
    if (!here.gap.open_above) continue;
    const glm::dvec2& at = raster_[here.column].at;
    const glm::dvec3 point(at.x, here.gap.low + std::min(1.0, 0.5 * standing_), at.y);
    int walls = 0;
    constexpr std::array<glm::dvec3, 4> sides{{{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}}};
    for (const glm::dvec3& side : sides) walls += std::isfinite(tracer_.distance(point, side)) ? 1 : 0;
    if (walls < 4) {
      outdoors_[g] = 1;
      lit_[g] = 0;
    }
  }
}

bool LitRooms::connected(const glm::dvec2& a, const Gap& gap_a, const glm::dvec2& b, const Gap& gap_b) const {
  const double low = std::max(gap_a.low, gap_b.low);
  const double high = std::min(gap_a.high, gap_b.high);
  if (high - low <= 4.0 * tracer_.rounding()) return false;
  // In the middle, at most at standing height, and near both ends.
  const double height = high - low;
  const double middle = low + std::min(0.5 * height, 0.5 * standing_m);
  return tracer_.sees(a, b, middle) || tracer_.sees(a, b, low + 0.1 * height) ||
         tracer_.sees(a, b, high - 0.1 * height);
}

// Light spreads from gap to gap; connected gaps are a room.
void LitRooms::connect() {
  DisjointSets<std::size_t> sets(gaps_.size());
  std::vector<std::size_t> front;
  for (std::size_t g = 0; g < gaps_.size(); ++g) {
    if (lit_[g] != 0) front.push_back(g);
  }
  while (!front.empty()) {
    const std::size_t g = front.back();
    front.pop_back();
    const std::size_t column = gaps_[g].column;
    for_each_neighbour(column, [&](std::size_t other) {
      for (std::size_t h = first_gap_[other]; h < first_gap_[other + 1]; ++h) {
        if (outdoors_[h] != 0 || (lit_[h] != 0 && sets.find(g) == sets.find(h))) continue;
        if (!connected(raster_[column].at, gaps_[g].gap, raster_[other].at, gaps_[h].gap)) continue;
        sets.join(g, h);
        if (lit_[h] != 0) continue;
        lit_[h] = 1;
        front.push_back(h);
      }
    });
  }
  std::map<std::size_t, std::size_t> room_of;
  for (std::size_t g = 0; g < gaps_.size(); ++g) {
    if (lit_[g] == 0) continue;
    gaps_[g].room = room_of.try_emplace(sets.find(g), room_of.size()).first->second;
  }
  rooms_.resize(room_of.size());
}

namespace {

// The lower ends of gaps that differ by no more than a step from a neighbour's.
template <class ForNeighbours>
std::vector<std::size_t> patches_of(const std::vector<LitGap>& gaps, const std::vector<std::size_t>& first_gap,
                                    double step, const ForNeighbours& for_each_neighbour) {
  DisjointSets<std::size_t> sets(gaps.size());
  for (std::size_t g = 0; g < gaps.size(); ++g) {
    if (gaps[g].room == no_number) continue;
    for_each_neighbour(gaps[g].column, [&](std::size_t other) {
      for (std::size_t h = first_gap[other]; h < first_gap[other + 1]; ++h) {
        if (gaps[h].room == gaps[g].room && std::abs(gaps[h].gap.low - gaps[g].gap.low) <= step &&
            overlap(gaps[g].gap, gaps[h].gap) > 0.0)
          sets.join(g, h);
      }
    });
  }
  std::vector<std::size_t> patch(gaps.size(), no_number);
  for (std::size_t g = 0; g < gaps.size(); ++g) {
    if (gaps[g].room != no_number) patch[g] = sets.find(g);
  }
  return patch;
}

}  // namespace

void LitRooms::find_floors() {
  const std::vector<std::size_t> patch_of = patches_of(
      gaps_, first_gap_, step_, [this](std::size_t column, const auto& use) { for_each_neighbour(column, use); });
  std::vector<Patch> patches(gaps_.size());
  for (std::size_t g = 0; g < gaps_.size(); ++g) {
    if (patch_of[g] == no_number) continue;
    Patch& patch = patches[patch_of[g]];
    const Gap& gap = gaps_[g].gap;
    ++patch.gaps;
    patch.lowest = std::min(patch.lowest, gap.low);
    if (gap.height() >= standing_) ++patch.standing;
    const std::size_t first = first_gap_[gaps_[g].column];
    for (std::size_t below = first; below < g; ++below) {
      if (gaps_[below].room == no_number) continue;
      ++patch.over_space;
      if (gap.low - gaps_[below].gap.low < standing_) ++patch.over_low;
      break;
    }
  }
  // Tops of closed bodies that stand on a larger floor.
  const double podium_height = std::min(podium_height_m, 6.0 * step_);
  std::vector<char> is_floor(gaps_.size(), 0);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const Patch& patch = patches[p];
    is_floor[p] = patch.gaps > 0 && 4 * patch.standing >= patch.gaps && 2 * patch.over_low < patch.gaps ? 1 : 0;
  }
  std::vector<double> largest(rooms_.size(), 0.0);  // m², of the floors of each room
  for (std::size_t g = 0; g < gaps_.size(); ++g) {
    if (patch_of[g] == no_number || is_floor[patch_of[g]] == 0) continue;
    double& area = largest[gaps_[g].room];
    area = std::max(area, static_cast<double>(patches[patch_of[g]].gaps) * spacing_ * spacing_);
  }
  for (std::size_t g = 0; g < gaps_.size(); ++g) {
    if (patch_of[g] == no_number || is_floor[patch_of[g]] == 0) continue;
    Patch& high = patches[patch_of[g]];
    if (2 * high.over_space > high.gaps) continue;  // a gallery or an upper storey
    for_each_neighbour(gaps_[g].column, [&](std::size_t other) {
      for (std::size_t h = first_gap_[other]; h < first_gap_[other + 1]; ++h) {
        if (gaps_[h].room != gaps_[g].room || patch_of[h] == patch_of[g] || is_floor[patch_of[h]] == 0) continue;
        const double rise = gaps_[g].gap.low - gaps_[h].gap.low;
        const Patch& low = patches[patch_of[h]];
        if (rise <= 0.0 || overlap(gaps_[g].gap, gaps_[h].gap) <= 0.0 || high.gaps >= low.gaps) continue;
        const double area = static_cast<double>(high.gaps) * spacing_ * spacing_;
        const double least = std::min(podium_area_m2, 0.25 * largest[gaps_[g].room]);
        if (rise > podium_height || area < least) high.furniture = true;
      }
    });
  }
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (patches[p].furniture) is_floor[p] = 0;
  }
  use_floors(patch_of, is_floor);
}

void LitRooms::use_floors(const std::vector<std::size_t>& patch_of, const std::vector<char>& is_floor) {
  std::map<std::size_t, std::size_t> number_of;
  for (std::size_t g = 0; g < gaps_.size(); ++g) {
    if (patch_of[g] == no_number || is_floor[patch_of[g]] == 0) continue;
    const auto [found, made] = number_of.try_emplace(patch_of[g], floors_.size());
    if (made) floors_.push_back({gaps_[g].room, gaps_[g].gap.low});
    gaps_[g].floor = found->second;
    Floor& floor = floors_[found->second];
    floor.lowest = std::min(floor.lowest, gaps_[g].gap.low);
  }
}

// How far the floors of each room extend: up to the walls, that is to what rays along the axes meet, no farther than
// one line of the raster beyond the last one with a floor.
void LitRooms::measure_rooms() {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (LitRoom& room : rooms_) room = {glm::dvec2(infinite), glm::dvec2(-infinite)};
  const glm::dvec2 low(tracer_.low().x, tracer_.low().z);
  const glm::dvec2 high(tracer_.high().x, tracer_.high().z);
  for (const LitGap& here : gaps_) {
    if (here.floor == no_number) continue;
    LitRoom& room = rooms_[here.room];
    const glm::dvec2& at = raster_[here.column].at;
    const glm::dvec3 point(at.x, here.gap.low + 0.5 * std::min(here.gap.height(), standing_), at.y);
    for (int k = 0; k < 2; ++k) {
      const glm::dvec3 axis = k == 0 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
      if (at[k] + spacing_ > room.high[k]) {
        const double far = std::min({at[k] + tracer_.distance(point, axis), at[k] + spacing_, high[k]});
        room.high[k] = std::max(room.high[k], far);
      }
      if (at[k] - spacing_ < room.low[k]) {
        const double far = std::max({at[k] - tracer_.distance(point, -axis), at[k] - spacing_, low[k]});
        room.low[k] = std::min(room.low[k], far);
      }
    }
  }
}

// Squares of lines about the place, from the inside: lines of a square are at least `ring` − 1 spacings away.
std::size_t LitRooms::nearest_on_floor(std::size_t floor, const glm::dvec2& at, double within_m) const {
  const auto rings = static_cast<long>(std::ceil(within_m / spacing_));
  const std::size_t middle = column_at(at);
  const long x0 = static_cast<long>(middle % columns_);
  const long y0 = static_cast<long>(middle / columns_);
  std::size_t nearest = no_number;
  double least = within_m;
  const auto test = [&](long x, long y) {
    if (x < 0 || y < 0 || x >= static_cast<long>(columns_) || y >= static_cast<long>(rows_)) return;
    const auto column = static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x);
    const double distance = glm::length(raster_[column].at - at);
    if (distance >= least) return;
    for (std::size_t g = first_gap_[column]; g < first_gap_[column + 1]; ++g) {
      if (gaps_[g].floor != floor) continue;
      least = distance;
      nearest = g;
    }
  };
  for (long ring = 0; ring <= rings && static_cast<double>(ring - 1) * spacing_ < least; ++ring) {
    for (long k = -ring; k <= ring; ++k) {
      test(x0 + k, y0 - ring);
      if (ring > 0) test(x0 + k, y0 + ring);
      if (std::abs(k) == ring) continue;
      test(x0 - ring, y0 + k);
      test(x0 + ring, y0 + k);
    }
  }
  return nearest;
}

double LitRooms::distance(std::size_t gap, const glm::dvec2& at) const {
  return glm::length(raster_[gaps_[gap].column].at - at);
}

bool LitRooms::is_between_floors(const glm::dvec2& at, std::size_t room) const {
  const std::size_t middle = column_at(at);
  const auto has_floor = [&](std::size_t column) {
    for (std::size_t g = first_gap_[column]; g < first_gap_[column + 1]; ++g) {
      if (gaps_[g].room == room && gaps_[g].floor != no_number) return true;
    }
    return false;
  };
  const std::size_t x = middle % columns_;
  const std::size_t y = middle / columns_;
  std::array<bool, 4> sides{};
  for (std::size_t k = 0; k < columns_; ++k) {
    if (k != x && has_floor(y * columns_ + k)) sides[k < x ? 0 : 1] = true;
  }
  for (std::size_t k = 0; k < rows_; ++k) {
    if (k != y && has_floor(k * columns_ + x)) sides[k < y ? 2 : 3] = true;
  }
  return (sides[0] && sides[1]) || (sides[2] && sides[3]);
}

bool LitRooms::is_lit(const Column& column, const Gap& gap, std::size_t room) const {
  return is_connected(column, gap, [this, room](std::size_t g) { return gaps_[g].room == room; });
}

}  // namespace lichtmc
