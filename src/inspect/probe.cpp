#include "inspect/probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "chance/directions.hpp"
#include "chance/stream.hpp"
#include "walk/wave.hpp"

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

// The flights that left, by the side that they passed.
class Leavers {
 public:
  Leavers(const Room& room, const Tracer& tracer, const glm::dvec3& low, const glm::dvec3& high)
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

// A triangle of the room by its numbers.
struct RoomTriangle {
  std::size_t surface = 0;
  std::size_t number = 0;
};

std::vector<RoomTriangle> triangles_of_facets(const Room& room, const Tracer& tracer) {
  std::vector<RoomTriangle> triangles(tracer.facets().size());
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    for (std::size_t n = 0; n < room.surfaces[k].triangles.size(); ++n) triangles[tracer.locate(k, n).facet] = {k, n};
  }
  return triangles;
}

// Where flight i met a triangle of Embree's, whose facets' coordinates are the barycentric ones.
glm::dvec3 hit_point(const Room& room, const RoomTriangle& triangle, const Rays& rays, std::size_t i) {
  const Surface& surface = room.surfaces[triangle.surface];
  const glm::uvec3 corner = surface.triangles[triangle.number];
  const glm::dvec3 a = surface.positions[corner.x];
  return a + double{rays.s[i]} * (surface.positions[corner.y] - a) +
         double{rays.t[i]} * (surface.positions[corner.z] - a);
}

}  // namespace

ProbeResult probe(const Room& room, const Scene& scene, const glm::dvec3& low, const glm::dvec3& high) {
  const Stream stream(seed);
  const std::vector<Facet>& facets = scene.tracer->facets();
  ProbeResult result;
  result.impacts.resize(room.surfaces.size());
  result.behind.resize(room.surfaces.size());
  Leavers leavers(room, *scene.tracer, low, high);
  Wave wave;
  Rays& rays = wave.rays;
  TraceCount count;
  std::vector<std::uint32_t> from(batch_histories);
  for (std::uint64_t w = 0; w < waves; ++w) {
    for (std::uint32_t i = 0; i < batch_histories; ++i) {
      wave.photon[i] = i;
      scene.launcher->launch(stream, w * batch_histories + i, rays, i);
    }
    rays.size = batch_histories;
    for (std::uint32_t flight = 1; flight <= flights_each && rays.size > 0; ++flight) {
      for (std::size_t i = 0; i < rays.size; ++i) from[i] = rays.facet[i];
      scene.tracer->depart(rays);
      scene.tracer->trace(rays, Misses::escape, count);
      result.flights += rays.size;
      std::size_t kept = 0;
      for (std::size_t i = 0; i < rays.size; ++i) {
        if (rays.facet[i] == no_facet) {
          leavers.add(rays, i, from[i]);
          ++result.left;
          continue;
        }
        const std::uint32_t surface = facets[rays.facet[i]].surface;
        ++result.impacts[surface];
        result.behind[surface] += rays.behind[i];
        wave.move(i, kept++);
      }
      rays.size = kept;
      for (std::size_t i = 0; i < rays.size; ++i) {
        const Words words = stream.draw(w * batch_histories + wave.photon[i], flight, Purpose::flight);
        rays.set_direction(
            i, direction_from(facets[rays.facet[i]], rays.behind[i] != 0, sample_lambert(words[0], words[1])));
      }
    }
  }
  result.openings = leavers.openings(result.left);
  return result;
}

glm::dvec3 find_inside(const Room& room, const Tracer& tracer, const glm::dvec3& low, const glm::dvec3& high) {
  const std::vector<RoomTriangle> triangle_of_facet = triangles_of_facets(room, tracer);
  constexpr std::uint32_t candidates = 64;
  constexpr std::uint32_t rays_each = 256;
  const Stream stream(seed + 1);
  Rays rays(rays_each);
  TraceCount count;
  glm::dvec3 best = 0.5 * (low + high);
  double best_score = -1.0;
  const double diagonal = glm::length(high - low);
  for (std::uint32_t c = 0; c < candidates; ++c) {
    // The middle first, then places all over.
    const Words place = stream.draw(c, 0, Purpose::place);
    const glm::dvec3 share(unit_open(place[0]), unit_open(place[1]), unit_open(place[2]));
    const glm::dvec3 candidate = c == 0 ? best : low + (high - low) * (0.1 + 0.8 * share);
    const Start start = tracer.start(candidate, glm::dvec3(0.0));
    if (start.on_surface) continue;
    for (std::uint32_t i = 0; i < rays_each; ++i) {
      const Words words = stream.draw(std::uint64_t{c} * rays_each + i, 0, Purpose::emission);
      rays.facet[i] = no_facet;
      rays.set_start(i, start.point);
      rays.set_direction(
          i, glm::vec3(tracer.directions() * IsotropicLaw{}.sample(unit_open(words[0]), unit_open(words[1]))));
    }
    rays.size = rays_each;
    tracer.trace(rays, Misses::escape, count);
    std::uint32_t hits = 0;
    double view = 0.0;
    for (std::uint32_t i = 0; i < rays_each; ++i) {
      if (rays.facet[i] == no_facet) continue;
      ++hits;
      view += glm::length(hit_point(room, triangle_of_facet[rays.facet[i]], rays, i) - candidate) / diagonal;
    }
    const double score = static_cast<double>(hits) + (hits > 0 ? 0.5 * rays_each * view / hits : 0.0);
    if (score <= best_score) continue;
    best_score = score;
    best = candidate;
  }
  return best;
}

}  // namespace lichtmc
