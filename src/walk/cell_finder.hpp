// The cell of its surface's grid that a point of a facet lies in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/lanes.hpp"
#include "tracer/facet.hpp"

namespace lichtmc {

// A surface's grid.
struct SurfaceGrid {
  std::uint32_t columns = 1;
  std::uint32_t rows = 1;
  std::uint32_t first_cell = 0;  // number of the grid's first cell; cells are numbered row by row, below 2³¹
};

class CellFinder {
 public:
  // On up to `threads` (≥ 1) threads.
  CellFinder(const std::vector<Facet>& facets, const std::vector<SurfaceGrid>& grids, unsigned threads = 1);

  // The cells that n points lie in, and their surfaces. A point that rounding moves outside the grid belongs to its
  // outermost cells. All arrays have whole_lanes(n) elements; all elements of `facet` are valid.
  void find(std::size_t n, const std::uint32_t* facet, const float* s, const float* t, std::uint32_t* cell,
            std::uint32_t* surface) const;

  // A facet's position in the grid of its surface: cell = cell_0 + s·cell_s + t·cell_t. Half a cache line.
  struct alignas(32) Row {
    float column_0 = 0.0F;
    float column_s = 0.0F;
    float column_t = 0.0F;
    float row_0 = 0.0F;
    float row_s = 0.0F;
    float row_t = 0.0F;
    std::uint32_t surface = 0;
  };
  struct Grid {
    std::int32_t last_column = 0;
    std::int32_t last_row = 0;
    std::int32_t columns = 1;
    std::int32_t first_cell = 0;
  };
  // The same for rooms with few facets, such as a cuboid: at most as many as fit into a vector register.
  struct Few {
    std::array<float, most_lanes> column_0{}, column_s{}, column_t{}, row_0{}, row_s{}, row_t{};
    std::array<std::int32_t, most_lanes> last_column{}, last_row{}, columns{}, first_cell{};
    std::array<std::uint32_t, most_lanes> surface{};
  };

 private:
  std::vector<Row> rows_;
  std::vector<Grid> grids_;
  Few few_;
};

}  // namespace lichtmc
