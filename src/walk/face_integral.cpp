#include "walk/face_integral.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "chance/places.hpp"

namespace lichtmc {

namespace {

constexpr double pi = std::numbers::pi;

// The position of a triangle in the beam of a point emitter.
struct InBeam {
  const PointLight& source;

  // The angle between the axis and the centre of the triangle; half_size: half the angle that the triangle subtends.
  double angle_to_centre(const Triangle& t, double& half_size) const {
    const glm::dvec3 segment = centroid_of(t) - source.position();
    const double distance = glm::length(segment);
    const double radius = radius_of(t);
    if (!(distance > radius)) {
      half_size = pi;
      return 0.0;
    }
    half_size = std::asin(radius / distance);
    const glm::dvec3 towards = segment / distance;
    return std::atan2(glm::length(glm::cross(towards, source.axis())), glm::dot(towards, source.axis()));
  }

  // The angle between the axis and the nearest direction to the triangle.
  double angle_off(const Triangle& t, double& half_size) const {
    return std::max(0.0, angle_to_centre(t, half_size) - half_size);
  }

  bool is_outside(const Triangle& t) const {
    double half_size = 0.0;
    return angle_off(t, half_size) > source.extent().half_angle;
  }

  // The irradiance changes over the distance from the emitter and over the width of its beam. In triangles smaller than
  // half of either, the difference of the two rules is a reliable error estimate.
  // Where the edge of a sharp beam crosses a triangle, all points of both rules may lie on one side of it. Of a
  // triangle up to some 1/25 is then counted wrongly (a corner beyond the point nearest to it). After n divisions the
  // edge crosses some 2 · 2ⁿ parts of 4⁻ⁿ of the area: 6 divisions leave at most 10⁻³ of the first triangle, with
  // either sign.
  bool coarse(const Triangle& t, int depth) const {
    double half_size = 0.0;
    const double angle = angle_to_centre(t, half_size);
    constexpr double half = 0.5;
    constexpr int divisions_at_edge = 6;
    const EmitterExtent& extent = source.extent();
    if (extent.sharp && depth < divisions_at_edge && std::abs(angle - extent.half_angle) < half_size) return true;
    return half_size > half || half_size > half * extent.width;
  }
};

}  // namespace

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
