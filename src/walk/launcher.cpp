#include "walk/launcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "base/lanes.hpp"
#include "chance/choice.hpp"
#include "chance/directions.hpp"
#include "chance/draw_many.hpp"
#include "chance/lane_math.hpp"
#include "chance/moments.hpp"

namespace lichtmc {

namespace {

glm::dvec3 sample(const IsotropicEmitter& /*law*/, double u, double turns) {
  return sample_sphere(u, turns);
}
glm::dvec3 sample(const LambertEmitter& law, double u, double turns) {
  return sample_generalized_lambert(law.exponent, u, turns);
}
glm::dvec3 sample(const SpotEmitter& law, double u, double turns) {
  return sample_spot(law.inner, law.outer, u, turns);
}

// Sine and cosine of the angle to the emitter's axis by the laws of directions.hpp. Generalized Lambert emitters:
// 1 − cos θ = −expm1(ln u · share), share = 1/(m + 1).
LICHTMC_LANES void lambert_polar(std::size_t n, const std::uint32_t* LICHTMC_APART words, float share,
                                 float* LICHTMC_APART sine, float* LICHTMC_APART cosine) {
  for (std::size_t i = 0; i < n; ++i) {
    const float versine = -lane_expm1(share * lane_log_unit(words[i]));
    sine[i] = std::sqrt(versine * (2.0F - versine));
    cosine[i] = 1.0F - versine;
  }
}

// The whole sphere, cos θ = 1 − 2u; both poles from what is left of u, which float holds exactly there.
LICHTMC_LANES void isotropic_polar(std::size_t n, const std::uint32_t* LICHTMC_APART words, float* LICHTMC_APART sine,
                                   float* LICHTMC_APART cosine) {
  for (std::size_t i = 0; i < n; ++i) {
    const float u = (static_cast<float>(words[i]) + 0.5F) * 0x1p-32F;
    const float rest = (static_cast<float>(~words[i]) + 0.5F) * 0x1p-32F;
    sine[i] = 2.0F * std::sqrt(u * rest);
    cosine[i] = rest - u;
  }
}

// Directions at these angles to the third axis of a frame, with uniform azimuth.
LICHTMC_LANES void aim(std::size_t n, const float* LICHTMC_APART sine_polar, const float* LICHTMC_APART cosine_polar,
                       const std::uint32_t* LICHTMC_APART words, const glm::mat3& frame, float* LICHTMC_APART dx,
                       float* LICHTMC_APART dy, float* LICHTMC_APART dz) {
  const glm::vec3 a = frame[0];
  const glm::vec3 b = frame[1];
  const glm::vec3 c = frame[2];
  for (std::size_t i = 0; i < n; ++i) {
    float sine = 0.0F;
    float cosine = 0.0F;
    sine_cosine(static_cast<float>(words[i]) * 0x1p-32F, sine, cosine);
    const float x = sine_polar[i] * cosine;
    const float y = sine_polar[i] * sine;
    const float z = cosine_polar[i];
    dx[i] = x * a.x + y * b.x + z * c.x;
    dy[i] = x * a.y + y * b.y + z * c.y;
    dz[i] = x * a.z + y * b.z + z * c.z;
  }
}

}  // namespace

Launcher::Launcher(const Room& room, const Tracer& tracer) : facets_(&tracer.facets()) {
  std::vector<double> powers;
  for (const Emitter& emitter : room.emitters) {
    powers.push_back(emitter.power);
    if (const auto* surface = std::get_if<SurfaceEmitter>(&emitter.shape)) {
      sources_.emplace_back(surface_source(room, *surface, tracer));
    } else {
      sources_.emplace_back(point_source(emitter, tracer));
    }
  }
  // Shares of the largest first: tiny powers would lose their digits in the sum.
  const double largest = *std::max_element(powers.begin(), powers.end());
  for (double& power : powers) power /= largest;
  powers_up_to_ = cumulative(powers);
  const auto is_area_light = [](double power) { return power > 0.0; };
  if (std::count_if(powers.begin(), powers.end(), is_area_light) == 1)
    only_source_ = static_cast<std::size_t>(std::find_if(powers.begin(), powers.end(), is_area_light) - powers.begin());
}

Launcher::PointSource Launcher::point_source(const Emitter& emitter, const Tracer& tracer) {
  PointSource source;
  glm::dvec3 position(0.0);
  glm::dvec3 axis(0.0);
  std::visit(
      [&](const auto& law) {
        if constexpr (requires { law.position; }) {
          position = law.position;
          source.law = law;
        }
        if constexpr (requires { law.axis; }) axis = law.axis;
      },
      emitter.shape);
  // Scaled by its largest component first: the square of a very long or short axis would not be a double.
  const double largest = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
  if (largest > 0.0) axis = glm::normalize(axis / largest);
  source.start = tracer.start(position, axis);
  hangs_free_ = hangs_free_ && !source.start.on_surface;
  const Frame frame = frame_about(largest > 0.0 ? axis : glm::dvec3(0.0, 0.0, 1.0));
  source.to_tracer = tracer.directions() * glm::dmat3(frame.tangent, frame.bitangent, frame.normal);
  return source;
}

Launcher::SurfaceSource Launcher::surface_source(const Room& room, const SurfaceEmitter& emitter,
                                                 const Tracer& tracer) {
  const Surface& surface = room.surfaces[emitter.surface];
  SurfaceSource source;
  source.exponent = emitter.exponent;
  std::vector<double> areas;
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    const glm::uvec3 corner = surface.triangles[n];
    const glm::dvec3 a = surface.positions[corner.x];
    areas.push_back(glm::length(glm::cross(surface.positions[corner.y] - a, surface.positions[corner.z] - a)));
    source.triangles.push_back(tracer.locate(emitter.surface, n));
  }
  source.areas_up_to = cumulative(areas);
  return source;
}

void Launcher::launch(const Stream& stream, std::uint64_t history, Rays& rays, std::size_t i) const {
  const Words words = stream.draw(history, 0, Purpose::emission);
  const auto& source = sources_[choose(powers_up_to_, unit_fine(words[2], words[3]))];
  if (const auto* point = std::get_if<PointSource>(&source)) {
    start_at(*point, words[0], words[1], rays, i);
  } else {
    const auto& surface = std::get<SurfaceSource>(source);
    const glm::dvec3 local = sample_generalized_lambert(surface.exponent, unit_open(words[0]), unit_open(words[1]));
    start_on(surface, glm::vec3(local), stream.draw(history, 0, Purpose::place), rays, i);
  }
}

// Random words of a batch's launches, in the order of the photons in the wave.
struct Launcher::Launches {
  std::array<std::uint32_t, batch_histories> polar;
  std::array<std::uint32_t, batch_histories> azimuth;
  std::array<std::uint64_t, batch_histories> chance;
  std::array<float, batch_histories> sine;
  std::array<float, batch_histories> cosine;
};

void Launcher::launch_all(const Stream& stream, std::uint64_t first, std::uint32_t n, Rays& rays,
                          std::uint32_t* photon) const {
  std::array<std::uint64_t, batch_histories> history;
  for (std::uint32_t i = 0; i < batch_histories; ++i) {
    history[i] = first + i;
    photon[i] = i;
  }
  Launches launches;
  draw_many(stream, n, history.data(), 0, Purpose::emission, launches.polar.data(), launches.azimuth.data(),
            launches.chance.data());
  if (only_source_) return launch_from(*only_source_, launches, 0, n, stream, first, rays, photon);

  // Photons of one emitter stand together in the wave.
  const std::vector<std::uint32_t> ends = sort_by_source(n, launches, photon);
  std::uint32_t begin = 0;
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    if (ends[k] > begin) launch_from(k, launches, begin, ends[k], stream, first, rays, photon);
    begin = ends[k];
  }
}

// Chooses each photon's source and puts photons in the order of their sources; returns where each source's end.
std::vector<std::uint32_t> Launcher::sort_by_source(std::uint32_t n, Launches& launches, std::uint32_t* photon) const {
  std::vector<std::uint32_t> place(sources_.size());
  std::array<std::uint32_t, batch_histories> source;
  for (std::uint32_t i = 0; i < n; ++i) {
    source[i] =
        static_cast<std::uint32_t>(choose(powers_up_to_, static_cast<double>(launches.chance[i] >> 11) * 0x1p-53));
    ++place[source[i]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& of_source : place) sum += std::exchange(of_source, sum);
  const auto polar = launches.polar;
  const auto azimuth = launches.azimuth;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t to = place[source[i]]++;
    photon[to] = i;
    launches.polar[to] = polar[i];
    launches.azimuth[to] = azimuth[i];
  }
  return place;
}

void Launcher::launch_from(std::size_t k, Launches& launches, std::uint32_t begin, std::uint32_t end,
                           const Stream& stream, std::uint64_t first, Rays& rays, const std::uint32_t* photon) const {
  const std::size_t n = end - begin;
  const std::uint32_t* polar = &launches.polar[begin];
  const std::uint32_t* azimuth = &launches.azimuth[begin];
  float* sine_polar = &launches.sine[begin];
  float* cosine_polar = &launches.cosine[begin];
  const auto share = [](double exponent) { return static_cast<float>(1.0 / (exponent + 1.0)); };
  if (const auto* surface = std::get_if<SurfaceSource>(&sources_[k])) {
    lambert_polar(n, polar, share(surface->exponent), sine_polar, cosine_polar);
    for (std::uint32_t i = begin; i < end; ++i) {
      float sine = 0.0F;
      float cosine = 0.0F;
      sine_cosine(static_cast<float>(launches.azimuth[i]) * 0x1p-32F, sine, cosine);
      const glm::vec3 local(launches.sine[i] * cosine, launches.sine[i] * sine, launches.cosine[i]);
      start_on(*surface, local, stream.draw(first + photon[i], 0, Purpose::place), rays, i);
    }
    return;
  }
  const auto& point = std::get<PointSource>(sources_[k]);
  if (!point.start.steps.empty() || std::holds_alternative<SpotEmitter>(point.law)) {
    for (std::uint32_t i = begin; i < end; ++i) start_at(point, launches.polar[i], launches.azimuth[i], rays, i);
    return;
  }
  if (const auto* lambert = std::get_if<LambertEmitter>(&point.law)) {
    lambert_polar(n, polar, share(lambert->exponent), sine_polar, cosine_polar);
  } else {
    isotropic_polar(n, polar, sine_polar, cosine_polar);
  }
  aim(n, sine_polar, cosine_polar, azimuth, glm::mat3(point.to_tracer), &rays.dx[begin], &rays.dy[begin],
      &rays.dz[begin]);
  std::fill_n(&rays.facet[begin], n, no_facet);
  std::fill_n(&rays.x[begin], n, point.start.point.x);
  std::fill_n(&rays.y[begin], n, point.start.point.y);
  std::fill_n(&rays.z[begin], n, point.start.point.z);
}

void Launcher::start_at(const PointSource& source, std::uint32_t polar, std::uint32_t azimuth, Rays& rays,
                        std::size_t i) const {
  const double u = unit_open(polar);
  const double turns = unit_open(azimuth);
  const glm::dvec3 local = std::visit([&](const auto& law) { return sample(law, u, turns); }, source.law);
  const glm::vec3 direction(source.to_tracer * local);
  glm::vec3 point = source.start.point;
  // An emitter that touches a surface sends each photon off on the side it flies to.
  for (const glm::vec3& step : source.start.steps) point += glm::dot(step, direction) < 0.0F ? -step : step;
  rays.facet[i] = no_facet;
  rays.set_start(i, point);
  rays.set_direction(i, direction);
}

void Launcher::start_on(const SurfaceSource& source, const glm::vec3& local, const Words& place, Rays& rays,
                        std::size_t i) const {
  const std::size_t n = choose(source.areas_up_to, unit_fine(place[0], place[1]));
  // Uniform on the triangle: 1 − √u is the share of the way from the side opposite a corner, the rest is uniform along
  // it.
  const double root = std::sqrt(unit_open(place[2]));
  const double b1 = root * (1.0 - unit_open(place[3]));
  const double b2 = root * unit_open(place[3]);
  const TriangleOnFacet& triangle = source.triangles[n];
  const glm::vec2 st = triangle.st_0 + static_cast<float>(b1) * triangle.st_1 + static_cast<float>(b2) * triangle.st_2;
  rays.facet[i] = triangle.facet;
  rays.s[i] = st.x;
  rays.t[i] = st.y;
  rays.behind[i] = 0;
  rays.set_direction(i, direction_from((*facets_)[triangle.facet], false, local));
}

}  // namespace lichtmc
