#include "lichtmc/tiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "base/memory.hpp"
#include "base/message.hpp"
#include "base/parallel.hpp"
#include "lichtmc/error.hpp"
#include "room/chart.hpp"
#include "room/clip.hpp"
#include "room/engine_chart.hpp"
#include "room/triangle_shapes.hpp"
#include "room/uv_chart.hpp"

namespace lichtmc {

namespace {

constexpr double most_cells = 0x1p31;

// Memory of a run of two threads per cell, with its tables, pictures and state: 171 to 211 bytes measured in a room of
// 2·10⁷ tiles.
constexpr double bytes_per_cell = 212.0;

// The edge of tiles of surfaces that are not measured: one tile takes all their scores.
constexpr double one_tile = std::numeric_limits<double>::max();

// A cell's centre counts as on a triangle if it is outside by no more than this share of it: otherwise rounding could
// exclude a centre on the edge between two triangles from both.
constexpr double on_triangle = -1e-9;

Chart make_chart(const Surface& surface, const std::vector<TriangleShape>& shapes, double edge_m) {
  const bool has_area =
      std::any_of(shapes.begin(), shapes.end(), [](const TriangleShape& shape) { return shape.area_m2 > 0.0; });
  if (!has_area) {
    Chart chart;
    chart.source = ChartSource::engine;
    chart.reason = "it has no area";
    chart.corners.resize(shapes.size());
    return chart;
  }
  std::string fault = uv_fault(surface, shapes);
  if (fault.empty()) return make_uv_chart(surface, shapes, edge_m);
  return make_engine_chart(surface, shapes, edge_m, std::move(fault));
}

double cell_count(const Surface& surface, const Chart& chart) {
  return chart.cells.x * chart.cells.y * (surface.sides == Sides::both ? 2.0 : 1.0);
}

// The number of cells of all tile maps, which memory must hold.
double check_cells(const Room& room, const std::vector<Chart>& charts, double edge_m) {
  double total = 0.0;
  double most = 0.0;
  std::size_t worst = 0;
  for (std::size_t k = 0; k < charts.size(); ++k) {
    const double count = cell_count(room.surfaces[k], charts[k]);
    total += count;
    if (!(count > most)) continue;
    most = count;
    worst = k;
  }
  const double allowed = std::min(most_cells, std::floor(memory_limit() / bytes_per_cell));
  if (total <= allowed) return total;
  const double area_m2 = surface_area(room.surfaces[worst]);
  // Two digits, rounded up.
  const double exact = edge_m * std::sqrt(total / allowed);
  const double digit = std::pow(10.0, std::floor(std::log10(exact)) - 1.0);
  const double enough = std::ceil(exact / digit * 1.001) * digit;
  throw InputError("Tiles of " + rounded(edge_m, 6) + " m divide the room into " + short_number(total) + " cells, " +
                   short_number(most) + " of them on the surface " + in_quotes(room.surfaces[worst].name) + " of " +
                   short_number(area_m2) + " m^2, " + short_number(most * edge_m * edge_m / area_m2) +
                   " for each tile of that area (allowed: " + to_text(allowed) +
                   " cells, what memory holds). Give --tile " + rounded(enough, 2) +
                   " or more; if the area is wrong, give --scale the length of the file's unit in metres.");
}

// A tile of which some pieces are known.
struct Draft {
  Tile tile;
  double largest_piece_m2 = 0.0;
  bool at_centre = false;
};

// A tile map in which tile_of_cell has numbers of drafts, in order of appearance.
struct DraftedMap {
  TileMap map;
  std::vector<Draft> drafts;
};

// Fills one tile map.
class TileMapBuilder {
 public:
  TileMapBuilder(const Surface& surface, DraftedMap& drafted)
      : surface_(surface), tile_map_(drafted.map), drafts_(drafted.drafts) {}

  // Cuts a triangle into cells and adds its pieces to their tiles.
  void add(std::size_t triangle, double area_m2, const std::array<glm::dvec2, 3>& corners);

 private:
  Draft& draft_of(const CellPiece& piece);
  glm::dvec3 point_on(std::size_t triangle, const glm::dvec3& weights) const;

  const Surface& surface_;
  TileMap& tile_map_;
  std::vector<Draft>& drafts_;
  std::vector<CellPiece> pieces_;
};

Draft& TileMapBuilder::draft_of(const CellPiece& piece) {
  std::uint32_t& number = tile_map_.tile_of_cell[std::size_t{piece.row} * tile_map_.columns + piece.column];
  if (number == no_tile) {
    number = static_cast<std::uint32_t>(drafts_.size());
    drafts_.emplace_back();
    drafts_.back().tile.column = piece.column;
    drafts_.back().tile.row = piece.row;
  }
  return drafts_[number];
}

glm::dvec3 TileMapBuilder::point_on(std::size_t triangle, const glm::dvec3& weights) const {
  const glm::uvec3 corner = surface_.triangles[triangle];
  return weights.x * surface_.positions[corner.x] + weights.y * surface_.positions[corner.y] +
         weights.z * surface_.positions[corner.z];
}

// Barycentric coordinates of a point in the grid; not finite if the triangle has no area there.
glm::dvec3 weights_at(const glm::dvec2& place, const std::array<glm::dvec2, 3>& corners) {
  const glm::dvec2 b = corners[1] - corners[0];
  const glm::dvec2 c = corners[2] - corners[0];
  const glm::dvec2 p = place - corners[0];
  const double determinant = b.x * c.y - b.y * c.x;
  const double second = (p.x * c.y - p.y * c.x) / determinant;
  const double third = (b.x * p.y - b.y * p.x) / determinant;
  return {1.0 - second - third, second, third};
}

void TileMapBuilder::add(std::size_t triangle, double area_m2, const std::array<glm::dvec2, 3>& corners) {
  clip_to_cells(corners, tile_map_.columns, tile_map_.rows, pieces_);
  for (const CellPiece& piece : pieces_) {
    Draft& draft = draft_of(piece);
    const double piece_m2 = piece.share * area_m2;
    draft.tile.area_m2 += piece_m2;
    if (draft.at_centre) continue;
    const glm::dvec3 weights = weights_at({piece.column + 0.5, piece.row + 0.5}, corners);
    draft.at_centre = weights.x >= on_triangle && weights.y >= on_triangle && weights.z >= on_triangle;
    if (draft.at_centre) {
      draft.tile.point = point_on(triangle, weights);
      draft.tile.triangle = static_cast<std::uint32_t>(triangle);
    } else if (piece_m2 > draft.largest_piece_m2) {
      draft.largest_piece_m2 = piece_m2;
      draft.tile.point = point_on(triangle, piece.centroid);
      draft.tile.triangle = static_cast<std::uint32_t>(triangle);
    }
  }
}

// Renumbers the tiles row by row, and appends them.
void number_tiles(DraftedMap& drafted, std::uint32_t tile_map_index, std::vector<Tile>& tiles) {
  for (std::uint32_t& number : drafted.map.tile_of_cell) {
    if (number == no_tile) continue;
    const Draft& draft = drafted.drafts[number];
    if (!(draft.tile.area_m2 > 0.0)) {  // an area too small for a double
      number = no_tile;
      continue;
    }
    number = static_cast<std::uint32_t>(tiles.size());
    tiles.push_back(draft.tile);
    tiles.back().map = tile_map_index;
  }
}

TileMap front_tile_map(const Surface& surface, std::size_t index, const Chart& chart) {
  TileMap tile_map;
  tile_map.name = surface.name;
  tile_map.surface = index;
  tile_map.chart = chart.source;
  tile_map.chart_reason = chart.reason;
  tile_map.columns = static_cast<std::uint32_t>(chart.cells.x);
  tile_map.rows = static_cast<std::uint32_t>(chart.cells.y);
  tile_map.uv_min = chart.uv_min;
  tile_map.uv_max = chart.uv_max;
  tile_map.tile_of_cell.assign(std::size_t{tile_map.columns} * tile_map.rows, no_tile);
  return tile_map;
}

DraftedMap draft_tiles(const Surface& surface, std::size_t index, const Chart& chart) {
  DraftedMap drafted{front_tile_map(surface, index, chart), {}};
  TileMapBuilder tiler(surface, drafted);
  const std::vector<TriangleShape> shapes = triangle_shapes(surface);
  for (std::size_t n = 0; n < shapes.size(); ++n) {
    if (shapes[n].area_m2 > 0.0) tiler.add(n, shapes[n].area_m2, chart.corners[n]);
  }
  return drafted;
}

// Surfaces whose tiles are drafted at the same time: as many as have together no more cells than this, so
// that drafts need little memory beside the tiles. At least one surface.
std::size_t end_of_group(const std::vector<Chart>& charts, std::size_t first) {
  constexpr double most = 0x1p20;
  double sum = 0.0;
  std::size_t k = first;
  while (k < charts.size() && (k == first || sum <= most)) {
    sum += charts[k].cells.x * charts[k].cells.y;
    ++k;
  }
  return k;
}

// The charts of all surfaces. Those of many triangles are made first, so that no thread is left alone with one.
std::vector<Chart> make_charts(const Room& room, double edge_m, unsigned threads) {
  std::vector<std::size_t> order(room.surfaces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&room](std::size_t a, std::size_t b) {
    return room.surfaces[a].triangles.size() > room.surfaces[b].triangles.size();
  });
  std::vector<Chart> charts(order.size());
  for_each_on_threads(threads, order.size(), [&](std::size_t k) {
    const Surface& surface = room.surfaces[order[k]];
    charts[order[k]] = make_chart(surface, triangle_shapes(surface), surface.measured ? edge_m : one_tile);
  });
  return charts;
}

// The back has the front's grid and geometry; its tiles follow the front's in the same order.
void add_back(Tiling& tiling, std::size_t first_tile) {
  TileMap back = tiling.maps.back();
  back.name += ".back";
  back.side = Side::back;
  const std::size_t count = tiling.tiles.size() - first_tile;
  for (std::uint32_t& tile : back.tile_of_cell) {
    if (tile != no_tile) tile += static_cast<std::uint32_t>(count);
  }
  for (std::size_t n = 0; n < count; ++n) {
    tiling.tiles.push_back(tiling.tiles[first_tile + n]);
    tiling.tiles.back().map = static_cast<std::uint32_t>(tiling.maps.size());
  }
  tiling.maps.push_back(std::move(back));
}

}  // namespace

namespace {

double memory_for(const Room& room, double cells, unsigned threads) {
  // Measured as a whole: program, Embree and pictures; positions, facets, tree, charts and the search for faces in one
  // plane for each triangle.
  constexpr double bytes_of_program = 70e6;
  constexpr double bytes_per_triangle = 480.0;
  constexpr double of_a_thread = 0.25;  // of the memory for cells: a tally
  double triangles = 0.0;
  for (const Surface& surface : room.surfaces) triangles += static_cast<double>(surface.triangles.size());
  const double more_threads = threads > 2 ? threads - 2.0 : 0.0;
  return bytes_of_program + bytes_per_triangle * triangles +
         bytes_per_cell * cells * (1.0 + of_a_thread * more_threads);
}

}  // namespace

double memory_needed(const Room& room, const Tiling& tiling, unsigned threads) {
  double cells = 0.0;
  for (const TileMap& tile_map : tiling.maps) cells += static_cast<double>(tile_map.tile_of_cell.size());
  return memory_for(room, cells, threads);
}

MemoryForecast forecast_memory(const Room& room, double edge_m, unsigned threads) {
  constexpr double cells_over_area = 1.2;  // of charts, on average (docs/rooms.md)
  double cells = 0.0;
  for (const Surface& surface : room.surfaces) {
    const double sides = surface.sides == Sides::both ? 2.0 : 1.0;
    cells +=
        sides * (surface.measured ? std::max(1.0, cells_over_area * surface_area(surface) / (edge_m * edge_m)) : 1.0);
  }
  return {memory_for(room, cells, threads), memory_used() + memory_available()};
}

Tiling make_tiling(const Room& room, double edge_m, unsigned threads) {
  if (!(edge_m > 0.0) || !std::isfinite(edge_m)) {
    throw InputError("The tile edge is " + to_text(edge_m) +
                     " m (allowed: a finite number above 0). Give --tile a length in metres.");
  }
  if (threads == 0) threads = usable_processors();
  std::vector<Chart> charts = make_charts(room, edge_m, threads);
  const double cells = check_cells(room, charts, edge_m);

  Tiling tiling;
  // A cell is a tile at most. The pages that empty cells would fill are never touched.
  tiling.tiles.reserve(static_cast<std::size_t>(cells));
  for (std::size_t first = 0; first < charts.size();) {
    const std::size_t last = end_of_group(charts, first);
    std::vector<DraftedMap> drafted(last - first);
    for_each_on_threads(threads, drafted.size(), [&](std::size_t k) {
      drafted[k] = draft_tiles(room.surfaces[first + k], first + k, charts[first + k]);
    });
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t first_tile = tiling.tiles.size();
      DraftedMap& drafts = drafted[k - first];
      number_tiles(drafts, static_cast<std::uint32_t>(tiling.maps.size()), tiling.tiles);
      tiling.maps.push_back(std::move(drafts.map));
      drafts.drafts = {};
      if (room.surfaces[k].sides == Sides::both) add_back(tiling, first_tile);
      tiling.cells.push_back(std::move(charts[k].corners));
    }
    first = last;
  }
  return tiling;
}

}  // namespace lichtmc
