// Direct light: the irradiance by the emitters themselves, with shadows.
//
// At a receiver it is not estimated by the walks but computed: point lights in closed form, E = I(θ) cos θ'/r²,
// with one shadow ray; Lambertian area lights by the polygon formula if nothing casts a shadow; other area lights by
// stratified samples to a relative standard error of 0.1 %. At the surfaces that a backward walk hits it is estimated
// by one point of one emitter, or of each emitter if there are few.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "chance/choice.hpp"
#include "chance/stream.hpp"
#include "lichtmc/room.hpp"
#include "tracer/tracer.hpp"
#include "walk/area_light_sampling.hpp"
#include "walk/light_selection.hpp"
#include "walk/light_source.hpp"
#include "walk/reference_point.hpp"
#include "walk/visibility.hpp"

namespace lichtmc {

struct Scene;

// An emitter with a flux, as DirectLight has it.
struct LightSource {
  enum class Kind { point, opening, area };
  Kind kind = Kind::point;
  std::size_t index = 0;    // into DirectLight::points(), openings() or areas()
  std::size_t number = 0;   // among all sources
  std::size_t emitter = 0;  // index into Room::emitters
  double flux = 0.0;        // W or lm
};

class DirectLight {
 public:
  // The room must have passed check_room(), and outlive this.
  DirectLight(const Room& room, const Tracer& tracer);

  // Learns which emitters light which part of the room (learn_selection.hpp), if there are more than a few; until then,
  // light samples choose them by flux alone. Call it before walks begin.
  void learn_selection(const Scene& scene);

  // The direct irradiance at a receiver. Samples of area lights depend on (seed, number) only. Shadow rays are counted.
  // accuracy: of the parts that are sampled. of_emitters: the part of each of Room::emitters is added there; null: not
  // wanted.
  DirectIrradiance irradiance_at(const ReferencePoint& reference, const Stream& stream, std::uint64_t number,
                                 TraceCount& count, const SamplingAccuracy& accuracy = {},
                                 std::vector<DirectIrradiance>* of_emitters = nullptr) const;

  // Its part by point emitters.
  double irradiance_by_points(const ReferencePoint& reference, TraceCount& count,
                              std::vector<DirectIrradiance>* of_emitters = nullptr) const;

  // The emitters with a flux above 0 that are not wholly covered by other faces in their plane; openings: point
  // emitters whose light starts all over an opening.
  const std::vector<PointLight>& points() const { return points_; }
  const std::vector<PointLight>& openings() const { return openings_; }
  const std::vector<AreaLight>& areas() const { return areas_; }
  // The index into Room::emitters of an area light, given by its index in areas().
  std::size_t emitter_of_area(std::size_t area) const { return emitter_of_area_[area]; }

  // Number of light samples at each surface of a walk: one of every emitter if there are few, else one of one emitter
  // (light_selection.hpp).
  std::size_t light_samples_per_point() const { return selection_ ? 1 : sources_.size(); }

  // The emitters that light samples choose from, numbered from 0; a point light, or null for others.
  std::size_t sources() const { return sources_.size(); }
  const LightSource& source(std::size_t number) const { return sources_[number]; }
  const PointLight* point_light(std::size_t source) const {
    return sources_[source].kind == LightSource::Kind::point ? &points_[sources_[source].index] : nullptr;
  }
  // Whether light sample k is of source k; if not, a source is chosen for it by u, uniform in [0, 1).
  bool takes_all() const { return !selection_; }
  struct Choice {
    std::size_t source = 0;
    double probability = 1.0;
  };
  Choice choose_source(std::uint32_t cell, double u) const {
    const LightSelection::Choice choice = selection_->choose(cell, u);
    return {choice.emitter, choice.probability};
  }

  // The cell of a surface point of the walk, whose table of emitters its light samples use.
  std::uint32_t cell_of(const ReferencePoint& reference) const {
    return selection_ ? selection_->cell_of(reference.point, reference.normal) : 0;
  }

  // Light sample k (below light_samples_per_point()) at a surface point of the walk, of this cell. Its mean over the
  // random words is the direct irradiance without shadows; area lights count with their weight of the balance
  // heuristic; walks that hit them add the rest (mis_weighted_emission()).
  //
  // forward_ratio, in m²: above 0 if histories from the emitters find the same paths, and contribute them to the origin
  // of the walk with the rest of the weights: n_F/(n_B p_r) for n_F such histories for n_B walks from the origin, where
  // p_r is the density per area of the walk's first impact, for a flight from the origin. Reflections between have the
  // same densities in both directions: only the ends of the path differ (E. Veach, L. Guibas, SIGGRAPH 1995). A history
  // from the emitters, of power ΣΦ in all, arrives first at a point of the surface, from a point x₀ of the emitter,
  // with the density e₀/ΣΦ, e₀ the irradiance by that point; per area of the emitter if it is an area light. With q the
  // probability that the light sample chooses the emitter, p_L the density of its points on it, and p_hit the density
  // with which a flight from the surface hits x₀, the weights are
  //   of a point light, or a point of an opening, whose density is the same either way:
  //                                 q / (q + forward_ratio e₀/ΣΦ)
  //   of the point of an area light: q p_L / (q p_L + p_hit + forward_ratio e₀/ΣΦ)
  //   of the flight that hits it:   p_hit / (q p_L + p_hit + forward_ratio e₀/ΣΦ)
  LightSample sample_light(std::size_t k, std::uint32_t cell, const ReferencePoint& reference, const Words& which,
                           const Words& where, double forward_ratio = 0.0) const;
  // The same for a source that is chosen already.
  LightSample sample_of(const Choice& choice, const ReferencePoint& reference, const Words& where,
                        double forward_ratio) const;
  // The same for a point light: its irradiance (above 0, without shadow) with its weight.
  double weighted(double irradiance, double probability, double forward_ratio) const {
    return irradiance / (probability + forward_ratio * (irradiance / power_));
  }

  // Flight i, which left a surface point of this cell at an angle of cosine `cosine_here`, has hit the front of an area
  // light: calls add(number of the source, its weighted contribution to the direct irradiance at the surface that it
  // left), for each emitter of that surface. Samples of the emitter's points and flights that hit it are combined by
  // the balance heuristic, see area_light_sampling.hpp. Without it, light samples on a wall that touches a luminous
  // ceiling would grow as 1/r² near the common edge. forward_ratio: see sample_light().
  template <class Add>
  void mis_weighted_emission(const Rays& rays, std::size_t i, std::uint32_t cell, double cosine_here,
                             const FlightGeometry& flight, double forward_ratio, const Add& add) const;
  bool has_area_lights() const { return !areas_.empty(); }
  // Whether light samples of some emitters take a random point of them.
  bool has_extended_lights() const { return !areas_.empty() || !openings_.empty(); }
  bool is_area_light(std::size_t surface) const { return !area_sources_of_surface_[surface].empty(); }

  // The emitter that a receiver at this point lies on, as index into Room::emitters.
  std::optional<std::size_t> emitter_at(const ReferencePoint& reference) const;

  // The source of an emitter with a flux above 0, not wholly covered; an index into Room::emitters.
  const LightSource& source_of(std::size_t emitter) const { return sources_[source_of_emitter_[emitter]]; }
  // The probability that the light samples at a surface choose this source; 1 if all are chosen.
  double selection_probability(const LightSource& source, const ReferencePoint& reference) const {
    return probability(cell_of(reference), source.number);
  }

 private:
  static constexpr std::size_t no_source = std::numeric_limits<std::size_t>::max();

  std::vector<double> fluxes() const;
  double probability(std::uint32_t cell, std::size_t source) const {
    return selection_ ? selection_->probability(cell, source) : 1.0;
  }

  const Room* room_;
  const Tracer* tracer_;
  std::vector<PointLight> points_;
  std::vector<PointLight> openings_;
  std::vector<AreaLight> areas_;
  std::vector<std::size_t> emitter_of_area_;  // of each of areas_
  std::vector<LightSource> sources_;
  std::vector<std::size_t> source_of_emitter_;                     // of Room::emitters; or no_source
  std::optional<LightSelection> selection_;                        // among sources_, unless these are few
  std::vector<std::vector<std::size_t>> area_sources_of_surface_;  // indices into sources_
  double power_ = 0.0;                                             // of all emitters of the room, W or lm
};

template <class Add>
void DirectLight::mis_weighted_emission(const Rays& rays, std::size_t i, std::uint32_t cell, double cosine_here,
                                        const FlightGeometry& flight, double forward_ratio, const Add& add) const {
  constexpr double pi = std::numbers::pi;
  const double pdf_bsdf = flight.pdf_bsdf(cosine_here);
  for (const std::size_t k : area_sources_of_surface_[tracer_->facets()[rays.facet[i]].surface]) {
    const AreaLight& light = areas_[sources_[k].index];
    const double relative = light.relative_exitance(rays.facet[i], rays.s[i], rays.t[i]);
    const double pdf_light = probability(cell, k) / light.area_m2() * relative;
    const double radiance = light.radiance(flight.cosine_there) * relative;
    if (!(radiance > 0.0)) continue;
    const double pdf_forward = forward_ratio * (pi * radiance * pdf_bsdf / power_);
    add(k, pi * radiance * pdf_bsdf / (pdf_light + pdf_bsdf + pdf_forward));
  }
}

}  // namespace lichtmc
