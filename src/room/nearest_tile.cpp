#include "room/nearest_tile.hpp"

#include <cstddef>

namespace lichtmc {

namespace {

struct Grid {
  std::size_t columns;
  std::size_t rows;

  // Calls use(neighbour) for the up to four cells beside a cell.
  template <class Use>
  void for_each_neighbour(std::size_t cell, const Use& use) const {
    const std::size_t column = cell % columns;
    if (cell >= columns) use(cell - columns);
    if (column > 0) use(cell - 1);
    if (column + 1 < columns) use(cell + 1);
    if (cell + columns < columns * rows) use(cell + columns);
  }
};

}  // namespace

// Breadth first from all tiles at once, row by row; each pass fills the cells one step further out.
std::vector<std::uint32_t> nearest_tiles(const TileMap& tile_map) {
  const Grid grid{tile_map.columns, tile_map.rows};
  std::vector<std::uint32_t> filled = tile_map.tile_of_cell;
  std::vector<std::uint32_t> front;
  for (std::size_t cell = 0; cell < filled.size(); ++cell) {
    if (filled[cell] == no_tile) continue;
    bool at_boundary = false;
    grid.for_each_neighbour(cell, [&](std::size_t beside) { at_boundary = at_boundary || filled[beside] == no_tile; });
    if (at_boundary) front.push_back(static_cast<std::uint32_t>(cell));
  }
  std::vector<std::uint32_t> next;
  while (!front.empty()) {
    next.clear();
    for (const std::uint32_t cell : front) {
      grid.for_each_neighbour(cell, [&](std::size_t beside) {
        if (filled[beside] != no_tile) return;
        filled[beside] = filled[cell];
        next.push_back(static_cast<std::uint32_t>(beside));
      });
    }
    front.swap(next);
  }
  return filled;
}

}  // namespace lichtmc
