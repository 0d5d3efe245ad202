#include "walk/direct_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "chance/choice.hpp"
#include "chance/directions.hpp"
#include "room/bounds.hpp"

namespace lichtmc {

namespace {

constexpr double pi = std::numbers::pi;

// Up to so many emitters each one is looked at from every surface; with more the shadow rays cost more than the chance
// of having chosen the wrong one.
constexpr std::size_t few = 4;

// How near to a surface emitter a receiver counts as on it: a millionth of the room, what Embree's coordinates resolve.
constexpr double on_emitter = 1e-6;

glm::dvec3 corner_of(const Surface& surface, std::size_t triangle, int k) {
  return surface.positions[surface.triangles[triangle][k]];
}

glm::dvec3 normal_of(const Surface& surface, std::size_t triangle) {
  const glm::dvec3 a = corner_of(surface, triangle, 0);
  return glm::normalize(glm::cross(corner_of(surface, triangle, 1) - a, corner_of(surface, triangle, 2) - a));
}

// The part of a triangle in front of a plane through the origin: a polygon of up to four corners.
std::vector<glm::dvec3> above_horizon(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& normal) {
  std::vector<glm::dvec3> kept;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3& here = corners[k];
    const glm::dvec3& next = corners[(k + 1) % 3];
    const double height = glm::dot(here, normal);
    const double height_next = glm::dot(next, normal);
    if (height >= 0.0) kept.push_back(here);
    if ((height > 0.0 && height_next < 0.0) || (height < 0.0 && height_next > 0.0))
      kept.push_back(here + height / (height - height_next) * (next - here));
  }
  return kept;
}

// The angle between two vectors, exact for small ones and for those near π.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

// L = Φ (m+1)/(2π A) cos^(m−1) θ.
double DirectLight::SurfaceSource::radiance(double cosine) const {
  return power / area_m2 * pdf_generalized_lambert(exponent, cosine) / cosine;
}

glm::dvec3 start_of(const Outlook& outlook, const Tracer& tracer) {
  return tracer.tracer_point(outlook.point) +
         double{tracer.step()} * glm::normalize(tracer.directions() * outlook.normal);
}

DirectLight::DirectLight(const Room& room, const Tracer& tracer) : room_(&room), tracer_(&tracer) {
  sources_of_surface_.resize(room.surfaces.size());
  std::vector<double> powers;
  for (std::size_t n = 0; n < room.emitters.size(); ++n) {
    const Emitter& emitter = room.emitters[n];
    if (emitter.power == 0.0) continue;
    powers.push_back(emitter.power);
    if (const auto* shape = std::get_if<SurfaceEmitter>(&emitter.shape)) {
      const Surface& surface = room.surfaces[shape->surface];
      SurfaceSource source;
      source.surface = shape->surface;
      source.power = emitter.power;
      source.area_m2 = surface_area(surface);
      source.exponent = shape->exponent;
      std::vector<double> areas;
      for (std::size_t k = 0; k < surface.triangles.size(); ++k) {
        const glm::dvec3 a = corner_of(surface, k, 0);
        const double area = glm::length(glm::cross(corner_of(surface, k, 1) - a, corner_of(surface, k, 2) - a));
        if (!(area > 0.0)) continue;
        areas.push_back(area);
        source.triangles.push_back(k);
      }
      source.areas_up_to = cumulative(areas);
      sources_of_surface_[shape->surface].push_back(surfaces_.size());
      sources_.push_back({true, surfaces_.size(), 1.0});
      surfaces_.push_back(std::move(source));
      continue;
    }
    PointSource source{n, glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0), emitter.power, &emitter};
    std::visit(
        [&source](const auto& shape) {
          if constexpr (requires { shape.position; }) source.position = shape.position;
          if constexpr (requires { shape.axis; }) {
            const glm::dvec3 a = shape.axis;
            source.axis = glm::normalize(a / std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}));
          }
        },
        emitter.shape);
    sources_.push_back({false, points_.size(), 1.0});
    points_.push_back(source);
  }
  any_surface_ = !surfaces_.empty();
  few_ = sources_.size() <= few;
  if (few_) return;
  const double sum = total_power(room);
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    sources_[k].share = powers[k] / sum;
    if (sources_[k].on_surface) surfaces_[sources_[k].index].share = sources_[k].share;
  }
  powers_up_to_ = cumulative(powers);
}

// Power per solid angle in a direction of length 1.
double DirectLight::intensity(const PointSource& source, const glm::dvec3& direction) const {
  const double cosine = glm::dot(direction, source.axis);
  struct Density {
    double cosine;
    double operator()(const IsotropicEmitter&) const { return pdf_sphere(cosine); }
    double operator()(const LambertEmitter& law) const { return pdf_generalized_lambert(law.exponent, cosine); }
    double operator()(const SpotEmitter& law) const { return pdf_spot(law.inner, law.outer, cosine); }
    double operator()(const SurfaceEmitter&) const { return 0.0; }
  };
  return source.power * std::visit(Density{cosine}, source.emitter->shape);
}

LightOffer DirectLight::from_point(const PointSource& source, const Outlook& outlook) const {
  const glm::dvec3 way = source.position - outlook.point;
  const double r = glm::length(way);
  if (!(r > 0.0)) return {};
  const glm::dvec3 towards = way / r;
  const double cosine = glm::dot(towards, outlook.normal);
  if (cosine <= 0.0 || cosine < outlook.least_cosine) return {};
  return {intensity(source, -towards) * cosine / (r * r), source.position, 0.0};
}

// The offer of a random point: its mean is the emitter's irradiance, if nothing stood between.
LightOffer DirectLight::from_surface(const SurfaceSource& source, const Outlook& outlook, double u, double v,
                                     double w) const {
  const Surface& surface = room_->surfaces[source.surface];
  const std::size_t triangle = source.triangles[choose(source.areas_up_to, u)];
  // Uniform on the triangle, as in the launcher.
  const double root = std::sqrt(v);
  const glm::dvec3 a = corner_of(surface, triangle, 0);
  const glm::dvec3 target =
      a + root * (1.0 - w) * (corner_of(surface, triangle, 1) - a) + root * w * (corner_of(surface, triangle, 2) - a);
  const glm::dvec3 way = target - outlook.point;
  const double r = glm::length(way);
  if (!(r > 0.0)) return {};
  const glm::dvec3 towards = way / r;
  const double cosine = glm::dot(towards, outlook.normal);
  const double cosine_there = -glm::dot(towards, normal_of(surface, triangle));
  if (cosine <= 0.0 || cosine < outlook.least_cosine || cosine_there <= 0.0) return {};
  return {source.power * pdf_generalized_lambert(source.exponent, cosine_there) * cosine / (r * r), target,
          cosine * cosine_there / (pi * r * r)};
}

// Irradiance by a Lambertian polygon: L/2 Σ Γ_k · n, Γ_k the angle under which edge k is seen times the normal of the
// plane through the point and it (J. H. Lambert, Photometria, 1760; P. Schröder, P. Hanrahan, SIGGRAPH 1993).
double DirectLight::polygon(const SurfaceSource& source, const Outlook& outlook) const {
  const Surface& surface = room_->surfaces[source.surface];
  const double radiance = source.power / source.area_m2 / pi;
  double sum = 0.0;
  for (const std::size_t triangle : source.triangles) {
    std::array<glm::dvec3, 3> corners{};
    for (int k = 0; k < 3; ++k) corners[static_cast<std::size_t>(k)] = corner_of(surface, triangle, k) - outlook.point;
    if (glm::dot(normal_of(surface, triangle), corners[0]) >= 0.0) continue;  // seen from behind
    const std::vector<glm::dvec3> seen = above_horizon(corners, outlook.normal);
    double edges = 0.0;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const glm::dvec3& here = seen[k];
      const glm::dvec3& next = seen[(k + 1) % seen.size()];
      const glm::dvec3 across = glm::cross(here, next);
      const double length = glm::length(across);
      if (length > 0.0) edges += angle_between(here, next) * glm::dot(across / length, outlook.normal);
    }
    sum += std::abs(edges);
  }
  return 0.5 * radiance * sum;
}

bool DirectLight::blocked(const Outlook& outlook, const glm::dvec3& target, TraceCount& count) const {
  if (!tracer_->casts_shadows()) return false;
  // One step off, on the side that the point looks to and short of the emitter's own surface: both may lie on one.
  const double step = tracer_->step();
  const glm::dvec3 start = start_of(outlook, *tracer_);
  const glm::dvec3 way = tracer_->tracer_point(target) - start;
  const double length = glm::length(way);
  if (length <= 2.0 * step) return false;
  ShadowRays ray;
  ray.add(glm::vec3(start), glm::vec3(way * (1.0 - 2.0 * step / length)));
  tracer_->find_blocked(ray, count);
  return ray.blocked[0] != 0;
}

// Two kinds of samples: points on the emitter, in strata of its area, and flights from the receiver, in strata of its
// field of view, that may meet it. Each counts by how likely it was (see hit()): points find small emitters, flights
// near ones, and those that fill a narrow view. Their number doubles until the error, from the differences between
// neighbours in a stratum, is small.
DirectIrradiance DirectLight::sampled(const SurfaceSource& source, const Outlook& outlook, const Stream& stream,
                                      std::uint64_t number, TraceCount& count) const {
  constexpr std::uint32_t first = 64;
  constexpr std::uint32_t most = 16384;
  constexpr double small = 1e-3;
  double sum = 0.0;
  double squares = 0.0;  // of the differences within pairs
  std::uint32_t samples = 0;
  DirectIrradiance result;
  for (std::uint32_t level = first; level <= most; level *= 2) {
    const std::uint32_t fresh = level - samples;
    const auto add = [&](const std::vector<double>& values) {
      for (std::uint32_t k = 0; k < fresh; k += 2) {
        sum += values[k] + values[k + 1];
        squares += (values[k] - values[k + 1]) * (values[k] - values[k + 1]);
      }
    };
    add(by_points(source, outlook, stream, number, samples, fresh, count));
    add(by_flights(source, outlook, stream, number, samples, fresh, count));
    samples = level;
    // The variance of a pair's mean is its squared difference/4, on average.
    result = {sum / samples, std::sqrt(squares) / samples};
    if (result.standard_error <= small * result.value) break;
  }
  return result;
}

namespace {

// Where sample k of n lies from 0 to 1: two in each of n/2 strata.
double in_stratum(std::uint32_t k, std::uint32_t n, double u) {
  return std::min((k / 2 + u) / (n / 2), 1.0 - 0x1p-53);
}

}  // namespace

std::vector<double> DirectLight::by_points(const SurfaceSource& source, const Outlook& outlook, const Stream& stream,
                                           std::uint64_t number, std::uint32_t first, std::uint32_t n,
                                           TraceCount& count) const {
  std::vector<double> values(n, 0.0);
  const double by_point = 1.0 / source.area_m2;
  for (std::uint32_t k = 0; k < n; ++k) {
    const Words words = stream.draw(number, first + k, Purpose::on_light);
    const LightOffer offer =
        from_surface(source, outlook, in_stratum(k, n, unit_open(words[0])), unit_open(words[1]), unit_open(words[2]));
    if (!(offer.irradiance > 0.0) || blocked(outlook, offer.target, count)) continue;
    values[k] = offer.irradiance * by_point / (by_point + offer.by_walk / outlook.squared_sine());
  }
  return values;
}

std::vector<double> DirectLight::by_flights(const SurfaceSource& source, const Outlook& outlook, const Stream& stream,
                                            std::uint64_t number, std::uint32_t first, std::uint32_t n,
                                            TraceCount& count) const {
  std::vector<double> values(n, 0.0);
  const double view = outlook.squared_sine();
  const Frame frame = frame_about(outlook.normal);
  const glm::vec3 start(start_of(outlook, *tracer_));
  Rays rays(n);
  rays.size = n;
  std::vector<double> cosines(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    const Words words = stream.draw(number, first + k, Purpose::light);
    const double squared = view * in_stratum(k, n, unit_open(words[0]));
    const double azimuth = 2.0 * pi * unit_open(words[1]);
    cosines[k] = std::sqrt(1.0 - squared);
    const glm::dvec3 direction =
        std::sqrt(squared) * (std::cos(azimuth) * frame.tangent + std::sin(azimuth) * frame.bitangent) +
        cosines[k] * frame.normal;
    rays.facet[k] = no_facet;
    rays.set_start(k, start);
    rays.set_direction(k, glm::vec3(tracer_->directions() * direction));
  }
  tracer_->trace(rays, Misses::escape, count);
  for (std::uint32_t k = 0; k < n; ++k) {
    if (rays.facet[k] == no_facet || rays.behind[k] != 0) continue;
    const Facet& facet = tracer_->facets()[rays.facet[k]];
    if (facet.surface != source.surface) continue;
    const glm::dvec3 way = tracer_->world_vector(glm::dvec3(rays.direction(k)) * double{rays.length[k]});
    const double r = glm::length(way);
    const glm::dvec3 normal = glm::normalize(tracer_->world_vector(glm::dvec3(facet.normal)));
    const double cosine_there = std::abs(glm::dot(way, normal)) / r;
    if (!(r > 0.0) || !(cosine_there > 0.0)) continue;
    const double by_walk = cosines[k] * cosine_there / (pi * r * r) / view;
    values[k] = view * source.radiance(cosine_there) * pi * by_walk / (by_walk + 1.0 / source.area_m2);
  }
  return values;
}

DirectIrradiance DirectLight::at(const Outlook& outlook, const Stream& stream, std::uint64_t number,
                                 TraceCount& count) const {
  DirectIrradiance sum;
  double variance = 0.0;
  for (const PointSource& source : points_) {
    const LightOffer offer = from_point(source, outlook);
    if (offer.irradiance > 0.0 && !blocked(outlook, offer.target, count)) sum.value += offer.irradiance;
  }
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    const SurfaceSource& source = surfaces_[k];
    if (!tracer_->casts_shadows() && source.exponent == 1.0 && outlook.least_cosine <= 0.0) {
      sum.value += polygon(source, outlook);
      continue;
    }
    const DirectIrradiance part = sampled(source, outlook, stream, number * surfaces_.size() + k, count);
    sum.value += part.value;
    variance += part.standard_error * part.standard_error;
  }
  sum.standard_error = std::sqrt(variance);
  return sum;
}

LightOffer DirectLight::offer(std::size_t k, const Outlook& outlook, const Words& which, const Words& where) const {
  const Source& source = sources_[few_ ? k : choose(powers_up_to_, unit_fine(which[0], which[1]))];
  if (!source.on_surface) {
    LightOffer offer = from_point(points_[source.index], outlook);
    offer.irradiance /= source.share;
    return offer;
  }
  const SurfaceSource& surface = surfaces_[source.index];
  LightOffer offer = from_surface(surface, outlook, unit_open(where[0]), unit_open(where[1]), unit_open(where[2]));
  const double by_point = source.share / surface.area_m2;
  offer.irradiance *= by_point / (by_point + offer.by_walk) / source.share;
  return offer;
}

double DirectLight::hit(std::size_t surface, double cosine_here, double cosine_there, double r_m) const {
  double sum = 0.0;
  for (const std::size_t k : sources_of_surface_[surface]) {
    const SurfaceSource& source = surfaces_[k];
    const double by_point = source.share / source.area_m2;
    const double by_walk = cosine_here * cosine_there / (pi * r_m * r_m);
    sum += pi * source.radiance(cosine_there) * by_walk / (by_point + by_walk);
  }
  return sum;
}

std::optional<std::size_t> DirectLight::emitter_at(const Outlook& outlook) const {
  for (const PointSource& source : points_) {
    if (source.position == outlook.point) return source.number;
  }
  if (surfaces_.empty()) return std::nullopt;
  const Bounds bounds = bounds_of(*room_);
  const glm::dvec3 size = bounds.high - bounds.low;
  const double near = on_emitter * std::max({size.x, size.y, size.z});
  for (std::size_t n = 0; n < room_->emitters.size(); ++n) {
    const auto* shape = std::get_if<SurfaceEmitter>(&room_->emitters[n].shape);
    if (shape == nullptr || room_->emitters[n].power == 0.0) continue;
    const Surface& surface = room_->surfaces[shape->surface];
    for (std::size_t k = 0; k < surface.triangles.size(); ++k) {
      const glm::dvec3 a = corner_of(surface, k, 0);
      const glm::dvec3 b = corner_of(surface, k, 1) - a;
      const glm::dvec3 c = corner_of(surface, k, 2) - a;
      const glm::dvec3 cross = glm::cross(b, c);
      const double twice = glm::length(cross);
      const glm::dvec3 p = outlook.point - a;
      if (!(twice > 0.0) || std::abs(glm::dot(p, cross)) > near * twice) continue;
      if (glm::dot(outlook.normal, cross) >= 0.0) continue;  // it looks away from the emitter that it lies on
      const double s = glm::dot(glm::cross(p, c), cross) / (twice * twice);
      const double t = glm::dot(glm::cross(b, p), cross) / (twice * twice);
      if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) return n;
    }
  }
  return std::nullopt;
}

}  // namespace lichtmc
