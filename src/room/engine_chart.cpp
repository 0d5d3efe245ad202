#include "room/engine_chart.hpp"

#include <iterator>
#include <utility>

#include "room/lay_out.hpp"
#include "room/pack.hpp"
#include "room/patches.hpp"

namespace lichtmc {

namespace {

bool any_area(const std::vector<std::uint32_t>& triangles, const std::vector<TriangleShape>& shapes) {
  for (const std::uint32_t k : triangles) {
    if (shapes[k].area_m2 > 0.0) return true;
  }
  return false;
}

}  // namespace

Chart make_engine_chart(const Surface& surface, const std::vector<TriangleShape>& shapes, double edge_m,
                        std::string reason) {
  const double noise_m = float_noise * largest_extent_m(surface);
  Patches cut = cut_into_patches(surface, shapes, noise_m);
  const MeshLinks links(surface);
  std::vector<LaidPatch> laid;
  for (Patch& patch : cut.patches) {
    std::vector<LaidPatch> parts = lay_out(std::move(patch), shapes, links, edge_m, noise_m);
    std::move(parts.begin(), parts.end(), std::back_inserter(laid));
  }
  std::vector<glm::dvec2> sizes;
  sizes.reserve(laid.size() + 1);
  for (const LaidPatch& part : laid) sizes.push_back(part.cells);
  if (any_area(cut.slivers, shapes)) sizes.emplace_back(1.0, 1.0);
  const Packing packing = pack(sizes);

  Chart chart;
  chart.source = ChartSource::engine;
  chart.reason = std::move(reason);
  chart.cells = packing.size;
  // Slivers are at the centre of their cell; those without area need no cell of their own.
  const glm::dvec2 sliver_cell = sizes.size() > laid.size() ? packing.corners.back() : glm::dvec2(0.0);
  chart.corners.resize(shapes.size());
  for (const std::uint32_t k : cut.slivers) chart.corners[k].fill(sliver_cell + 0.5);
  for (std::size_t p = 0; p < laid.size(); ++p) {
    const GridTransform grid(laid[p].low, laid[p].high, sizes[p], noise_m);
    const Patch& patch = laid[p].patch;
    for (std::size_t n = 0; n < patch.triangles.size(); ++n) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const glm::dvec2 place = grid(patch.flat[n][corner]);
        chart.corners[patch.triangles[n]][corner] =
            packing.corners[p] + (packing.turned[p] ? glm::dvec2(place.y, place.x) : place);
      }
    }
  }
  return chart;
}

}  // namespace lichtmc
