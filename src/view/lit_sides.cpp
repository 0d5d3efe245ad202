#include "view/lit_sides.hpp"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>

#include "chance/draw_many.hpp"
#include "chance/stream.hpp"
#include "room/mesh_links.hpp"
#include "room/triangle_shapes.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

namespace {

constexpr std::uint64_t seed = 20217;  // any: the same room is always drawn the same
constexpr std::uint64_t waves = 48;
constexpr std::uint32_t flights_each = 16;  // light that gets into a corner at all is there by then
constexpr double least_share = 1e-3;        // of the mean impacts per area that makes a side lit
constexpr double enough_impacts = 20.0;     // expected on a side, for it to be judged: none comes by chance once in 5e8
constexpr double bend_cosine = 0.866;       // cos 30°

// Sets that grow together (R. Tarjan, Efficiency of a Good But Not Linear Set Union Algorithm, 1975).
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t of(std::size_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(std::size_t a, std::size_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> parent_;
};

// Impacts of photons that are never absorbed, on side 2·facet + behind.
std::vector<std::uint32_t> impacts_of_sides(const Scene& scene) {
  const Stream stream(seed);
  std::vector<std::uint32_t> impacts(2 * scene.tracer->facets().size());
  Wave wave;
  Rays& rays = wave.rays;
  TraceCount count;
  for (std::uint64_t w = 0; w < waves; ++w) {
    rays.size = batch_histories;
    scene.launcher->launch_all(stream, w * batch_histories, batch_histories, rays, wave.photon.data());
    scene.tracer->depart(rays);
    for (std::uint32_t flight = 1; flight <= flights_each && rays.size > 0; ++flight) {
      scene.tracer->trace(rays, scene.misses, count);
      std::size_t kept = 0;
      for (std::size_t i = 0; i < rays.size; ++i) {
        if (rays.facet[i] == no_facet) continue;
        ++impacts[2 * std::size_t{rays.facet[i]} + rays.behind[i]];
        wave.move(i, kept++);
      }
      rays.size = kept;
      for (std::size_t i = 0; i < kept; ++i) wave.history[i] = w * batch_histories + wave.photon[i];
      for (std::size_t i = kept; i < whole_lanes(kept); ++i) rays.facet[i] = 0;
      draw_many(stream, kept, wave.history.data(), flight, Purpose::flight, wave.polar.data(), wave.azimuth.data(),
                wave.chance.data());
      scene.tracer->scatter(rays, wave.polar.data(), wave.azimuth.data(), nullptr);
    }
  }
  return impacts;
}

// Joins sides of neighbours that face the same way. `first`: number of the surface's first triangle in the room.
void join_neighbours(const Surface& surface, const std::vector<TriangleShape>& shapes, std::size_t first, Sets& sides) {
  const MeshLinks links(surface);
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      for (const std::uint32_t other : links.at_edge(n, edge)) {
        if (other <= n) continue;
        const double cosine = glm::dot(shapes[n].normal, shapes[other].normal);
        if (std::abs(cosine) < bend_cosine) continue;
        const std::size_t turned = cosine < 0.0 ? 1 : 0;  // one of them is wound the other way
        for (std::size_t side = 0; side < 2; ++side)
          sides.join(2 * (first + n) + side, 2 * (first + other) + (side ^ turned));
      }
    }
  }
}

}  // namespace

LitSides find_lit_sides(const Room& room, const Scene& scene) {
  const std::vector<std::uint32_t> impacts = impacts_of_sides(scene);
  Sets sides(impacts.size());
  std::vector<double> areas;  // of the triangles, in m²
  for (const Surface& surface : room.surfaces) {
    const std::vector<TriangleShape> shapes = triangle_shapes(surface);
    join_neighbours(surface, shapes, areas.size(), sides);
    for (const TriangleShape& shape : shapes) areas.push_back(shape.area_m2);
  }
  std::vector<double> area(impacts.size());
  std::vector<double> hits(impacts.size());
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    area[sides.of(k)] += areas[k / 2];
    hits[sides.of(k)] += impacts[k];
  }
  double lit_area = 0.0;
  double all_hits = 0.0;
  for (std::size_t k = 0; k < area.size(); ++k) {
    lit_area += hits[k] > 0.0 ? area[k] : 0.0;
    all_hits += hits[k];
  }
  const double mean = all_hits / lit_area;  // impacts per m²; NaN where nothing is hit: then all is drawn
  const auto is_lit = [&](std::size_t side) {
    const double expected = mean * area[sides.of(side)];
    return !(expected >= enough_impacts) || hits[sides.of(side)] > least_share * expected;
  };
  LitSides lit(room.surfaces.size());
  std::size_t side = 0;
  for (std::size_t s = 0; s < lit.size(); ++s) {
    for (std::size_t n = 0; n < room.surfaces[s].triangles.size(); ++n, side += 2)
      lit[s].push_back({is_lit(side), is_lit(side + 1)});
  }
  return lit;
}

}  // namespace lichtmc
