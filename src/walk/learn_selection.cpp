#include "walk/learn_selection.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>

#include "walk/kernel.hpp"
#include "walk/never_absorbed.hpp"
#include "walk/visibility.hpp"

namespace lichtmc {

namespace {

constexpr std::uint64_t seed = 0x7F4A7C159E3779B9;  // any

// Photons in all, and limits of those of each emitter.
constexpr std::size_t photons = 65'536;
constexpr std::size_t least_photons = 16;
constexpr std::size_t most_photons = 1024;

constexpr std::size_t points_of_cell = 6;  // at most
constexpr std::size_t points_of_region = 256;
constexpr std::size_t tests_of_region = 16;  // of emitters whose photons have arrived only around it
// An emitter whose light without shadow is less than this fraction of that which is known to arrive at a test point is
// not tested there: the choice by flux serves it.
constexpr double negligible = 1e-3;
// Of the weights of a cell, this share that belongs to the weakest emitters is left to the other choices; at most this
// many are kept.
constexpr double left_out = 0.005;
constexpr std::size_t most_of_cell = 128;

// Where a photon has arrived first.
struct Arrival {
  std::uint32_t emitter = 0;
  glm::vec3 start{0.0F};  // off the surface, tracer's coordinates
};

struct Arrivals {
  std::vector<Place> places;
  std::vector<Arrival> of;
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
    const Tracer& tracer = *scene_.tracer;
    for (std::size_t i = 0; i < wave.rays.size; ++i) {
      const glm::vec3 start = wave.rays.start(i);
      const glm::dvec3 normal = world_normal(tracer, tracer.facets()[wave.rays.facet[i]]);
      arrivals_.places.push_back({tracer.world_point(glm::dvec3(start)), wave.rays.behind[i] != 0 ? -normal : normal});
      arrivals_.of.push_back({static_cast<std::uint32_t>((first_history_ + wave.photon[i]) / each_), start});
    }
  }

 private:
  const Scene& scene_;
  const Stream& stream_;
  const std::vector<std::size_t>& emitters_;
  std::size_t each_;
  Arrivals& arrivals_;
};

Arrivals first_arrivals(const Scene& scene, const Stream& stream, const std::vector<std::size_t>& emitters) {
  const std::size_t each = std::clamp(photons / emitters.size(), least_photons, most_photons);
  Arrivals arrivals;
  ArrivalsGoal goal(scene, stream, emitters, each, arrivals);
  Kernel<NeverAbsorbedPolicy, SurfaceReflectance, ArrivalsGoal> kernel(scene, stream, 1);
  const std::uint64_t all = each * emitters.size();
  for (std::uint64_t first = 0; first < all; first += batch_histories) {
    goal.begin(first);
    kernel.fly(static_cast<std::uint32_t>(std::min<std::uint64_t>(batch_histories, all - first)), goal,
               [] { return false; });
  }
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
    const ReferencePoint reference{arrivals_.places[point].point, arrivals_.places[point].normal};
    const Arrival& arrival = arrivals_.of[point];
    const double known = sample(arrival.emitter, reference, point).irradiance;
    for (const std::uint32_t emitter : candidates) {
      const LightSample light = sample(emitter, reference, point);
      if (!(light.irradiance > negligible * known)) continue;
      const double square = light.irradiance * light.irradiance;
      const glm::dvec3 start(arrival.start);
      const auto segment = tracer_.casts_shadows() ? shadow_segment(tracer_, start, light.target) : std::nullopt;
      if (!segment) {
        squares_[emitter] += square;
        continue;
      }
      tested_.push_back({emitter, square});
      rays_.add(arrival.start, *segment);
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

// The emitters whose light may arrive in a region.
class Candidates {
 public:
  Candidates(const PlaceTree& cells, const Arrivals& arrivals, std::size_t emitters)
      : cells_(cells), arrivals_(arrivals), listed_(emitters, false), arrived_(emitters, 0.0) {}

  // Those that have sent a photon to the region, and those that have sent one to regions around it, up to the second
  // beyond, and light a test point of the region.
  std::vector<std::uint32_t> of_region(std::uint32_t region, LightTest& test) {
    const std::vector<std::uint32_t> own = senders_to({region});
    const std::vector<std::uint32_t> all = senders_to(around(region));
    std::vector<std::uint32_t> others;
    std::set_difference(all.begin(), all.end(), own.begin(), own.end(), std::back_inserter(others));
    const std::span<const std::uint32_t> members = cells_.members(cells_.cells_of_region(region));
    std::vector<std::uint32_t> points;
    for (std::size_t k = 0; k < tests_of_region; ++k) points.push_back(members[k * members.size() / tests_of_region]);
    std::vector<std::uint32_t> candidates = own;
    for (const Light& one : test.at(points, others)) candidates.push_back(one.emitter);
    std::sort(candidates.begin(), candidates.end());
    return candidates;
  }

  // The table of a region: the flux that arrives there and in the regions around.
  std::vector<LightSelection::Weight> table_of_region(std::uint32_t region, const std::vector<double>& fluxes) {
    std::vector<LightSelection::Weight> table;
    for (const std::uint32_t one : around(region)) {
      for (const std::uint32_t k : cells_.members(cells_.cells_of_region(one))) {
        const std::uint32_t emitter = arrivals_.of[k].emitter;
        if (arrived_[emitter] == 0.0) table.push_back({emitter, 0.0});
        arrived_[emitter] += fluxes[emitter];
      }
    }
    for (auto& one : table) one.weight = std::exchange(arrived_[one.emitter], 0.0);
    std::sort(table.begin(), table.end(), [](const auto& a, const auto& b) { return a.emitter < b.emitter; });
    return table;
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

  // The emitters whose photons have arrived in regions, ascending.
  std::vector<std::uint32_t> senders_to(const std::vector<std::uint32_t>& regions) {
    std::vector<std::uint32_t> senders;
    for (const std::uint32_t region : regions) {
      for (const std::uint32_t k : cells_.members(cells_.cells_of_region(region))) {
        const std::uint32_t emitter = arrivals_.of[k].emitter;
        if (!listed_[emitter]) senders.push_back(emitter);
        listed_[emitter] = true;
      }
    }
    for (const std::uint32_t emitter : senders) listed_[emitter] = false;
    std::sort(senders.begin(), senders.end());
    return senders;
  }

  const PlaceTree& cells_;
  const Arrivals& arrivals_;
  std::vector<bool> listed_;     // by emitter; false between calls
  std::vector<double> arrived_;  // by emitter; 0 between calls
};

// The table of a cell: roots of the sums of squares, without the weakest.
std::vector<LightSelection::Weight> table_of_cell(const std::vector<Light>& light) {
  std::vector<LightSelection::Weight> table;
  double sum = 0.0;
  for (const Light& one : light) {
    table.push_back({one.emitter, std::sqrt(one.square)});
    sum += table.back().weight;
  }
  std::sort(table.begin(), table.end(), [](const auto& a, const auto& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.emitter < b.emitter;
  });
  double left = 0.0;
  while (!table.empty() && (left += table.back().weight) < left_out * sum) table.pop_back();
  if (table.size() > most_of_cell) table.resize(most_of_cell);
  std::sort(table.begin(), table.end(), [](const auto& a, const auto& b) { return a.emitter < b.emitter; });
  return table;
}

}  // namespace

LightSelection learn_selection(const Scene& scene, const LearnedEmitters& emitters) {
  const Stream stream(seed);
  const Arrivals arrivals = first_arrivals(scene, stream, emitters.in_room);
  PlaceTree cells(arrivals.places, points_of_cell, points_of_region);
  LightTest test(scene, emitters, arrivals, stream);
  Candidates candidates(cells, arrivals, emitters.fluxes.size());
  LightSelection::Tables weights;
  for (std::uint32_t region = 0; region < cells.regions(); ++region) {
    weights.of_regions.push_back(candidates.table_of_region(region, emitters.fluxes));
    const std::vector<std::uint32_t> here = candidates.of_region(region, test);
    const PlaceTree::Range range = cells.cells_of_region(region);
    for (std::uint32_t cell = range.begin; cell < range.end; ++cell) {
      std::span<const std::uint32_t> members = cells.members(cell);
      if (members.size() > points_of_cell) members = members.first(points_of_cell);  // one and the same point
      weights.of_cells.push_back(table_of_cell(test.at(members, here)));
    }
  }
  return {emitters.fluxes, std::move(cells), weights};
}

}  // namespace lichtmc
