#include "tracer/departure.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/lanes.hpp"
#include "chance/directions.hpp"

namespace lichtmc {

namespace {

// If a facet is parallel to two axes, its normal has exactly one component, and only the coordinate along it counts:
// the distance between such walls may be arbitrarily small. Near the origin this step remains, which does not vanish in
// the products.
constexpr double least_step = step_roundings * 0x1p-24;

// Margin of a photon from the sides of its facet, in steps: it stays inside where walls meet at angles down to 27°.
constexpr double margin_steps = 2.0;

// A photon is never moved by more than this share of the facet: on slivers, narrower than some steps, the margin is
// smaller.
constexpr double largest_margin = 0x1p-10;

double largest_component(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Start point of a photon on a facet; the rule is in the header.
struct StartPoint {
  double x, y, z;

  StartPoint(const Departure& from, float on_s, float on_t, bool behind) {
    const double margin_s = from.margin.y;
    const double margin_t = from.margin.z;
    double s = on_s < from.margin.y ? margin_s : on_s;
    double t = on_t < from.margin.z ? margin_t : on_t;
    const double too_far = s + t - (1.0 - double{from.margin.x});
    const double excess = too_far > 0.0 ? 0.5 * too_far : 0.0;
    s -= excess;
    t -= excess;
    // In the acute corner this moved one of them below its margin; the other is well above its own.
    const double s_lacks = s < margin_s ? margin_s - s : 0.0;
    const double t_lacks = t < margin_t ? margin_t - t : 0.0;
    s += s_lacks - t_lacks;
    t += t_lacks - s_lacks;
    const double step = behind ? -double{from.step} : double{from.step};
    x = from.corner.x + s * from.edge_s.x + t * from.edge_t.x + step * from.normal.x;
    y = from.corner.y + s * from.edge_s.y + t * from.edge_t.y + step * from.normal.y;
    z = from.corner.z + s * from.edge_s.z + t * from.edge_t.z + step * from.normal.z;
  }
};

// Start points on facets, and directions by Lambert's law, on the side given by `behind`.
LICHTMC_LANES void scatter_lanes(std::size_t n, const Departure* LICHTMC_APART departures,
                                 const std::uint32_t* LICHTMC_APART facet, const float* LICHTMC_APART s,
                                 const float* LICHTMC_APART t, const std::uint32_t* LICHTMC_APART behind,
                                 const std::uint32_t* LICHTMC_APART polar, const std::uint32_t* LICHTMC_APART azimuth,
                                 float* LICHTMC_APART x, float* LICHTMC_APART y, float* LICHTMC_APART z,
                                 float* LICHTMC_APART dx, float* LICHTMC_APART dy, float* LICHTMC_APART dz) {
  for (std::size_t i = 0; i < n; ++i) {
    const Departure& from = departures[facet[i]];
    const StartPoint start(from, s[i], t[i], behind[i] != 0);
    x[i] = static_cast<float>(start.x);
    y[i] = static_cast<float>(start.y);
    z[i] = static_cast<float>(start.z);
    // About the normal as frame_about() does.
    const glm::vec3 local = sample_lambert(polar[i], azimuth[i]);
    const float normal_x = from.normal.x;
    const float normal_y = from.normal.y;
    const float normal_z = from.normal.z;
    const float sign = normal_z < 0.0F ? -1.0F : 1.0F;
    const float a = -1.0F / (sign + normal_z);
    const float b = normal_x * normal_y * a;
    const float up = behind[i] != 0 ? -local.z : local.z;
    dx[i] = local.x * (1.0F + sign * normal_x * normal_x * a) + local.y * b + up * normal_x;
    dy[i] = local.x * sign * b + local.y * (sign + normal_y * normal_y * a) + up * normal_y;
    dz[i] = local.x * -sign * normal_x - local.y * normal_y + up * normal_z;
  }
}

}  // namespace

Departure make_departure(const std::array<glm::vec3, 3>& corners, const glm::dvec3& normal) {
  const std::array<glm::dvec3, 3> p{corners[0], corners[1], corners[2]};
  const double twice_area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
  const double reach = std::max({largest_component(p[0]), largest_component(p[1]), largest_component(p[2])});
  const std::array<double, 3> side{glm::length(p[2] - p[1]), glm::length(p[0] - p[2]), glm::length(p[1] - p[0])};
  const double step = step_roundings * (reach + std::max({side[0], side[1], side[2]}));
  double own_step = step;
  for (int k = 0; k < 3; ++k) {
    if (p[0][k] == p[1][k] && p[0][k] == p[2][k]) own_step = step_roundings * std::abs(p[0][k]) + least_step;
  }

  Departure departure;
  departure.corner = corners[0];
  departure.edge_s = corners[1] - corners[0];
  departure.edge_t = corners[2] - corners[0];
  departure.normal = glm::vec3(normal);
  departure.step = static_cast<float>(own_step);
  for (int k = 0; k < 3; ++k) {
    // Height of the triangle over side k; a share of it is a barycentric coordinate.
    const double share = margin_steps * step * side[static_cast<std::size_t>(k)] / twice_area;
    departure.margin[k] = static_cast<float>(share < largest_margin ? share : largest_margin);
  }
  return departure;
}

void raise_step(Departure& departure, double step) {
  if (!(step > double{departure.step})) return;
  departure.step = static_cast<float>(step);
  const glm::dvec3 s(departure.edge_s);
  const glm::dvec3 t(departure.edge_t);
  const double twice_area = glm::length(glm::cross(s, t));
  const std::array<double, 3> side{glm::length(t - s), glm::length(t), glm::length(s)};
  for (int k = 0; k < 3; ++k) {
    const double share = std::min(margin_steps * step * side[static_cast<std::size_t>(k)] / twice_area, largest_margin);
    departure.margin[k] = std::max(departure.margin[k], static_cast<float>(share));
  }
}

void depart_from(const std::vector<Departure>& departures, Rays& rays) {
  for (std::size_t i = 0; i < rays.size; ++i) {
    if (rays.facet[i] == no_facet) continue;
    const StartPoint start(departures[rays.facet[i]], rays.s[i], rays.t[i], rays.behind[i] != 0);
    rays.set_start(i, {start.x, start.y, start.z});
  }
}

void scatter_from(const std::vector<Departure>& departures, Rays& rays, const std::uint32_t* polar,
                  const std::uint32_t* azimuth, float* cosines) {
  scatter_lanes(rays.size, departures.data(), rays.facet.data(), rays.s.data(), rays.t.data(), rays.behind.data(),
                polar, azimuth, rays.x.data(), rays.y.data(), rays.z.data(), rays.dx.data(), rays.dy.data(),
                rays.dz.data());
  for (std::size_t i = 0; cosines != nullptr && i < rays.size; ++i) cosines[i] = sample_lambert(polar[i], 0).z;
}

}  // namespace lichtmc
