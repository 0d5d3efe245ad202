#include "inspect/probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "chance/stream.hpp"
#include "inspect/emitter_light.hpp"
#include "inspect/luminaire_light.hpp"
#include "walk/kernel.hpp"
#include "walk/never_absorbed.hpp"

namespace lichtmc {

namespace {

constexpr std::uint64_t seed = 20211;  // any: the same room is told the same each time
constexpr std::uint64_t waves = 32;
constexpr std::uint32_t flights_each = 16;

const std::array<const char*, 6> side_names{"-x", "+x", "-y", "+y", "-z", "+z"};

// Where a ray leaves a box that it starts in, or next to.
struct Exit {
  std::size_t side = 0;
  glm::dvec3 place{0.0};
};

Exit exit_of(const glm::dvec3& start, const glm::dvec3& direction, const glm::dvec3& low, const glm::dvec3& high) {
  Exit exit{0, start};
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) continue;
    const bool up = direction[k] > 0.0;
    const double distance = std::max(0.0, ((up ? high[k] : low[k]) - start[k]) / direction[k]);
    if (distance >= nearest) continue;
    nearest = distance;
    exit = {2 * static_cast<std::size_t>(k) + (up ? 1 : 0), start + distance * direction};
  }
  return exit;
}

// The flights that escaped, by the side of the bounding box that they passed.
class EscapedFlights {
 public:
  EscapedFlights(const Room& room, const Tracer& tracer, const glm::dvec3& low, const glm::dvec3& high)
      : room_(&room), tracer_(&tracer), to_world_(glm::inverse(tracer.directions())), low_(low), high_(high) {}

  // Flight i of the rays met nothing; `from` is the facet it started from, or no_facet.
  void add(const Rays& rays, std::size_t i, std::uint32_t from) {
    const glm::dvec3 direction = to_world_ * glm::dvec3(rays.direction(i));
    const Exit exit = exit_of(tracer_->world_point(rays.start(i)), direction, low_, high_);
    Opening& opening = sides_[exit.side];
    if (counts_[exit.side]++ > 0) return;
    opening.side = side_names[exit.side];
    opening.place = exit.place;
    if (from != no_facet) opening.from = room_->surfaces[tracer_->facets()[from].surface].name;
  }

  std::vector<Opening> openings(std::uint64_t left) const {
    std::vector<Opening> list;
    for (std::size_t side = 0; side < 6; ++side) {
      if (counts_[side] == 0) continue;
      list.push_back(sides_[side]);
      list.back().share = static_cast<double>(counts_[side]) / static_cast<double>(left);
    }
    std::sort(list.begin(), list.end(), [](const Opening& a, const Opening& b) { return a.share > b.share; });
    return list;
  }

 private:
  const Room* room_;
  const Tracer* tracer_;
  glm::dmat3 to_world_;
  glm::dvec3 low_;
  glm::dvec3 high_;
  std::array<Opening, 6> sides_;
  std::array<std::uint64_t, 6> counts_{};
};

// Goal: impacts on surfaces, flights that escape.
class ProbeGoal : public GoalBase {
 public:
  ProbeGoal(const Room& room, const Scene& scene, const Stream& stream, const glm::dvec3& low, const glm::dvec3& high)
      : room_(room),
        scene_(scene),
        stream_(stream),
        escaped_(room, *scene.tracer, low, high),
        light_(room, scene, low, high),
        luminaires_(room, scene),
        from_(batch_histories) {
    result_.impacts.resize(room.surfaces.size());
    result_.behind.resize(room.surfaces.size());
  }

  void begin(std::uint64_t first_history) { first_history_ = first_history; }
  void start(Wave& wave, std::uint32_t n) {
    for (std::uint32_t i = 0; i < n; ++i) {
      scene_.launcher->launch(stream_, first_history_ + i, wave.rays, i);
      from_[i] = wave.rays.facet[i];
      const std::size_t emitter = scene_.launcher->emitter_of(stream_, first_history_ + i);
      light_.start(i, emitter);
      luminaires_.start(i, emitter);
    }
  }
  void escape(const Wave& wave, std::size_t i) {
    escaped_.add(wave.rays, i, from_[wave.photon[i]]);
    ++result_.flights;
    ++result_.left;
  }
  void land(const Wave& wave) {
    result_.flights += wave.rays.size;
    light_.land(wave);
    luminaires_.land(wave);
    for (std::size_t i = 0; i < wave.rays.size; ++i) {
      const std::uint32_t facet = wave.rays.facet[i];
      const std::uint32_t surface = scene_.surface_of[facet];
      ++result_.impacts[surface];
      result_.behind[surface] += wave.rays.behind[i];
      from_[wave.photon[i]] = facet;
    }
  }
  // land() reads the flight that has ended; the next flight does not need it.
  static void move(Wave& wave, std::size_t from, std::size_t to) {
    Rays& rays = wave.rays;
    rays.set_start(to, rays.start(from));
    rays.set_direction(to, rays.direction(from));
    rays.length[to] = rays.length[from];
  }
  [[maybe_unused]] static constexpr bool in_lanes = true;

  ProbeResult result() {
    result_.emitters = light_.facts(room_);
    result_.luminaires = luminaires_.facts();
    result_.undecided = traced().undecided;
    result_.openings = escaped_.openings(result_.left);
    return result_;
  }

 private:
  const Room& room_;
  const Scene& scene_;
  const Stream& stream_;
  EscapedFlights escaped_;
  EmitterLight light_;
  LuminaireLight luminaires_;
  std::vector<std::uint32_t> from_;  // facet that a photon left last, or no_facet
  ProbeResult result_;
};

}  // namespace

ProbeResult probe(const Room& room, const Scene& scene, const glm::dvec3& low, const glm::dvec3& high) {
  const Stream stream(seed);
  ProbeGoal goal(room, scene, stream, low, high);
  Kernel<NeverAbsorbedPolicy, SurfaceReflectance, ProbeGoal> kernel(scene, stream, flights_each);
  for (std::uint64_t w = 0; w < waves; ++w) {
    goal.begin(w * batch_histories);
    kernel.fly(batch_histories, goal, [] { return false; });
  }
  return goal.result();
}

}  // namespace lichtmc
