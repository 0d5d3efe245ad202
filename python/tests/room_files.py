"""Rooms and files that several tests use, and the command line to compare with."""

from __future__ import annotations

import csv
import os
import subprocess
import sys
from pathlib import Path

import pytest

import lichtmc

ROOT = Path(os.environ.get("LICHTMC_SOURCE", Path(__file__).resolve().parents[2]))
SCENES = ROOT / "scenes"
DATA = ROOT / "tests" / "data"
ROOMS = Path(os.environ.get("LICHTMC_ROOMS", ROOT.parent / "shared" / "rooms"))

# A cuboid 4 × 2.5 × 5 m in numbers that a float32 of glTF has, as Room.cuboid() makes it.
VERTICES = [(x, y, z) for y in (0.0, 2.5) for z in (0.0, 5.0) for x in (0.0, 4.0)]


def existing(path: Path) -> Path:
    """The path, or the test is skipped with the reason."""
    if not path.exists():
        pytest.skip(f"{path} is not there (set LICHTMC_SOURCE or LICHTMC_ROOMS)")
    return path


def cuboid() -> lichtmc.Room:
    """4 × 2.5 × 5 m with a lamp of 1000 lm below the ceiling."""
    room = lichtmc.Room.cuboid((4, 2.5, 5), 0.5, ceiling=0.75)
    room.add_emitter(lichtmc.Isotropic((2, 2.25, 2.5)), 1000)
    return room


def command(*words: object) -> str:
    """Runs the command line; returns what it writes to stdout."""
    done = subprocess.run(
        [sys.executable, "-m", "lichtmc", *map(str, words)], capture_output=True, text=True, timeout=300, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def table(file: Path, column: str) -> list[float]:
    """A column of a table of results."""
    with open(file, newline="", encoding="utf-8") as rows:
        return [float(row[column]) for row in csv.DictReader(rows)]
