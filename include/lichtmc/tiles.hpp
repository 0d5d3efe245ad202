// Tiles: the parts of surfaces on which irradiance is computed.
//
// Each side of a surface has a tile map: a grid of cells over the surface's UV chart (both sides share one if the
// surface has Sides::one). A cell that contains a part of the surface is a tile; its area is the area of that part in
// 3-D. One index numbers all tiles of a room.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// In TileMap::tile_of_cell: no part of the surface lies in this cell.
inline constexpr std::uint32_t no_tile = std::numeric_limits<std::uint32_t>::max();

enum class Side { front, back };

enum class ChartSource {
  file,    // the surface's own UVs
  engine,  // made by lichtmc, because the UVs are absent, degenerate, overlapping, wrapping or uneven
};

// The grid of cells of one side of one surface. Row 0 lies at the smallest v, column 0 at the smallest u.
struct TileMap {
  std::string name;         // the surface's name; for a back side with ".back" appended
  std::size_t surface = 0;  // index into Room::surfaces
  Side side = Side::front;  // back only if the surface has Sides::both
  ChartSource chart = ChartSource::file;
  std::string chart_reason;  // why the engine made the chart; empty for ChartSource::file
  std::uint32_t columns = 1;
  std::uint32_t rows = 1;
  glm::dvec2 uv_min{0.0};  // extent of the grid: the bounds of the surface's UVs, or 0 … 1 for an engine chart
  glm::dvec2 uv_max{1.0};
  std::vector<std::uint32_t> tile_of_cell;  // columns × rows, row by row: global tile index or no_tile
};

struct Tile {
  std::uint32_t map = 0;  // index into Tiling::maps
  std::uint32_t column = 0;
  std::uint32_t row = 0;
  std::uint32_t triangle = 0;  // of the surface, on which `point` lies
  glm::dvec3 point{0.0};       // m, a point of the surface in this tile: the cell's centre if the surface covers it
  double area_m2 = 0.0;        // of the surface in this cell, > 0
};

struct Tiling {
  std::vector<TileMap> maps;  // tile maps in the order of the surfaces, a back side directly after its front
  std::vector<Tile> tiles;    // tile map by tile map, row by row, column by column
  // Position of each triangle in its surface's grid, in cells: [surface][triangle][corner], x along the columns, y
  // along the rows.
  std::vector<std::vector<std::array<glm::dvec2, 3>>> cells;
};

// Divides every surface of a room into tiles with edges as close to `edge_m` metres (> 0) as the charts allow: a chart
// with a length of L metres in one direction has max(1, round(L / edge_m)) cells in that direction.
//
// The areas of a surface's tiles add up to the area of the surface. Throws InputError if edge_m is not a finite number
// above 0, or if the room would have more than 2^31 cells or more than fit into the machine's memory. The work is done
// on up to `threads` threads (0: one per processor); the tiles are the same for any number of them.
Tiling make_tiling(const Room& room, double edge_m, unsigned threads = 0);

// The most memory, in bytes, that a run of a room needs at any time, with its report. Measured in rooms of 0.6 to 2.3
// million triangles and of 1 to 20 million tiles it is right within 25 %; rooms of less than 100 000 triangles and
// tiles need 50 to 150 MB. threads (≥ 1): of the run.
double memory_needed(const Room& room, const Tiling& tiling, unsigned threads = 2);

struct MemoryForecast {
  double needed =
      0.0;  // bytes, as memory_needed(), with the number of tiles that follows from the area of the surfaces
  double available = 0.0;  // bytes that this process has or can get now; infinity if that is not known
};

// Before anything is prepared: whether a run of a room with tiles of this edge (m, > 0) fits into the free memory.
MemoryForecast forecast_memory(const Room& room, double edge_m, unsigned threads = 2);

}  // namespace lichtmc
