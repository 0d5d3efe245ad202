#include "walk/learn_selection.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>

#include "walk/marked_points.hpp"

namespace lichtmc {

namespace {

constexpr std::uint64_t seed = 0x7F4A7C159E3779B9;  // any

// Photons: in all as many as this, if that gives each emitter a number within the limits; with very many emitters at
// most the other number in all, or one of each.
constexpr std::size_t photons = 65'536;
constexpr std::size_t least_photons = 32;
constexpr std::size_t most_photons = 1024;
constexpr std::size_t most_in_all = 524'288;

constexpr std::size_t points_of_cell = 6;  // at most
constexpr std::size_t points_of_region = 128;
constexpr std::size_t tests_of_region = 16;  // of emitters whose photons have arrived only around it
constexpr std::size_t most_candidates = 96;  // emitters that are tested in the cells of a region: the strongest
constexpr std::size_t tests_of_cell = 192;   // at most: points times candidates
// An emitter whose light without shadow is less than this fraction of that which is known to arrive at a test point is
// not tested there: the choice by flux serves it.
constexpr double negligible = 1e-3;
// Of the weights of a cell, this share that belongs to the weakest emitters is left to the other choices.
constexpr double left_out = 0.005;

// Where photons have arrived first.
struct Arrivals {
  MarkedPoints points;
  std::vector<std::uint32_t> emitters;  // of the photon at each point
};

class ArrivalsGoal : public GoalBase {
 public:
  ArrivalsGoal(const Scene& scene, const Stream& stream, const std::vector<std::size_t>& emitters, std::size_t each,
               Arrivals& arrivals)
      : scene_(scene), stream_(stream), emitters_(emitters), each_(each), arrivals_(arrivals) {}

  void begin(std::uint64_t first_history) { first_history_ = first_history; }
  void start(Wave& wave, std::uint32_t n) {
    scene_.launcher->launch_in_turn(stream_, first_history_, n, emitters_, each_, wave.rays, wave.photon.data());
  }
  Misses misses() const { return scene_.misses; }

  void reflect(const Wave& wave, std::uint32_t /*flight*/) {
    arrivals_.points.mark(wave, *scene_.tracer);
    for (std::size_t i = 0; i < wave.rays.size; ++i)
      arrivals_.emitters.push_back(static_cast<std::uint32_t>((first_history_ + wave.photon[i]) / each_));
  }

 private:
  const Scene& scene_;
  const Stream& stream_;
  const std::vector<std::size_t>& emitters_;
  std::size_t each_;
  Arrivals& arrivals_;
};

Arrivals first_arrivals(const Scene& scene, const Stream& stream, const std::vector<std::size_t>& emitters) {
  const std::size_t wanted = std::clamp(photons / emitters.size(), least_photons, most_photons);
  const std::size_t each = std::clamp<std::size_t>(most_in_all / emitters.size(), 1, wanted);
  Arrivals arrivals;
  ArrivalsGoal goal(scene, stream, emitters, each, arrivals);
  fly_unabsorbed(scene, stream, 1, each * emitters.size(), goal);
  return arrivals;
}

// The sum of the squares of the irradiance by an emitter at test points.
struct Light {
  std::uint32_t emitter = 0;
  double square = 0.0;
};

// Which emitters' light arrives at test points, and how much.
class LightTest {
 public:
  LightTest(const Scene& scene, const LearnedEmitters& emitters, const Arrivals& arrivals, const Stream& stream)
      : tracer_(*scene.tracer),
        emitters_(emitters),
        arrivals_(arrivals),
        stream_(stream),
        squares_(emitters.fluxes.size(), 0.0) {}

  // At these arrivals together; candidates without light are left out.
  std::vector<Light> at(std::span<const std::uint32_t> points, const std::vector<std::uint32_t>& candidates) {
    rays_.clear();
    tested_.clear();
    for (const std::uint32_t point : points) test(point, candidates);
    tracer_.find_blocked(rays_, count_);
    for (std::size_t n = 0; n < tested_.size(); ++n) {
      if (rays_.blocked[n] == 0) squares_[tested_[n].emitter] += tested_[n].square;
    }
    std::vector<Light> light;
    for (const std::uint32_t emitter : candidates) {
      const double square = std::exchange(squares_[emitter], 0.0);
      if (square > 0.0) light.push_back({emitter, square});
    }
    return light;
  }

 private:
  LightSample sample(std::uint32_t emitter, const ReferencePoint& reference, std::uint32_t point) const {
    return emitters_.sample(emitter, reference, stream_.draw(point, emitter, Purpose::on_light));
  }

  // The irradiance by each candidate; if something may cast a shadow, shadow rays to them.
  void test(std::uint32_t point, const std::vector<std::uint32_t>& candidates) {
    const Place& place = arrivals_.points.places[point];
    const ReferencePoint reference{place.point, place.normal};
    const glm::vec3& from = arrivals_.points.starts[point];
    const double known = sample(arrivals_.emitters[point], reference, point).irradiance;
    for (const std::uint32_t emitter : candidates) {
      const LightSample light = sample(emitter, reference, point);
      if (!(light.irradiance > negligible * known)) continue;
      const double square = light.irradiance * light.irradiance;
      const glm::dvec3 start(from);
      const auto segment = tracer_.casts_shadows() ? shadow_segment(tracer_, start, light.target) : std::nullopt;
      if (!segment) {
        squares_[emitter] += square;
        continue;
      }
      tested_.push_back({emitter, square});
      rays_.add(from, *segment);
    }
  }

  const Tracer& tracer_;
  const LearnedEmitters& emitters_;
  const Arrivals& arrivals_;
  const Stream& stream_;
  std::vector<double> squares_;  // by emitter; 0 between calls
  std::vector<Light> tested_;    // by a shadow ray
  ShadowRays rays_;
  TraceCount count_;
};

using Weights = std::vector<LightSelection::Weight>;

bool is_stronger(const LightSelection::Weight& a, const LightSelection::Weight& b) {
  return a.weight != b.weight ? a.weight > b.weight : a.emitter < b.emitter;
}
bool has_lower_number(const LightSelection::Weight& a, const LightSelection::Weight& b) {
  return a.emitter < b.emitter;
}

// A region: the emitters that light it.
struct RegionLight {
  Weights arriving;                       // power that arrives there and nearby, as shares; emitters ascending
  std::vector<std::uint32_t> candidates;  // emitters to be tested in its cells, ascending
  double share = 0.0;                     // of the power that arrives in the region, by candidates
};

class Regions {
 public:
  Regions(const PlaceTree& cells, const Arrivals& arrivals, const std::vector<double>& fluxes)
      : cells_(cells), arrivals_(arrivals), fluxes_(fluxes), power_(fluxes.size(), 0.0) {}

  // Candidates are the strongest of the emitters that have sent a photon to the region and, if these are few, of those
  // that have sent one nearby and light a test point of the region.
  RegionLight light_of(std::uint32_t region, LightTest& test) {
    RegionLight light;
    Weights own = arriving_in({region});
    light.arriving = arriving_in(around(region));
    Weights others;
    std::set_difference(light.arriving.begin(), light.arriving.end(), own.begin(), own.end(),
                        std::back_inserter(others), has_lower_number);
    keep_strongest(own, most_candidates);
    keep_strongest(others, most_candidates - own.size());
    for (const LightSelection::Weight& one : own) {
      light.candidates.push_back(one.emitter);
      light.share += one.weight;
    }
    std::vector<std::uint32_t> to_test;
    for (const LightSelection::Weight& one : others) to_test.push_back(one.emitter);
    const std::span<const std::uint32_t> members = cells_.members(cells_.cells_of_region(region));
    std::vector<std::uint32_t> points;
    for (std::size_t k = 0; k < tests_of_region; ++k) points.push_back(members[k * members.size() / tests_of_region]);
    for (const Light& one : test.at(points, to_test)) light.candidates.push_back(one.emitter);
    std::sort(light.candidates.begin(), light.candidates.end());
    return light;
  }

 private:
  // A region, its neighbours and theirs, ascending.
  std::vector<std::uint32_t> around(std::uint32_t region) const {
    std::vector<std::uint32_t> around{region};
    for (int ring = 0; ring < 2; ++ring) {
      const std::vector<std::uint32_t> inner = around;
      for (const std::uint32_t one : inner) {
        const std::vector<std::uint32_t> outer = cells_.neighbours(one);
        around.insert(around.end(), outer.begin(), outer.end());
      }
      std::sort(around.begin(), around.end());
      around.erase(std::unique(around.begin(), around.end()), around.end());
    }
    return around;
  }

  // The power that arrives in regions, as shares; emitters ascending.
  Weights arriving_in(const std::vector<std::uint32_t>& regions) {
    Weights arriving;
    double sum = 0.0;
    for (const std::uint32_t one : regions) {
      for (const std::uint32_t k : cells_.members(cells_.cells_of_region(one))) {
        const std::uint32_t emitter = arrivals_.emitters[k];
        if (power_[emitter] == 0.0) arriving.push_back({emitter, 0.0});
        power_[emitter] += fluxes_[emitter];
        sum += fluxes_[emitter];
      }
    }
    for (LightSelection::Weight& one : arriving) one.weight = std::exchange(power_[one.emitter], 0.0) / sum;
    std::sort(arriving.begin(), arriving.end(), has_lower_number);
    return arriving;
  }

  static void keep_strongest(Weights& weights, std::size_t most) {
    std::sort(weights.begin(), weights.end(), is_stronger);
    if (weights.size() > most) weights.resize(most);
  }

  const PlaceTree& cells_;
  const Arrivals& arrivals_;
  const std::vector<double>& fluxes_;
  std::vector<double> power_;  // by emitter; 0 between calls
};

// The table of a cell: roots of the sums of squares, without the weakest. share: of the light, by the candidates.
LightSelection::CellTable table_of_cell(const std::vector<Light>& light, double share) {
  Weights all;
  double sum = 0.0;
  for (const Light& one : light) {
    all.push_back({one.emitter, std::sqrt(one.square)});
    sum += all.back().weight;
  }
  std::sort(all.begin(), all.end(), is_stronger);
  double left = 0.0;
  while (!all.empty() && left + all.back().weight < left_out * sum) {
    left += all.back().weight;
    all.pop_back();
  }
  std::sort(all.begin(), all.end(), has_lower_number);
  return {Weights(all.begin(), all.end()), sum > 0.0 ? share * (1.0 - left / sum) : 0.0};
}

}  // namespace

LightSelection learn_selection(const Scene& scene, const LearnedEmitters& emitters) {
  const Stream stream(seed);
  const Arrivals arrivals = first_arrivals(scene, stream, emitters.in_room);
  PlaceTree cells(arrivals.points.places, points_of_cell, points_of_region);
  LightTest test(scene, emitters, arrivals, stream);
  Regions regions(cells, arrivals, emitters.fluxes);
  LightSelection::Tables tables;
  for (std::uint32_t region = 0; region < cells.regions(); ++region) {
    RegionLight light = regions.light_of(region, test);
    const std::size_t most_points =
        std::max<std::size_t>(tests_of_cell / std::max<std::size_t>(light.candidates.size(), 1), 1);
    const PlaceTree::Range range = cells.cells_of_region(region);
    for (std::uint32_t cell = range.begin; cell < range.end; ++cell) {
      std::span<const std::uint32_t> points = cells.members(cell);
      points = points.first(std::min({points.size(), points_of_cell, most_points}));
      tables.of_cells.push_back(table_of_cell(test.at(points, light.candidates), light.share));
    }
    tables.of_regions.push_back(std::move(light.arriving));
  }
  return {emitters.fluxes, std::move(cells), tables};
}

}  // namespace lichtmc
