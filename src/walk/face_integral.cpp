#include "walk/face_integral.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "chance/places.hpp"
#include "walk/in_beam.hpp"

namespace lichtmc {

// Integrates light(reference point) over the pieces of the face for which may_receive(reference point) is true.
template <class Light, class MayReceive, class Coarse, class IsZero>
void FaceIntegral::integrate_pieces(const Light& light, const MayReceive& may_receive, const Coarse& coarse,
                                    const IsZero& is_zero, const IntegralAccuracy& accuracy) {
  for (std::size_t n = 0; n < face_->size(); ++n) {
    ReferencePoint reference = face_->reference(n);
    if (!may_receive(reference)) continue;
    const auto at = [&](const glm::dvec3& point) {
      reference.point = point;
      return light(reference);
    };
    const std::size_t before = leaves_.size();
    integrate(face_->triangle(n), at, coarse, is_zero, accuracy.relative, accuracy.absolute, leaves_);
    for (std::size_t k = before; k < leaves_.size(); ++k) leaves_[k].part = n;
  }
  for (const IntegratedTriangle& leaf : leaves_) {
    up_to_.push_back(sum_ += leaf.integral);
    error_ += leaf.error;
  }
}

FaceIntegral FaceIntegral::by_point(const FaceTriangles& face, const PointLight& source,
                                    const IntegralAccuracy& accuracy) {
  FaceIntegral integral(face);
  const InBeam beam{source};
  integral.integrate_pieces([&](const ReferencePoint& reference) { return source.sample_light(reference).irradiance; },
                            [&](const ReferencePoint& reference) {
                              return glm::dot(source.position() - reference.point, reference.normal) > 0.0;
                            },
                            [&](const Triangle& t, int depth) { return beam.coarse(t, depth); },
                            [&](const Triangle& t) { return beam.is_outside(t); }, accuracy);
  return integral;
}

FaceIntegral FaceIntegral::by_polygons(const FaceTriangles& face, const AreaLight& source,
                                       const IntegralAccuracy& accuracy) {
  FaceIntegral integral(face);
  const auto no = [](const Triangle&, int = 0) { return false; };
  integral.integrate_pieces([&](const ReferencePoint& reference) { return source.polygon_irradiance(reference); },
                            [&](const ReferencePoint& reference) { return source.reaches_above_horizon(reference); },
                            no, no, accuracy);
  return integral;
}

FaceIntegral::LitPoint FaceIntegral::point(double u, double v) const {
  const double light = u * sum_;
  const auto found = std::upper_bound(up_to_.begin(), up_to_.end(), light);
  const std::size_t k = std::min<std::size_t>(static_cast<std::size_t>(found - up_to_.begin()), leaves_.size() - 1);
  const IntegratedTriangle& leaf = leaves_[k];
  const double within = (light - (up_to_[k] - leaf.integral)) / leaf.integral;
  const Triangle& t = leaf.triangle;
  const glm::dvec2 weights = uniform_on_triangle(std::clamp(within, 0.0, 1.0), v);
  return {{leaf.part, point_of_triangle(t[0], t[1], t[2], weights)}, mean() * area_of(t) / leaf.integral};
}

}  // namespace lichtmc
