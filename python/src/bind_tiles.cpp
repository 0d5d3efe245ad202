// The tiles of a result, as arrays that show the memory of the result.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "run_result.hpp"
#include "views.hpp"

namespace lichtmc::python {

namespace {

template <class Member>
auto of_result(const Tiles& tiles, Member TileResult::*member) {
  return column(tiles.run, tiles.run->result.tiles, member);
}

// A run that measured receivers only has a tiling, but no tiles with results.
template <class Member>
auto of_tiling(const Tiles& tiles, Member Tile::*member) {
  static const std::vector<Tile> none;
  const Result& result = tiles.run->result;
  return column(tiles.run, result.tiles.empty() ? none : result.tiling.tiles, member);
}

// The library has bits, or nothing if light reaches all tiles: then one value serves all.
View<bool> unreached(const Tiles& tiles) {
  static constexpr bool reached = false;
  const Result& result = tiles.run->result;
  const std::array<std::size_t, 1> shape{result.tiles.size()};
  if (result.unreached.empty()) return strided(tiles.run, &reached, shape, std::array<std::int64_t, 1>{0});
  auto values = std::make_shared<std::unique_ptr<bool[]>>(std::make_unique<bool[]>(shape[0]));
  std::copy(result.unreached.begin(), result.unreached.end(), values->get());
  return View<bool>(values->get(), 1, shape.data(), keep(values));
}

}  // namespace

void bind_tiles(nb::module_& module) {
  nb::class_<Tiles>(module, "Tiles",
                    "The tiles of all surfaces, one value each: arrays of shape (n,) that show the memory of the "
                    "result without copies, read-only. Irradiances in W/m² or lx, see Result.irradiance_unit; a run "
                    "that measured receivers only has no tiles.")
      .def("__len__", [](const Tiles& tiles) { return tiles.run->result.tiles.size(); })
      .def("__repr__",
           [](const Tiles& tiles) { return "Tiles(" + std::to_string(tiles.run->result.tiles.size()) + ")"; })
      .def_prop_ro(
          "irradiance", [](const Tiles& tiles) { return of_result(tiles, &TileResult::irradiance); }, has_owner,
          "Irradiance (W/m²) or illuminance (lx), float64 (n,). 0 for a tile without hits.")
      .def_prop_ro(
          "standard_error", [](const Tiles& tiles) { return of_result(tiles, &TileResult::standard_error); }, has_owner,
          "Standard error of the irradiance, same unit, float64 (n,). NaN: unknown, with fewer than two batches of "
          "1024 histories.")
      .def_prop_ro(
          "direct", [](const Tiles& tiles) { return of_result(tiles, &TileResult::direct); }, has_owner,
          "Part of the irradiance that comes from the emitters without reflection, same unit, float64 (n,). NaN: not "
          "known apart, unless the run had direct='analytic'.")
      .def_prop_ro(
          "power", [](const Tiles& tiles) { return of_result(tiles, &TileResult::power); }, has_owner,
          "Incident power, W or lm, float64 (n,): irradiance times area.")
      .def_prop_ro(
          "hits", [](const Tiles& tiles) { return of_result(tiles, &TileResult::hits); }, has_owner,
          "Impacts that scored in the tile, uint64 (n,); with tile_walk='backward': walks that started there.")
      .def_prop_ro(
          "area", [](const Tiles& tiles) { return of_tiling(tiles, &Tile::area_m2); }, has_owner,
          "Area of the surface in the tile, m², float64 (n,).")
      .def_prop_ro(
          "position", [](const Tiles& tiles) { return of_tiling(tiles, &Tile::point); }, has_owner,
          "A point of the surface in the tile, m, float64 (n, 3): its centre where the surface covers that.")
      .def_prop_ro(
          "map", [](const Tiles& tiles) { return of_tiling(tiles, &Tile::map); }, has_owner,
          "Number of the element of Result.surfaces to which the tile belongs, uint32 (n,), ascending.")
      .def_prop_ro(
          "column", [](const Tiles& tiles) { return of_tiling(tiles, &Tile::column); }, has_owner,
          "Column of the tile in the grid of its surface, uint32 (n,). Column 0 lies at the smallest u.")
      .def_prop_ro(
          "row", [](const Tiles& tiles) { return of_tiling(tiles, &Tile::row); }, has_owner,
          "Row of the tile in the grid of its surface, uint32 (n,). Row 0 lies at the smallest v.")
      .def_prop_ro(
          "unreached", &unreached, has_owner,
          "Whether no light can reach the tile's point, by the shape of the room, bool (n,). Errors and lowest "
          "irradiances are of the other tiles. A copy, if there are any.");
}

}  // namespace lichtmc::python
