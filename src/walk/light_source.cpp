#include "walk/light_source.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "chance/choice.hpp"
#include "chance/philox.hpp"
#include "chance/places.hpp"
#include "room/nearest_on_triangle.hpp"

namespace lichtmc {

namespace {

constexpr double pi = std::numbers::pi;

glm::dvec3 corner_of(const Surface& surface, std::size_t triangle, int k) {
  return surface.positions[surface.triangles[triangle][k]];
}

// Length: twice the area.
glm::dvec3 cross_of(const Surface& surface, std::size_t triangle) {
  const glm::dvec3 a = corner_of(surface, triangle, 0);
  return glm::cross(corner_of(surface, triangle, 1) - a, corner_of(surface, triangle, 2) - a);
}

// At most four corners, also with rounding: each side of a triangle gives two at most.
class Outline {
 public:
  void add(const glm::dvec3& corner) {
    assert(size_ < corners_.size());
    corners_[size_++] = corner;
  }
  std::size_t size() const { return size_; }
  const glm::dvec3& operator[](std::size_t k) const { return corners_[k]; }

 private:
  std::array<glm::dvec3, 6> corners_;
  std::size_t size_ = 0;
};

// The part of a triangle in front of a plane through the origin.
Outline above_horizon(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& normal) {
  Outline kept;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3& here = corners[k];
    const glm::dvec3& next = corners[(k + 1) % 3];
    const double height = glm::dot(here, normal);
    const double height_next = glm::dot(next, normal);
    if (height >= 0.0) kept.add(here);
    if ((height > 0.0 && height_next < 0.0) || (height < 0.0 && height_next > 0.0))
      kept.add(here + height / (height - height_next) * (next - here));
  }
  return kept;
}

// Whether a triangle, relative to a point, reaches above its horizon by more than rounding. A triangle in the plane of
// the horizon does not.
bool is_above_horizon(const std::array<glm::dvec3, 3>& corners, const ReferencePoint& reference) {
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  double size = glm::length(reference.point);
  double height = 0.0;
  for (const glm::dvec3& corner : corners) {
    size = std::max(size, glm::length(corner));
    height = std::max(height, glm::dot(corner, reference.normal));
  }
  return height > rounding * size;
}

// The angle between two vectors, exact for small ones and for those near π.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// If the first proposal for a point of an emitter with an emission map, by u, v and w, is rejected, the words for
// others are a function of these three numbers: as random as they are, and independent of them.
auto further_words(double u, double v, double w) {
  const auto word = [](double unit) { return static_cast<std::uint32_t>(unit * 0x1p32); };
  return [bits = std::bit_cast<std::uint64_t>(u), v_word = word(v), w_word = word(w)](std::uint32_t k) {
    return philox4x32_10({static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32), k, 0},
                         {v_word, w_word});
  };
}

}  // namespace

LightSample PointLight::sample_light(const ReferencePoint& reference, const glm::dvec3& from) const {
  const glm::dvec3 segment = from - reference.point;
  const double r = glm::length(segment);
  if (!(r > 0.0)) return {};
  const glm::dvec3 towards = segment / r;
  const double weight = reference.weight(towards);
  if (!(weight > 0.0)) return {};
  return {flux_ * density(-towards) * weight / (r * r), from, 0.0};
}

glm::dvec3 PointLight::place(double u, double v) const {
  const glm::dvec3 p = opening_ ? opening_->place(u, v) : glm::dvec3(0.0);
  return position_ + p.x * frame_.tangent + p.y * frame_.bitangent + p.z * frame_.normal;
}

std::optional<double> PointLight::uniform_intensity() const {
  if (!std::holds_alternative<IsotropicLaw>(law_)) return std::nullopt;
  return intensity(law_, flux_, {0.0, 0.0, 1.0});
}

const CandelaTable* PointLight::table() const {
  const auto* law = std::get_if<MeasuredLaw>(&law_);
  return law != nullptr ? law->table.get() : nullptr;
}

double PointLight::density(const glm::dvec3& away) const {
  return intensity(law_, 1.0, in_frame(away));
}

AreaLight::AreaLight(const Room& room, const SurfaceEmitter& emitter, std::optional<SurfaceEmission> emission,
                     double flux, std::uint32_t first_facet, const FacesInOnePlane* planes)
    : surface_(&room.surfaces[emitter.surface]),
      surface_number_(emitter.surface),
      flux_(flux),
      area_m2_(surface_area(*surface_)),
      law_(emitter.law()),
      first_facet_(first_facet),
      emission_(std::move(emission)) {
  if (planes != nullptr) leave_out_covered(room, *planes);
  std::vector<double> areas;
  prepared_.resize(surface_->triangles.size());
  low_ = glm::dvec3(std::numeric_limits<double>::infinity());
  high_ = -low_;
  for (std::size_t k = 0; k < surface_->triangles.size(); ++k) {
    const double area = glm::length(cross_of(*surface_, k));
    if (!(area > 0.0)) continue;
    areas.push_back(area);
    const glm::dvec3 corner = corner_of(*surface_, k, 0);
    prepared_[k] = {corner, corner_of(*surface_, k, 1) - corner, corner_of(*surface_, k, 2) - corner,
                    glm::normalize(cross_of(*surface_, k))};
    triangles_.push_back(k);
    for (int c = 0; c < 3; ++c) {
      low_ = glm::min(low_, corner_of(*surface_, k, c));
      high_ = glm::max(high_, corner_of(*surface_, k, c));
    }
  }
  areas_up_to_ = cumulative(areas);
}

// The light is uniform over the whole surface, or follows its map: uncovered parts keep their exitance.
void AreaLight::leave_out_covered(const Room& room, const FacesInOnePlane& planes) {
  auto part = planes.uncovered_front(room, surface_number_);
  if (!part) return;
  if (emission_) {
    planes_ = &planes;
    return;
  }
  uncovered_ = std::make_shared<const Surface>(std::move(*part));
  surface_ = uncovered_.get();
  const double whole_m2 = area_m2_;
  area_m2_ = surface_area(*surface_);
  flux_ *= area_m2_ / whole_m2;
}

bool AreaLight::reaches_above_horizon(const ReferencePoint& reference) const {
  const glm::dvec3& n = reference.normal;
  const glm::dvec3 highest(n.x > 0.0 ? high_.x : low_.x, n.y > 0.0 ? high_.y : low_.y, n.z > 0.0 ? high_.z : low_.z);
  return glm::dot(highest - reference.point, n) > 0.0;
}

double AreaLight::distance_m(const glm::dvec3& point) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::size_t triangle : triangles_) {
    const glm::dvec3 a = corner_of(*surface_, triangle, 0);
    if (glm::dot(point - a, cross_of(*surface_, triangle)) <= 0.0) continue;  // its back
    const glm::dvec3 there =
        nearest_on_triangle(point, a, corner_of(*surface_, triangle, 1), corner_of(*surface_, triangle, 2));
    nearest = std::min(nearest, glm::length(there - point));
  }
  return nearest;
}

// Cramer's rule for point + λ direction = a + s b + t c (T. Möller, B. Trumbore, Fast, Minimum Storage Ray/Triangle
// Intersection, 1997): λ > 0, if the front of the triangle is hit.
std::optional<AreaLight::FrontHit> AreaLight::front_hit(std::size_t triangle, const glm::dvec3& point,
                                                        const glm::dvec3& direction) const {
  const Prepared& here = prepared_[triangle];
  const glm::dvec3& a = here.corner;
  const glm::dvec3& b = here.side_1;
  const glm::dvec3& c = here.side_2;
  const glm::dvec3 across = glm::cross(direction, c);
  const double determinant = glm::dot(b, across);  // above 0 if the front is hit
  if (!(determinant > 0.0)) return std::nullopt;
  const glm::dvec3 from = point - a;
  const double s = glm::dot(from, across) / determinant;
  const glm::dvec3 up = glm::cross(from, b);
  const double t = glm::dot(direction, up) / determinant;
  const double length = glm::dot(c, up) / determinant;
  if (s >= 0.0 && t >= 0.0 && s + t <= 1.0 && length > 0.0) return FrontHit{length, {s, t}};
  return std::nullopt;
}

int AreaLight::fronts_hit(const glm::dvec3& point, const glm::dvec3& direction) const {
  return static_cast<int>(std::count_if(triangles_.begin(), triangles_.end(), [&](std::size_t triangle) {
    return front_hit(triangle, point, direction).has_value();
  }));
}

void AreaLight::add_fronts_hit(const ReferencePoint& reference, const glm::dvec3& direction,
                               std::vector<LightSample>& samples) const {
  const double cosine = glm::dot(direction, reference.normal);
  for (const std::size_t triangle : triangles_) {
    const auto hit = front_hit(triangle, reference.point, direction);
    if (!hit || is_covered(triangle, hit->weights)) continue;
    const double cosine_there = -glm::dot(direction, prepared_[triangle].normal);
    if (!(cosine_there > 0.0)) continue;
    const double relative = emission_ ? emission_->relative(triangle, hit->weights) : 1.0;
    samples.push_back({pi * radiance(cosine_there) * relative, reference.point + hit->length * direction,
                       cosine * cosine_there / (pi * hit->length * hit->length), relative});
  }
}

double AreaLight::least_distance_m(const glm::dvec3& point) const {
  return glm::length(point - glm::clamp(point, low_, high_));
}

// Most area lights follow Lambert's law, whose power is the cosine itself.
double AreaLight::density_at(double cosine) const {
  if (law_.exponent != 1.0 || cosine <= 0.0) return law_.density_at(cosine);
  return 2.0 / (2.0 * pi) * cosine;
}

// L = Φ (m+1)/(2π A) cos^(m−1) θ.
double AreaLight::radiance(double cosine) const {
  return flux_ / area_m2_ * density_at(cosine) / cosine;
}

double AreaLight::mean_radiance() const {
  return flux_ / area_m2_ / pi;
}

LightSample AreaLight::sample_light(const ReferencePoint& reference, double u, double v, double w) const {
  if (emission_) return sample_at(reference, emission_->choose_place(u, v, w, further_words(u, v, w)));
  return sample_at(reference, {triangles_[choose(areas_up_to_, u)], uniform_on_triangle(v, w)});
}

LightSample AreaLight::sample_evenly(const ReferencePoint& reference, double p, double q) const {
  if (emission_) return sample_at(reference, emission_->choose_evenly(p, q, further_words(p, q, 0.0)));
  const std::size_t k = choose(areas_up_to_, p);
  return sample_at(reference, {triangles_[k], uniform_on_triangle(share_within(areas_up_to_, k, p), q)});
}

bool AreaLight::is_covered(std::size_t triangle, const glm::dvec2& weights) const {
  return planes_ != nullptr &&
         !planes_->counts({static_cast<std::uint32_t>(first_facet_ + triangle), weights.x, weights.y, false});
}

LightSample AreaLight::sample_at(const ReferencePoint& reference, const EmissionPlace& place) const {
  const std::size_t triangle = place.triangle;
  if (is_covered(triangle, place.weights)) return {};
  const Prepared& here = prepared_[triangle];
  const glm::dvec3 target = here.corner + place.weights.x * here.side_1 + place.weights.y * here.side_2;
  const glm::dvec3 segment = target - reference.point;
  const double r = glm::length(segment);
  if (!(r > 0.0)) return {};
  const glm::dvec3 towards = segment / r;
  const double weight = reference.weight(towards);
  const double cosine_there = -glm::dot(towards, here.normal);
  if (!(weight > 0.0) || cosine_there <= 0.0) return {};
  // The exitance at the point and the density of the points are proportional: their ratio is the flux everywhere.
  return {flux_ * density_at(cosine_there) * weight / (r * r), target, weight * cosine_there / (pi * r * r),
          place.relative};
}

// L/2 Σ Γ_k · n, Γ_k the angle subtended by edge k times the normal of the plane through the point and it (J. H.
// Lambert, Photometria, 1760; P. Schröder, P. Hanrahan, SIGGRAPH 1993).
double AreaLight::polygon_irradiance(const ReferencePoint& reference) const {
  const double luminance = flux_ / area_m2_ / pi;
  double sum = 0.0;
  for (const std::size_t triangle : triangles_) {
    std::array<glm::dvec3, 3> corners{};
    for (int k = 0; k < 3; ++k)
      corners[static_cast<std::size_t>(k)] = corner_of(*surface_, triangle, k) - reference.point;
    if (glm::dot(cross_of(*surface_, triangle), corners[0]) >= 0.0) continue;  // its back faces the point
    if (!is_above_horizon(corners, reference)) continue;
    const Outline seen = above_horizon(corners, reference.normal);
    double edges = 0.0;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const glm::dvec3& here = seen[k];
      const glm::dvec3& next = seen[(k + 1) % seen.size()];
      const glm::dvec3 across = glm::cross(here, next);
      const double length = glm::length(across);
      if (length > 0.0) edges += angle_between(here, next) * glm::dot(across / length, reference.normal);
    }
    sum += std::abs(edges);
  }
  return 0.5 * luminance * sum;
}

}  // namespace lichtmc
