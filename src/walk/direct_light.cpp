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

}  // namespace

glm::dvec3 start_of(const ReferencePoint& reference, const Tracer& tracer) {
  return tracer.tracer_point(reference.point) +
         double{tracer.step()} * glm::normalize(tracer.directions() * reference.normal);
}

DirectLight::DirectLight(const Room& room, const Tracer& tracer) : room_(&room), tracer_(&tracer) {
  sources_of_surface_.resize(room.surfaces.size());
  std::vector<double> powers;
  for (std::size_t n = 0; n < room.emitters.size(); ++n) {
    const Emitter& emitter = room.emitters[n];
    if (emitter.power == 0.0) continue;
    powers.push_back(emitter.power);
    if (const auto* shape = std::get_if<SurfaceEmitter>(&emitter.shape)) {
      sources_of_surface_[shape->surface].push_back(surfaces_.size());
      sources_.push_back({true, surfaces_.size(), 1.0});
      surfaces_.emplace_back(room, emitter);
    } else {
      sources_.push_back({false, points_.size(), 1.0});
      points_.emplace_back(emitter, n);
    }
  }
  surface_shares_.assign(surfaces_.size(), 1.0);
  few_ = sources_.size() <= few;
  if (few_) return;
  const double sum = total_power(room);
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    sources_[k].share = powers[k] / sum;
    if (sources_[k].on_surface) surface_shares_[sources_[k].index] = sources_[k].share;
  }
  powers_up_to_ = cumulative(powers);
}

bool DirectLight::blocked(const ReferencePoint& reference, const glm::dvec3& target, TraceCount& count) const {
  if (!tracer_->casts_shadows()) return false;
  // One step off, on the side that the point looks to and short of the emitter's own surface: both may lie on one.
  const double step = tracer_->step();
  const glm::dvec3 start = start_of(reference, *tracer_);
  const glm::dvec3 segment = tracer_->tracer_point(target) - start;
  const double length = glm::length(segment);
  if (length <= 2.0 * step) return false;
  return tracer_->is_blocked(glm::vec3(start), glm::vec3(segment * (1.0 - 2.0 * step / length)), count);
}

// Two kinds of samples: points on the emitter, in strata of its area, and flights from the receiver, in strata of its
// field of view, that may meet it. Each counts by how likely it was (see hit()): points find small emitters, flights
// near ones, and those that fill a narrow view. Their number doubles until the error, from the differences between
// neighbours in a stratum, is small.
DirectIrradiance DirectLight::sampled(std::size_t k, const ReferencePointAt& reference, const Stream& stream,
                                      std::uint64_t number, const Accuracy& accuracy, TraceCount& count) const {
  constexpr std::uint32_t first = 64;
  const SurfaceSource& source = surfaces_[k];
  double sum = 0.0;
  double squares = 0.0;  // of the differences within pairs
  std::uint32_t samples = 0;
  DirectIrradiance result;
  for (std::uint32_t level = first; level <= accuracy.most; level *= 2) {
    const std::uint32_t fresh = level - samples;
    const auto add = [&](const std::vector<double>& values) {
      for (std::uint32_t i = 0; i < fresh; i += 2) {
        sum += values[i] + values[i + 1];
        squares += (values[i] - values[i + 1]) * (values[i] - values[i + 1]);
      }
    };
    add(by_points(source, reference, stream, number, samples, fresh, count));
    add(by_flights(source, reference, stream, number, samples, fresh, count));
    samples = level;
    // The variance of a pair's mean is its squared difference/4, on average.
    result = {sum / samples, std::sqrt(squares) / samples};
    if (result.standard_error <= std::max(accuracy.relative * result.value, accuracy.absolute)) break;
  }
  return result;
}

namespace {

// Where sample k of n lies from 0 to 1: two in each of n/2 strata.
double in_stratum(std::uint32_t k, std::uint32_t n, double u) {
  const std::uint32_t stratum = k / 2;
  const std::uint32_t strata = n / 2;
  return std::min((stratum + u) / strata, 1.0 - 0x1p-53);
}

}  // namespace

std::vector<double> DirectLight::by_points(const SurfaceSource& source, const ReferencePointAt& reference_point_of,
                                           const Stream& stream, std::uint64_t number, std::uint32_t first,
                                           std::uint32_t n, TraceCount& count) const {
  std::vector<double> values(n, 0.0);
  const double by_point = 1.0 / source.area_m2();
  for (std::uint32_t k = 0; k < n; ++k) {
    const ReferencePoint reference = reference_point_of(first + k);
    const Words words = stream.draw(number, first + k, Purpose::direct_point);
    const LightSample offer =
        source.offer(reference, in_stratum(k, n, unit_open(words[0])), unit_open(words[1]), unit_open(words[2]));
    if (!(offer.irradiance > 0.0) || blocked(reference, offer.target, count)) continue;
    values[k] = offer.irradiance * by_point / (by_point + offer.pdf_bsdf / reference.squared_sine());
  }
  return values;
}

std::vector<double> DirectLight::by_flights(const SurfaceSource& source, const ReferencePointAt& reference_point_of,
                                            const Stream& stream, std::uint64_t number, std::uint32_t first,
                                            std::uint32_t n, TraceCount& count) const {
  std::vector<double> values(n, 0.0);
  Rays rays(n);
  rays.size = n;
  std::vector<double> cosines(n);
  std::vector<double> views(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    const ReferencePoint reference = reference_point_of(first + k);
    const double view = views[k] = reference.squared_sine();
    const Frame frame = frame_about(reference.normal);
    const Words words = stream.draw(number, first + k, Purpose::direct_flight);
    const double squared = view * in_stratum(k, n, unit_open(words[0]));
    const double azimuth = 2.0 * pi * unit_open(words[1]);
    cosines[k] = std::sqrt(1.0 - squared);
    const glm::dvec3 direction =
        std::sqrt(squared) * (std::cos(azimuth) * frame.tangent + std::sin(azimuth) * frame.bitangent) +
        cosines[k] * frame.normal;
    rays.facet[k] = no_facet;
    rays.set_start(k, glm::vec3(start_of(reference, *tracer_)));
    rays.set_direction(k, glm::vec3(tracer_->directions() * direction));
  }
  tracer_->trace(rays, Misses::escape, count);
  for (std::uint32_t k = 0; k < n; ++k) {
    if (rays.facet[k] == no_facet || rays.behind[k] != 0) continue;
    const Facet& facet = tracer_->facets()[rays.facet[k]];
    if (facet.surface != source.surface()) continue;
    const glm::dvec3 segment = tracer_->world_vector(glm::dvec3(rays.direction(k)) * double{rays.length[k]});
    const double r = glm::length(segment);
    const glm::dvec3 normal = glm::normalize(tracer_->world_vector(glm::dvec3(facet.normal)));
    const double cosine_there = std::abs(glm::dot(segment, normal)) / r;
    if (!(r > 0.0) || !(cosine_there > 0.0)) continue;
    const double pdf_bsdf = cosines[k] * cosine_there / (pi * r * r) / views[k];
    values[k] = views[k] * source.radiance(cosine_there) * pi * pdf_bsdf / (pdf_bsdf + 1.0 / source.area_m2());
  }
  return values;
}

DirectIrradiance DirectLight::at(const ReferencePoint& reference, const Stream& stream, std::uint64_t number,
                                 TraceCount& count) const {
  DirectIrradiance sum;
  double variance = 0.0;
  for (const PointSource& source : points_) {
    const LightSample offer = source.offer(reference);
    if (offer.irradiance > 0.0 && !blocked(reference, offer.target, count)) sum.value += offer.irradiance;
  }
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    if (!tracer_->casts_shadows() && surfaces_[k].lambertian() && reference.least_cosine <= 0.0) {
      sum.value += surfaces_[k].by_polygons(reference);
      continue;
    }
    const DirectIrradiance part = sampled(
        k, [&reference](std::uint32_t) { return reference; }, stream, number * surfaces_.size() + k, Accuracy{}, count);
    sum.value += part.value;
    variance += part.standard_error * part.standard_error;
  }
  sum.standard_error = std::sqrt(variance);
  return sum;
}

LightSample DirectLight::offer(std::size_t k, const ReferencePoint& reference, const Words& which,
                               const Words& where) const {
  const Source& source = sources_[few_ ? k : choose(powers_up_to_, unit_fine(which[0], which[1]))];
  if (!source.on_surface) {
    LightSample offer = points_[source.index].offer(reference);
    offer.irradiance /= source.share;
    return offer;
  }
  const SurfaceSource& surface = surfaces_[source.index];
  LightSample offer = surface.offer(reference, unit_open(where[0]), unit_open(where[1]), unit_open(where[2]));
  const double by_point = source.share / surface.area_m2();
  offer.irradiance *= by_point / (by_point + offer.pdf_bsdf) / source.share;
  return offer;
}

double DirectLight::hit(std::size_t surface, double cosine_here, double cosine_there, double r_m) const {
  double sum = 0.0;
  for (const std::size_t k : sources_of_surface_[surface]) {
    const SurfaceSource& source = surfaces_[k];
    const double by_point = surface_shares_[k] / source.area_m2();
    const double pdf_bsdf = cosine_here * cosine_there / (pi * r_m * r_m);
    sum += pi * source.radiance(cosine_there) * pdf_bsdf / (by_point + pdf_bsdf);
  }
  return sum;
}

std::optional<std::size_t> DirectLight::emitter_at(const ReferencePoint& reference) const {
  for (const PointSource& source : points_) {
    if (source.position() == reference.point) return source.number();
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
      const glm::uvec3 corner = surface.triangles[k];
      const glm::dvec3 a = surface.positions[corner.x];
      const glm::dvec3 b = surface.positions[corner.y] - a;
      const glm::dvec3 c = surface.positions[corner.z] - a;
      const glm::dvec3 cross = glm::cross(b, c);
      const double twice = glm::length(cross);
      const glm::dvec3 p = reference.point - a;
      if (!(twice > 0.0) || std::abs(glm::dot(p, cross)) > near * twice) continue;
      if (glm::dot(reference.normal, cross) >= 0.0) continue;  // it looks away from the emitter that it lies on
      const double s = glm::dot(glm::cross(p, c), cross) / (twice * twice);
      const double t = glm::dot(glm::cross(b, p), cross) / (twice * twice);
      if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) return n;
    }
  }
  return std::nullopt;
}

}  // namespace lichtmc
