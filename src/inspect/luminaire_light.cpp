#include "inspect/luminaire_light.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/message.hpp"
#include "chance/stream.hpp"
#include "lichtmc/photometry.hpp"

namespace lichtmc {

namespace {

constexpr std::uint32_t no_emitter = std::numeric_limits<std::uint32_t>::max();

// Beyond the half diagonal of the opening, m: the frame of a luminaire.
constexpr double frame_m = 0.02;
// Triangles of a housing are not much larger than the housing; those of a ceiling are.
constexpr double largest_in_housing = 3.0;
// From five times the largest dimension on, a luminaire may be taken for a point: the illuminance below a Lambertian
// disc of diameter D at the distance d is that of a point times 1/(1 + (D/2d)²), 1 % less at d = 5 D.
constexpr double far_sizes = 5.0;
// The mean over these places is known to some 5 %.
constexpr std::size_t most_places = 400;
constexpr int steps_at_places = 12;  // along each side of the opening
constexpr int steps_at_receivers = 32;
// With fewer of the probe's 32 768 photons, shares are not known.
constexpr std::uint64_t enough_of_a_luminaire = 64;

std::vector<double> longest_edges(const Room& room) {
  std::vector<double> medians;
  for (const Surface& surface : room.surfaces) {
    std::vector<double> edges;
    for (const glm::uvec3& t : surface.triangles) {
      const glm::dvec3& a = surface.positions[t.x];
      const glm::dvec3& b = surface.positions[t.y];
      const glm::dvec3& c = surface.positions[t.z];
      edges.push_back(std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)}));
    }
    const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
    std::nth_element(edges.begin(), middle, edges.end());
    medians.push_back(edges.empty() ? 0.0 : *middle);
  }
  return medians;
}

}  // namespace

double LuminaireLight::light_of_point(const Lamp& lamp, const glm::dvec3& start, const glm::dvec3& point,
                                      const glm::dvec3& normal) {
  const glm::dvec3 way = point - start;
  const double square = glm::dot(way, way);
  const double cosine = -glm::dot(way, normal);
  if (!(cosine > 0.0) || !(square > 0.0)) return 0.0;
  const glm::dvec3 to = way / std::sqrt(square);
  const glm::dvec3 local(glm::dot(to, lamp.axes.c0), glm::dot(to, lamp.axes.c90), glm::dot(to, lamp.axes.aim));
  return lamp.photometry->candela->candela(local) * cosine / (square * std::sqrt(square));
}

double LuminaireLight::light_of_opening(const Lamp& lamp, const glm::dvec3& point, const glm::dvec3& normal,
                                        int steps) {
  double sum = 0.0;
  for (int j = 0; j < steps; ++j) {
    for (int k = 0; k < steps; ++k) {
      const glm::dvec3 place = lamp.photometry->opening.place((j + 0.5) / steps, (k + 0.5) / steps);
      const glm::dvec3 start =
          lamp.position + place.x * lamp.axes.c0 + place.y * lamp.axes.c90 + place.z * lamp.axes.aim;
      sum += light_of_point(lamp, start, point, normal);
    }
  }
  return sum / (steps * steps);
}

// Walls beside a long luminaire may be nearer to its middle than its ends. A housing is nearer to the opening than half
// of its width, or than the depth of a shade.
bool LuminaireLight::is_beside_opening(const glm::dvec3& point, const Lamp& lamp, const LuminousOpening& opening) {
  constexpr double shade_m = 0.15;
  const glm::dvec3 way = point - lamp.position;
  const glm::dvec3 local(glm::dot(way, lamp.axes.c0), glm::dot(way, lamp.axes.c90), glm::dot(way, lamp.axes.aim));
  const glm::dvec3 half = 0.5 * opening.size_m;
  const double low = std::min({half.x, half.y, half.z});
  const double high = std::max({half.x, half.y, half.z});
  const double middle = half.x + half.y + half.z - low - high;
  return glm::length(glm::max(glm::abs(local) - half, glm::dvec3(0.0))) <= std::max(shade_m, middle) + frame_m;
}

LuminaireLight::LuminaireLight(const Room& room, const Scene& scene) : room_(room), scene_(scene) {
  list_files();
  if (lamps_.empty()) return;
  longest_edge_ = longest_edges(room);
  emitter_of_.resize(batch_histories, no_emitter);
}

void LuminaireLight::list_files() {
  std::map<const Photometry*, std::size_t> files;
  std::vector<Lamp> lamps(room_.emitters.size());
  for (std::size_t e = 0; e < room_.emitters.size(); ++e) {
    Lamp& lamp = lamps[e];
    bool all_over = false;
    std::visit(
        [&](const auto& shape) {
          if constexpr (requires { shape.photometry; }) {
            lamp.photometry = shape.photometry.get();
            lamp.position = shape.position;
            lamp.axes = {shape.axis, shape.c0, shape.c90};
            all_over = shape.opening.has_value();
          }
        },
        room_.emitters[e].shape);
    if (lamp.photometry == nullptr) continue;
    const Photometry& file = *lamp.photometry;
    const auto [entry, is_new] = files.try_emplace(&file, facts_.size());
    if (is_new) {
      LuminaireFacts& facts = facts_.emplace_back();
      facts.file = std::filesystem::path(file.source).filename().string();
      facts.version = file.version;
      facts.watts = file.watts;
      facts.opening = file.opening;
      facts.limit_m = far_sizes * file.opening.largest_m();
    }
    LuminaireFacts& facts = facts_[entry->second];
    ++facts.count;
    facts.power += room_.emitters[e].power;
    lamp.file = entry->second;
    lamp.housing_m = file.opening.half_diagonal_m() + frame_m;
    lamp.sizeless = !all_over && file.opening.form != OpeningForm::point;
    if (lamp.sizeless) ++facts.as_points;
  }
  if (facts_.empty()) return;
  lamps_ = std::move(lamps);
  places_.resize(facts_.size());
}

void LuminaireLight::start(std::uint32_t photon, std::size_t emitter) {
  if (lamps_.empty()) return;
  const bool counts = lamps_[emitter].photometry != nullptr;
  emitter_of_[photon] = counts ? static_cast<std::uint32_t>(emitter) : no_emitter;
  if (counts) ++lamps_[emitter].photons;
}

void LuminaireLight::land(const Wave& wave) {
  if (lamps_.empty()) return;
  const Rays& rays = wave.rays;
  for (std::size_t i = 0; i < rays.size; ++i) {
    std::uint32_t& emitter = emitter_of_[wave.photon[i]];
    if (emitter == no_emitter) continue;
    Lamp& lamp = lamps_[emitter];
    const glm::dvec3 start(rays.start(i));
    const glm::dvec3 end = scene_.tracer->world_point(start + double{rays.length[i]} * glm::dvec3(rays.direction(i)));
    const double distance = glm::length(end - lamp.position);
    const std::uint32_t facet = rays.facet[i];
    if (distance <= lamp.housing_m && is_beside_opening(end, lamp, facts_[lamp.file].opening) &&
        longest_edge_[scene_.surface_of[facet]] <= largest_in_housing * lamp.housing_m)
      ++lamp.in_housing;
    if (lamp.sizeless && distance < facts_[lamp.file].limit_m) {
      ++lamp.near;
      std::vector<Place>& places = places_[lamp.file];
      if (places.size() < most_places) {
        const glm::dvec3 normal = glm::normalize(glm::inverse(scene_.tracer->directions()) *
                                                 glm::dvec3(scene_.tracer->facets()[facet].normal));
        places.push_back({emitter, end, rays.behind[i] != 0 ? -normal : normal});
      }
    }
    emitter = no_emitter;
  }
}

std::vector<LuminaireFacts> LuminaireLight::facts() const {
  std::vector<LuminaireFacts> list = facts_;
  std::vector<std::uint64_t> photons(list.size());
  std::vector<std::uint64_t> near(list.size());
  for (std::size_t e = 0; e < lamps_.size(); ++e) {
    const Lamp& lamp = lamps_[e];
    if (lamp.photometry == nullptr) continue;
    if (lamp.sizeless) {
      photons[lamp.file] += lamp.photons;
      near[lamp.file] += lamp.near;
    }
    if (lamp.photons < enough_of_a_luminaire) continue;
    LuminaireFacts& facts = list[lamp.file];
    const double share = static_cast<double>(lamp.in_housing) / static_cast<double>(lamp.photons);
    if (share <= facts.in_housing) continue;
    facts.in_housing = share;
    facts.housing_m = lamp.housing_m;
    facts.housed = room_.emitters[e].name;
  }
  for (std::size_t f = 0; f < list.size(); ++f) {
    if (photons[f] >= enough_of_a_luminaire)
      list[f].near = static_cast<double>(near[f]) / static_cast<double>(photons[f]);
    // Photons land with a density proportional to the illuminance: their mean is that of the light.
    double elsewhere = 0.0;
    for (const Place& place : places_[f]) {
      const Lamp& lamp = lamps_[place.emitter];
      const double as_point = light_of_point(lamp, lamp.position, place.point, place.normal);
      const double as_area = light_of_opening(lamp, place.point, place.normal, steps_at_places);
      if (as_point > 0.0) elsewhere += std::abs(as_area / as_point - 1.0);
    }
    if (!places_[f].empty()) list[f].elsewhere = elsewhere / static_cast<double>(places_[f].size());
  }
  find_nearest_receivers(list);
  return list;
}

void LuminaireLight::find_nearest_receivers(std::vector<LuminaireFacts>& list) const {
  for (const Lamp& lamp : lamps_) {
    if (lamp.photometry == nullptr || !lamp.sizeless) continue;
    LuminaireFacts& facts = list[lamp.file];
    double limit = facts.nearest_receiver.empty() ? facts.limit_m : facts.nearest_m;
    for (const Receiver& receiver : room_.receivers) {
      const glm::dvec3 way = receiver.position - lamp.position;
      if (!(glm::dot(way, way) < limit * limit)) continue;
      const glm::dvec3 normal = glm::normalize(receiver.normal);
      const double as_point = light_of_point(lamp, lamp.position, receiver.position, normal);
      if (!(as_point > 0.0)) continue;
      const double as_area = light_of_opening(lamp, receiver.position, normal, steps_at_receivers);
      limit = glm::length(way);
      facts.nearest_m = limit;
      facts.nearest_receiver = receiver.name;
      facts.excess_there = as_area > 0.0 ? as_point / as_area - 1.0 : std::numeric_limits<double>::infinity();
    }
  }
}

}  // namespace lichtmc
