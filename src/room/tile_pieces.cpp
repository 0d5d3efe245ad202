#include "room/tile_pieces.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "chance/places.hpp"
#include "room/clip.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

namespace {

struct Cut {
  std::uint32_t tile = 0;
  double area_m2 = 0.0;
  TilePiece piece;
};

// The pieces of a surface's front tiles, in the order of its triangles.
std::vector<Cut> cuts_of(const Surface& surface, const TileMap& tile_map,
                         const std::vector<std::array<glm::dvec2, 3>>& cells) {
  std::vector<Cut> cuts;
  std::vector<CellTriangle> triangles;
  const std::vector<TriangleShape> shapes = triangle_shapes(surface);
  for (std::uint32_t n = 0; n < shapes.size(); ++n) {
    const double area = shapes[n].area_m2;
    if (!(area > 0.0)) continue;
    cut_into_triangles(cells[n], tile_map.columns, tile_map.rows, triangles);
    for (const CellTriangle& one : triangles) {
      const std::uint32_t tile = tile_map.tile_of_cell[std::size_t{one.row} * tile_map.columns + one.column];
      if (tile != no_tile) cuts.push_back({tile, one.share * area, {0.0, one.weights, n}});
    }
  }
  return cuts;
}

}  // namespace

TilePieces::TilePieces(const Room& room, const Tiling& tiling)
    : first_(tiling.tiles.size()), count_(tiling.tiles.size()) {
  for (const TileMap& tile_map : tiling.maps) {
    if (tile_map.side == Side::back) continue;
    std::vector<Cut> cuts = cuts_of(room.surfaces[tile_map.surface], tile_map, tiling.cells[tile_map.surface]);
    std::stable_sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.tile < b.tile; });
    for (std::size_t k = 0; k < cuts.size();) {
      std::size_t end = k;
      double area = 0.0;
      for (; end < cuts.size() && cuts[end].tile == cuts[k].tile; ++end) area += cuts[end].area_m2;
      first_[cuts[k].tile] = pieces_.size();
      count_[cuts[k].tile] = static_cast<std::uint32_t>(end - k);
      double sum = 0.0;
      for (; k < end; ++k) {
        sum += cuts[k].area_m2;
        cuts[k].piece.area_up_to = sum / area;
        pieces_.push_back(cuts[k].piece);
      }
      pieces_.back().area_up_to = 1.0;
    }
  }
  // A back side has the front's pieces.
  for (std::size_t m = 0; m < tiling.maps.size(); ++m) {
    if (tiling.maps[m].side == Side::front) continue;
    const std::vector<std::uint32_t>& front = tiling.maps[m - 1].tile_of_cell;
    const std::vector<std::uint32_t>& back = tiling.maps[m].tile_of_cell;
    for (std::size_t cell = 0; cell < back.size(); ++cell) {
      if (back[cell] == no_tile) continue;
      first_[back[cell]] = first_[front[cell]];
      count_[back[cell]] = count_[front[cell]];
    }
  }
}

SurfacePlace place_on(std::span<const TilePiece> pieces, double u, double v) {
  assert(!pieces.empty());
  const auto found = std::upper_bound(pieces.begin(), pieces.end(), u,
                                      [](double share, const TilePiece& piece) { return share < piece.area_up_to; });
  const auto chosen = found == pieces.end() ? pieces.end() - 1 : found;
  const double before = chosen == pieces.begin() ? 0.0 : (chosen - 1)->area_up_to;
  const double within = (u - before) / (chosen->area_up_to - before);
  const glm::dvec2 weights = uniform_on_triangle(std::clamp(within, 0.0, 1.0), v);
  const glm::dvec2& a = chosen->weights[0];
  return {chosen->triangle, a + weights.x * (chosen->weights[1] - a) + weights.y * (chosen->weights[2] - a)};
}

std::optional<UncoveredPieces> uncovered_pieces(std::span<const TilePiece> pieces, std::size_t surface, bool behind,
                                                const Room& room, const FacesInOnePlane& planes) {
  if (std::none_of(pieces.begin(), pieces.end(), [&](const TilePiece& piece) {
        return planes.may_be_covered(planes.number_of(surface, piece.triangle), behind);
      }))
    return std::nullopt;
  UncoveredPieces part;
  double whole = 0.0;
  double sum = 0.0;
  // Areas in m²: barycentric coordinates times twice the area of the triangle.
  const auto twice_area = [&](std::uint32_t triangle) {
    const glm::dvec3 a = point_at(room.surfaces[surface], triangle, {0.0, 0.0});
    return glm::length(glm::cross(point_at(room.surfaces[surface], triangle, {1.0, 0.0}) - a,
                                  point_at(room.surfaces[surface], triangle, {0.0, 1.0}) - a));
  };
  for (const TilePiece& piece : pieces) {
    const double scale = 0.5 * twice_area(piece.triangle);
    const ConvexPolygon all(piece.weights.begin(), piece.weights.end());
    whole += scale * std::abs(twice_signed_area(all));
    for (const ConvexPolygon& polygon : planes.uncovered(planes.number_of(surface, piece.triangle), behind, all)) {
      for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        const ConvexPolygon triangle{polygon[0], polygon[k], polygon[k + 1]};
        const double area = scale * std::abs(twice_signed_area(triangle));
        if (!(area > 0.0)) continue;
        sum += area;
        part.pieces.push_back({sum, {polygon[0], polygon[k], polygon[k + 1]}, piece.triangle});
      }
    }
  }
  for (TilePiece& piece : part.pieces) piece.area_up_to /= sum;
  if (!part.pieces.empty()) part.pieces.back().area_up_to = 1.0;
  part.share = sum / whole;
  return part;
}

glm::dvec3 point_at(const Surface& surface, std::uint32_t triangle, const glm::dvec2& weights) {
  const glm::uvec3 corner = surface.triangles[triangle];
  const glm::dvec3& a = surface.positions[corner.x];
  return a + weights.x * (surface.positions[corner.y] - a) + weights.y * (surface.positions[corner.z] - a);
}

}  // namespace lichtmc
