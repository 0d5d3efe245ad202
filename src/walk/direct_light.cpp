#include "walk/direct_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "room/bounds.hpp"
#include "room/emitter_shape.hpp"
#include "walk/learn_selection.hpp"
#include "walk/near_area_light.hpp"
#include "walk/opening_sampling.hpp"

namespace lichtmc {

namespace {

// Up to this number of emitters, each is sampled at every surface. With more, the shadow rays cost more than the lower
// variance saves.
constexpr std::size_t few = 4;

// A receiver within this distance of an area light, as a fraction of the room's size, counts as on it: a millionth, the
// resolution of Embree's coordinates.
constexpr double on_emitter = 1e-6;

}  // namespace

DirectLight::DirectLight(const Room& room, const Tracer& tracer)
    : room_(&room),
      tracer_(&tracer),
      source_of_emitter_(room.emitters.size(), no_source),
      area_sources_of_surface_(room.surfaces.size()),
      power_(total_power(room)) {
  EmissionOfRoom emission(room);
  for (std::size_t n = 0; n < room.emitters.size(); ++n) {
    const double flux = room.emitters[n].power;
    if (flux == 0.0) continue;
    const std::size_t source = sources_.size();
    visit_shape(
        room.emitters[n],
        [&](const auto& point) {
          const bool opens = opening_of(point) != nullptr;
          std::vector<PointLight>& lights = opens ? openings_ : points_;
          const auto kind = opens ? LightSource::Kind::opening : LightSource::Kind::point;
          sources_.push_back({kind, lights.size(), source, n, flux});
          lights.emplace_back(point, flux, n);
        },
        [&](const auto& area) {
          AreaLight light(room, area, emission.of(area), flux, tracer.locate(area.surface, 0).facet,
                          tracer.faces_in_one_plane());
          if (!(light.area_m2() > 0.0)) return;  // wholly covered
          area_sources_of_surface_[area.surface].push_back(source);
          sources_.push_back({LightSource::Kind::area, areas_.size(), source, n, flux});
          areas_.push_back(std::move(light));
          emitter_of_area_.push_back(n);
        });
    if (sources_.size() > source) source_of_emitter_[n] = source;
  }
  if (sources_.size() > few) selection_.emplace(fluxes());
}

std::vector<double> DirectLight::fluxes() const {
  std::vector<double> fluxes;
  for (const LightSource& source : sources_) fluxes.push_back(source.flux);
  return fluxes;
}

void DirectLight::learn_selection(const Scene& scene) {
  if (!selection_) return;
  LearnedEmitters emitters{fluxes(), std::vector<std::size_t>(sources_.size()), {}};
  for (std::size_t n = 0; n < source_of_emitter_.size(); ++n) {
    if (source_of_emitter_[n] != no_source) emitters.in_room[source_of_emitter_[n]] = n;
  }
  emitters.sample = [this](std::size_t k, const ReferencePoint& reference, const Words& where) {
    return sample_of({k, 1.0}, reference, where, 0.0);
  };
  selection_ = lichtmc::learn_selection(scene, emitters);
}

DirectIrradiance DirectLight::irradiance_at(const ReferencePoint& reference, const Stream& stream, std::uint64_t number,
                                            TraceCount& count, const SamplingAccuracy& accuracy,
                                            std::vector<DirectIrradiance>* of_emitters) const {
  DirectIrradiance sum;
  double variance = 0.0;
  sum.value = irradiance_by_points(reference, count, of_emitters);
  const auto same_point = [&reference](std::uint32_t) { return reference; };
  const auto add = [&](std::size_t emitter, const DirectIrradiance& part) {
    sum.value += part.value;
    variance += part.standard_error * part.standard_error;
    if (of_emitters != nullptr) (*of_emitters)[emitter].add(part);
  };
  for (std::size_t k = 0; k < openings_.size(); ++k) {
    add(openings_[k].number(),
        sample_opening(openings_[k], *tracer_, same_point, stream, number * openings_.size() + k, accuracy, count));
  }
  sum.standard_error = std::sqrt(variance);
  if (reference.way_out) return sum;  // the walls lie between area lights, which are walls, and points outside
  for (std::size_t k = 0; k < areas_.size(); ++k) {
    if (!tracer_->casts_shadows() && areas_[k].has_closed_form() && sees_hemisphere(reference)) {
      add(emitter_of_area_[k], {areas_[k].polygon_irradiance(reference), 0.0});
      continue;
    }
    if (is_near(areas_[k], reference)) {
      add(emitter_of_area_[k],
          sample_near_light(areas_[k], *tracer_, reference, stream, number * areas_.size() + k, accuracy, count));
      continue;
    }
    add(emitter_of_area_[k],
        sample_area_light(areas_[k], *tracer_, same_point, stream, number * areas_.size() + k, accuracy, count));
  }
  sum.standard_error = std::sqrt(variance);
  return sum;
}

// The shadow rays to all point lights are traced together.
double DirectLight::irradiance_by_points(const ReferencePoint& reference, TraceCount& count,
                                         std::vector<DirectIrradiance>* of_emitters) const {
  const bool has_shadows = tracer_->casts_shadows() || reference.way_out;
  const glm::dvec3 start = start_of(reference, *tracer_);
  constexpr std::size_t untested = std::numeric_limits<std::size_t>::max();
  struct Part {
    double irradiance = 0.0;
    std::size_t ray = untested;
    std::size_t emitter = 0;
  };
  std::vector<Part> parts;
  ShadowRays rays;
  for (const PointLight& light : points_) {
    const LightSample sample = light.sample_light(reference);
    if (!(sample.irradiance > 0.0)) continue;
    const auto segment = has_shadows ? shadow_segment(*tracer_, start, sample.target) : std::nullopt;
    parts.push_back({sample.irradiance, segment ? rays.size : untested, light.number()});
    if (segment) rays.add(glm::vec3(start), *segment);
  }
  if (rays.size > 0) tracer_->find_blocked(rays, count);
  double sum = 0.0;
  for (const Part& part : parts) {
    if (part.ray != untested && rays.blocked[part.ray] != 0) continue;
    sum += part.irradiance;
    if (of_emitters != nullptr) (*of_emitters)[part.emitter].value += part.irradiance;
  }
  return sum;
}

LightSample DirectLight::sample_light(std::size_t k, std::uint32_t cell, const ReferencePoint& reference,
                                      const Words& which, const Words& where, double forward_ratio) const {
  const Choice choice = takes_all() ? Choice{k, 1.0} : choose_source(cell, unit_fine(which[0], which[1]));
  return sample_of(choice, reference, where, forward_ratio);
}

LightSample DirectLight::sample_of(const Choice& choice, const ReferencePoint& reference, const Words& where,
                                   double forward_ratio) const {
  const LightSource& source = sources_[choice.source];
  if (source.kind != LightSource::Kind::area) {
    const bool opens = source.kind == LightSource::Kind::opening;
    const PointLight& light = opens ? openings_[source.index] : points_[source.index];
    LightSample sample = opens ? light.sample_light(reference, light.place(unit_open(where[0]), unit_open(where[1])))
                               : light.sample_light(reference);
    if (sample.irradiance > 0.0) sample.irradiance = weighted(sample.irradiance, choice.probability, forward_ratio);
    return sample;
  }
  const AreaLight& light = areas_[source.index];
  LightSample sample = light.sample_light(reference, unit_open(where[0]), unit_open(where[1]), unit_open(where[2]));
  if (!(sample.irradiance > 0.0)) return sample;
  const double pdf_point = sample.relative / light.area_m2();
  const double pdf_light = choice.probability / light.area_m2() * sample.relative;
  const double pdf_forward = forward_ratio * (sample.irradiance * pdf_point / power_);
  sample.irradiance *= pdf_light / (pdf_light + sample.pdf_bsdf + pdf_forward) / choice.probability;
  return sample;
}

std::optional<std::size_t> DirectLight::emitter_at(const ReferencePoint& reference) const {
  for (const PointLight& light : points_) {
    if (light.position() == reference.point) return light.number();
  }
  if (areas_.empty()) return std::nullopt;
  const Bounds bounds = bounds_of(*room_);
  const glm::dvec3 size = bounds.high - bounds.low;
  const double near = on_emitter * std::max({size.x, size.y, size.z});
  for (std::size_t n = 0; n < room_->emitters.size(); ++n) {
    const std::optional<std::size_t> number = emitting_surface(room_->emitters[n]);
    if (!number || room_->emitters[n].power == 0.0) continue;
    const Surface& surface = room_->surfaces[*number];
    for (std::size_t k = 0; k < surface.triangles.size(); ++k) {
      const glm::uvec3 corner = surface.triangles[k];
      const glm::dvec3 a = surface.positions[corner.x];
      const glm::dvec3 b = surface.positions[corner.y] - a;
      const glm::dvec3 c = surface.positions[corner.z] - a;
      const glm::dvec3 cross = glm::cross(b, c);
      const double twice = glm::length(cross);
      const glm::dvec3 p = reference.point - a;
      if (!(twice > 0.0) || std::abs(glm::dot(p, cross)) > near * twice) continue;
      const bool is_planar = reference.law == ReceiverLaw::planar;
      if (is_planar && glm::dot(reference.normal, cross) >= 0.0) continue;  // it faces away from the emitter
      const double s = glm::dot(glm::cross(p, c), cross) / (twice * twice);
      const double t = glm::dot(glm::cross(b, p), cross) / (twice * twice);
      if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) return n;
    }
  }
  return std::nullopt;
}

}  // namespace lichtmc
