#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include <glm/common.hpp>

#include "lichtmc/gltf.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "room/nearest_tile.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

namespace {

std::vector<std::filesystem::path> real_rooms() {
  const std::filesystem::path folder = std::filesystem::path(LICHTMC_ROOMS) / "real";
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto ending = entry.path().extension();
    if (ending == ".glb" || ending == ".gltf") files.push_back(entry.path());
  }
  return files;
}

double largest_extent(const Room& room) {
  glm::dvec3 low(1e300);
  glm::dvec3 high(-1e300);
  for (const Surface& surface : room.surfaces) {
    for (const glm::dvec3& p : surface.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

// Compensated summation (W. Kahan, 1965), so that the sum of a million tiles is as precise as its terms.
struct ExactSum {
  double sum = 0.0;
  double carry = 0.0;
  void add(double term) {
    const double corrected = term - carry;
    const double next = sum + corrected;
    carry = (next - sum) - corrected;
    sum = next;
  }
};

void check_areas(const Room& room, double edge_m) {
  const Tiling tiling = make_tiling(room, edge_m);
  std::vector<ExactSum> areas(tiling.maps.size());
  for (const Tile& tile : tiling.tiles) {
    REQUIRE(tile.area_m2 > 0.0);
    areas[tile.map].add(tile.area_m2);
  }
  for (std::size_t m = 0; m < tiling.maps.size(); ++m) {
    const TileMap& map = tiling.maps[m];
    INFO("surface " << map.name);
    const double area = surface_area(room.surfaces[map.surface]);
    CHECK(std::abs(areas[m].sum - area) <= 1e-9 * area);
    if (area > 0.0) {
      for (const std::uint32_t tile : nearest_tiles(map)) REQUIRE(tile < tiling.tiles.size());
    }
  }
}

}  // namespace

// The tiles of a surface cover it: their areas add up to its own to 1e-9, also in real rooms, with overlapping and
// wrapping UVs and thousands of triangles without area. A tile left out or counted twice would be missing by 1e-5 or
// more in all but the finest of these.
TEST_CASE("tile areas add up to the area of every surface of real rooms") {
  const auto files = real_rooms();
  if (files.empty()) {
    WARN("skipped: no rooms in " << LICHTMC_ROOMS << "/real");
    return;
  }
  for (const auto& file : files) {
    INFO(file.string());
    const Room room = read_gltf(file);
    // Tiles relative to the room, because not every file is in metres.
    const double extent = largest_extent(room);
    for (const double divisions : {1.0, 37.0, 200.0}) check_areas(room, extent / divisions);
  }
}
