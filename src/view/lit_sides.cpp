#include "view/lit_sides.hpp"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>

#include "chance/stream.hpp"
#include "room/mesh_links.hpp"
#include "room/triangle_shapes.hpp"
#include "walk/kernel.hpp"
#include "walk/never_absorbed.hpp"

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

// Goal: impacts on side 2·facet + behind.
class ImpactsOfSides : public GoalBase {
 public:
  ImpactsOfSides(const Scene& scene, const Stream& stream)
      : scene_(scene), stream_(stream), impacts_(2 * scene.tracer->facets().size()) {}

  void begin(std::uint64_t first_history) { first_history_ = first_history; }
  void start(Wave& wave, std::uint32_t n) {
    scene_.launcher->launch_all(stream_, first_history_, n, wave.rays, wave.photon.data());
  }
  Misses misses() const { return scene_.misses; }
  void land(const Wave& wave) {
    for (std::size_t i = 0; i < wave.rays.size; ++i)
      ++impacts_[2 * std::size_t{wave.rays.facet[i]} + wave.rays.behind[i]];
  }
  [[maybe_unused]] static constexpr bool in_lanes = true;

  const std::vector<std::uint32_t>& impacts() const { return impacts_; }

 private:
  const Scene& scene_;
  const Stream& stream_;
  std::vector<std::uint32_t> impacts_;
};

std::vector<std::uint32_t> impacts_of_sides(const Scene& scene) {
  const Stream stream(seed);
  ImpactsOfSides goal(scene, stream);
  Kernel<NeverAbsorbedPolicy, SurfaceReflectance, ImpactsOfSides> kernel(scene, stream, flights_each);
  for (std::uint64_t w = 0; w < waves; ++w) {
    goal.begin(w * batch_histories);
    kernel.fly(batch_histories, goal, [] { return false; });
  }
  return goal.impacts();
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
