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
  static constexpr std::uint32_t no_map = 0xFFFFFFFF;

  double reflectance = 0.0;
  // Its tile map; that of its back, if there is one, is the next. no_map in the tiling of a result without this surface.
  std::uint32_t map = no_map;
  std::uint32_t tiles_to_back = 0;  // tile number on the back minus that on the front; 0: both share one tile map
};

// The vertex colours on a facet: colour_0 + s·colour_s + t·colour_t.
struct ColouredFacet {
  glm::dvec3 colour_0{0.0};
  glm::dvec3 colour_s{0.0};
  glm::dvec3 colour_t{0.0};
  double highest = 1.0;  // limit of ρ
};

// The position of a facet on a reflectance map: (u, v) = uv_0 + s·uv_s + t·uv_t.
struct ReflectanceMapPlace {
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  const ReflectanceMap* map = nullptr;  // null if the surface has none
  std::uint32_t coloured = none;        // its vertex colours: index into Scene::coloured_facets
  glm::dvec2 uv_0{0.0};
  glm::dvec2 uv_s{0.0};
  glm::dvec2 uv_t{0.0};
};

struct Scene {
  // Prepares the data for walks through `room`; the room must outlive it. prepared: as for
  // make_embree_tracer().
  Scene(const Room& room, const Tiling& tiling, Engine engine, std::shared_ptr<PreparedRoom> prepared = nullptr);

  Engine engine = Engine::embree;  // the one used; declared before `tracer`, whose construction sets it
  std::unique_ptr<Tracer> tracer;
  Misses misses = Misses::escape;
  std::vector<SurfaceOptics> surfaces;
  std::vector<ReflectanceMapPlace> reflectance_map_places;  // per facet; empty if no surface has a varying ρ
  std::vector<ColouredFacet> coloured_facets;
  std::vector<std::uint32_t> tile_of_cell;  // every cell has a tile; an empty cell has the nearest
  std::vector<double> reflectance_of;       // of each surface
  std::vector<std::int64_t> survival_of;    // the same in units of 2⁻⁵³, rounded up
  std::vector<std::uint32_t> surface_of;    // of each facet
  std::unique_ptr<CellFinder> cells;
  bool maps_are_surfaces = false;         // tile map k is that of surface k: no back has its own
  bool cells_are_tiles = false;           // tile_of_cell[k] = k: rooms of rectangles
  std::vector<std::uint32_t> first_tile;  // of each tile map; the last element is the number of all tiles
  bool reflects_all_somewhere = false;    // a surface, or a point of one, has ρ = 1
  std::unique_ptr<Launcher> launcher;

  // Whether the reflectance of a surface varies from point to point, by a map or by vertex colours.
  bool has_reflectance_maps() const { return !reflectance_map_places.empty(); }

  // ρ where flight i ended. surface_reflectance() is for scenes without reflectance maps, and faster.
  double surface_reflectance(const Rays& rays, std::size_t i) const {
    return reflectance_of[surface_of[rays.facet[i]]];
  }
  double reflectance(const Rays& rays, std::size_t i) const {
    if (!has_reflectance_maps()) return surface_reflectance(rays, i);
    const ReflectanceMapPlace& place = reflectance_map_places[rays.facet[i]];
    const bool is_coloured = place.coloured != ReflectanceMapPlace::none;
    if (place.map == nullptr && !is_coloured) return surface_reflectance(rays, i);
    const glm::dvec2 uv = place.uv_0 + double{rays.s[i]} * place.uv_s + double{rays.t[i]} * place.uv_t;
    if (!is_coloured) return reflectance_at(*place.map, uv.x, uv.y);
    const ColouredFacet& at = coloured_facets[place.coloured];
    const glm::dvec3 colour = at.colour_0 + double{rays.s[i]} * at.colour_s + double{rays.t[i]} * at.colour_t;
    return coloured_reflectance(colour, place.map, uv, at.highest);
  }

  // The tile that each flight of a wave ended on, its tile map and surface. A point that rounding moves outside
  // the grid belongs to its outermost cells.
  void tile_of_each(const Rays& rays, std::uint32_t* tile, std::uint32_t* map, std::uint32_t* surface) const;

 private:
  void set_reflectances(const Room& room);
  void place_on_maps(const Room& room);
  void set_tiles(const Tiling& tiling);
};

}  // namespace lichtmc
