"""Rooms, results, files and programs that several tests use."""

from __future__ import annotations

import csv
import functools
import os
import subprocess
import sys
from pathlib import Path

import lichtmc
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "scenes"
DATA = ROOT / "tests" / "data"
ROOMS = Path(os.environ.get("LICHTMC_ROOMS", ROOT.parent / "shared" / "rooms"))  # files of others, which may be absent

PHOTONS = 60_000

# For other processes: they find the package where this one did, whatever their folder is.
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(Path(lichtmc.__file__).resolve().parents[1])}


def of_others(*names: str) -> Path:
    """A file or folder in ROOMS, or the test is skipped with the reason."""
    path = ROOMS.joinpath(*names)
    if not path.exists():
        pytest.skip(f"{path} is not there (set LICHTMC_ROOMS)")
    return path


def command_line(*words: object, folder: Path | None = None, status: int = 0) -> str:
    """Runs `lichtmc WORDS…` in a folder; returns what it printed, with its messages if it is to fail with a status."""
    done = subprocess.run(
        [sys.executable, "-m", "lichtmc", *map(str, words)],
        cwd=folder,
        env=ENVIRONMENT,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout + (done.stderr if status else "")


def rows_of(file: Path) -> list[dict[str, str]]:
    """The rows of a table of results."""
    with open(file, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert rows
    return rows


def table(file: Path) -> dict[str, list[str]]:
    """The columns of a table of results."""
    rows = rows_of(file)
    return {name: [row[name] for row in rows] for name in rows[0]}


def numbers(file: Path, name: str) -> list[float]:
    """The numbers in a column of a table of results; NaN where there is none."""
    return [float(text or "nan") for text in table(file)[name]]


def cube() -> lichtmc.Room:
    """A cube with one lamp: 24 tiles of 0.5 m."""
    return lichtmc.Room.from_gltf(SCENES / "cube_paper.gltf")


def living_room() -> lichtmc.Room:
    return lichtmc.Room.from_gltf(SCENES / "living_room.glb")


# A cuboid 4 × 2.5 × 5 m in numbers that a float32 of glTF has, as Room.cuboid() makes it.
VERTICES = [(x, y, z) for y in (0.0, 2.5) for z in (0.0, 5.0) for x in (0.0, 4.0)]


def cuboid() -> lichtmc.Room:
    """4 × 2.5 × 5 m with a lamp of 1000 lm below the ceiling."""
    room = lichtmc.Room.cuboid((4, 2.5, 5), 0.5, ceiling=0.75)
    room.add_emitter(lichtmc.Isotropic((2, 2.25, 2.5)), 1000)
    return room


def box_room() -> lichtmc.Room:
    """A cuboid with two lamps, two receivers, a desk and a working plane."""
    room = lichtmc.Room.cuboid((6, 3, 4), 0.6, floor=0.3, ceiling=0.8)
    room.add_emitter(lichtmc.Lambert((2, 2.9, 2)), 3000, name="left")
    room.add_emitter(lichtmc.Lambert((4.5, 2.9, 2)), 2000, name="right")
    room.add_receivers([(1, 0.8, 1), (4, 0.8, 3)], names=["phone", "tablet"], half_angle=70, area=1e-4)
    room.add_area("desk", (1, 0.75, 1), (2, 0, 0), (0, 0, 1.5), role="task", target_lx=500, target_uniformity=0.6)
    room.add_working_plane(0.75)
    return room


@functools.cache
def box_result() -> lichtmc.Result:
    return lichtmc.simulate(box_room(), photons=PHOTONS)


@functools.cache
def box_with_parts() -> lichtmc.Result:
    return lichtmc.simulate(box_room(), photons=PHOTONS, per_emitter=True, only="receivers")


@functools.cache
def box_with_channels(per_emitter: bool = True) -> lichtmc.Result:
    return lichtmc.simulate(
        box_room(),
        photons=20_000,
        estimator="weight",
        only="receivers",
        impulse_response=0.5e-9,
        time_span=100e-9,
        orders=2,
        per_emitter=per_emitter,
    )


@functools.cache
def half_covered() -> lichtmc.Result:
    """A wall of one triangle, which covers half of the cells of its grid, over a floor."""
    room = lichtmc.Room.from_triangles(
        [(0, 0, 0), (2, 0, 0), (2, 0, 2), (0, 0, 2), (0, 0, 0), (2, 0, 0), (0, 2, 0)],
        [(0, 2, 1), (0, 3, 2), (4, 5, 6)],
        0.5,
        surfaces=[0, 0, 1],
        names=["floor", "gable"],
    )
    room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 100)
    return lichtmc.simulate(room, photons=PHOTONS)


def same(a: np.ndarray, b: np.ndarray) -> bool:
    """Whether two arrays are equal bit for bit, NaN included."""
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


def same_tiles(a: lichtmc.Result, b: lichtmc.Result) -> bool:
    """Whether two results have the same tiles, bit for bit."""
    return all(
        same(getattr(a.tiles, name), getattr(b.tiles, name))
        for name in ("irradiance", "standard_error", "area", "position")
    )
