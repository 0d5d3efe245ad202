// The irradiance by an emitter without shadows, integrated over the face of a tile, and points of the face distributed
// like it.
#pragma once

#include <cstddef>
#include <vector>

#include "walk/face_triangles.hpp"
#include "walk/light_source.hpp"
#include "walk/triangle_integral.hpp"

namespace lichtmc {

// Triangles are divided until the error of each is at most `relative` times its integral, or `absolute` (W/m² or lx)
// times its area.
struct IntegralAccuracy {
  double relative = 1e-3;
  double absolute = 0.0;
};

// The triangles into which a face was divided; those without light are left out.
class FaceIntegral {
 public:
  // The triangles must outlive the integral. Of a point emitter: also divided until they are small against their
  // distance from it and the width of its beam.
  static FaceIntegral by_point(const FaceTriangles& face, const PointLight& source, const IntegralAccuracy& accuracy);
  // Of an area light with a closed form.
  static FaceIntegral by_polygons(const FaceTriangles& face, const AreaLight& source, const IntegralAccuracy& accuracy);

  bool empty() const { return leaves_.empty(); }
  // The mean irradiance of the face, and a bound of its error.
  double mean() const { return sum_ / face_->area_m2(); }
  double error() const { return error_ / face_->area_m2(); }

  // The point selected by u, v in [0, 1): u selects a triangle in proportion to its integral, both a uniform point of
  // it.
  struct LitPoint {
    FacePoint place;
    double share = 0.0;  // the irradiance at the point times this has the mean mean()
  };
  LitPoint point(double u, double v) const;

 private:
  explicit FaceIntegral(const FaceTriangles& face) : face_(&face) {}
  template <class Light, class MayReceive, class Coarse, class IsZero>
  void integrate_pieces(const Light& light, const MayReceive& may_receive, const Coarse& coarse, const IsZero& is_zero,
                        const IntegralAccuracy& accuracy);

  const FaceTriangles* face_;
  std::vector<IntegratedTriangle> leaves_;
  std::vector<double> up_to_;  // running sum of their integrals
  double sum_ = 0.0;
  double error_ = 0.0;
};

}  // namespace lichtmc
