"""Small rooms and their results, which several tests use: made once."""

from __future__ import annotations

import csv
import functools
import subprocess
import sys
from pathlib import Path

import lichtmc

ROOT = Path(__file__).resolve().parents[2]
PHOTONS = 60_000


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


def run_program(*words: object) -> None:
    """The program lichtmc, as it comes with the package."""
    subprocess.run([sys.executable, "-m", "lichtmc", *map(str, words)], check=True, capture_output=True)


def table(file: Path) -> dict[str, list[str]]:
    with open(file, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    return {name: [row[name] for row in rows] for name in rows[0]}
