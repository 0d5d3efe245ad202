"""Surfaces of a result: a mapping, figures and grids."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
import rooms


def test_surfaces_are_a_mapping() -> None:
    surfaces = rooms.box_result().surfaces
    names = ["floor", "ceiling", "wall_x0", "wall_x1", "wall_z0", "wall_z1"]
    assert isinstance(surfaces, Mapping)
    assert len(surfaces) == 6 and list(surfaces) == surfaces.keys() == names
    assert [surface.name for surface in surfaces.values()] == names
    assert [(name, surface.name) for name, surface in surfaces.items()] == list(zip(names, names))
    assert surfaces[0].name == surfaces["floor"].name == surfaces[np.int64(-6)].name == "floor"
    assert "floor" in surfaces and "roof" not in surfaces and 3 not in surfaces
    assert surfaces.get("roof") is None and surfaces.get("roof", 5) == 5
    assert surfaces.get(0).name == surfaces.get(-6).name == "floor"
    assert surfaces.get(6) is None and surfaces.get(-7, 5) == 5 and surfaces.get(2**70) is None
    assert surfaces.get(1.5) is surfaces.get("\ud800") is None and "\ud800" not in surfaces
    assert {name: surface.rows for name, surface in surfaces.items()} == {n: dict(surfaces)[n].rows for n in names}


def test_what_is_no_surface_is_refused_with_advice() -> None:
    surfaces = rooms.box_result().surfaces
    with pytest.raises(KeyError, match="no surface 'wall_x2'.*'wall_x1'.*'floor'"):
        surfaces["wall_x2"]
    with pytest.raises(KeyError, match=r"no surface 'x\\+ud800'"):
        surfaces["x\ud800"]
    with pytest.raises(IndexError, match="no surface number 6: the result has 6 surfaces"):
        surfaces[6]
    for key in (None, 1.5, slice(0, 2), ("floor",)):
        with pytest.raises(TypeError, match=r"by name \(str\) or number \(int\)"):
            surfaces[key]
    with pytest.raises(KeyError, match="the result has no surfaces"):
        rooms.box_with_parts().surfaces["floor"]


def test_figures_of_a_surface() -> None:
    result = rooms.box_result()
    floor = result.surfaces["floor"]
    assert (floor.area, floor.tiles, floor.rows, floor.columns) == (pytest.approx(24), 2400, 60, 40) or (
        floor.area, floor.tiles, floor.rows, floor.columns) == (pytest.approx(24), 2400, 40, 60)  # fmt: skip
    assert floor.reflectance == 0.3 and floor.covered_area == 0 and floor.unreached_area == 0
    assert floor.power == pytest.approx(result.tiles.power[floor.tile_slice].sum())
    assert floor.absorbed == pytest.approx(0.7 * floor.power)
    assert floor.hits == result.tiles.hits[floor.tile_slice].sum()
    assert floor.minimum == floor.grid.min() and floor.maximum == floor.grid.max()
    assert float(floor.figure) == floor.mean and floor.figure.standard_error == floor.standard_error
    assert 0 < floor.standard_error < 0.02 * floor.mean
    assert floor.uv_min == (0, 0) and floor.uv_max == (1, 1)
    assert "floor" in repr(floor) and "lx" in repr(floor)


@pytest.mark.parametrize("name", ["grid", "grid_error", "grid_area", "grid_position"])
def test_a_full_grid_is_a_view_of_the_tiles(name: str) -> None:
    result = rooms.box_result()
    column = {"grid": "irradiance", "grid_error": "standard_error", "grid_area": "area", "grid_position": "position"}[name]
    tiles = getattr(result.tiles, column)
    for surface in result.surfaces.values():
        grid = getattr(surface, name)
        assert grid.shape[:2] == (surface.rows, surface.columns)
        assert np.shares_memory(grid, tiles) and not grid.flags.writeable
        rows, columns = result.tiles.row[surface.tile_slice], result.tiles.column[surface.tile_slice]
        np.testing.assert_array_equal(grid[rows, columns], tiles[surface.tile_slice])


def test_rows_follow_v_and_columns_u() -> None:
    floor = rooms.box_result().surfaces["floor"]  # u along x, v along z
    np.testing.assert_allclose(floor.grid_position[0, :, 0], (np.arange(60) + 0.5) * 0.1, atol=1e-9)
    np.testing.assert_allclose(floor.grid_position[:, 0, 2], (np.arange(40) + 0.5) * 0.1, atol=1e-9)
    assert floor.grid[20, 20] > 1.3 * floor.grid[0, 59]  # under a lamp, and in a corner


def test_cells_without_a_tile_are_nan() -> None:
    result = rooms.half_covered()
    gable = result.surfaces["gable"]
    assert 0 < gable.tiles < gable.rows * gable.columns
    for grid in (gable.grid, gable.grid_error, gable.grid_area, gable.grid_position[..., 0]):
        assert np.isfinite(grid).sum() == gable.tiles
        assert not np.shares_memory(grid, result.tiles.irradiance) and not grid.flags.writeable
    part = result.tiles.row[gable.tile_slice], result.tiles.column[gable.tile_slice]
    np.testing.assert_array_equal(gable.grid[part], result.tiles.irradiance[gable.tile_slice])
    np.testing.assert_array_equal(gable.grid_position[part], result.tiles.position[gable.tile_slice])
    assert np.nansum(gable.grid_area) == pytest.approx(2.0)
