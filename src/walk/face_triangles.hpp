// The triangles of a tile's face in the world, prepared for many random points.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "tracer/tracer.hpp"
#include "walk/tile_faces.hpp"
#include "walk/triangle_integral.hpp"

namespace lichtmc {

// A point of a face.
struct FacePoint {
  std::size_t triangle = 0;  // of FaceTriangles
  glm::dvec3 point{0.0};     // m
};

class FaceTriangles {
 public:
  // Of the parts of a face that are not covered.
  FaceTriangles(const TileFaces& faces, std::size_t face, const Tracer& tracer);

  std::size_t size() const { return pieces_.size(); }
  const Triangle& triangle(std::size_t k) const { return pieces_[k].corners; }
  const glm::dvec3& normal(std::size_t k) const { return pieces_[k].normal; }
  // A reference point at the first corner of a triangle.
  ReferencePoint reference(std::size_t k) const { return {pieces_[k].corners[0], pieces_[k].normal, 0.0}; }

  double area_m2() const { return area_m2_; }           // of the tile, with covered parts
  double share() const { return share_; }               // of it that is not covered
  const glm::dvec3& centre() const { return centre_; }  // of a ball that contains the face
  double radius_m() const { return radius_m_; }

  // The point that u, v in [0, 1) select, uniform over the area.
  FacePoint point(double u, double v) const;
  // Where rays from a point start, in the tracer's coordinates: one step off the surface.
  glm::dvec3 start(const FacePoint& at) const { return tracer_->tracer_point(at.point) + pieces_[at.triangle].step; }

 private:
  struct Piece {
    Triangle corners{};
    glm::dvec3 normal{0.0};
    glm::dvec3 step{0.0};  // tracer's coordinates
    double up_to = 0.0;    // share of the area in this triangle and those before it; 1 for the last
  };

  const Tracer* tracer_;
  std::vector<Piece> pieces_;
  double area_m2_;
  double share_;
  glm::dvec3 centre_{0.0};
  double radius_m_ = 0.0;
};

}  // namespace lichtmc
