// The room as prepared for walks: tracer, reflectances, tiles, launcher of photons.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/tiles.hpp"
#include "room/reflectance.hpp"
#include "tracer/tracer.hpp"
#include "walk/cell_finder.hpp"
#include "walk/launcher.hpp"

namespace lichtmc {

// The data of a surface that a walk needs.
struct SurfaceOptics {
  double reflectance = 0.0;
  std::uint32_t map = 0;            // its tile map; that of its back, if there is one, is the next
  std::uint32_t tiles_to_back = 0;  // tile number on the back minus that on the front; 0: both share one tile map
};

// The position of a facet on a reflectance map: (u, v) = uv_0 + s·uv_s + t·uv_t.
struct ReflectanceMapPlace {
  const ReflectanceMap* map = nullptr;  // null if the surface has one reflectance
  glm::dvec2 uv_0{0.0};
  glm::dvec2 uv_s{0.0};
  glm::dvec2 uv_t{0.0};
};

struct Scene {
  // Prepares the data for walks through `room`; the room must outlive it.
  Scene(const Room& room, const Tiling& tiling, Engine engine);

  Engine engine = Engine::embree;  // the one used; declared before `tracer`, whose construction sets it
  std::unique_ptr<Tracer> tracer;
  Misses misses = Misses::escape;
  std::vector<SurfaceOptics> surfaces;
  std::vector<ReflectanceMapPlace> reflectance_map_places;  // per facet; empty if no surface has a reflectance map
  std::vector<std::uint32_t> tile_of_cell;                  // every cell has a tile; an empty cell has the nearest
  std::vector<double> reflectance_of;                       // of each surface
  std::vector<std::int64_t> survival_of;                    // the same in units of 2⁻⁵³, rounded up
  std::vector<std::uint32_t> surface_of;                    // of each facet
  std::unique_ptr<CellFinder> cells;
  bool cells_are_tiles = false;           // tile_of_cell[k] = k: rooms of rectangles
  std::vector<std::uint32_t> first_tile;  // of each tile map; the last element is the number of all tiles
  bool reflects_all_somewhere = false;    // a surface, or a point of one, has ρ = 1
  std::unique_ptr<Launcher> launcher;

  // Whether the reflectance of a surface varies from point to point.
  bool has_reflectance_maps() const { return !reflectance_map_places.empty(); }

  // ρ where flight i ended. surface_reflectance() is for scenes without reflectance maps, and faster.
  double surface_reflectance(const Rays& rays, std::size_t i) const {
    return reflectance_of[surface_of[rays.facet[i]]];
  }
  double reflectance(const Rays& rays, std::size_t i) const {
    if (!has_reflectance_maps() || reflectance_map_places[rays.facet[i]].map == nullptr)
      return surface_reflectance(rays, i);
    const ReflectanceMapPlace& place = reflectance_map_places[rays.facet[i]];
    const glm::dvec2 uv = place.uv_0 + double{rays.s[i]} * place.uv_s + double{rays.t[i]} * place.uv_t;
    return reflectance_at(*place.map, uv.x, uv.y);
  }

  // The tile that each flight of a wave ended on, its tile map and surface. A point that rounding moves outside
  // the grid belongs to its outermost cells.
  void tile_of_each(const Rays& rays, std::uint32_t* tile, std::uint32_t* map, std::uint32_t* surface) const;

 private:
  void set_reflectances(const Room& room);
  void set_tiles(const Tiling& tiling);
};

}  // namespace lichtmc
