"""lichtmc as a user runs it, on one thread. CPU time of the process, less that of its start."""

import csv
import pathlib
import subprocess

import numpy as np

from estimates import Turn, child_seconds

PROGRAM = pathlib.Path(__file__).resolve().parent.parent.parent / "build/release/bin/lichtmc"


def lichtmc(*arguments):
    subprocess.run([PROGRAM, *map(str, arguments)], check=True, stderr=subprocess.DEVNULL)


def has_option(name):
    return name in subprocess.run([PROGRAM, "run", "--help"], capture_output=True, text=True, check=True).stdout


def version():
    return subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout.strip()


def cpu_seconds(*arguments):
    before = child_seconds()
    lichtmc(*arguments)
    return child_seconds() - before


def read_columns(path, *names):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return [np.array([float(row[name]) for row in rows]) for name in names]


class Lichtmc:
    """options: the method. seconds: walking time of a turn. fixed: the method has work that no error changes."""

    def __init__(self, task, folder, label, options=(), seconds=10.0, fixed=False):
        self.label = f"lichtmc, {label}"
        self.task, self.folder, self.options, self.seconds, self.fixed = task, folder, list(options), seconds, fixed

    def _run(self, seed, *options):
        what = [*self.task.options, "--threads", 1, "--seed", seed, "--no-report", "--no-images", "--quiet"]
        return cpu_seconds("run", self.task.room, *what, "-o", self.folder / "run", *options)

    def start(self):
        """CPU time until photons fly: reading and checking the room, acceleration structure; and writing results."""
        return self._run(1, "--photons", 1)

    def turn(self, seed):
        start = self.start()
        once = max(self._run(seed, "--photons", 1, *self.options) - start, 0.0) if self.fixed else 0.0
        total = self._run(seed, "--max-time", f"{self.seconds}s", *self.options)
        if self.task.tiles is None:
            values, errors = read_columns(self.folder / "run/receivers.csv", "irradiance", "standard_error")
        else:
            values, errors = read_columns(self.folder / "run/tiles.csv", "irradiance", "standard_error")
            values, errors = values[self.task.tiles.selected], errors[self.task.tiles.selected]
        return Turn(total - start - once, values, errors, once)


def methods(task, folder):
    auto, integrated, embree = ["--estimator", "auto"], ["--direct", "analytic"], ["--engine", "embree"]
    if task.name == "cube":
        return [
            Lichtmc(task, folder, "closed form, direct light integrated", [*auto, *integrated], 2.0, fixed=True),
            Lichtmc(task, folder, "closed form", auto, 2.0),
            Lichtmc(task, folder, "Embree, direct light integrated", [*auto, *integrated, *embree], 4.0, fixed=True),
            Lichtmc(task, folder, "Embree", [*auto, *embree], 4.0),
        ]
    if task.name == "tiles":
        return [Lichtmc(task, folder, "Embree", auto, 15.0)]
    if not has_option("--receiver-walk"):
        return [Lichtmc(task, folder, "backward walk")]
    walks = ("two-way", "next-event", "backward")
    return [Lichtmc(task, folder, "defaults")] + [
        Lichtmc(task, folder, f"walk {walk}", ["--receiver-walk", walk]) for walk in walks
    ]
