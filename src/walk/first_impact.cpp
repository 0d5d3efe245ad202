#include "walk/first_impact.hpp"

#include <cmath>

#include <glm/geometric.hpp>

#include "room/emitter_shape.hpp"

namespace lichtmc {

FirstImpact::FirstImpact(const Room& room, const Tracer& tracer, const DirectLight& light)
    : tracer_(&tracer), light_(&light), power_(total_power(room)) {}

double FirstImpact::backward_over_forward(std::size_t emitter, const StartOnFacet& from, const Rays& rays,
                                          std::size_t i) const {
  const glm::dvec3 end(rays.start(i) + rays.length[i] * rays.direction(i));
  const ReferencePoint reference{tracer_->world_point(end), hit_normal(*tracer_, rays, i), 0.0};
  const LightSource& source = light_->source_of(emitter);
  const double q = light_->selection_probability(source, reference);
  if (source.kind != LightSource::Kind::area) {
    const bool opens = source.kind == LightSource::Kind::opening;
    const double irradiance = opens ? light_->openings()[source.index]
                                          .sample_light(reference, tracer_->world_point(glm::dvec3(rays.start(i))))
                                          .irradiance
                                    : light_->points()[source.index].sample_light(reference).irradiance;
    // A photon of a pencil beam reaches points that no light sample finds: its path is made forward only.
    return irradiance > 0.0 ? q * power_ / irradiance : 0.0;
  }
  const FlightGeometry flight = flight_geometry(*tracer_, rays, i);
  if (flight.degenerate()) return 0.0;
  const glm::dvec3 along = glm::normalize(tracer_->world_vector(glm::dvec3(rays.direction(i))));
  const double cosine_here = glm::dot(along, world_normal(*tracer_, tracer_->facets()[from.facet]));
  return cosine_here > 0.0 ? of_area_light(light_->areas()[source.index], q, from, flight, cosine_here) : 0.0;
}

double FirstImpact::of_area_light(const AreaLight& light, double q, const StartOnFacet& from,
                                  const FlightGeometry& flight, double cosine_here) const {
  const double relative = light.relative_exitance(from.facet, from.s, from.t);
  const double hit = flight.pdf_bsdf(cosine_here);
  const double irradiance = light.radiance(cosine_here) * relative * hit * std::numbers::pi;  // per area of the light
  return irradiance > 0.0 ? (q * relative / light.area_m2() + hit) * power_ / irradiance : 0.0;
}

}  // namespace lichtmc
