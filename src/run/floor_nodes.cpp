#include "run/floor_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "base/disjoint_sets.hpp"

namespace lichtmc {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double over_furniture_m = 2.5;  // as far as the floor beside it counts
// Doors and windows, in steps of LitRooms (0.25 m in rooms of usual size): height and width of 2.5 m, 1.25 m².
constexpr double opening_steps = 10.0;
constexpr double opening_square_steps = 20.0;

// Lines of the raster along one axis, with one more beyond the bounds on each side.
std::vector<double> lines_with_ends(double first, double spacing, std::size_t count, double low, double high) {
  const double beyond = 0.1 * spacing;
  std::vector<double> lines{std::min(first - spacing, low - beyond)};
  for (std::size_t k = 0; k < count; ++k) lines.push_back(first + spacing * static_cast<double>(k));
  lines.push_back(std::max(lines.back() + spacing, high + beyond));
  return lines;
}

}  // namespace

FloorNodes::FloorNodes(LitSpace& space, std::size_t floor)
    : tracer_(space.tracer), lit_(space.rooms), floor_(floor), room_(space.rooms.floors()[floor].room) {
  const glm::dvec2 first = lit_.line(0).at;
  xs_ = lines_with_ends(first.x, lit_.spacing(), lit_.lines_along_x(), tracer_.low().x, tracer_.high().x);
  zs_ = lines_with_ends(first.y, lit_.spacing(), lit_.lines_along_z(), tracer_.low().z, tracer_.high().z);
  measure_heights();
  find_nodes();
  judge_lintels();
  find_barriers();
  judge_barriers();
  join_parts();
}

bool FloorNodes::is_raster(std::size_t node) const {
  const std::size_t i = node % width();
  const std::size_t j = node / width();
  return i > 0 && j > 0 && i + 1 < width() && j + 1 < height();
}

std::size_t FloorNodes::raster_line(std::size_t node) const {
  return (node / width() - 1) * lit_.lines_along_x() + node % width() - 1;
}

std::size_t FloorNodes::node_of(std::size_t line) const {
  return (line / lit_.lines_along_x() + 1) * width() + line % lit_.lines_along_x() + 1;
}

template <class Use>
void FloorNodes::for_each_around(std::size_t node, std::size_t radius, const Use& use) const {
  const std::size_t i = node % width();
  const std::size_t j = node / width();
  for (std::size_t y = j - std::min(j, radius); y <= std::min(j + radius, height() - 1); ++y) {
    for (std::size_t x = i - std::min(i, radius); x <= std::min(i + radius, width() - 1); ++x) use(y * width() + x);
  }
}

void FloorNodes::measure_heights() {
  const std::size_t n = width() * height();
  own_floor_.assign(n, unknown);
  near_floor_.assign(n, unknown);
  near_ceiling_.assign(n, unknown);
  other_floors_.resize(n);
  std::vector<double> own_ceiling(n, unknown);
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high(-low);
  for (const LitGap& gap : lit_.gaps()) {
    if (gap.room != room_ || gap.floor == no_number) continue;
    const std::size_t node = node_of(gap.column);
    if (gap.floor != floor_) {
      other_floors_[node].push_back(gap.gap.low);
      continue;
    }
    own_floor_[node] = gap.gap.low;
    own_ceiling[node] = gap.gap.high;
    low = glm::min(low, place(node));
    high = glm::max(high, place(node));
  }
  for (std::size_t node = 0; node < n; ++node) {
    if (std::isnan(own_floor_[node])) continue;
    near_floor_[node] = own_floor_[node];
    for_each_around(
        node, 2, [&](std::size_t other) { near_ceiling_[node] = std::fmax(near_ceiling_[node], own_ceiling[other]); });
  }
  const double reach = std::max(over_furniture_m, 2.0 * lit_.spacing());
  for (std::size_t node = 0; node < n; ++node) {
    const glm::dvec2 at = place(node);
    const bool close = glm::all(glm::greaterThan(at, low - reach)) && glm::all(glm::lessThan(at, high + reach));
    if (!close || !std::isnan(own_floor_[node])) continue;
    const std::size_t near = lit_.nearest_on_floor(floor_, at, reach);
    if (near == no_number) continue;
    near_floor_[node] = lit_.gaps()[near].gap.low;
    near_ceiling_[node] = near_ceiling_[node_of(lit_.gaps()[near].column)];
  }
}

// nearest: the node nearest to the line. is_lit(k): whether light of this room reaches gap k of the line.
template <class IsLit>
FloorNodes::Above FloorNodes::above(const Column& line, std::size_t nearest, const IsLit& is_lit) const {
  Above result;
  const double floor = near_floor_[nearest];
  const double ceiling = near_ceiling_[nearest];
  if (std::isnan(floor)) return result;
  bool on_floor = false;
  for (std::size_t k = 0; k < line.gaps.size(); ++k) {
    const Gap& gap = line.gaps[k];
    if (gap.low < floor - lit_.step() || gap.low >= ceiling - 4.0 * tracer_.rounding() || !is_lit(k)) continue;
    on_floor = on_floor || std::abs(gap.low - floor) <= lit_.step();
    result = {true, false, gap.low, gap.high};
  }
  if (!result.extends) return result;
  if (!on_floor) {
    bool other = false;  // a podium, or a gallery
    for_each_around(nearest, 1, [&](std::size_t node) {
      for (const double height : other_floors_[node]) other = other || std::abs(result.low - height) <= lit_.step();
    });
    if (other) return {};
  }
  result.under_lintel =
      result.high < ceiling - lit_.step() && result.high < floor + opening_steps * lit_.step() + tracer_.rounding();
  return result;
}

void FloorNodes::find_nodes() {
  above_.resize(width() * height());
  for (std::size_t node = 0; node < above_.size(); ++node) {
    if (!is_raster(node)) continue;
    const std::size_t line = raster_line(node);
    const std::size_t first = lit_.first_gap(line);
    above_[node] = above(lit_.line(line), node, [&](std::size_t k) { return lit_.gaps()[first + k].room == room_; });
  }
}

// Whether connected nodes are no larger than a door or window.
bool FloorNodes::is_opening(const std::vector<std::size_t>& nodes) const {
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high(-low);
  for (const std::size_t node : nodes) {
    low = glm::min(low, place(node));
    high = glm::max(high, place(node));
  }
  const double step = lit_.step();
  const double area = static_cast<double>(nodes.size()) * lit_.spacing() * lit_.spacing();
  return std::max(high.x - low.x, high.y - low.y) <= opening_steps * step && area <= opening_square_steps * step * step;
}

// Small parts that are lower than the room beside them, next to a wall, are its doors and windows.
void FloorNodes::judge_lintels() {
  under_lintel_.assign(above_.size(), 0);
  for (std::size_t seed = 0; seed < above_.size(); ++seed) {
    if (!above_[seed].under_lintel || under_lintel_[seed] != 0) continue;
    std::vector<std::size_t> found{seed};
    bool at_wall = false;
    under_lintel_[seed] = 1;
    for (std::size_t k = 0; k < found.size(); ++k) {
      for_each_around(found[k], 1, [&](std::size_t other) {
        at_wall = at_wall || !above_[other].extends;
        if (!above_[other].under_lintel || under_lintel_[other] != 0) return;
        under_lintel_[other] = 1;
        found.push_back(other);
      });
    }
    if (at_wall && is_opening(found)) continue;
    for (const std::size_t node : found) under_lintel_[node] = 2;
  }
  for (std::size_t node = 0; node < above_.size(); ++node) {
    if (under_lintel_[node] == 1) above_[node].extends = false;
  }
}

FloorNodes::Barrier FloorNodes::barrier(std::size_t a, std::size_t b) const {
  const double low = std::max(above_[a].low, above_[b].low);
  const double high = std::min(above_[a].high, above_[b].high);
  if (high - low <= 4.0 * tracer_.rounding()) return Barrier::nothing;
  constexpr double near_ceiling = 0.9;
  if (tracer_.sees(place(a), place(b), low + near_ceiling * (high - low))) return Barrier::nothing;
  return tracer_.sees(place(a), place(b), 0.5 * (low + high)) ? Barrier::above : Barrier::wall;
}

void FloorNodes::find_barriers() {
  wall_.assign(2 * above_.size(), Barrier::nothing);
  for (std::size_t node = 0; node < above_.size(); ++node) {
    for (const bool along_z : {false, true}) {
      if (!has_edge(node, along_z)) continue;
      const std::size_t e = edge(node, along_z);
      if (above_[node].extends && above_[second_node(e)].extends) wall_[e] = barrier(node, second_node(e));
    }
  }
}

// What crosses edges above only is the wall above a door if it is as small and next to a wall; else a beam, or a lamp.
void FloorNodes::judge_barriers() {
  std::vector<std::size_t> edges;
  for (std::size_t e = 0; e < wall_.size(); ++e) {
    if (wall_[e] == Barrier::above) edges.push_back(e);
  }
  std::map<std::size_t, std::size_t> number;
  for (const std::size_t e : edges) number.try_emplace(e, number.size());
  DisjointSets<std::size_t> groups(edges.size());
  std::vector<char> at_wall(edges.size(), 0);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    for_each_around(first_node(edges[k]), 1, [&](std::size_t other) {
      if (!above_[other].extends) at_wall[k] = 1;
      for (const std::size_t e : {edge(other, false), edge(other, true)}) {
        if (wall_[e] == Barrier::wall) at_wall[k] = 1;
        const auto found = number.find(e);
        if (found != number.end()) groups.join(k, found->second);
      }
    });
  }
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t k = 0; k < edges.size(); ++k) members[groups.find(k)].push_back(k);
  for (const auto& [root, group] : members) {
    std::vector<std::size_t> nodes;
    bool touches = false;
    for (const std::size_t k : group) {
      nodes.push_back(first_node(edges[k]));
      touches = touches || at_wall[k] != 0;
    }
    const Barrier what = touches && is_opening(nodes) ? Barrier::wall : Barrier::nothing;
    for (const std::size_t k : group) wall_[edges[k]] = what;
  }
}

void FloorNodes::join_parts() {
  DisjointSets<std::size_t> sets(above_.size());
  for (std::size_t node = 0; node < above_.size(); ++node) {
    for (const bool along_z : {false, true}) {
      if (!has_edge(node, along_z)) continue;
      const std::size_t e = edge(node, along_z);
      if (above_[node].extends && above_[second_node(e)].extends && !has_wall(e)) sets.join(node, second_node(e));
    }
  }
  part_.assign(above_.size(), no_number);
  std::map<std::size_t, std::size_t> number;
  for (std::size_t node = 0; node < above_.size(); ++node) {
    if (above_[node].extends) part_[node] = number.try_emplace(sets.find(node), number.size()).first->second;
  }
  parts_ = number.size();
}

// The farther one of what lies in the way near the ceiling and halfway: something may stand before the wall.
glm::dvec2 FloorNodes::wall_on(std::size_t from, std::size_t to) const {
  const double low = std::max(above_[from].low, above_[to].low);
  const double high = std::min(above_[from].high, above_[to].high);
  const glm::dvec2 way = place(to) - place(from);
  const double length = glm::length(way);
  double far = 0.0;
  for (const double share : {0.9, 0.5}) {
    const glm::dvec3 start(place(from).x, low + share * (high - low), place(from).y);
    const double distance = tracer_.distance(start, glm::dvec3(way.x, 0.0, way.y) / length);
    if (distance <= length) far = std::max(far, distance);
  }
  return place(from) + way * (far / length);
}

std::vector<bool> FloorNodes::extends_to(const std::vector<glm::dvec2>& places) const {
  std::vector<bool> extends;
  for (const Column& line : tracer_.columns(places)) {
    const std::size_t nearest = node_of(lit_.nearest_line(line.at));
    const Above here = above(line, nearest, [&](std::size_t k) { return lit_.is_lit(line, line.gaps[k], room_); });
    bool lower_part = !here.under_lintel;
    if (here.under_lintel)
      for_each_around(nearest, 1, [&](std::size_t node) { lower_part = lower_part || under_lintel_[node] == 2; });
    extends.push_back(here.extends && lower_part);
  }
  return extends;
}

}  // namespace lichtmc
