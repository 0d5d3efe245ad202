// Tiles: the pieces of surface that irradiance is measured on.
//
// Each side of a surface that is measured has a tile map: a grid of cells over the surface's UV chart. A cell that
// holds some of the surface is a tile; its area is that of the surface inside the cell, measured in 3-D. All tiles of a
// room are numbered through by one index.
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

// In TileMap::tile_of_cell: the surface does not reach into this cell.
inline constexpr std::uint32_t no_tile = std::numeric_limits<std::uint32_t>::max();

enum class Side { front, back };

enum class ChartSource {
  file,    // the surface's own UVs
  engine,  // made here, because the UVs are absent, degenerate, overlapping or wrapping
};

// The grid of cells of one side of one surface. Row 0 lies at the smallest v, column 0 at the smallest u.
struct TileMap {
  std::string name;         // the surface's name; of a back side with ".back" behind it
  std::size_t surface = 0;  // index into Room::surfaces
  Side side = Side::front;  // back only where the surface has Sides::both
  ChartSource chart = ChartSource::file;
  std::string chart_reason;  // why the engine made the chart; empty for ChartSource::file
  std::uint32_t columns = 1;
  std::uint32_t rows = 1;
  glm::dvec2 uv_min{0.0};  // what the grid spans: the bounds of the surface's UVs, or 0 … 1 for an engine chart
  glm::dvec2 uv_max{1.0};
  std::vector<std::uint32_t> tile_of_cell;  // columns × rows, row by row: global tile index or no_tile
};

struct Tile {
  std::uint32_t map = 0;  // index into Tiling::maps
  std::uint32_t column = 0;
  std::uint32_t row = 0;
  glm::dvec3 point{0.0};  // m, a point of the surface in this tile: at the cell's centre where the surface is there
  double area_m2 = 0.0;   // of the surface in this cell, > 0
};

struct Tiling {
  std::vector<TileMap> maps;  // in the order of the surfaces, a back side right after its front
  std::vector<Tile> tiles;    // map by map, row by row, column by column
  // Where each triangle lies in its surface's grid, in cells: [surface][triangle][corner], x along the columns, y along
  // the rows.
  std::vector<std::vector<std::array<glm::dvec2, 3>>> cells;
};

// Divides every surface of a room into tiles with edges as close to `edge_m` metres (> 0) as the charts allow: a chart
// that is L metres long gets max(1, round(L / edge_m)) cells that way.
//
// The areas of a surface's tiles add up to the area of the surface. Throws InputError where edge_m is not a finite
// number above 0 or the room would get more than 2^31 cells or than the machine's memory holds.
Tiling make_tiling(const Room& room, double edge_m);

// About how many bytes of memory a run with one thread takes for the tiles of a room.
double memory_needed(const Tiling& tiling);

}  // namespace lichtmc
