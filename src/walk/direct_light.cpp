#include "walk/direct_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "chance/choice.hpp"
#include "room/bounds.hpp"
#include "room/emitter_shape.hpp"
#include "walk/near_area_light.hpp"

namespace lichtmc {

namespace {

constexpr double pi = std::numbers::pi;

// Up to this number of emitters, each is sampled at every surface. With more, the shadow rays cost more than the lower
// variance saves.
constexpr std::size_t few = 4;

// A receiver within this distance of an area light, as a fraction of the room's size, counts as on it: a millionth, the
// resolution of Embree's coordinates.
constexpr double on_emitter = 1e-6;

}  // namespace

DirectLight::DirectLight(const Room& room, const Tracer& tracer)
    : room_(&room), tracer_(&tracer), power_(total_power(room)) {
  areas_of_surface_.resize(room.surfaces.size());
  std::vector<double> fluxes;
  EmissionOfRoom emission(room);
  source_of_emitter_.assign(room.emitters.size(), 0);
  for (std::size_t n = 0; n < room.emitters.size(); ++n) {
    const double flux = room.emitters[n].power;
    if (flux == 0.0) continue;
    source_of_emitter_[n] = sources_.size();
    fluxes.push_back(flux);
    visit_shape(
        room.emitters[n],
        [&](const auto& point) {
          sources_.push_back({false, points_.size(), 1.0});
          points_.emplace_back(point, flux, n);
        },
        [&](const auto& area) {
          AreaLight light(room, area, emission.of(area), flux, tracer.locate(area.surface, 0).facet,
                          tracer.faces_in_one_plane());
          if (!(light.area_m2() > 0.0)) {  // wholly covered
            fluxes.pop_back();
            return;
          }
          areas_of_surface_[area.surface].push_back(areas_.size());
          sources_.push_back({true, areas_.size(), 1.0});
          areas_.push_back(std::move(light));
        });
  }
  area_shares_.assign(areas_.size(), 1.0);
  few_ = sources_.size() <= few;
  if (!few_) choose_by_flux(fluxes);
}

void DirectLight::choose_by_flux(const std::vector<double>& fluxes) {
  const double sum = std::accumulate(fluxes.begin(), fluxes.end(), 0.0);
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    sources_[k].share = fluxes[k] / sum;
    if (sources_[k].is_area) area_shares_[sources_[k].index] = sources_[k].share;
  }
  fluxes_up_to_ = cumulative(fluxes);
}

DirectIrradiance DirectLight::irradiance_at(const ReferencePoint& reference, const Stream& stream, std::uint64_t number,
                                            TraceCount& count) const {
  DirectIrradiance sum;
  double variance = 0.0;
  for (const PointLight& light : points_) {
    const LightSample sample = light.sample_light(reference);
    if (sample.irradiance > 0.0 && !is_blocked(*tracer_, reference, sample.target, count))
      sum.value += sample.irradiance;
  }
  if (reference.way_out) return sum;  // the walls lie between area lights, which are walls, and points outside
  for (std::size_t k = 0; k < areas_.size(); ++k) {
    if (!tracer_->casts_shadows() && areas_[k].has_closed_form() && reference.least_cosine <= 0.0) {
      sum.value += areas_[k].polygon_irradiance(reference);
      continue;
    }
    if (is_near(areas_[k], reference)) {
      const DirectIrradiance part =
          sample_near_light(areas_[k], *tracer_, reference, stream, number * areas_.size() + k, count);
      sum.value += part.value;
      variance += part.standard_error * part.standard_error;
      continue;
    }
    const auto same_point = [&reference](std::uint32_t) { return reference; };
    const DirectIrradiance part =
        sample_area_light(areas_[k], *tracer_, same_point, stream, number * areas_.size() + k, {}, count);
    sum.value += part.value;
    variance += part.standard_error * part.standard_error;
  }
  sum.standard_error = std::sqrt(variance);
  return sum;
}

LightSample DirectLight::sample_light(std::size_t k, const ReferencePoint& reference, const Words& which,
                                      const Words& where, double forward_ratio) const {
  const LightSource& source = sources_[few_ ? k : choose(fluxes_up_to_, unit_fine(which[0], which[1]))];
  if (!source.is_area) {
    LightSample sample = points_[source.index].sample_light(reference);
    if (sample.irradiance > 0.0) sample.irradiance /= source.share + forward_ratio * (sample.irradiance / power_);
    return sample;
  }
  const AreaLight& light = areas_[source.index];
  LightSample sample = light.sample_light(reference, unit_open(where[0]), unit_open(where[1]), unit_open(where[2]));
  if (!(sample.irradiance > 0.0)) return sample;
  const double pdf_point = sample.relative / light.area_m2();
  const double pdf_light = source.share / light.area_m2() * sample.relative;
  const double pdf_forward = forward_ratio * (sample.irradiance * pdf_point / power_);
  sample.irradiance *= pdf_light / (pdf_light + sample.pdf_bsdf + pdf_forward) / source.share;
  return sample;
}

double DirectLight::mis_weighted_emission(const Rays& rays, std::size_t i, double cosine_here,
                                          const FlightGeometry& flight, double forward_ratio) const {
  double sum = 0.0;
  const double pdf_bsdf = flight.pdf_bsdf(cosine_here);
  for (const std::size_t k : areas_of_surface_[tracer_->facets()[rays.facet[i]].surface]) {
    const double relative = areas_[k].relative_exitance(rays.facet[i], rays.s[i], rays.t[i]);
    const double pdf_light = area_shares_[k] / areas_[k].area_m2() * relative;
    const double radiance = areas_[k].radiance(flight.cosine_there) * relative;
    if (!(radiance > 0.0)) continue;
    const double pdf_forward = forward_ratio * (pi * radiance * pdf_bsdf / power_);
    sum += pi * radiance * pdf_bsdf / (pdf_light + pdf_bsdf + pdf_forward);
  }
  return sum;
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
      if (glm::dot(reference.normal, cross) >= 0.0) continue;  // it faces away from the emitter
      const double s = glm::dot(glm::cross(p, c), cross) / (twice * twice);
      const double t = glm::dot(glm::cross(b, p), cross) / (twice * twice);
      if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) return n;
    }
  }
  return std::nullopt;
}

}  // namespace lichtmc
