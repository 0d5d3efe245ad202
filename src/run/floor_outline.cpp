#include "run/floor_outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "run/floor_nodes.hpp"
#include "run/outline_corners.hpp"

namespace lichtmc {

namespace {

// A crossing of a wall with an edge of the raster, seen from one of its nodes: 2 · edge, + 1 from the second node.
using Crossing = std::size_t;

class OutlineTracer {
 public:
  OutlineTracer(LitSpace& space, std::size_t floor) : space_(space), nodes_(space, floor) {}

  std::vector<FloorPart> parts() {
    link_crossings();
    place_crossings();
    parts_.resize(nodes_.parts());
    close_outlines();
    add_inner_walls();
    measure();
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      if (parts_[k].area_m2 > 0.0) order.push_back(k);
    }
    std::sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) { return first_[a] < first_[b]; });
    std::vector<FloorPart> sorted;
    for (const std::size_t k : order) sorted.push_back(std::move(parts_[k]));
    return sorted;
  }

 private:
  std::size_t inner_node(Crossing crossing) const {
    return crossing % 2 == 0 ? nodes_.first_node(crossing / 2) : nodes_.second_node(crossing / 2);
  }
  std::size_t outer_node(Crossing crossing) const { return inner_node(crossing ^ 1U); }

  // In every cell of the raster, counter-clockwise in (x, z): where a part begins along its sides is linked to where it
  // ended before. Marching squares, with the floor on the left; parts that touch in a corner stay apart.
  void link_crossings() {
    const std::size_t w = nodes_.width();
    for (std::size_t node = 0; node + w + 1 < w * nodes_.height(); ++node) {
      if (node % w + 1 == w) continue;
      const std::array<std::size_t, 4> corner{node, node + 1, node + w + 1, node + w};
      const std::array<std::size_t, 4> side{FloorNodes::edge(node, false), FloorNodes::edge(node + 1, true),
                                            FloorNodes::edge(node + w, false), FloorNodes::edge(node, true)};
      std::set<std::size_t> here;
      for (const std::size_t c : corner) here.insert(nodes_.part(c));
      if (here.size() == 1) continue;
      for (const std::size_t part : here) {
        if (part != no_number) link_in_cell(part, corner, side);
      }
    }
  }

  void link_in_cell(std::size_t part, const std::array<std::size_t, 4>& corner,
                    const std::array<std::size_t, 4>& side) {
    const auto inside = [&](std::size_t k) { return nodes_.part(corner[k % 4]) == part; };
    const auto crossing = [&](std::size_t k, std::size_t inner) {
      return 2 * side[k % 4] + (nodes_.first_node(side[k % 4]) == inner ? 0 : 1);
    };
    for (std::size_t k = 0; k < 4; ++k) {
      if (!inside(k) || inside(k + 1)) continue;
      std::size_t begin = k + 4;  // side by which the part was entered
      while (!(inside(begin) && !inside(begin - 1))) --begin;
      next_[crossing(k, corner[k])] = crossing(begin - 1, corner[begin % 4]);
    }
  }

  // By halving the way from a node of the floor to one beside it, unless a thin wall stands between two floors.
  void place_crossings() {
    struct Way {
      Crossing crossing;
      glm::dvec2 inside, outside;
    };
    std::vector<Way> ways;
    for (const auto& [crossing, next] : next_) {
      const std::size_t inner = inner_node(crossing);
      const std::size_t outer = outer_node(crossing);
      if (nodes_.part(outer) != no_number) {
        place_[crossing] = nodes_.wall_on(inner, outer);
      } else {
        ways.push_back({crossing, nodes_.place(inner), nodes_.place(outer)});
      }
    }
    const double enough = 0.25 * space_.tracer.rounding();
    const double length = 2.0 * space_.rooms.spacing();
    for (double width = length; width > enough; width *= 0.5) {
      std::vector<glm::dvec2> middles;
      for (const Way& way : ways) middles.push_back(0.5 * (way.inside + way.outside));
      const std::vector<bool> extends = nodes_.extends_to(middles);
      for (std::size_t k = 0; k < ways.size(); ++k) (extends[k] ? ways[k].inside : ways[k].outside) = middles[k];
    }
    for (const Way& way : ways) place_[way.crossing] = 0.5 * (way.inside + way.outside);
  }

  void close_outlines() {
    std::set<Crossing> seen;
    for (const auto& [start, unused] : next_) {
      std::vector<glm::dvec2> points;
      for (Crossing at = start; seen.insert(at).second; at = next_.at(at)) points.push_back(place_.at(at));
      if (points.size() < 3) continue;
      const std::vector<glm::dvec2> corners =
          polygon_through(points, space_.rooms.spacing(), 2.0 * space_.tracer.rounding());
      FloorPart& part = parts_[nodes_.part(inner_node(start))];
      for (std::size_t k = 0; k < corners.size(); ++k)
        part.outline.push_back({corners[k], corners[(k + 1) % corners.size()]});
    }
    for (FloorPart& part : parts_) part.walls = part.outline;
  }

  // Thin walls with the same part on both sides: lines between the places where neighbouring edges meet them.
  void add_inner_walls() {
    const std::size_t w = nodes_.width();
    for (std::size_t node = 0; node < w * nodes_.height(); ++node) {
      for (const bool along_z : {false, true}) {
        if (!is_inner_wall(node, along_z)) continue;
        const std::size_t second = nodes_.second_node(FloorNodes::edge(node, along_z));
        const std::size_t aside = node + (along_z ? 1 : w);
        const bool goes_on = aside < w * nodes_.height() && is_inner_wall(aside, along_z);
        std::vector<PlanLine>& walls = parts_[nodes_.part(node)].walls;
        for (const auto& [from, to] : {std::pair(node, second), std::pair(second, node)}) {
          const std::size_t shift = aside - node;
          const glm::dvec2 here = nodes_.wall_on(from, to);
          walls.push_back({here, goes_on ? nodes_.wall_on(from + shift, to + shift) : here});
        }
      }
    }
  }

  bool is_inner_wall(std::size_t node, bool along_z) const {
    if (!nodes_.has_edge(node, along_z)) return false;
    const std::size_t edge = FloorNodes::edge(node, along_z);
    return nodes_.has_wall(edge) && nodes_.part(node) == nodes_.part(nodes_.second_node(edge));
  }

  void measure() {
    std::vector<std::vector<double>> heights(parts_.size());
    first_.assign(parts_.size(), {std::numeric_limits<double>::infinity(), 0.0});
    for (std::size_t node = 0; node < nodes_.width() * nodes_.height(); ++node) {
      const std::size_t part = nodes_.part(node);
      if (part == no_number) continue;
      const glm::dvec2 at = nodes_.place(node);
      first_[part] = std::min(first_[part], std::pair(at.y, at.x));
      if (!std::isnan(nodes_.floor_height(node))) heights[part].push_back(nodes_.floor_height(node));
    }
    const double square = space_.rooms.spacing() * space_.rooms.spacing();
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      if (heights[k].empty()) continue;  // nowhere on the floor
      std::sort(heights[k].begin(), heights[k].end());
      FloorPart& part = parts_[k];
      part.area_m2 = static_cast<double>(heights[k].size()) * square;
      part.lowest_m = heights[k].front();
      part.highest_m = heights[k].back();
      part.floor_m = most_frequent(heights[k]);
    }
  }

  // Of sorted heights; those that differ by less than 1 mm are the same.
  static double most_frequent(const std::vector<double>& heights) {
    constexpr double same_m = 1e-3;
    double best = heights.front();
    std::size_t most = 0;
    for (std::size_t first = 0, last = 0; first < heights.size(); first = last) {
      while (last < heights.size() && heights[last] - heights[first] < same_m) ++last;
      if (last - first > most) {
        most = last - first;
        best = heights[first + (last - first) / 2];
      }
    }
    return best;
  }

  LitSpace& space_;
  FloorNodes nodes_;
  std::map<Crossing, Crossing> next_;
  std::map<Crossing, glm::dvec2> place_;
  std::vector<FloorPart> parts_;
  std::vector<std::pair<double, double>> first_;  // of each part, (z, x) of its first node
};

}  // namespace

std::vector<FloorPart> parts_of_floor(LitSpace& space, std::size_t floor) {
  return OutlineTracer(space, floor).parts();
}

bool is_within(const std::vector<PlanLine>& outline, const glm::dvec2& at) {
  bool within = false;
  for (const auto& [a, b] : outline) {
    if ((a.y > at.y) == (b.y > at.y)) continue;
    if (at.x < a.x + (b.x - a.x) * ((at.y - a.y) / (b.y - a.y))) within = !within;
  }
  return within;
}

double distance_to(const std::vector<PlanLine>& lines, const glm::dvec2& at) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : lines) {
    const glm::dvec2 way = b - a;
    const double square = glm::dot(way, way);
    const double share = square > 0.0 ? std::clamp(glm::dot(at - a, way) / square, 0.0, 1.0) : 0.0;
    least = std::min(least, glm::length(a + share * way - at));
  }
  return least;
}

}  // namespace lichtmc
