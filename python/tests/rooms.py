"""Rooms and programs that several tests use."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import lichtmc
import numpy as np

SCENES = Path(__file__).resolve().parents[2] / "scenes"
DATA = SCENES.parent / "tests" / "data"


def cube() -> lichtmc.Room:
    """A cube with one lamp: 24 tiles of 0.5 m."""
    return lichtmc.Room.from_gltf(SCENES / "cube_paper.gltf")


def living_room() -> lichtmc.Room:
    return lichtmc.Room.from_gltf(SCENES / "living_room.glb")


# For other processes: they find the package where this one did, whatever their folder is.
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(Path(lichtmc.__file__).resolve().parents[1])}


def command_line(*words: object, folder: Path | None = None, status: int = 0) -> str:
    """Runs `lichtmc WORDS…` in a folder; returns what it printed. Its exit status must be this."""
    done = subprocess.run(
        [sys.executable, "-m", "lichtmc", *map(str, words)],
        cwd=folder,
        env=ENVIRONMENT,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout + done.stderr


def same(a: np.ndarray, b: np.ndarray) -> bool:
    """Whether two arrays are equal bit for bit, NaN included."""
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


def same_tiles(a: lichtmc.Result, b: lichtmc.Result) -> bool:
    """Whether two results have the same tiles, bit for bit."""
    return all(
        same(getattr(a.tiles, name), getattr(b.tiles, name))
        for name in ("irradiance", "standard_error", "area", "position")
    )
