#include "view/plan_subjects.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "room/mesh_links.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

namespace {

constexpr double min_area_share = 0.02;  // of the room's surface area, for a plan
constexpr std::size_t max_parts = 12;    // of a readable tile map
constexpr double least_part = 0.05;      // of the longer side of the map
constexpr double readable_share = 0.9;   // of the cells
constexpr double side_share = 0.01;      // of a body's area, for one of its plane sides
constexpr double plane_share = 0.9;      // of the area of a body with plane sides

// Whether the connected parts of a tile map are few and large.
bool is_readable(const TileMap& map) {
  const std::size_t columns = map.columns;
  const std::size_t rows = map.rows;
  const double least = least_part * static_cast<double>(std::max(columns, rows));
  std::vector<bool> seen(columns * rows);
  std::size_t parts = 0;
  std::size_t cells = 0;
  std::size_t in_large = 0;
  std::vector<std::size_t> queue;
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (seen[first] || map.tile_of_cell[first] == no_tile) continue;
    if (++parts > max_parts) return false;
    std::size_t left = columns;
    std::size_t right = 0;
    std::size_t top = rows;
    std::size_t bottom = 0;
    seen[first] = true;
    queue.assign(1, first);
    for (std::size_t at = 0; at < queue.size(); ++at) {
      const std::size_t x = queue[at] % columns;
      const std::size_t y = queue[at] / columns;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
      for (std::size_t v = y > 0 ? y - 1 : 0; v <= std::min(y + 1, rows - 1); ++v) {
        for (std::size_t u = x > 0 ? x - 1 : 0; u <= std::min(x + 1, columns - 1); ++u) {
          const std::size_t cell = v * columns + u;
          if (seen[cell] || map.tile_of_cell[cell] == no_tile) continue;
          seen[cell] = true;
          queue.push_back(cell);
        }
      }
    }
    cells += queue.size();
    if (static_cast<double>(std::min(right - left, bottom - top) + 1) >= least) in_large += queue.size();
  }
  return static_cast<double>(in_large) >= readable_share * static_cast<double>(cells);
}

// Whether the connected pieces of a surface are few, but for a tenth of its area.
bool has_few_pieces(const Surface& surface) {
  const std::vector<TriangleShape> shapes = triangle_shapes(surface);
  const MeshLinks links(surface);
  std::vector<bool> seen(shapes.size());
  std::vector<double> areas;
  std::vector<std::size_t> queue;
  for (std::size_t first = 0; first < shapes.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = true;
    queue.assign(1, first);
    areas.push_back(0.0);
    for (std::size_t at = 0; at < queue.size(); ++at) {
      areas.back() += shapes[queue[at]].area_m2;
      for (std::size_t edge = 0; edge < 3; ++edge) {
        for (const std::uint32_t other : links.at_edge(queue[at], edge)) {
          if (!seen[other]) queue.push_back(other);
          seen[other] = true;
        }
      }
    }
  }
  std::sort(areas.begin(), areas.end(), std::greater<>());
  const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
  areas.resize(std::min(areas.size(), max_parts));
  return std::accumulate(areas.begin(), areas.end(), 0.0) >= readable_share * all;
}

bool has_plane_sides(const Surface& surface) {
  const double area = surface_area(surface);
  double plane = 0.0;
  for (const FlatPiece& piece : flat_pieces(surface, side_share * area)) plane += piece.area_m2;
  return plane >= plane_share * area;
}

class Subjects {
 public:
  Subjects(const Room& room, const Result& result, const LitSides& lit) : room_(&room), result_(&result), lit_(&lit) {
    double area = 0.0;
    for (const Surface& surface : room.surfaces) area += surface_area(surface);
    for (std::size_t m = 0; m < result.tiling.maps.size(); ++m) add(m, min_area_share * area);
    std::stable_sort(found_.subjects.begin(), found_.subjects.end(),
                     [](const PlanSubject& a, const PlanSubject& b) { return a.piece.area_m2 > b.piece.area_m2; });
  }

  PlanSubjects take() { return std::move(found_); }

 private:
  void add(std::size_t m, double least_m2) {
    const TileMap& map = result_->tiling.maps[m];
    const Surface& surface = room_->surfaces[map.surface];
    const double area = result_->surfaces[m].area_m2;
    if (area < least_m2) return;
    double flat = 0.0;
    for (FlatPiece& piece : flat_pieces(surface, least_m2)) {
      flat += piece.area_m2;
      const auto [front, back] = lit_areas(map.surface, piece);
      if (has_lit(map, front, back))
        found_.subjects.push_back({m, std::move(piece), is_split(map) ? map.side == Side::back : back > front});
    }
    if (flat >= 0.5 * area) return;
    PlanSubject whole{m, {}, false};
    whole.piece.area_m2 = area;
    FlatPiece all;
    all.triangles.resize(surface.triangles.size());
    std::iota(all.triangles.begin(), all.triangles.end(), 0U);
    const auto [front, back] = lit_areas(map.surface, all);
    if (!has_lit(map, front, back)) return;
    if (is_readable(map) && has_few_pieces(surface) && !has_plane_sides(surface))
      found_.subjects.push_back(std::move(whole));
    else if (flat == 0.0)
      found_.small_parts.push_back(m);
  }

  // Whether the surface has a tile map for either side.
  bool is_split(const TileMap& map) const { return room_->surfaces[map.surface].sides == Sides::both; }
  bool has_lit(const TileMap& map, double front, double back) const {
    if (is_split(map)) return (map.side == Side::front ? front : back) > 0.0;
    return front > 0.0 || back > 0.0;
  }

  // Area in m² with a lit front face, and with a lit back face.
  std::pair<double, double> lit_areas(std::size_t surface, const FlatPiece& piece) const {
    double front = 0.0;
    double back = 0.0;
    for (const std::uint32_t n : piece.triangles) {
      const SideLight& side = (*lit_)[surface][n];
      const Surface& own = room_->surfaces[surface];
      const glm::dvec3 a = own.positions[own.triangles[n].x];
      const double area =
          0.5 * glm::length(glm::cross(own.positions[own.triangles[n].y] - a, own.positions[own.triangles[n].z] - a));
      front += side.front ? area : 0.0;
      back += side.back ? area : 0.0;
    }
    return {front, back};
  }

  const Room* room_;
  const Result* result_;
  const LitSides* lit_;
  PlanSubjects found_;
};

}  // namespace

PlanSubjects plan_subjects(const Room& room, const Result& result, const LitSides& lit) {
  return Subjects(room, result, lit).take();
}

}  // namespace lichtmc
