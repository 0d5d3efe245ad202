#include "walk/scene.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "base/lanes.hpp"
#include "lichtmc/error.hpp"
#include "room/emitter_shape.hpp"
#include "room/nearest_tile.hpp"
#include "room/triangle_shapes.hpp"
#include "tracer/prepared_room.hpp"

namespace lichtmc {

namespace {

// Whether photons of a surface emitter start inside a closed shell. This is tested in front of some of its triangles,
// at a millionth of the triangle's size.
bool emits_inside(const Surface& surface, const Enclosure& enclosure) {
  const std::vector<TriangleSample> samples = sample_triangles(surface);
  return std::all_of(samples.begin(), samples.end(), [&](const TriangleSample& triangle) {
    return enclosure.encloses(triangle.middle + 1e-6 * triangle.size_m * triangle.normal);
  });
}

// Whether all photons start inside closed shells. Then none can leave the room, except by rounding.
bool all_inside(const Room& room, const Enclosure& enclosure) {
  return std::all_of(room.emitters.begin(), room.emitters.end(), [&](const Emitter& emitter) {
    return visit_shape(
        emitter, [&](const auto& point) { return enclosure.encloses(point.position); },
        [&](const auto& area_light) { return emits_inside(room.surfaces[area_light.surface], enclosure); });
  });
}

// A back side has the grid of the front, and its tiles follow those of the front in the same order: the difference of
// their numbers is constant.
std::uint32_t tiles_between(const TileMap& front, const TileMap& back) {
  const auto used =
      std::find_if(back.tile_of_cell.begin(), back.tile_of_cell.end(), [](std::uint32_t t) { return t != no_tile; });
  if (used == back.tile_of_cell.end()) return 0;
  return *used - front.tile_of_cell[static_cast<std::size_t>(used - back.tile_of_cell.begin())];
}

std::unique_ptr<Tracer> make_tracer(const Room& room, const Tiling& tiling, Engine requested, Engine& chosen,
                                    std::shared_ptr<PreparedRoom> prepared) {
  std::string why_not;
  if (requested == Engine::automatic || requested == Engine::cuboid) {
    chosen = Engine::cuboid;
    if (auto tracer = make_cuboid_tracer(room, tiling, why_not)) return tracer;
    if (requested == Engine::cuboid) {
      throw InputError("The engine 'cuboid' does not support " + room.source + ": the room " + why_not +
                       ". Use the engine 'auto' or 'embree'.");
    }
  }
  chosen = requested == Engine::embree_fast ? requested : Engine::embree;
  return make_embree_tracer(room, tiling, requested == Engine::embree_fast ? Edges::fast : Edges::robust,
                            std::move(prepared));
}

}  // namespace

Scene::Scene(const Room& room, const Tiling& tiling, Engine requested, std::shared_ptr<PreparedRoom> prepared)
    : tracer(make_tracer(room, tiling, requested, engine, std::move(prepared))) {
  set_reflectances(room);
  set_tiles(tiling);
  launcher = std::make_unique<Launcher>(room, *tracer);
  if (engine == Engine::embree && launcher->all_off_surfaces()) {
    const Enclosure& enclosure = tracer->prepared()->enclosure();
    if (enclosure.has_closed_shell() && all_inside(room, enclosure)) misses = Misses::retrace;
  }
}

void Scene::set_reflectances(const Room& room) {
  surfaces.resize(room.surfaces.size());
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const double reflectance = room.surfaces[k].reflectance;
    surfaces[k].reflectance = reflectance;
    reflectance_of.push_back(reflectance);
    // unit_fine() returns multiples of 2⁻⁵³: as many of them are below this number as below ρ.
    survival_of.push_back(static_cast<std::int64_t>(std::ceil(reflectance * 0x1p53)));
  }
  place_on_maps(room);
  const HighestReflectance highest(room);
  reflects_all_somewhere = std::any_of(room.surfaces.begin(), room.surfaces.end(),
                                       [&](const Surface& surface) { return highest.of(surface) == 1.0; });
}

// The positions of facets on the reflectance maps of their surfaces, and their vertex colours. Each facet of such a
// surface is one triangle.
void Scene::place_on_maps(const Room& room) {
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    const Surface& surface = room.surfaces[k];
    if (!has_varying_reflectance(surface)) continue;
    reflectance_map_places.resize(tracer->facets().size());
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
      const glm::uvec3 corner = surface.triangles[n];
      const TriangleOnFacet triangle = tracer->locate(k, n);
      assert(triangle.st_0 == glm::vec2(0.0F) && triangle.st_1 == glm::vec2(1.0F, 0.0F));
      ReflectanceMapPlace& place = reflectance_map_places[triangle.facet];
      if (surface.reflectance_map) {
        const glm::dvec2 uv_0 = surface.reflectance_uvs[corner.x];
        place.map = &room.reflectance_maps[*surface.reflectance_map];
        place.uv_0 = uv_0;
        place.uv_s = surface.reflectance_uvs[corner.y] - uv_0;
        place.uv_t = surface.reflectance_uvs[corner.z] - uv_0;
      }
      if (surface.vertex_colours.empty()) continue;
      const glm::dvec3 colour_0 = surface.vertex_colours[corner.x];
      place.coloured = static_cast<std::uint32_t>(coloured_facets.size());
      coloured_facets.push_back({colour_0, surface.vertex_colours[corner.y] - colour_0,
                                 surface.vertex_colours[corner.z] - colour_0, surface.highest_reflectance});
    }
  }
}

void Scene::set_tiles(const Tiling& tiling) {
  for (std::size_t m = 0, n = 0; m <= tiling.maps.size(); ++m) {
    while (n < tiling.tiles.size() && tiling.tiles[n].map < m) ++n;
    first_tile.push_back(static_cast<std::uint32_t>(n));
  }
  maps_are_surfaces = tiling.maps.size() == surfaces.size();
  std::vector<SurfaceGrid> grids(surfaces.size());
  for (std::size_t m = 0; m < tiling.maps.size(); ++m) {
    const TileMap& map = tiling.maps[m];
    SurfaceOptics& surface = surfaces[map.surface];
    maps_are_surfaces = maps_are_surfaces && map.surface == m;
    if (map.side == Side::back) {
      surface.tiles_to_back = tiles_between(tiling.maps[m - 1], map);
      continue;
    }
    surface.map = static_cast<std::uint32_t>(m);
    grids[map.surface] = {map.columns, map.rows, static_cast<std::uint32_t>(tile_of_cell.size())};
    const std::vector<std::uint32_t> filled = nearest_tiles(map);
    tile_of_cell.insert(tile_of_cell.end(), filled.begin(), filled.end());
  }
  surface_of.reserve(tracer->facets().size());
  for (const Facet& facet : tracer->facets()) surface_of.push_back(facet.surface);
  const unsigned threads = tracer->prepared() != nullptr ? tracer->prepared()->threads() : 1;
  cells = std::make_unique<CellFinder>(tracer->facets(), grids, threads);
  cells_are_tiles = true;
  for (std::size_t cell = 0; cell < tile_of_cell.size(); ++cell)
    cells_are_tiles = cells_are_tiles && tile_of_cell[cell] == cell;
}

void Scene::tile_of_each(const Rays& rays, std::uint32_t* tile, std::uint32_t* map, std::uint32_t* surface) const {
  cells->find(rays.size, rays.facet.data(), rays.s.data(), rays.t.data(), tile, surface);
  if (!cells_are_tiles) {
    for (std::size_t i = 0; i < rays.size; ++i) {
      assert(tile_of_cell[tile[i]] != no_tile);  // a surface that was hit has an area, hence a tile
      tile[i] = tile_of_cell[tile[i]];
    }
  }
  if (maps_are_surfaces) {
    std::copy_n(surface, rays.size, map);
    return;
  }
  for (std::size_t i = 0; i < rays.size; ++i) {
    const SurfaceOptics& at = surfaces[surface[i]];
    const std::uint32_t back = at.tiles_to_back != 0 ? rays.behind[i] : 0;
    tile[i] += back * at.tiles_to_back;
    map[i] = at.map + back;
  }
}

}  // namespace lichtmc
