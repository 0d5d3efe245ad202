#include "walk/face_triangles.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "chance/places.hpp"

namespace lichtmc {

FaceTriangles::FaceTriangles(const TileFaces& faces, std::size_t face, const Tracer& tracer)
    : tracer_(&tracer), area_m2_(faces.area_m2(face)), share_(faces.uncovered_share(face)) {
  const Surface& surface = faces.surface(face);
  for (const TilePiece& from : faces.pieces(face)) {
    Piece piece;
    for (std::size_t k = 0; k < 3; ++k) piece.corners[k] = point_at(surface, from.triangle, from.weights[k]);
    const ReferencePoint reference = faces.reference(face, {from.triangle, from.weights[0]});
    piece.normal = reference.normal;
    piece.step = start_of(reference, tracer) - tracer.tracer_point(reference.point);
    piece.up_to = from.area_up_to;
    pieces_.push_back(piece);
  }
  for (const Piece& piece : pieces_) centre_ += centroid_of(piece.corners) / static_cast<double>(pieces_.size());
  for (const Piece& piece : pieces_) {
    for (const glm::dvec3& corner : piece.corners) radius_m_ = std::max(radius_m_, glm::length(corner - centre_));
  }
}

FacePoint FaceTriangles::point(double u, double v) const {
  std::size_t k = 0;
  while (k + 1 < pieces_.size() && u >= pieces_[k].up_to) ++k;
  const double before = k > 0 ? pieces_[k - 1].up_to : 0.0;
  const double within = std::clamp((u - before) / (pieces_[k].up_to - before), 0.0, 1.0);
  const Triangle& t = pieces_[k].corners;
  return {k, point_of_triangle(t[0], t[1], t[2], uniform_on_triangle(within, v))};
}

}  // namespace lichtmc
