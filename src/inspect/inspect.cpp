#include "lichtmc/inspect.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "inspect/findings.hpp"
#include "inspect/guesses.hpp"
#include "inspect/probe.hpp"
#include "inspect/topics.hpp"
#include "lichtmc/error.hpp"
#include "room/bounds.hpp"
#include "room/cuboid_shape.hpp"
#include "room/reflectance.hpp"
#include "room/room_check.hpp"
#include "tracer/prepared_room.hpp"
#include "walk/inside.hpp"
#include "walk/non_absorbing_enclosure.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

namespace {

void count_triangles(const Room& room, Inspection& facts) {
  for (const Surface& surface : room.surfaces) {
    facts.triangles += surface.triangles.size();
    facts.triangles_without_area += surface.without_area;
  }
  const Bounds bounds = bounds_of(room);
  facts.low = bounds.low;
  facts.high = bounds.high;
}

void inspect_mesh(const MeshFacts& mesh, Inspection& facts) {
  facts.duplicate_triangles = mesh.duplicates;
  facts.open_edges = mesh.open_edges;
  facts.open_edge_places = mesh.open_edges_at;
  facts.convex = mesh.convex;
}

void inspect_surfaces(const Room& room, Inspection& facts) {
  const HighestReflectance highest(room);
  for (const Surface& surface : room.surfaces) {
    SurfaceFacts& one = facts.surfaces.emplace_back();
    one.name = surface.name;
    one.material = surface.material;
    one.reflectance = surface.reflectance;
    one.highest_reflectance = highest.of(surface);
    one.reflectance_source = surface.reflectance_source;
    one.area_m2 = surface_area(surface);
    one.triangles = surface.triangles.size();
    one.triangles_without_area = surface.without_area;
    one.sides = surface.sides;
  }
}

void inspect_tiles(const Room& room, const Tiling& tiling, double tile_edge_m, Inspection& facts) {
  for (const TileMap& map : tiling.maps) {
    SurfaceFacts& surface = facts.surfaces[map.surface];
    surface.chart = map.chart;
    surface.chart_reason = map.chart_reason;
    // Approximate: the edge of a cell is close to tile_edge_m; the exact value depends on the chart.
    if (map.side == Side::front && surface.area_m2 > 0.0)
      surface.cells_over_area =
          static_cast<double>(map.tile_of_cell.size()) * tile_edge_m * tile_edge_m / surface.area_m2;
  }
  for (const Tile& tile : tiling.tiles) ++facts.surfaces[tiling.maps[tile.map].surface].tiles;
  facts.tiles = tiling.tiles.size();
  facts.memory_bytes = memory_needed(room, tiling);
}

// The tiles with this edge, and what there is to say of them. If they need too much memory, adds a fault, says nothing
// of tiles, and returns one tile per surface, for the rays.
Tiling tiling_within_memory(PreparedRoom& prepared, double tile_edge_m, Inspection& facts) {
  try {
    Tiling tiling = prepared.take_tiling(tile_edge_m);
    inspect_tiles(prepared.room(), tiling, tile_edge_m, facts);
    return tiling;
  } catch (const InputError& fault) {
    if (!(tile_edge_m > 0.0) || !std::isfinite(tile_edge_m)) throw;
    add_fault(fault.what(), "tiles", facts.findings);
    return prepared.take_tiling(std::numeric_limits<double>::max());
  }
}

// If the emitters are not valid, rays start at a point inside.
void trace_rays(const Room& room, const Tiling& tiling, bool own_emitters,
                const std::shared_ptr<PreparedRoom>& prepared, Inspection& facts) {
  std::optional<Room> with_probe;
  std::optional<Scene> own_scene;
  const auto find = [&](const Tracer& tracer) {
    const InsidePoint inside = find_inside(room, tracer, facts.low, facts.high);
    facts.inside = inside.place;
    facts.inside_is_sure = inside.sure;
  };
  if (own_emitters) {
    own_scene.emplace(room, tiling, Engine::embree, prepared);
    find(*own_scene->tracer);
  } else {
    find(*make_embree_tracer(room, tiling, Edges::robust, prepared));
    if (!facts.inside_is_sure) return;
    with_probe = room;
    with_probe->emitters = {{"probe", 1.0, IsotropicEmitter{facts.inside}}};
    own_scene.emplace(*with_probe, tiling, Engine::embree, prepared);
  }
  const Room& lit = own_emitters ? room : *with_probe;
  const Scene& scene = *own_scene;
  prepared->announce("Following test photons");
  facts.closed = scene.misses == Misses::retrace;
  const ProbeResult result = probe(lit, scene, facts.low, facts.high);
  facts.flights = result.flights;
  facts.undecided_flights = result.undecided;
  facts.covers = prepared->planes()->covers();
  facts.opposites = prepared->planes()->opposites();
  facts.flights_that_left = result.left;
  facts.openings = result.openings;
  if (own_emitters) facts.emitters = result.emitters;
  if (own_emitters) facts.luminaires = result.luminaires;
  for (std::size_t k = 0; k < facts.surfaces.size(); ++k) {
    facts.surfaces[k].impacts = result.impacts[k];
    if (result.impacts[k] == 0) continue;
    facts.surfaces[k].seen_from_behind = static_cast<double>(result.behind[k]) / static_cast<double>(result.impacts[k]);
  }
  if (const auto enclosure = find_non_absorbing_enclosure(scene, 1)) {
    add_non_absorbing_enclosure(own_emitters ? room.emitters[enclosure->emitter].name : std::string(),
                                room.surfaces[enclosure->surface].name, facts.findings);
  }
}

}  // namespace

std::string_view reflectance_source_word(ReflectanceSource source) {
  switch (source) {
    case ReflectanceSource::given:
      return "given";
    case ReflectanceSource::property:
      return "property";
    case ReflectanceSource::base_colour:
      return "base colour";
    case ReflectanceSource::texture:
      return "texture";
    case ReflectanceSource::vertex_colours:
      return "vertex colours";
    case ReflectanceSource::default_white:
      break;
  }
  return "default (white)";
}

std::size_t Inspection::count(Severity severity) const {
  return static_cast<std::size_t>(std::count_if(
      findings.begin(), findings.end(), [severity](const Finding& finding) { return finding.severity == severity; }));
}

namespace {

// tiling: null to make one, which the prepared room then keeps.
Inspection inspect_with(const Room& room, const Tiling* tiling, double tile_edge_m,
                        const std::shared_ptr<PreparedRoom>& prepared) {
  check_surfaces(room);
  Inspection facts;
  bool own_emitters = true;
  try {
    check_room(room);
  } catch (const InputError& fault) {
    own_emitters = false;
    add_fault(fault.what(), "emitters", facts.findings);
  }
  count_triangles(room, facts);
  prepared->planes();  // first: it needs most memory beside the room
  inspect_mesh(prepared->mesh(), facts);
  facts.cuboid = recognise_cuboid(room).has_value();
  facts.probably_z_up = looks_z_up(room, facts.high - facts.low);
  if (const auto unit = guess_unit(upright(facts))) facts.suggested_scale = unit->metres;
  inspect_surfaces(room, facts);
  std::optional<Tiling> made;
  if (tiling == nullptr) {
    made = tiling_within_memory(*prepared, tile_edge_m, facts);
    tiling = &*made;
  } else {
    inspect_tiles(room, *tiling, tile_edge_m, facts);
  }
  trace_rays(room, *tiling, own_emitters, prepared, facts);
  add_findings(room, prepared->enclosure(), facts);
  std::stable_sort(facts.findings.begin(), facts.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  if (made && facts.tiles > 0) prepared->keep_tiling(tile_edge_m, std::move(*made));
  return facts;
}

}  // namespace

Inspection inspect(const Room& room, double tile_edge_m, std::shared_ptr<PreparedRoom> prepared) {
  return inspect_with(room, nullptr, tile_edge_m, prepared_or_new(std::move(prepared), room, 0));
}

Inspection inspect(const Room& room, const Tiling& tiling, double tile_edge_m, std::shared_ptr<PreparedRoom> prepared) {
  return inspect_with(room, &tiling, tile_edge_m, prepared_or_new(std::move(prepared), room, 0));
}

}  // namespace lichtmc
