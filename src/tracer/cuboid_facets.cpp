#include "tracer/cuboid_facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lichtmc {

namespace {

// A triangle as part of a face: its corners in the face's coordinates and in the surface's grid.
struct Piece {
  std::size_t surface = 0;
  bool front_along_axis = false;  // its normal points along the face's axis, not against it
  std::array<glm::dvec2, 3> st{};
  std::array<glm::dvec2, 3> cell{};
};

double twice_area(const std::array<glm::dvec2, 3>& corner) {
  const glm::dvec2 a = corner[1] - corner[0];
  const glm::dvec2 b = corner[2] - corner[0];
  return a.x * b.y - a.y * b.x;
}

// The affine transformation from face coordinates to cells that a piece's corners define.
struct FaceToCells {
  glm::dvec2 cell_0{0.0};
  glm::dmat2 slope{0.0};

  explicit FaceToCells(const Piece& piece) {
    const glm::dmat2 st(piece.st[1] - piece.st[0], piece.st[2] - piece.st[0]);
    const glm::dmat2 cells(piece.cell[1] - piece.cell[0], piece.cell[2] - piece.cell[0]);
    slope = cells * glm::inverse(st);
    cell_0 = piece.cell[0] - slope * piece.st[0];
  }
  glm::dvec2 operator()(const glm::dvec2& st) const { return cell_0 + slope * st; }
};

// UVs are floats in files: corners may deviate from the transformation by some roundings of the grid's extent.
bool follows(const FaceToCells& to_cells, const Piece& piece, double grid_extent) {
  constexpr double uv_roundings = 4.0 * 0x1p-23;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 miss = to_cells(piece.st[k]) - piece.cell[k];
    if (std::max(std::abs(miss.x), std::abs(miss.y)) > uv_roundings * grid_extent) return false;
  }
  return true;
}

// The facet that the pieces of a face form; none if they belong to different surfaces, face different sides or do not
// share one transformation to cells.
std::optional<Facet> facet_of_face(std::size_t axis, const std::vector<Piece>& pieces, double grid_extent) {
  const auto largest = std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
    return std::abs(twice_area(a.st)) < std::abs(twice_area(b.st));
  });
  const FaceToCells to_cells(*largest);
  for (const Piece& piece : pieces) {
    if (piece.surface != largest->surface || piece.front_along_axis != largest->front_along_axis) return std::nullopt;
    if (!follows(to_cells, piece, grid_extent)) return std::nullopt;
  }
  Facet facet;
  facet.surface = static_cast<std::uint32_t>(largest->surface);
  facet.normal[static_cast<glm::length_t>(axis)] = largest->front_along_axis ? 1.0F : -1.0F;
  facet.cell_0 = to_cells.cell_0;
  facet.cell_s = to_cells.slope[0];
  facet.cell_t = to_cells.slope[1];
  return facet;
}

double grid_extent(const Tiling& tiling, std::size_t surface) {
  double extent = 1.0;
  for (const TileMap& tile_map : tiling.maps) {
    if (tile_map.surface == surface)
      extent = std::max({extent, double{1} * tile_map.columns, double{1} * tile_map.rows});
  }
  return extent;
}

// Corners of a triangle in its face's coordinates.
Piece make_piece(const Room& room, const Tiling& tiling, const CuboidShape& shape, std::size_t k, std::size_t n) {
  const Surface& surface = room.surfaces[k];
  const glm::uvec3 corner = surface.triangles[n];
  const std::size_t axis = axis_of(shape.face_of_triangle[k][n]);
  const glm::dvec3& edge_s = shape.edges[s_axis(axis)];
  const glm::dvec3& edge_t = shape.edges[t_axis(axis)];
  Piece piece;
  piece.surface = k;
  piece.cell = tiling.cells[k][n];
  for (std::size_t c = 0; c < 3; ++c) {
    const glm::dvec3 from_corner = surface.positions[corner[static_cast<glm::length_t>(c)]] - shape.corner;
    piece.st[c] = {glm::dot(from_corner, edge_s) / glm::dot(edge_s, edge_s),
                   glm::dot(from_corner, edge_t) / glm::dot(edge_t, edge_t)};
  }
  // s × t points along the axis: the triangle's winding in (s, t) determines the direction of its front.
  piece.front_along_axis = twice_area(piece.st) > 0.0;
  return piece;
}

// The triangles of a room, sorted by the faces of the cuboid.
struct Faces {
  std::array<std::vector<Piece>, 6> pieces;             // of each face; without triangles that have no area
  std::vector<std::vector<TriangleOnFacet>> triangles;  // [surface][triangle]
};

Faces sort_by_face(const Room& room, const Tiling& tiling, const CuboidShape& shape) {
  Faces faces;
  faces.triangles.resize(room.surfaces.size());
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    for (std::size_t n = 0; n < room.surfaces[k].triangles.size(); ++n) {
      const Piece piece = make_piece(room, tiling, shape, k, n);
      const std::uint8_t face = shape.face_of_triangle[k][n];
      faces.triangles[k].push_back(
          {face, glm::vec2(piece.st[0]), glm::vec2(piece.st[1] - piece.st[0]), glm::vec2(piece.st[2] - piece.st[0])});
      if (twice_area(piece.st) != 0.0) faces.pieces[face].push_back(piece);
    }
  }
  return faces;
}

// The facets of all six faces; fewer if a face does not form one facet.
std::vector<Facet> make_facets(const Tiling& tiling, const std::array<std::vector<Piece>, 6>& pieces) {
  std::vector<Facet> facets;
  for (std::size_t face = 0; face < 6; ++face) {
    const auto facet = facet_of_face(axis_of(face), pieces[face], grid_extent(tiling, pieces[face].front().surface));
    if (!facet) break;
    facets.push_back(*facet);
  }
  return facets;
}

}  // namespace

std::optional<CuboidFacets> facets_of_cuboid(const Room& room, const Tiling& tiling, const CuboidShape& shape) {
  Faces faces = sort_by_face(room, tiling, shape);
  std::vector<Facet> facets = make_facets(tiling, faces.pieces);
  if (facets.size() < 6) return std::nullopt;
  return CuboidFacets{std::move(facets), std::move(faces.triangles)};
}

}  // namespace lichtmc
