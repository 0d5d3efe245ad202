// In rooms with many facets, each point reads the data of its facet from memory. If the data of all facets fit into a
// vector register, one instruction looks them up for all lanes; this is written with Highway.
#include "walk/cell_finder.hpp"

#include "base/parallel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "walk/cell_finder.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lichtmc::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<float>;
using Int = hn::Rebind<std::int32_t, Tag>;
using Unsigned = hn::Rebind<std::uint32_t, Tag>;

#if HWY_TARGET == HWY_SCALAR

// Machines without vector instructions read from memory.
std::size_t MostFew() {
  return 0;
}
void FindFew(const CellFinder::Few& /*few*/, std::size_t /*n*/, const std::uint32_t* /*facet*/, const float* /*s*/,
             const float* /*t*/, std::uint32_t* /*cell*/, std::uint32_t* /*surface*/) {}

#else

std::size_t MostFew() {
  return hn::Lanes(Tag());
}

// Index of the column or row; the same as index() below.
template <class V>
HWY_INLINE hn::Vec<Int> Index(V at, hn::Vec<Int> last) {
  const Tag d;
  const Int di;
  const auto low = hn::IfThenElseZero(hn::Gt(at, hn::Zero(d)), at);
  return hn::Min(hn::ConvertTo(di, hn::Min(low, hn::Set(d, 2147483520.0F))), last);
}

void FindFew(const CellFinder::Few& few, std::size_t n, const std::uint32_t* HWY_RESTRICT facet,
             const float* HWY_RESTRICT s, const float* HWY_RESTRICT t, std::uint32_t* HWY_RESTRICT cell,
             std::uint32_t* HWY_RESTRICT surface) {
  const Tag d;
  const Int di;
  const Unsigned du;
  const auto column_0 = hn::LoadU(d, few.column_0.data());
  const auto column_s = hn::LoadU(d, few.column_s.data());
  const auto column_t = hn::LoadU(d, few.column_t.data());
  const auto row_0 = hn::LoadU(d, few.row_0.data());
  const auto row_s = hn::LoadU(d, few.row_s.data());
  const auto row_t = hn::LoadU(d, few.row_t.data());
  const auto last_column = hn::LoadU(di, few.last_column.data());
  const auto last_row = hn::LoadU(di, few.last_row.data());
  const auto columns = hn::LoadU(di, few.columns.data());
  const auto first_cell = hn::LoadU(di, few.first_cell.data());
  const auto surfaces = hn::LoadU(du, few.surface.data());
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const auto at_s = hn::LoadU(d, s + i);
    const auto at_t = hn::LoadU(d, t + i);
    const auto on = hn::LoadU(du, facet + i);
    const auto of = [&](auto numbers) {
      return hn::TableLookupLanes(numbers, hn::IndicesFromVec(hn::DFromV<decltype(numbers)>(), on));
    };
    const auto along = [&](auto at_0, auto along_s, auto along_t) {
      return hn::Add(hn::Add(of(at_0), hn::Mul(at_s, of(along_s))), hn::Mul(at_t, of(along_t)));
    };
    const auto column = Index(along(column_0, column_s, column_t), of(last_column));
    const auto row = Index(along(row_0, row_s, row_t), of(last_row));
    const auto number = hn::Add(hn::Add(of(first_cell), hn::Mul(row, of(columns))), column);
    hn::StoreU(hn::BitCast(du, number), du, cell + i);
    hn::StoreU(of(surfaces), du, surface + i);
  }
}

#endif

}  // namespace lichtmc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lichtmc {

HWY_EXPORT(MostFew);
HWY_EXPORT(FindFew);

namespace {

LICHTMC_LANES void find_many(std::size_t n, const CellFinder::Row* LICHTMC_APART rows,
                             const CellFinder::Grid* LICHTMC_APART grids, const std::uint32_t* LICHTMC_APART facet,
                             const float* LICHTMC_APART s, const float* LICHTMC_APART t,
                             std::uint32_t* LICHTMC_APART cell, std::uint32_t* LICHTMC_APART surface) {
  // Positions outside the grid, and NaN, count as in its outermost cells.
  constexpr float most = 2147483520.0F;  // the largest float below 2³¹
  const auto index = [](float at, std::int32_t last) {
    const float low = at > 0.0F ? at : 0.0F;
    const auto whole = static_cast<std::int32_t>(low < most ? low : most);
    return whole < last ? whole : last;
  };
  for (std::size_t i = 0; i < n; ++i) __builtin_prefetch(&rows[facet[i]]);
  for (std::size_t i = 0; i < n; ++i) {
    const CellFinder::Row& at = rows[facet[i]];
    const CellFinder::Grid& grid = grids[at.surface];
    const std::int32_t column = index(at.column_0 + s[i] * at.column_s + t[i] * at.column_t, grid.last_column);
    const std::int32_t row = index(at.row_0 + s[i] * at.row_s + t[i] * at.row_t, grid.last_row);
    cell[i] = static_cast<std::uint32_t>(grid.first_cell + row * grid.columns + column);
    surface[i] = at.surface;
  }
}

}  // namespace

CellFinder::CellFinder(const std::vector<Facet>& facets, const std::vector<SurfaceGrid>& grids, unsigned threads)
    : rows_(facets.size()) {
  for (const SurfaceGrid& grid : grids) {
    grids_.push_back({static_cast<std::int32_t>(grid.columns - 1), static_cast<std::int32_t>(grid.rows - 1),
                      static_cast<std::int32_t>(grid.columns), static_cast<std::int32_t>(grid.first_cell)});
  }
  constexpr std::size_t at_a_time = 65536;
  for_each_range(threads, facets.size(), at_a_time, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const Facet& facet = facets[k];
      rows_[k] = {static_cast<float>(facet.cell_0.x),
                  static_cast<float>(facet.cell_s.x),
                  static_cast<float>(facet.cell_t.x),
                  static_cast<float>(facet.cell_0.y),
                  static_cast<float>(facet.cell_s.y),
                  static_cast<float>(facet.cell_t.y),
                  facet.surface};
    }
  });
  for (std::size_t k = 0; k < rows_.size() && k < most_lanes; ++k) {
    const Row& row = rows_[k];
    const Grid& grid = grids_[row.surface];
    few_.column_0[k] = row.column_0;
    few_.column_s[k] = row.column_s;
    few_.column_t[k] = row.column_t;
    few_.row_0[k] = row.row_0;
    few_.row_s[k] = row.row_s;
    few_.row_t[k] = row.row_t;
    few_.last_column[k] = grid.last_column;
    few_.last_row[k] = grid.last_row;
    few_.columns[k] = grid.columns;
    few_.first_cell[k] = grid.first_cell;
    few_.surface[k] = row.surface;
  }
}

void CellFinder::find(std::size_t n, const std::uint32_t* facet, const float* s, const float* t, std::uint32_t* cell,
                      std::uint32_t* surface) const {
  if (rows_.size() <= HWY_DYNAMIC_DISPATCH(MostFew)()) {
    HWY_DYNAMIC_DISPATCH(FindFew)(few_, n, facet, s, t, cell, surface);
  } else {
    find_many(n, rows_.data(), grids_.data(), facet, s, t, cell, surface);
  }
}

}  // namespace lichtmc
#endif
