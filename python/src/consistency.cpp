#include "consistency.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <variant>
#include <vector>

#include "lichtmc/channel.hpp"
#include "lichtmc/emitter_parts.hpp"
#include "lichtmc/photometry.hpp"
#include "result_parts.hpp"

namespace lichtmc::python {

namespace {

// Without their product, which may be too large for a number.
bool is_product(std::size_t size, std::initializer_list<std::size_t> factors) {
  for (const std::size_t factor : factors) {
    if (factor == 0) return size == 0;
  }
  if (size == 0) return false;
  for (const std::size_t factor : factors) {
    if (size % factor != 0) return false;
    size /= factor;
  }
  return size == 1;
}

template <class List>
bool is_none_or(const List& list, std::size_t size) {
  return list.empty() || list.size() == size;
}

bool is_map(const std::optional<std::size_t>& map, const std::vector<glm::dvec2>& uvs, std::size_t maps,
            const Surface& surface) {
  return !map || (*map < maps && uvs.size() == surface.positions.size());
}

bool is_consistent(const TextureMap& map) {
  return !map.values.empty() && is_product(map.values.size(), {map.rows, map.columns}) &&
         is_none_or(map.colours, map.values.size());
}

bool is_consistent(const Surface& surface, const Room& room) {
  const std::size_t corners = surface.positions.size();
  return is_none_or(surface.uvs, corners) && is_none_or(surface.vertex_colours, corners) &&
         is_map(surface.reflectance_map, surface.reflectance_uvs, room.reflectance_maps.size(), surface) &&
         std::all_of(surface.triangles.begin(), surface.triangles.end(), [&](const glm::uvec3& triangle) {
           return triangle.x < corners && triangle.y < corners && triangle.z < corners;
         });
}

bool is_consistent(const Emitter& emitter, const Room& room) {
  if (const auto* area = std::get_if<SurfaceEmitter>(&emitter.shape)) {
    return area->surface < room.surfaces.size() &&
           is_map(area->emission_map, area->emission_uvs, room.emission_maps.size(), room.surfaces[area->surface]);
  }
  const auto* measured = std::get_if<MeasuredEmitter>(&emitter.shape);
  return measured == nullptr || (measured->photometry && measured->photometry->candela);
}

bool is_consistent(const Area& area, std::size_t receivers) {
  const std::size_t grid = std::size_t{area.rows} * area.columns;
  return area.cells.size() <= grid && area.cells.size() <= receivers &&
         area.first_receiver <= receivers - area.cells.size() &&
         std::all_of(area.cells.begin(), area.cells.end(), [&](std::uint32_t cell) { return cell < grid; });
}

bool is_consistent(const TileMap& map, std::size_t tiles, const Room& room) {
  return map.surface < room.surfaces.size() && is_product(map.tile_of_cell.size(), {map.rows, map.columns}) &&
         std::all_of(map.tile_of_cell.begin(), map.tile_of_cell.end(),
                     [&](std::uint32_t tile) { return tile < tiles || tile == no_tile; });
}

bool is_consistent(const Tiling& tiling, const Room& room) {
  const auto is_valid_map = [&](const TileMap& map) { return is_consistent(map, tiling.tiles.size(), room); };
  if (!std::all_of(tiling.maps.begin(), tiling.maps.end(), is_valid_map)) return false;
  const auto is_valid_tile = [&](const Tile& tile) {
    if (tile.map >= tiling.maps.size()) return false;
    const TileMap& map = tiling.maps[tile.map];
    return tile.column < map.columns && tile.row < map.rows &&
           tile.triangle < room.surfaces[map.surface].triangles.size();
  };
  if (!std::all_of(tiling.tiles.begin(), tiling.tiles.end(), is_valid_tile)) return false;
  if (!is_none_or(tiling.cells, room.surfaces.size())) return false;
  for (std::size_t k = 0; k < tiling.cells.size(); ++k) {
    if (!is_none_or(tiling.cells[k], room.surfaces[k].triangles.size())) return false;
  }
  return true;
}

// The tiles of each map are next to each other.
bool has_tiles_of_surfaces(const Result& result) {
  const std::vector<Tile>& tiles = result.tiling.tiles;
  for (std::size_t m = 0; m < result.surfaces.size(); ++m) {
    const std::size_t first = first_tile(result.tiling.maps[m]);
    if (first == no_tile) continue;
    const std::size_t count = result.surfaces[m].tiles;
    if (count > tiles.size() - first) return false;
    for (std::size_t k = first; k < first + count; ++k) {
      if (tiles[k].map != m) return false;
    }
  }
  return true;
}

bool is_consistent(const EmitterParts& parts) {
  const std::size_t count = parts.parts.size();
  const auto has_all = [&](const std::vector<double>& list) {
    return is_product(list.size(), {parts.receivers, count});
  };
  return has_all(parts.direct) && has_all(parts.direct_error) && has_all(parts.reflected) &&
         is_product(parts.of_groups.size(), {parts.receivers, count, parts.group_rounds.size()}) &&
         is_product(parts.covariance.size(), {parts.receivers, parts.pairs()});
}

bool is_consistent(const ImpulseResponses& all) {
  const std::size_t emitters = all.emitters.size();
  const auto has = [&](const auto& list, std::initializer_list<std::size_t> last) {
    std::size_t size = emitters * all.receivers.size();
    if (size == 0) return list.empty();
    if (list.size() % size != 0) return false;
    return is_product(list.size() / size, last);
  };
  return all.powers.size() == emitters && all.delays_s.size() == emitters && has(all.h, {all.columns(), all.bins}) &&
         has(all.standard_error, {all.columns(), all.bins}) && has(all.h_all, {all.bins}) &&
         has(all.standard_error_all, {all.bins}) && has(all.order_gain, {all.columns()}) &&
         has(all.order_beyond, {all.columns()}) && has(all.order_first_s, {all.columns()}) &&
         has(all.response, {all.frequencies_hz.size()}) && has(all.magnitude_error, {all.frequencies_hz.size()}) &&
         has(all.channels, {1});
}

}  // namespace

bool is_consistent(const Room& room) {
  const auto all = [](const auto& list, const auto& is_valid) {
    return std::all_of(list.begin(), list.end(), is_valid);
  };
  const auto is_valid_map = [](const TextureMap& map) { return is_consistent(map); };
  return all(room.reflectance_maps, is_valid_map) && all(room.emission_maps, is_valid_map) &&
         all(room.surfaces, [&](const Surface& surface) { return is_consistent(surface, room); }) &&
         all(room.emitters, [&](const Emitter& emitter) { return is_consistent(emitter, room); }) &&
         all(room.areas, [&](const Area& area) { return is_consistent(area, room.receivers.size()); });
}

bool is_consistent(const Result& result, const Room& room) {
  const std::size_t tiles = result.tiling.tiles.size();
  const auto is_valid_area = [&](const AreaResult& found) {
    const std::size_t grid = std::size_t{found.area.rows} * found.area.columns;
    return is_consistent(found.area, result.receiver_results.size()) &&
           (found.area.cells.empty() || (found.lowest_cell < grid && found.highest_cell < grid));
  };
  return is_consistent(room) && is_consistent(result.tiling, room) && is_none_or(result.tiles, tiles) &&
         (result.unreached.empty() || result.unreached.size() >= tiles) &&
         is_none_or(result.surfaces, result.tiling.maps.size()) && has_tiles_of_surfaces(result) &&
         is_none_or(result.receiver_results, result.receivers.size()) &&
         std::all_of(result.areas.begin(), result.areas.end(), is_valid_area) &&
         (!result.parts || is_consistent(*result.parts)) && (!result.channels || is_consistent(*result.channels));
}

}  // namespace lichtmc::python
