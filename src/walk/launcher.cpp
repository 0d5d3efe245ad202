#include "walk/launcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>
#include <variant>

#include <glm/geometric.hpp>

#include "base/lanes.hpp"
#include "chance/choice.hpp"
#include "chance/directions.hpp"
#include "chance/draw_many.hpp"
#include "chance/law_lanes.hpp"
#include "chance/moments.hpp"
#include "chance/places.hpp"
#include "room/emitter_shape.hpp"

namespace lichtmc {

namespace {

// The first two components of directions at these angles to the third axis, with uniform azimuth.
LICHTMC_LANES void turn(std::size_t n, const float* LICHTMC_APART sine_polar, const std::uint32_t* LICHTMC_APART words,
                        float* LICHTMC_APART x, float* LICHTMC_APART y) {
  for (std::size_t i = 0; i < n; ++i) {
    float sine = 0.0F;
    float cosine = 0.0F;
    sine_cosine(static_cast<float>(words[i]) * 0x1p-32F, sine, cosine);
    x[i] = sine_polar[i] * cosine;
    y[i] = sine_polar[i] * sine;
  }
}

// Directions in a frame, in the coordinates of its axes.
LICHTMC_LANES void rotate(std::size_t n, const float* LICHTMC_APART x, const float* LICHTMC_APART y,
                          const float* LICHTMC_APART z, const glm::mat3& frame, float* LICHTMC_APART dx,
                          float* LICHTMC_APART dy, float* LICHTMC_APART dz) {
  const glm::vec3 a = frame[0];
  const glm::vec3 b = frame[1];
  const glm::vec3 c = frame[2];
  for (std::size_t i = 0; i < n; ++i) {
    dx[i] = x[i] * a.x + y[i] * b.x + z[i] * c.x;
    dy[i] = x[i] * a.y + y[i] * b.y + z[i] * c.y;
    dz[i] = x[i] * a.z + y[i] * b.z + z[i] * c.z;
  }
}

// Directions of photons begin … end − 1 in the frames of their emitters, which all have this law.
template <class Law, class Launches>
void sample_directions(const Law& law, Launches& launches, std::uint32_t begin, std::uint32_t end) {
  if constexpr (PolarLaneLaw<Law>) {
    polar_angles(law, end - begin, &launches.polar[begin], &launches.sine[begin], &launches.z[begin]);
    turn(end - begin, &launches.sine[begin], &launches.azimuth[begin], &launches.x[begin], &launches.y[begin]);
  } else {
    lane_directions(law, end - begin, &launches.polar[begin], &launches.azimuth[begin], &launches.x[begin],
                    &launches.y[begin], &launches.z[begin]);
  }
}

// Starts photons begin … end − 1, whose directions have been sampled, from one emitter.
template <class Source, class Launches>
void start_together(const Source& point, const Launches& launches, std::uint32_t begin, std::uint32_t end, Rays& rays) {
  const std::size_t n = end - begin;
  rotate(n, &launches.x[begin], &launches.y[begin], &launches.z[begin], glm::mat3(point.to_tracer), &rays.dx[begin],
         &rays.dy[begin], &rays.dz[begin]);
  std::fill_n(&rays.facet[begin], n, no_facet);
  std::fill_n(&rays.x[begin], n, point.start.point.x);
  std::fill_n(&rays.y[begin], n, point.start.point.y);
  std::fill_n(&rays.z[begin], n, point.start.point.z);
}

// Whether all photons of a source start at one point.
template <class Source>
bool starts_at_one_point(const Source& source) {
  return source.start.steps.empty() && !source.opening;
}

// Whether the photons of two emitters can be sampled together: equal laws that are sampled in lanes, and none of them
// touches a surface or has an opening.
template <class Source>
bool go_together(const Source& a, const Source& b) {
  if (!starts_at_one_point(a) || !starts_at_one_point(b)) return false;
  return std::visit(
      [](const auto& law, const auto& other) {
        using Law = std::decay_t<decltype(law)>;
        if constexpr (LaneLaw<Law> && std::is_same_v<Law, std::decay_t<decltype(other)>>) {
          return same_angles(law, other);
        } else {
          return false;
        }
      },
      a.law, b.law);
}

// choose() for many numbers below 1, given as the upper bits of words: a table has, for each value of a word's first
// byte, the first share at which the search begins (H. C. Chen, Y. Asau: On generating random variates from an
// empirical distribution. AIIE Transactions 6(2), 1974).
class GuidedChoice {
 public:
  explicit GuidedChoice(const std::vector<double>& sums) : sums_(sums) {
    std::uint32_t k = 0;
    for (std::size_t j = 0; j < guide_.size(); ++j) {
      while (sums[k] <= static_cast<double>(j) / static_cast<double>(guide_.size())) ++k;
      guide_[j] = k;
    }
  }
  std::uint32_t operator()(std::uint64_t word) const {
    const double u = static_cast<double>(word >> 11U) * 0x1p-53;
    std::uint32_t k = guide_[word >> 56U];
    while (sums_[k] <= u) ++k;
    return k;
  }

 private:
  const std::vector<double>& sums_;
  std::array<std::uint32_t, 256> guide_;
};

}  // namespace

Launcher::Launcher(const Room& room, const Tracer& tracer) : facets_(&tracer.facets()) {
  std::vector<double> powers;
  EmissionOfRoom emission(room);
  for (const Emitter& emitter : room.emitters) {
    powers.push_back(emitter.power);
    visit_shape(
        emitter, [&](const auto& shape) { sources_.emplace_back(point_source(shape, tracer)); },
        [&](const auto& shape) { sources_.emplace_back(surface_source(room, shape, emission, tracer)); });
  }
  // The largest fractions first: very small powers would lose their digits in the sum.
  const double largest = *std::max_element(powers.begin(), powers.end());
  for (double& power : powers) power /= largest;
  powers_up_to_ = cumulative(powers);
  const auto emits = [](double power) { return power > 0.0; };
  if (std::count_if(powers.begin(), powers.end(), emits) == 1)
    only_source_ = static_cast<std::size_t>(std::find_if(powers.begin(), powers.end(), emits) - powers.begin());
}

template <class Shape>
Launcher::PointSource Launcher::point_source(const Shape& shape, const Tracer& tracer) {
  const Frame frame = frame_of(shape);
  constexpr bool has_axis = requires {
    shape.axis;
  };
  PointSource source;
  source.law = shape.law();
  source.start = tracer.start(shape.position, has_axis ? frame.normal : glm::dvec3(0.0));
  source.to_tracer = tracer.directions() * glm::dmat3(frame.tangent, frame.bitangent, frame.normal);
  all_off_surfaces_ = all_off_surfaces_ && !source.start.on_surface;
  if (const LuminousOpening* opening = opening_of(shape)) {
    source.opening = *opening;
    for (int k = 0; k < 3; ++k)
      source.places[k] = tracer.tracer_vector(glm::dmat3(frame.tangent, frame.bitangent, frame.normal)[k]);
    all_off_surfaces_ = false;  // a point of it may be on one
  }
  return source;
}

Launcher::SurfaceSource Launcher::surface_source(const Room& room, const SurfaceEmitter& emitter,
                                                 EmissionOfRoom& emission, const Tracer& tracer) {
  const Surface& surface = room.surfaces[emitter.surface];
  SurfaceSource source;
  source.law = emitter.law();
  source.emission = emission.of(emitter);
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
    const double u = unit_open(words[0]);
    const double turns = unit_open(words[1]);
    const glm::dvec3 local = std::visit([&](const auto& law) { return law.sample(u, turns); }, point->law);
    const Words place = point->opening ? LaunchWords(stream).place(history) : Words{};
    start_at(*point, local, point->opening ? &place : nullptr, rays, i);
  } else {
    const auto& surface = std::get<SurfaceSource>(source);
    const glm::dvec3 local = surface.law.sample(unit_open(words[0]), unit_open(words[1]));
    start_on(surface, glm::vec3(local), LaunchWords(stream), history, rays, i);
  }
}

std::size_t Launcher::emitter_of(const Stream& stream, std::uint64_t history) const {
  const Words words = stream.draw(history, 0, Purpose::emission);
  return choose(powers_up_to_, unit_fine(words[2], words[3]));
}

// Random words of a batch's launches, in the order of the photons in the wave.
struct Launcher::Launches {
  std::array<std::uint32_t, batch_histories> polar;
  std::array<std::uint32_t, batch_histories> azimuth;
  std::array<std::uint64_t, batch_histories> chance;
  std::array<float, batch_histories> sine;
  // Direction in the frame of the emitter.
  std::array<float, batch_histories> x;
  std::array<float, batch_histories> y;
  std::array<float, batch_histories> z;
};

void Launcher::launch_in_turn(const Stream& stream, std::uint64_t first, std::uint32_t n,
                              const std::vector<std::size_t>& emitters, std::size_t each, Rays& rays,
                              std::uint32_t* photon) const {
  const LaunchWords words(stream);
  std::iota(photon, photon + batch_histories, 0U);
  Launches launches;
  words.draw_emission(first, n, launches.polar.data(), launches.azimuth.data(), launches.chance.data());
  for (std::uint32_t begin = 0; begin < n;) {
    const std::uint64_t turn = (first + begin) / each;
    const auto end = static_cast<std::uint32_t>(std::min<std::uint64_t>(n, (turn + 1) * each - first));
    launch_from(emitters[turn], launches, begin, end, words, first, rays, photon);
    begin = end;
  }
}

void Launcher::launch_all(const LaunchWords& words, std::uint64_t first, std::uint32_t n, Rays& rays,
                          std::uint32_t* photon, std::uint32_t* emitter) const {
  std::iota(photon, photon + batch_histories, 0U);
  Launches launches;
  words.draw_emission(first, n, launches.polar.data(), launches.azimuth.data(), launches.chance.data());
  if (only_source_) {
    if (emitter != nullptr) std::fill_n(emitter, n, static_cast<std::uint32_t>(*only_source_));
    return launch_from(*only_source_, launches, 0, n, words, first, rays, photon);
  }

  // Photons of one emitter are adjacent in the wave. Those of successive emitters with one law are sampled together: in
  // a building of hundreds of lamps each emits a few photons of a batch.
  const std::vector<std::uint32_t> ends = sort_by_source(n, launches, photon, emitter);
  std::uint32_t begin = 0;
  for (std::size_t k = 0; k < sources_.size();) {
    std::size_t last = k + 1;
    const auto* point = std::get_if<PointSource>(&sources_[k]);
    const auto follows = [&](std::size_t other) {
      const auto* next = std::get_if<PointSource>(&sources_[other]);
      return next != nullptr && go_together(*point, *next);
    };
    while (point != nullptr && last < sources_.size() && follows(last)) ++last;
    if (last == k + 1) {
      if (ends[k] > begin) launch_from(k, launches, begin, ends[k], words, first, rays, photon);
      begin = ends[k++];
      continue;
    }
    const auto sample = [&](const auto& law) {
      if constexpr (LaneLaw<std::decay_t<decltype(law)>>) sample_directions(law, launches, begin, ends[last - 1]);
    };
    std::visit(sample, point->law);
    for (; k < last; begin = ends[k++]) {
      if (ends[k] > begin) start_together(std::get<PointSource>(sources_[k]), launches, begin, ends[k], rays);
    }
  }
}

// Chooses the source of each photon and sorts the photons by source; returns the end of the photons of each source.
std::vector<std::uint32_t> Launcher::sort_by_source(std::uint32_t n, Launches& launches, std::uint32_t* photon,
                                                    std::uint32_t* emitter) const {
  std::vector<std::uint32_t> place(sources_.size());
  std::array<std::uint32_t, batch_histories> source;
  const GuidedChoice choice(powers_up_to_);
  for (std::uint32_t i = 0; i < n; ++i) {
    source[i] = choice(launches.chance[i]);
    ++place[source[i]];
  }
  if (emitter != nullptr) std::copy_n(source.begin(), n, emitter);
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
                           const LaunchWords& words, std::uint64_t first, Rays& rays,
                           const std::uint32_t* photon) const {
  if (const auto* surface = std::get_if<SurfaceSource>(&sources_[k])) {
    polar_angles(surface->law, end - begin, &launches.polar[begin], &launches.sine[begin], &launches.z[begin]);
    for (std::uint32_t i = begin; i < end; ++i) {
      float sine = 0.0F;
      float cosine = 0.0F;
      sine_cosine(static_cast<float>(launches.azimuth[i]) * 0x1p-32F, sine, cosine);
      const glm::vec3 local(launches.sine[i] * cosine, launches.sine[i] * sine, launches.z[i]);
      start_on(*surface, local, words, first + photon[i], rays, i);
    }
    return;
  }
  const auto& point = std::get<PointSource>(sources_[k]);
  std::visit([&](const auto& law) { launch_from_point(point, law, launches, begin, end, rays); }, point.law);
  if (!point.opening) return;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Words place = words.place(first + photon[i]);
    const glm::dvec3 local(launches.x[i], launches.y[i], launches.z[i]);
    start_at(point, local, &place, rays, i);
  }
}

// Photons of a law that is sampled in lanes are launched together; those of other laws, and those of an emitter that
// touches a surface (on either side), one by one. With an opening, only their directions are sampled here.
template <class Law>
void Launcher::launch_from_point(const PointSource& point, const Law& law, Launches& launches, std::uint32_t begin,
                                 std::uint32_t end, Rays& rays) const {
  if constexpr (LaneLaw<Law>) {
    if (starts_at_one_point(point)) {
      sample_directions(law, launches, begin, end);
      start_together(point, launches, begin, end, rays);
      return;
    }
  }
  for (std::uint32_t i = begin; i < end; ++i) {
    const glm::dvec3 local = law.sample(unit_open(launches.polar[i]), unit_open(launches.azimuth[i]));
    launches.x[i] = static_cast<float>(local.x);
    launches.y[i] = static_cast<float>(local.y);
    launches.z[i] = static_cast<float>(local.z);
    if (!point.opening) start_at(point, local, nullptr, rays, i);
  }
}

void Launcher::start_at(const PointSource& source, const glm::dvec3& local, const Words* place, Rays& rays,
                        std::size_t i) {
  const glm::vec3 direction(source.to_tracer * local);
  glm::vec3 point = source.start.point;
  // Anywhere on the opening, with the same distribution of directions.
  if (place != nullptr) {
    const glm::dvec3 on_opening = source.opening->place(unit_fine((*place)[0], (*place)[1]), unit_open((*place)[2]));
    point = glm::vec3(glm::dvec3(point) + source.places * on_opening);
  }
  // If the emitter touches a surface, each photon starts on the side that its direction points to.
  for (const glm::vec3& step : source.start.steps) point += glm::dot(step, direction) < 0.0F ? -step : step;
  rays.facet[i] = no_facet;
  rays.set_start(i, point);
  rays.set_direction(i, direction);
}

void Launcher::start_on(const SurfaceSource& source, const glm::vec3& local, const LaunchWords& words,
                        std::uint64_t history, Rays& rays, std::size_t i) const {
  const Words place = words.place(history);
  const double u = unit_fine(place[0], place[1]);
  const double v = unit_open(place[2]);
  const double w = unit_open(place[3]);
  std::size_t n = 0;
  glm::vec2 weights(0.0F);
  if (source.emission) {
    const auto further = [&](std::uint32_t k) { return words.further_place(history, k + 1); };
    const EmissionPlace chosen = source.emission->choose_place(u, v, w, further);
    n = chosen.triangle;
    weights = chosen.weights;
  } else {
    n = choose(source.areas_up_to, u);
    weights = uniform_on_triangle(v, w);
  }
  const TriangleOnFacet& triangle = source.triangles[n];
  const glm::vec2 st = triangle.st_0 + weights.x * triangle.st_1 + weights.y * triangle.st_2;
  rays.facet[i] = triangle.facet;
  rays.s[i] = st.x;
  rays.t[i] = st.y;
  rays.behind[i] = 0;
  rays.set_direction(i, direction_from((*facets_)[triangle.facet], false, local));
}

}  // namespace lichtmc
