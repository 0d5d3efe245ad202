"""The arrays of tiles: shapes, types, no copies, lifetime; the digits of the program."""

from __future__ import annotations

import ctypes
import gc
import resource
from pathlib import Path

import lichtmc
import numpy as np
import pytest
import rooms

COLUMNS = {
    "irradiance": (np.float64, 1),
    "standard_error": (np.float64, 1),
    "direct": (np.float64, 1),
    "power": (np.float64, 1),
    "hits": (np.uint64, 1),
    "area": (np.float64, 1),
    "position": (np.float64, 2),
    "map": (np.uint32, 1),
    "column": (np.uint32, 1),
    "row": (np.uint32, 1),
    "unreached": (np.bool_, 1),
}


@pytest.mark.parametrize("name", COLUMNS)
def test_columns_have_their_type_and_shape(name: str) -> None:
    tiles = rooms.box_result().tiles
    dtype, dimensions = COLUMNS[name]
    values = getattr(tiles, name)
    assert values.dtype == dtype
    assert values.shape == (len(tiles),) if dimensions == 1 else (len(tiles), 3)
    assert len(tiles) == 2 * (60 * 40 + 60 * 30 + 40 * 30)


@pytest.mark.parametrize("name", [name for name in COLUMNS if name != "unreached"])
def test_columns_show_the_memory_of_the_result(name: str) -> None:
    result = rooms.box_result()
    assert np.shares_memory(getattr(result.tiles, name), getattr(result.tiles, name))
    assert np.may_share_memory(result.tiles.irradiance, result.tiles.standard_error)  # fields of the same structures
    assert not getattr(result.tiles, name).flags.owndata


@pytest.mark.parametrize("name", COLUMNS)
def test_columns_are_read_only(name: str) -> None:
    values = getattr(rooms.box_result().tiles, name)
    with pytest.raises(ValueError, match="read-only"):
        values[0] = 0
    with pytest.raises(ValueError):
        values.flags.writeable = True


def resident_bytes() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="only Linux says how much memory is resident")
def test_arrays_take_no_memory() -> None:
    room = lichtmc.Room.cuboid((6, 3, 6))
    room.add_emitter(lichtmc.Isotropic((3, 1.5, 3)), 1000)
    result = lichtmc.simulate(room, photons=20_000, tile=0.015)
    assert len(result.tiles) == 2 * 400 * 400 + 4 * 400 * 200
    gc.collect()
    before = resident_bytes()
    arrays = [getattr(result.tiles, name) for name in COLUMNS]
    for surface in result.surfaces.values():
        arrays += [surface.grid, surface.grid_error, surface.grid_direct, surface.grid_area, surface.grid_position]
    size = sum(array.nbytes for array in arrays)
    assert size > 50e6
    assert resident_bytes() - before < 0.02 * size


def test_views_outlive_their_result() -> None:
    result = lichtmc.simulate(rooms.box_room(), photons=2048)
    kept = {name: getattr(result.tiles, name) for name in COLUMNS}
    grid = result.surfaces["floor"].grid
    area_grid = result.areas["desk"].grid
    receivers = result.receivers.irradiance
    copies = [values.copy() for values in (*kept.values(), grid, area_grid, receivers)]
    del result
    gc.collect()
    rubbish = [np.full(100_000, 7.0) for _ in range(50)]  # would take the place of freed memory
    for values, copy in zip((*kept.values(), grid, area_grid, receivers), copies):
        np.testing.assert_array_equal(values, copy)
    del rubbish


def test_parts_of_a_result_outlive_it() -> None:
    result = lichtmc.simulate(rooms.box_room(), photons=2048)
    floor, desk, phone = result.surfaces["floor"], result.areas["desk"], result.receivers["phone"]
    walk, balance = result.walk, result.balance
    mean = floor.mean
    del result
    gc.collect()
    assert floor.mean == mean == pytest.approx(np.average(floor.grid, weights=floor.grid_area))
    assert desk.grid.shape == (desk.rows, desk.columns)
    assert phone.irradiance > 0
    assert walk is not None and walk.histories == 2048
    assert balance.emitted == 5000


def test_power_is_irradiance_times_area() -> None:
    tiles = rooms.box_result().tiles
    np.testing.assert_allclose(tiles.power, tiles.irradiance * tiles.area, rtol=1e-12)
    assert np.isnan(tiles.direct).all()  # scored together with reflected light
    assert not tiles.unreached.any()


def test_direct_light_apart() -> None:
    result = lichtmc.simulate(rooms.box_room(), photons=2048, direct="analytic", only="tiles")
    assert np.all(result.tiles.direct >= 0) and np.all(result.tiles.direct <= result.tiles.irradiance)
    floor = result.surfaces["floor"]
    assert floor.direct == pytest.approx(np.average(floor.grid_direct, weights=floor.grid_area), rel=1e-9)


def test_unreached_tiles_are_named() -> None:
    room = lichtmc.Room.from_gltf(rooms.DATA / "office.glb")
    result = lichtmc.simulate(room, photons=20_000, only="tiles")
    unreached = result.tiles.unreached
    assert unreached.any() and not unreached.all()
    assert result.tiles.irradiance[unreached].mean() < 0.01 * result.tiles.irradiance.mean()  # parts of some are lit
    assert sum(surface.unreached_area for surface in result.surfaces.values()) > 0
    assert "cannot be reached by light" in result.unreached_text()


def test_a_run_for_receivers_has_no_tiles() -> None:
    result = rooms.box_with_parts()
    assert len(result.tiles) == 0
    assert {getattr(result.tiles, name).shape[0] for name in COLUMNS} == {0}
    assert result.tiles.position.shape == (0, 3)
    assert len(result.surfaces) == 0
    assert result.walk is None


def test_digits_of_the_program(tmp_path: Path) -> None:
    file = rooms.SCENES / "l_room.gltf"
    rooms.command_line(
        "run", file, "-o", tmp_path / "out", "--photons", 30_000, "--estimator", "collision", "--seed", 7, "--no-report",
        "--no-images", "--plane", "0.75", "--direct", "analytic", "--tile", 0.25, "--quiet",
    )  # fmt: skip
    room = lichtmc.Room.from_gltf(file)
    room.add_working_plane(0.75)
    result = lichtmc.simulate(room, photons=30_000, seed=7, direct="analytic", tile=0.25)

    written = rooms.table(tmp_path / "out/tiles.csv")
    tiles = result.tiles
    numbers = {name: np.array(written[name], dtype=float) for name in ("x", "y", "z", "area", "power", "irradiance",
                                                                     "standard_error", "direct")}  # fmt: skip
    np.testing.assert_array_equal(tiles.position, np.column_stack([numbers["x"], numbers["y"], numbers["z"]]))
    for name in ("area", "power", "irradiance", "standard_error", "direct"):
        np.testing.assert_array_equal(getattr(tiles, name), numbers[name])
    for name in ("hits", "column", "row"):
        np.testing.assert_array_equal(getattr(tiles, name), np.array(written[name], dtype=np.uint64))
    names = list(result.surfaces)
    assert [names[k] for k in tiles.map] == written["surface"]

    written = rooms.table(tmp_path / "out/surfaces.csv")
    for column, attribute in {
        "name": "name", "material": "material", "reflectance": "reflectance", "area": "area", "tiles": "tiles",
        "mean_irradiance": "mean", "min_irradiance": "minimum", "max_irradiance": "maximum",
        "standard_error": "standard_error", "power": "power", "behind_share": "behind_share", "hits": "hits",
        "direct": "direct", "absorbed": "absorbed", "unreached_area": "unreached_area",
    }.items():  # fmt: skip
        for text, surface in zip(written[column], result.surfaces.values(), strict=True):
            value = getattr(surface, attribute)
            assert value == type(value)(text) or (value != value and text == "nan"), column

    written = rooms.table(tmp_path / "out/receivers.csv")
    assert result.receivers.names == written["name"]
    for name in ("irradiance", "direct", "indirect", "standard_error", "gain"):
        np.testing.assert_array_equal(getattr(result.receivers, name), np.array(written[name], dtype=float))

    written = rooms.table(tmp_path / "out/areas.csv")
    area = result.areas[0]
    for column, figure in {"em": area.mean, "emin": area.minimum, "emax": area.maximum, "u0": area.uniformity}.items():
        assert figure.value == float(written[column][0])
        assert figure.standard_error == float(written[column + "_se"][0])
    assert area.points == int(written["points"][0])
    assert sum(area.left_out.values()) == int(written["left_out"][0])


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="only Linux says how much memory is resident")
def test_results_of_earlier_states_of_a_room_do_not_keep_what_is_known_of_its_surfaces() -> None:
    """That takes some 150 bytes for each triangle, and is found again when it is needed."""
    n = 200
    x, z = np.meshgrid(np.linspace(0.5, 3.5, n + 1), np.linspace(0.5, 3.5, n + 1))
    vertices = np.stack([x, np.full_like(x, 0.5), z], axis=-1).reshape(-1, 3)
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).reshape(-1)
    halves = [(corner, corner + n + 1, corner + 1), (corner + 1, corner + n + 1, corner + n + 2)]
    triangles = np.concatenate([np.stack(half, 1) for half in halves])
    room = lichtmc.Room.cuboid((4, 2, 4))
    room.add_surface("sheet", vertices, triangles)
    room.add_emitter(lichtmc.Isotropic((2, 1.5, 2)), 1000)
    results = []
    sizes = []
    for k in range(13):
        room.set_reflectance("floor", 0.05 * k)
        results.append(lichtmc.simulate(room, photons=1000, tile=1))
        gc.collect()
        getattr(ctypes.CDLL(None), "malloc_trim", int)(0)  # what is freed is not resident
        sizes.append(resident_bytes())
    growth = (sizes[-1] - sizes[2]) / 10 / len(triangles)
    assert growth < 150, growth
    assert len(lichtmc.simulate(results[0].room, photons=1000, tile=1).tiles) == len(results[0].tiles)
