#include "walk/light_on_face.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "chance/places.hpp"

namespace lichtmc {

namespace {

constexpr double pi = std::numbers::pi;

// A light with more triangles is not integrated, and not intersected by flights: that would cost more than samples.
constexpr std::size_t most_triangles = 64;

// Places on the face and on the light, divided into strata by turns.
constexpr std::array<std::uint8_t, 4> face_and_light{0, 2, 1, 3};

}  // namespace

std::span<const std::uint8_t> PointOnFace::dimensions() const {
  static constexpr std::array<std::uint8_t, 2> of_place{0, 1};
  return of_place;
}

void PointOnFace::sample(const UnitPoint& at, std::vector<Connection>& found) {
  const FaceIntegral::LitPoint lit = integral_.point(at[0], at[1]);
  here_.point = lit.place.point;
  here_.normal = face_.normal(lit.place.triangle);
  const double irradiance = source_.sample_light(here_).irradiance;
  if (irradiance > 0.0) found.push_back({irradiance * lit.share, lit.place, source_.position()});
}

bool OpeningOnFace::is_dark() const {
  for (std::size_t k = 0; k < face_.size(); ++k) {
    const ReferencePoint reference = face_.reference(k);
    if (glm::dot(source_.position() - reference.point, reference.normal) > -source_.reach_m()) return false;
  }
  return true;
}

std::span<const std::uint8_t> OpeningOnFace::dimensions() const {
  return face_and_light;
}

void OpeningOnFace::sample(const UnitPoint& at, std::vector<Connection>& found) {
  const FacePoint from = face_.point(at[0], at[1]);
  here_.point = from.point;
  here_.normal = face_.normal(from.triangle);
  const LightSample sample = source_.sample_light(here_, source_.place(at[2], at[3]));
  if (sample.irradiance > 0.0) found.push_back({face_.share() * sample.irradiance, from, sample.target});
}

// The density of flights per area of the light is at most 1/(π d²) at a distance d. Where that is more than the density
// of uniform points, samples of these vary by more than the strata even out.
AreaOnFace::AreaOnFace(const FaceTriangles& face, const AreaLight& source) : face_(face), source_(source) {
  for (std::size_t k = 0; k < face.size() && dark_; ++k) dark_ = !source.reaches_above_horizon(face.reference(k));
  if (dark_) return;
  const double distance = std::max(0.0, source.least_distance_m(face.centre()) - face.radius_m());
  near_ = pi * distance * distance < source.area_m2();
}

std::span<const std::uint8_t> AreaOnFace::dimensions() const {
  return face_and_light;
}

void AreaOnFace::sample(const UnitPoint& at, std::vector<Connection>& found) {
  const FacePoint from = face_.point(at[0], at[1]);
  here_.point = from.point;
  here_.normal = face_.normal(from.triangle);
  const LightSample sample = source_.sample_evenly(here_, at[2], at[3]);
  if (sample.irradiance > 0.0) {
    const double pdf_light = sample.relative / source_.area_m2();
    const double weight = near_ ? pdf_light / (pdf_light + sample.pdf_bsdf) : 1.0;
    found.push_back({face_.share() * weight * sample.irradiance, from, sample.target});
  }
  if (near_) add_flight(from, at, found);
}

void AreaOnFace::add_flight(const FacePoint& from, const UnitPoint& at, std::vector<Connection>& found) {
  hits_.clear();
  source_.add_fronts_hit(here_, sample_cosine_cone(frame_about(here_.normal), 1.0, at[2], at[3]).direction, hits_);
  for (const LightSample& hit : hits_) {
    const double pdf_light = hit.relative / source_.area_m2();
    const double weight = hit.pdf_bsdf / (hit.pdf_bsdf + pdf_light);
    found.push_back({face_.share() * weight * hit.irradiance, from, hit.target});
  }
}

bool AreaOnFace::has_many_triangles() const {
  return source_.triangles() > most_triangles;
}

bool AreaOnFace::integrate(const IntegralAccuracy& accuracy) {
  if (!source_.has_closed_form() || has_many_triangles()) return false;
  integral_ = FaceIntegral::by_polygons(face_, source_, accuracy);
  return true;
}

// A triangle of the light costs about half of a sample at each point of the rules, of which a face needs some hundred
// where samples vary so much that integration is considered.
double AreaOnFace::integration_cost() const {
  constexpr double points = 500.0;
  constexpr double of_triangle = 0.5;
  return points * of_triangle * static_cast<double>(source_.triangles());
}

}  // namespace lichtmc
