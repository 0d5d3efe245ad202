// The tiles of a result, as arrays that show the memory of the result.
#include <nanobind/stl/shared_ptr.h>

#include "bindings.hpp"
#include "run_result.hpp"
#include "views.hpp"

namespace lichtmc::python {

namespace {

template <class Member>
auto of_result(const Tiles& tiles, Member TileResult::*member) {
  return column(tiles.run, tiles.run->result.tiles, member);
}

template <class Member>
auto of_tiling(const Tiles& tiles, Member Tile::*member) {
  return column(tiles.run, tiles.run->result.tiling.tiles, member);
}

}  // namespace

void bind_tiles(nb::module_& module) {
  nb::class_<Tiles>(
      module, "Tiles",
      "The tiles of all surfaces, one value each: arrays of shape (n,) that show the memory of the result "
      "without copies, read-only. Irradiances in W/m² or lx, see Result.irradiance_unit.")
      .def("__len__", [](const Tiles& tiles) { return tiles.run->result.tiles.size(); })
      .def_prop_ro(
          "irradiance", [](const Tiles& tiles) { return of_result(tiles, &TileResult::irradiance); }, has_owner,
          "Irradiance (W/m²) or illuminance (lx), float64 (n,). 0 for a tile without hits.")
      .def_prop_ro(
          "standard_error", [](const Tiles& tiles) { return of_result(tiles, &TileResult::standard_error); }, has_owner,
          "Standard error of the irradiance, same unit, float64 (n,). NaN: unknown, with fewer than two batches of "
          "1024 "
          "histories.")
      .def_prop_ro(
          "area", [](const Tiles& tiles) { return of_tiling(tiles, &Tile::area_m2); }, has_owner,
          "Area of the surface in the tile, m², float64 (n,).")
      .def_prop_ro(
          "position", [](const Tiles& tiles) { return of_tiling(tiles, &Tile::point); }, has_owner,
          "A point of the surface in the tile, m, float64 (n, 3): its centre where the surface covers that.");
}

}  // namespace lichtmc::python
