// The surfaces of a result: figures, and grids of their tiles.
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <span>
#include <string>
#include <utility>

#include "bindings.hpp"
#include "figures.hpp"
#include "grids.hpp"
#include "named_elements.hpp"
#include "result_parts.hpp"

namespace lichtmc::python {

namespace {

std::pair<std::size_t, std::size_t> tiles_of(const OneSurface& surface) {
  const std::size_t first = first_tile(surface.grid());
  if (first == no_tile) return {0, 0};
  return {first, first + surface.figures().tiles};
}

template <class Row, class Member>
View<double> grid(const OneSurface& surface, const std::vector<Row>& rows, Member Row::*member) {
  const auto [first, last] = tiles_of(surface);
  const TileMap& map = surface.grid();
  const Tile* tiles = surface.run->result.tiling.tiles.data() + first;
  return grid_of(surface.run, std::span<const Row>(rows).subspan(first, last - first), member, {map.rows, map.columns},
                 [&map, tiles](std::size_t k) { return std::size_t{tiles[k].row} * map.columns + tiles[k].column; });
}

template <class Member>
auto grid_of_results(Member TileResult::*member) {
  return [member](const OneSurface& surface) { return grid(surface, surface.run->result.tiles, member); };
}

template <class Member>
auto grid_of_tiles(Member Tile::*member) {
  return [member](const OneSurface& surface) { return grid(surface, surface.run->result.tiling.tiles, member); };
}

template <class Member>
auto figure(Member SurfaceResult::*member) {
  return [member](const OneSurface& surface) { return surface.figures().*member; };
}

std::string repr_of(const OneSurface& surface) {
  const SurfaceResult& figures = surface.figures();
  const TileMap& map = surface.grid();
  return "SurfaceResult('" + figures.name + "', mean " + text_of({figures.mean_irradiance, figures.standard_error}) +
         " " + written_irradiance_unit(surface.run->result.quantity) + ", " + std::to_string(map.rows) + " × " +
         std::to_string(map.columns) + " cells)";
}

void bind_grids(nb::class_<OneSurface>& of) {
  of.def_prop_ro("grid", grid_of_results(&TileResult::irradiance), has_owner,
                 "Irradiance (W/m²) or illuminance (lx) of the tiles, float64 (rows, columns). Row 0 lies at the "
                 "smallest v, column 0 at the smallest u; NaN in cells without a tile. A view of the tiles without a "
                 "copy if every cell has a tile.")
      .def_prop_ro("grid_error", grid_of_results(&TileResult::standard_error), has_owner,
                   "Standard errors of grid, same unit and shape.")
      .def_prop_ro("grid_direct", grid_of_results(&TileResult::direct), has_owner,
                   "Direct part of grid, same unit and shape; NaN if it is not known apart, see Tiles.direct.")
      .def_prop_ro("grid_area", grid_of_tiles(&Tile::area_m2), has_owner, "Areas of the tiles, m², same shape as grid.")
      .def_prop_ro("grid_position", grid_of_tiles(&Tile::point), has_owner,
                   "Points of the tiles, m, float64 (rows, columns, 3), see Tiles.position.");
}

void bind_figures_of(nb::class_<OneSurface>& of) {
  of.def_prop_ro("name", figure(&SurfaceResult::name),
                 "Name of the surface; that of the back of a two-sided one ends with '.back'.")
      .def_prop_ro("material", figure(&SurfaceResult::material), "Name of its material; may be empty.")
      .def_prop_ro("reflectance", figure(&SurfaceResult::reflectance), "Reflectance, 0 … 1; if it varies, its mean.")
      .def_prop_ro("area", figure(&SurfaceResult::area_m2), "Area, m².")
      .def_prop_ro("mean", figure(&SurfaceResult::mean_irradiance),
                   "Mean irradiance (W/m²) or illuminance (lx) of the part that light can reach.")
      .def_prop_ro("standard_error", figure(&SurfaceResult::standard_error), "Standard error of the mean, same unit.")
      .def_prop_ro(
          "figure",
          [](const OneSurface& surface) {
            return Figure{surface.figures().mean_irradiance, surface.figures().standard_error};
          },
          "The mean with its standard error.")
      .def_prop_ro("minimum", figure(&SurfaceResult::min_irradiance),
                   "Lowest irradiance of a tile that light can reach, W/m² or lx, with its statistical error.")
      .def_prop_ro("maximum", figure(&SurfaceResult::max_irradiance),
                   "Highest irradiance of a tile, W/m² or lx, with its statistical error.")
      .def_prop_ro("direct", figure(&SurfaceResult::mean_direct),
                   "Direct part of the mean, same unit; NaN if it is not known apart, see Tiles.direct.")
      .def_prop_ro("power", figure(&SurfaceResult::power), "Incident power, W or lm.")
      .def_prop_ro("absorbed", figure(&SurfaceResult::absorbed), "Absorbed power, W or lm. NaN: unknown.")
      .def_prop_ro("hits", figure(&SurfaceResult::hits), "Impacts that scored.")
      .def_prop_ro("behind_share", figure(&SurfaceResult::behind_share),
                   "Share of the power that came from behind, 0 … 1 (0 or 1 if each side has a tile map).")
      .def_prop_ro("unreached_area", figure(&SurfaceResult::unreached_area_m2),
                   "Area that no light can reach, by the shape of the room, m².")
      .def_prop_ro("covered_area", figure(&SurfaceResult::covered_m2),
                   "Area that other surfaces in the same plane cover, m².")
      .def_prop_ro("tiles", figure(&SurfaceResult::tiles), "Number of tiles.")
      .def_prop_ro(
          "tile_slice",
          [](const OneSurface& surface) {
            const auto [first, last] = tiles_of(surface);
            return nb::slice(first, last);
          },
          "Where its tiles are in the arrays of Result.tiles.")
      .def_prop_ro(
          "columns", [](const OneSurface& surface) { return surface.grid().columns; }, "Columns of the grid.")
      .def_prop_ro(
          "rows", [](const OneSurface& surface) { return surface.grid().rows; }, "Rows of the grid.")
      .def_prop_ro(
          "uv_min",
          [](const OneSurface& surface) {
            return std::pair<double, double>(surface.grid().uv_min.x, surface.grid().uv_min.y);
          },
          "Texture coordinates (u, v) of the grid's first corner; (0, 0) of a chart made by lichtmc.")
      .def_prop_ro(
          "uv_max",
          [](const OneSurface& surface) {
            return std::pair<double, double>(surface.grid().uv_max.x, surface.grid().uv_max.y);
          },
          "Texture coordinates (u, v) of the opposite corner; (1, 1) of a chart made by lichtmc.")
      .def("__repr__", &repr_of);
}

NamedElements elements(const Surfaces& surfaces) {
  const RunResultPtr run = surfaces.run;
  return {"surface", "surfaces", run->result.surfaces.size(),
          [run](std::size_t k) -> const std::string& { return run->result.surfaces[k].name; }};
}

}  // namespace

void bind_surfaces(nb::module_& module) {
  nb::class_<OneSurface> one(module, "SurfaceResult",
                             "A surface of a result, or the back of a two-sided one: figures, and its tiles as grids.");
  bind_figures_of(one);
  bind_grids(one);
  nb::class_<Surfaces> all(module, "Surfaces",
                           "The surfaces of a result by name, as a dict; also by number. The back of a two-sided "
                           "surface follows its front.");
  bind_mapping(all, "SurfaceResult", elements, [](const Surfaces& surfaces, std::size_t k) {
    return OneSurface{surfaces.run, k};
  });
  all.def("__repr__", [](const Surfaces& surfaces) {
    return "Surfaces(" + std::string(nb::repr(elements(surfaces).names()).c_str()) + ")";
  });
}

}  // namespace lichtmc::python
