#include "inspect/emitter_light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/geometric.hpp>

#include "chance/stream.hpp"
#include "room/bounds.hpp"
#include "room/emitter_shape.hpp"

namespace lichtmc {

namespace {

// Distances of a luminaire's own size, of a body about a lamp, and of a void above a ceiling, in m.
constexpr double near_m = 0.25;
constexpr double about_m = 1.0;
constexpr double wide_m = 2.0;
constexpr double level_m = 0.3;

// In rooms smaller than this (models, other units) they shrink in proportion.
constexpr double usual_diagonal = 5.0;

// Shares are known to ± 1/(2√64) = 6 %. An emitter with fewer photons of the probe's 32 768 has less than 0.2 % of the
// power.
constexpr std::uint64_t enough_photons = 64;

// The diagonal of its bounding box, m.
double extent_of(const Surface& surface) {
  Bounds bounds;
  for (const glm::dvec3& p : surface.positions) bounds.add(p);
  return surface.positions.empty() ? 0.0 : glm::length(bounds.high - bounds.low);
}

std::uint64_t key(std::size_t emitter, std::uint32_t surface) {
  return (static_cast<std::uint64_t>(emitter) << 32) | surface;
}

}  // namespace

EmitterLight::EmitterLight(const Room& room, const Scene& scene, const glm::dvec3& low, const glm::dvec3& high)
    : scene_(scene), photons_(batch_histories), sums_(room.emitters.size()) {
  const double scale = std::min(1.0, glm::length(high - low) / usual_diagonal);
  near_m_ = scale * near_m;
  about_m_ = scale * about_m;
  wide_m_ = scale * wide_m;
  constexpr std::uint32_t no_surface = std::numeric_limits<std::uint32_t>::max();
  for (const Emitter& emitter : room.emitters) {
    const std::optional<std::size_t> surface = emitting_surface(emitter);
    const bool small = surface && extent_of(room.surfaces[*surface]) < 0.5 * glm::length(high - low);
    own_surface_.push_back(small ? static_cast<std::uint32_t>(*surface) : no_surface);
  }
  level_m_ = scale * level_m;
}

void EmitterLight::start(std::uint32_t photon, std::size_t emitter) {
  photons_[photon] = {static_cast<std::uint32_t>(emitter), 1.0, false, {}};
  ++sums_[emitter].photons;
}

void EmitterLight::land(const Wave& wave) {
  const Rays& rays = wave.rays;
  for (std::size_t i = 0; i < rays.size; ++i) {
    Photon& photon = photons_[wave.photon[i]];
    const glm::dvec3 start(rays.start(i));
    const glm::dvec3 end = scene_.tracer->world_point(start + double{rays.length[i]} * glm::dvec3(rays.direction(i)));
    if (!photon.started) {
      photon.started = true;
      photon.start = scene_.tracer->world_point(start);
      sums_[photon.emitter].first_behind += rays.behind[i];
      ++first_on_[key(photon.emitter, scene_.surface_of[rays.facet[i]])];
    }
    absorb(photon, end, scene_.surface_of[rays.facet[i]], scene_.reflectance(rays, i));
  }
}

void EmitterLight::absorb(Photon& photon, const glm::dvec3& end, std::uint32_t surface, double reflectance) {
  Sums& sums = sums_[photon.emitter];
  const double absorbed = photon.weight * (1.0 - reflectance);
  photon.weight *= reflectance;
  const glm::dvec3 way = end - photon.start;
  const double distance = glm::length(way);
  if (distance <= near_m_) sums.near += absorbed;
  if (distance <= about_m_) sums.about += absorbed;
  if (distance <= wide_m_) sums.wide += absorbed;
  if (surface == own_surface_[photon.emitter]) sums.itself += absorbed;
  if (std::abs(way.y) <= level_m_) sums.level += absorbed;
}

std::vector<EmitterFacts> EmitterLight::facts(const Room& room) const {
  std::vector<EmitterFacts> list;
  for (std::size_t e = 0; e < sums_.size(); ++e) {
    const Sums& sums = sums_[e];
    if (sums.photons < enough_photons) continue;
    const auto all = static_cast<double>(sums.photons);
    EmitterFacts facts;
    facts.name = room.emitters[e].name;
    facts.near_m = near_m_;
    facts.about_m = about_m_;
    facts.wide_m = wide_m_;
    facts.level_m = level_m_;
    facts.absorbed_near = sums.near / all;
    facts.absorbed_about = sums.about / all;
    facts.absorbed_wide = sums.wide / all;
    facts.absorbed_itself = sums.itself / all;
    facts.absorbed_level = sums.level / all;
    facts.first_behind = static_cast<double>(sums.first_behind) / all;
    std::uint32_t most = 0;
    for (std::uint32_t k = 0; k < room.surfaces.size(); ++k) {
      const auto found = first_on_.find(key(e, k));
      if (found == first_on_.end() || found->second <= most) continue;
      most = found->second;
      facts.first_surface = room.surfaces[k].name;
    }
    list.push_back(facts);
  }
  return list;
}

}  // namespace lichtmc
