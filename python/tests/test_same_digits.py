"""The digits of the command line and of Python are the same for the same room, settings and seed.

The program runs in a process of its own and writes tables, whose numbers have all digits. Every one of them must be
equal to the one in Python, bit for bit.
"""

from __future__ import annotations

from pathlib import Path

import lichtmc
import numpy as np
import pytest
from rooms import DATA, SCENES, command_line, numbers, rows_of

CUBE = SCENES / "cube_paper.gltf"
LIVING_ROOM = SCENES / "living_room.glb"
LIVING_ROOM_RECEIVERS = SCENES / "living_room_receivers.csv"
OFFICE = DATA / "office.glb"


def run_program(room: Path, folder: Path, *options: str) -> None:
    command_line("run", room, "-o", folder, "--no-report", "--no-images", "--quiet", *options)


def columns(file: Path, *names: str) -> list[np.ndarray]:
    return [np.array(numbers(file, name)) for name in names]


def assert_same(file: Path, **arrays: np.ndarray) -> None:
    for (name, array), column in zip(arrays.items(), columns(file, *arrays), strict=True):
        np.testing.assert_array_equal(np.asarray(array), column, err_msg=f"{file.name}, {name}")


def assert_same_tiles(folder: Path, result: lichtmc.Result) -> None:
    tiles = result.tiles
    x, y, z = tiles.position.T
    assert_same(
        folder / "tiles.csv",
        irradiance=tiles.irradiance,
        standard_error=tiles.standard_error,
        hits=tiles.hits,
        power=tiles.power,
        area=tiles.area,
        column=tiles.column,
        row=tiles.row,
        x=x,
        y=y,
        z=z,
    )


def assert_same_receivers(folder: Path, result: lichtmc.Result) -> None:
    receivers = result.receivers
    x, y, z = receivers.position.T
    # Points of areas are in tables of their own.
    listed = slice(len(columns(folder / "receivers.csv", "receiver")[0]))
    assert_same(
        folder / "receivers.csv",
        irradiance=receivers.irradiance[listed],
        direct=receivers.direct[listed],
        indirect=receivers.indirect[listed],
        standard_error=receivers.standard_error[listed],
        gain=receivers.gain[listed],
        x=x[listed],
        y=y[listed],
        z=z[listed],
    )


TILE_RUNS = {
    "collision, closed form, one thread": (
        CUBE,
        ["--photons", "200000", "--estimator", "collision", "--threads", "1"],
        {"photons": 200_000, "threads": 1},
    ),
    "weight, furnished room, two threads": (
        LIVING_ROOM,
        ["--photons", "100000", "--estimator", "weight", "--tile", "0.5", "--threads", "2", "--seed", "7"],
        {"photons": 100_000, "estimator": "weight", "tile": 0.5, "threads": 2, "seed": 7},
    ),
    "absorption, Embree, a part of a run": (
        CUBE,
        ["--histories", "10240:102400", "--estimator", "absorption", "--engine", "embree", "--threads", "2"],
        {"histories": (10_240, 102_400), "estimator": "absorption", "engine": "embree", "threads": 2},
    ),
    "direct light integrated": (
        CUBE,
        ["--photons", "100000", "--estimator", "collision", "--direct", "analytic", "--threads", "2"],
        {"photons": 100_000, "direct": "analytic", "threads": 2},
    ),
    "a target error, chosen estimator": (
        CUBE,
        ["--target-error", "5%", "--estimator", "auto", "--threads", "1"],
        {"target_error": 0.05, "estimator": "auto", "threads": 1},
    ),
    "weight, cut off": (
        CUBE,
        ["--photons", "50000", "--max-bounces", "5", "--estimator", "weight"],
        {"photons": 50_000, "max_bounces": 5, "estimator": "weight"},
    ),
}


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
@pytest.mark.parametrize("name", TILE_RUNS)
def test_tiles(name: str, tmp_path: Path) -> None:
    file, options, arguments = TILE_RUNS[name]
    run_program(file, tmp_path / "out", "--only", "tiles", *options)
    result = lichtmc.simulate(lichtmc.Room.from_gltf(file), only="tiles", **arguments)
    assert_same_tiles(tmp_path / "out", result)


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
def test_only_the_command_line_takes_the_estimator_weight_by_itself(tmp_path: Path) -> None:
    room = lichtmc.Room.from_gltf(CUBE)
    run_program(CUBE, tmp_path / "out", "--only", "tiles", "--photons", "5000", "--max-bounces", "5")
    settings = {"only": "tiles", "photons": 5000, "max_bounces": 5}
    assert_same_tiles(tmp_path / "out", lichtmc.simulate(room, estimator="weight", **settings))
    with pytest.raises(lichtmc.InputError, match="only 'weight' is cut off"):
        lichtmc.simulate(room, **settings)


def test_impulse_responses_by_the_usual_estimator_warn() -> None:
    room = lichtmc.Room.from_gltf(CUBE)
    room.add_receivers([(0.5, 0.25, 0.5)], area=1e-4)
    settings = {"only": "receivers", "photons": 2000, "impulse_response": 1e-9}
    with pytest.warns(lichtmc.ResultWarning, match="by the estimator 'collision'.*weight"):
        lichtmc.simulate(room, **settings)
    assert not lichtmc.simulate(room, estimator="weight", **settings).warnings


@pytest.mark.parametrize("walk", ["two-way", "next-event", "backward"])
def test_receivers(walk: str, tmp_path: Path) -> None:
    run_program(
        LIVING_ROOM,
        tmp_path / "out",
        *("--only", "receivers", "--receivers", str(LIVING_ROOM_RECEIVERS), "--receiver-walk", walk),
        *("--photons", "20000", "--estimator", "weight", "--threads", "2"),
    )
    room = lichtmc.Room.from_gltf(LIVING_ROOM)
    room.read_receivers(LIVING_ROOM_RECEIVERS)
    result = lichtmc.simulate(
        room, only="receivers", receiver_walk=walk, photons=20_000, estimator="weight", threads=1
    )
    assert_same_receivers(tmp_path / "out", result)


def test_receivers_from_arrays(tmp_path: Path) -> None:
    # The grid of the command line, and the same points as an array.
    run_program(
        CUBE, tmp_path / "out", "--only", "receivers", "--grid", "0.25", "--photons", "20000", "--estimator", "collision"
    )
    x, y, z = columns(tmp_path / "out/receivers.csv", "x", "y", "z")
    room = lichtmc.Room.from_gltf(CUBE)
    room.add_receivers(np.column_stack([x, y, z]), (0, 1, 0))
    assert_same_receivers(tmp_path / "out", lichtmc.simulate(room, only="receivers", photons=20_000))


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
def test_areas(tmp_path: Path) -> None:
    run_program(
        OFFICE,
        tmp_path / "out",
        *("--plane", "0.75:target_lx=300:target_uniformity=0.6", "--area", "desk:0.8,0.76,-1.2:1.6,0,0:0,0,-0.8"),
        *("--only", "receivers", "--photons", "20000", "--estimator", "weight", "--threads", "1"),
    )
    room = lichtmc.Room.from_gltf(OFFICE)
    # The order of the command line: the digits of a receiver depend on its number.
    room.add_area("desk", corner=(0.8, 0.76, -1.2), u=(1.6, 0, 0), v=(0, 0, -0.8))
    room.add_working_plane(0.75, target_lx=300, target_uniformity=0.6)
    result = lichtmc.simulate(room, only="receivers", photons=20_000, estimator="weight", threads=2)
    rows = {row["area"]: row for row in rows_of(tmp_path / "out/areas.csv")}
    assert list(rows) == list(result.areas)
    for name, row in rows.items():
        area = result.areas[name]
        assert int(row["points"]) == area.points
        for column, figure in {"em": area.mean, "emin": area.minimum, "emax": area.maximum, "u0": area.uniformity}.items():
            assert float(row[column]) == figure.value, (name, column)
            assert float(row[f"{column}_se"]) == figure.standard_error, (name, column)
        assert row["verdict"] == area.verdict
    assert_same_receivers(tmp_path / "out", result)


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
def test_channels(tmp_path: Path) -> None:
    run_program(
        LIVING_ROOM,
        tmp_path / "out",
        *("--receivers", str(LIVING_ROOM_RECEIVERS), "--only", "receivers", "--impulse-response", "1ns", "--time-span", "60ns"),
        *("--orders", "2", "--per-emitter", "--photons", "20000", "--estimator", "weight", "--threads", "2"),
    )
    room = lichtmc.Room.from_gltf(LIVING_ROOM)
    room.read_receivers(LIVING_ROOM_RECEIVERS)
    channels = lichtmc.simulate(
        room,
        only="receivers",
        impulse_response=1e-9,
        time_span=60e-9,
        orders=2,
        per_emitter=True,
        photons=20_000,
        estimator="weight",
        threads=1,
    ).channels
    rows = rows_of(tmp_path / "out/impulse_response.csv")
    place = {
        "emitter": {name: k for k, name in enumerate(channels.emitters)},
        "receiver": {name: k for k, name in enumerate(channels.receivers)},
        "order": {name: k for k, name in enumerate(channels.orders)},
    }
    compared = 0
    for row in rows:
        if row["order"] not in place["order"]:
            continue
        emitter, receiver, order = (place[axis][row[axis]] for axis in ("emitter", "receiver", "order"))
        bin_ = int(float(row["time_s"]) / channels.bin_width)
        assert float(row["h"]) == channels.h[emitter, receiver, order, bin_]
        assert float(row["standard_error"]) == channels.standard_error[emitter, receiver, order, bin_]
        compared += 1
    assert compared > 1000
    gains = columns(tmp_path / "out/channels.csv", "gain")[0]
    np.testing.assert_array_equal(gains, np.ravel(channels.gain.value))
