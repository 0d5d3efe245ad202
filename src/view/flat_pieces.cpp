#include "view/flat_pieces.hpp"

#include <algorithm>
#include <numeric>

#include <glm/geometric.hpp>

#include "room/triangle_shapes.hpp"

namespace lichtmc {

namespace {

constexpr double same_direction = 0.99985;  // cos 1°: tolerance for manual modelling and rounding by exporters
constexpr double same_plane = 1e-3;         // tolerance, relative to the extent of the surface
constexpr int max_seeds = 200;              // a surface of more planes has no large ones

}  // namespace

std::vector<FlatPiece> flat_pieces(const Surface& surface, double least_m2) {
  const std::vector<TriangleShape> shapes = triangle_shapes(surface);
  const double thick = same_plane * largest_extent_m(surface);
  std::vector<std::uint32_t> left(shapes.size());
  std::iota(left.begin(), left.end(), 0U);
  std::stable_sort(left.begin(), left.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return shapes[a].area_m2 > shapes[b].area_m2; });
  double area_left = 0.0;
  for (const TriangleShape& shape : shapes) area_left += shape.area_m2;

  std::vector<FlatPiece> pieces;
  const auto corner = [&](std::uint32_t n, int k) { return surface.positions[surface.triangles[n][k]]; };
  for (int seed = 0; seed < max_seeds && !left.empty() && area_left >= least_m2; ++seed) {
    FlatPiece piece;
    piece.normal = shapes[left.front()].normal;
    const glm::dvec3 place = corner(left.front(), 0);
    const auto belongs = [&](std::uint32_t n) {
      if (!(glm::dot(shapes[n].normal, piece.normal) > same_direction)) return false;
      for (int k = 0; k < 3; ++k) {
        if (std::abs(glm::dot(corner(n, k) - place, piece.normal)) > thick) return false;
      }
      return true;
    };
    const auto rest = std::stable_partition(left.begin(), left.end(), belongs);
    if (rest == left.begin()) break;  // a triangle without area: in descending order, the rest has none either
    for (auto n = left.begin(); n != rest; ++n) {
      piece.triangles.push_back(*n);
      piece.area_m2 += shapes[*n].area_m2;
    }
    left.erase(left.begin(), rest);
    area_left -= piece.area_m2;
    if (piece.area_m2 >= least_m2) pieces.push_back(std::move(piece));
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const FlatPiece& a, const FlatPiece& b) { return a.area_m2 > b.area_m2; });
  return pieces;
}

}  // namespace lichtmc
