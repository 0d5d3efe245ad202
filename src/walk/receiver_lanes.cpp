#include "walk/receiver_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/geometric.hpp>

#include "room/bounds.hpp"
#include "walk/channel_scores.hpp"

namespace lichtmc {

namespace {

// Heights over a plane below this are rounding errors: some roundings of coordinates of about 1. A receiver that lies
// in the plane of an impact gets nothing from it.
constexpr float least_height = 8.0F * 0x1p-24F;

// The position of a point in a box along a curve that visits neighbours one after the other (G. M. Morton, 1966):
// through cubes, so that neighbours on the curve are close together also in an elongated box.
std::uint64_t morton(const glm::dvec3& point, const Bounds& box) {
  constexpr int bits = 16;
  const glm::dvec3 extent = box.high - box.low;
  const double size = std::max({extent.x, extent.y, extent.z});
  std::uint64_t code = 0;
  for (int c = 0; c < 3; ++c) {
    const double share = size > 0.0 ? (point[c] - box.low[c]) / size : 0.0;
    const auto cell = static_cast<std::uint64_t>(share * ((1 << bits) - 1));
    for (int bit = 0; bit < bits; ++bit) code |= (cell >> bit & 1U) << (3 * bit + c);
  }
  return code;
}

// Receivers in lanes.
struct Lanes {
  const float* LICHTMC_APART x;
  const float* LICHTMC_APART y;
  const float* LICHTMC_APART z;
  const float* LICHTMC_APART normal_x;
  const float* LICHTMC_APART normal_y;
  const float* LICHTMC_APART normal_z;
  const float* LICHTMC_APART least_squared_cosine;
  const float* LICHTMC_APART spread;
};

// w G at receiver k, without shadows: G = cos θ cos ψ/(π r²), the radiance of a Lambertian impact of exitance 1 times
// the projected solid angle. With walks from the receivers it is weighted by the balance heuristic, w G/(1 + ratio ·
// G/sin² α): their first flight reaches the impact with the density G/sin² α, α the half angle of the field of view.
inline float irradiance_at(const Impact& impact, const Lanes& at, std::size_t k) {
  constexpr float inverse_pi = 0.318309886F;
  const float dx = at.x[k] - impact.point.x;
  const float dy = at.y[k] - impact.point.y;
  const float dz = at.z[k] - impact.point.z;
  const float squared = dx * dx + dy * dy + dz * dz;
  const float height = dx * impact.normal.x + dy * impact.normal.y + dz * impact.normal.z;  // r cos θ, over the impact
  const float depth = -(dx * at.normal_x[k] + dy * at.normal_y[k] + dz * at.normal_z[k]);  // r cos ψ, over the receiver
  const bool seen =
      (height > least_height) & (depth > least_height) & (depth * depth >= at.least_squared_cosine[k] * squared);
  const float projected = inverse_pi * height * depth;
  const float value =
      impact.weight * projected / (squared * squared + impact.backward_ratio * at.spread[k] * projected);
  return seen ? value : 0.0F;
}

// Of receivers some of which are cylinders.
struct LawLanes {
  const float* LICHTMC_APART facing_x;
  const float* LICHTMC_APART facing_y;
  const float* LICHTMC_APART facing_z;
  const float* LICHTMC_APART around;        // 1: a cylinder or half cylinder, 0: planar
  const float* LICHTMC_APART least_height;  // over impacts
};

// The same for any law: with r w in place of r cos ψ. A cylinder has sin ε/π, ε the angle to its axis, and a half
// cylinder (sin ε + sin ε cos α)/π, the second term of which is the component towards the direction that it faces.
inline float irradiance_by_law(const Impact& impact, const Lanes& at, const LawLanes& laws, std::size_t k) {
  constexpr float inverse_pi = 0.318309886F;
  const float dx = at.x[k] - impact.point.x;
  const float dy = at.y[k] - impact.point.y;
  const float dz = at.z[k] - impact.point.z;
  const float nx = at.normal_x[k];
  const float ny = at.normal_y[k];
  const float nz = at.normal_z[k];
  const float squared = dx * dx + dy * dy + dz * dz;
  const float height = dx * impact.normal.x + dy * impact.normal.y + dz * impact.normal.z;
  const float depth = -(dx * nx + dy * ny + dz * nz);
  const float across_x = dy * nz - dz * ny;
  const float across_y = dz * nx - dx * nz;
  const float across_z = dx * ny - dy * nx;
  const float sine = std::sqrt(across_x * across_x + across_y * across_y + across_z * across_z);
  const float forward = -(dx * laws.facing_x[k] + dy * laws.facing_y[k] + dz * laws.facing_z[k]);
  const bool is_around = laws.around[k] > 0.0F;
  const float around = inverse_pi * (sine + forward);
  const bool in_view = (depth > least_height) & (depth * depth >= at.least_squared_cosine[k] * squared);
  const bool seen = (height > laws.least_height[k]) & ((is_around & (around > 0.0F)) | (!is_around & in_view));
  const float projected = inverse_pi * height * (is_around ? around : depth);
  const float value =
      impact.weight * projected / (squared * squared + impact.backward_ratio * at.spread[k] * projected);
  return seen ? value : 0.0F;
}

LICHTMC_LANES std::uint32_t irradiate_lanes_by_law(std::size_t n, const Impact& impact, const Lanes& at,
                                                   const LawLanes& laws, float* LICHTMC_APART value) {
  const Impact here = impact;
  const Lanes lanes = at;
  const LawLanes by = laws;
  std::uint32_t any = 0;
  for (std::size_t k = 0; k < n; ++k) {
    value[k] = irradiance_by_law(here, lanes, by, k);
    any |= value[k] > 0.0F ? 1U : 0U;
  }
  return any;
}

LICHTMC_LANES std::uint32_t irradiate_lanes(std::size_t n, const Impact& impact, const Lanes& at,
                                            float* LICHTMC_APART value) {
  const Impact here = impact;
  const Lanes lanes = at;
  std::uint32_t any = 0;
  for (std::size_t k = 0; k < n; ++k) {
    value[k] = irradiance_at(here, lanes, k);
    any |= value[k] > 0.0F ? 1U : 0U;
  }
  return any;
}

LICHTMC_LANES void add_lanes(std::size_t n, const float* LICHTMC_APART value, double* LICHTMC_APART sums) {
  for (std::size_t k = 0; k < n; ++k) sums[k] += double{value[k]};
}

// The irradiance by many impacts where nothing casts a shadow.
LICHTMC_LANES void irradiate_all_lanes(std::size_t n, const Impact* impacts, std::size_t count, const Lanes& at,
                                       double* LICHTMC_APART sums) {
  const Lanes lanes = at;
  for (std::size_t i = 0; i < count; ++i) {
    const Impact here = impacts[i];
    double* LICHTMC_APART of_row = sums + here.row * n;
    for (std::size_t k = 0; k < n; ++k) of_row[k] += double{irradiance_at(here, lanes, k)};
  }
}

// Positions shifted within cells.
LICHTMC_LANES void shift_lanes(std::size_t n, const float* LICHTMC_APART from, const float* LICHTMC_APART u,
                               const float* LICHTMC_APART v, float share_u, float share_v, float* LICHTMC_APART to) {
  for (std::size_t k = 0; k < n; ++k) to[k] = from[k] + share_u * u[k] + share_v * v[k];
}

}  // namespace

ReceiverLanes::ReceiverLanes(const std::vector<ReferencePoint>& receivers, const Tracer& tracer, std::size_t first,
                             std::size_t last)
    : first_(first), number_(last - first) {
  // The sides of the tracer's unit cube, as long as they are in the world.
  const glm::dmat3 axes(tracer.world_vector({1.0, 0.0, 0.0}), tracer.world_vector({0.0, 1.0, 0.0}),
                        tracer.world_vector({0.0, 0.0, 1.0}));
  size_m_ = std::max({glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])});
  to_lanes_ = axes * (1.0 / size_m_);

  Bounds box;
  for (std::size_t k = first; k < last; ++k) box.add(receivers[k].point);
  std::iota(number_.begin(), number_.end(), 0U);
  std::vector<std::uint64_t> codes(number_.size());
  for (const std::uint32_t k : number_) codes[k] = morton(receivers[first + k].point, box);
  std::stable_sort(number_.begin(), number_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return codes[a] < codes[b]; });

  bool has_laws = false;
  const std::size_t whole = whole_lanes(number_.size());
  for (std::vector<float>& array : arrays_) array.resize(whole, 0.0F);
  ends_.resize(number_.size());
  for (std::size_t k = 0; k < number_.size(); ++k) {
    const ReferencePoint& receiver = receivers[first + number_[k]];
    const glm::vec3 end(start_of(receiver, tracer));
    const glm::vec3 here = point(end);
    // No reflected light reaches a receiver outside a room in which nothing casts a shadow, and none an empty field of
    // view: without a normal it receives nothing.
    const bool receives = !receiver.way_out && receiver.squared_sine() > 0.0;
    const glm::vec3 normal = receives ? glm::vec3(receiver.normal) : glm::vec3(0.0F);
    const double squared_sine = receives ? receiver.squared_sine() : 1.0;
    const std::array<double, 8> of_receiver{here.x,
                                            here.y,
                                            here.z,
                                            normal.x,
                                            normal.y,
                                            normal.z,
                                            receiver.least_cosine * receiver.least_cosine,
                                            1.0 / squared_sine};
    for (std::size_t c = 0; c < arrays_.size(); ++c) arrays_[c][k] = static_cast<float>(of_receiver[c]);
    ends_.set(k, end);
    if (receiver.is_cell()) set_edges(k, receiver, tracer);
    if (receiver.law != ReceiverLaw::planar) has_laws = true;
  }
  if (has_laws) set_laws(receivers);
}

void ReceiverLanes::set_laws(const std::vector<ReferencePoint>& receivers) {
  laws_.resize(5);
  for (std::vector<float>& array : laws_) array.resize(whole_lanes(size()), 0.0F);
  for (std::size_t k = 0; k < size(); ++k) {
    const ReferencePoint& receiver = receivers[first_ + number_[k]];
    // One that receives nothing has no axis, and then no direction that it faces.
    const bool receives = arrays_[3][k] != 0.0F || arrays_[4][k] != 0.0F || arrays_[5][k] != 0.0F;
    for (int c = 0; c < 3; ++c)
      laws_[static_cast<std::size_t>(c)][k] = receives ? static_cast<float>(receiver.facing[c]) : 0.0F;
    laws_[3][k] = receiver.law != ReceiverLaw::planar ? 1.0F : 0.0F;
    laws_[4][k] = std::max(least_height, static_cast<float>(receiver.least_height_m / size_m_));
  }
}

void ReceiverLanes::set_edges(std::size_t k, const ReferencePoint& receiver, const Tracer& tracer) {
  edges_.resize(12);
  for (std::vector<float>& edge : edges_) edge.resize(whole_lanes(size()), 0.0F);
  const glm::dvec3 u = tracer.tracer_vector(receiver.cell_u);
  const glm::dvec3 v = tracer.tracer_vector(receiver.cell_v);
  const std::array<glm::dvec3, 4> all{to_lanes_ * u, to_lanes_ * v, u, v};
  for (std::size_t e = 0; e < all.size(); ++e) {
    for (int c = 0; c < 3; ++c) edges_[3 * e + static_cast<std::size_t>(c)][k] = static_cast<float>(all[e][c]);
  }
}

namespace {

template <class Arrays>
Lanes lanes_from(const Arrays& of, std::size_t first) {
  return {of[0].data() + first, of[1].data() + first, of[2].data() + first, of[3].data() + first,
          of[4].data() + first, of[5].data() + first, of[6].data() + first, of[7].data() + first};
}

LawLanes law_lanes_from(const std::vector<std::vector<float>>& of, std::size_t first) {
  return {of[0].data() + first, of[1].data() + first, of[2].data() + first, of[3].data() + first, of[4].data() + first};
}

// laws: empty if all receivers are planar.
std::uint32_t irradiate_any(std::size_t n, const Impact& impact, const Lanes& at,
                            const std::vector<std::vector<float>>& laws, std::size_t first, float* value) {
  if (laws.empty()) return irradiate_lanes(n, impact, at, value);
  return irradiate_lanes_by_law(n, impact, at, law_lanes_from(laws, first), value);
}

}  // namespace

std::uint64_t ReceiverLanes::irradiate(std::span<const Impact> impacts, const Tracer& tracer,
                                       const ReceiverReach* reach, std::vector<float>& value, std::vector<double>& sums,
                                       TraceCount& count, const ImpactRecord* record) const {
  const std::size_t n = whole_lanes(size());
  if (has_cells()) return irradiate_cells(impacts, tracer, value, sums, count);
  if (!tracer.casts_shadows() && record == nullptr && laws_.empty()) {
    irradiate_all_lanes(n, impacts.data(), impacts.size(), lanes_from(arrays_, 0), sums.data());
    return impacts.size() * size();
  }
  value.resize(n);
  std::uint64_t pairs = 0;
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    const Impact& impact = impacts[i];
    double* of_row = sums.data() + impact.row * n;
    const auto serve = [&](const Impact& weighted, std::size_t begin, std::size_t end) {
      const bool some = irradiate_some(weighted, begin, end, tracer, value.data(), of_row, count);
      if (record != nullptr && some)
        record->scores->add_impact(record->paths[i], begin, end, value.data() + begin, record->unit);
      pairs += end - begin;
    };
    if (reach == nullptr) {
      serve(impact, 0, size());
      continue;
    }
    Impact weighted = impact;
    reach->choose(impact.cell, impact.turn, first_, size(), [&](std::size_t begin, std::size_t end, float factor) {
      weighted.weight = factor * impact.weight;
      serve(weighted, begin, end);
    });
  }
  return pairs;
}

bool ReceiverLanes::irradiate_some(const Impact& impact, std::size_t begin, std::size_t end, const Tracer& tracer,
                                   float* value, double* sums, TraceCount& count) const {
  const std::size_t n = whole_lanes(end - begin);
  if (irradiate_any(n, impact, lanes_from(arrays_, begin), laws_, begin, value + begin) == 0) return false;
  if (tracer.casts_shadows()) tracer.darken_blocked(impact.start, ends_, begin, end, value, count);
  add_lanes(n, value + begin, sums + begin);
  return true;
}

void ReceiverLanes::irradiate_unshadowed(const Impact& impact, std::vector<float>& value) const {
  const std::size_t n = whole_lanes(size());
  value.resize(n);
  irradiate_any(n, impact, lanes_from(arrays_, 0), laws_, 0, value.data());
}

// As irradiate(), with receivers shifted within their cells.
std::uint64_t ReceiverLanes::irradiate_cells(std::span<const Impact> impacts, const Tracer& tracer,
                                             std::vector<float>& value, std::vector<double>& sums,
                                             TraceCount& count) const {
  const std::size_t n = whole_lanes(size());
  value.resize(n);
  std::array<std::vector<float>, 3> shifted{arrays_[0], arrays_[1], arrays_[2]};
  Lanes lanes = lanes_from(arrays_, 0);
  lanes.x = shifted[0].data();
  lanes.y = shifted[1].data();
  lanes.z = shifted[2].data();
  EndPoints ends = ends_;
  const auto shift = [&](const std::vector<float>& from, std::size_t u, const Impact& by, std::vector<float>& to) {
    shift_lanes(n, from.data(), edges_[u].data(), edges_[u + 3].data(), by.in_cell_u, by.in_cell_v, to.data());
  };
  for (const Impact& impact : impacts) {
    for (std::size_t c = 0; c < 3; ++c) shift(arrays_[c], c, impact, shifted[c]);
    if (irradiate_any(n, impact, lanes, laws_, 0, value.data()) == 0) continue;
    if (tracer.casts_shadows()) {
      shift(ends_.x, 6, impact, ends.x);
      shift(ends_.y, 7, impact, ends.y);
      shift(ends_.z, 8, impact, ends.z);
      tracer.darken_blocked(impact.start, ends, 0, size(), value.data(), count);
    }
    add_lanes(n, value.data(), sums.data() + impact.row * n);
  }
  return impacts.size() * size();
}

}  // namespace lichtmc
