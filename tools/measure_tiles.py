#!/usr/bin/env python3
"""Measures what photons counted, direct light integrated, and walks from tiles cost for the same error, per tile size.

Runs build/release/bin/lichtmc on one thread and prints a table in Markdown: the time in seconds to an area-weighted rms
relative error of 1 % (of the floor, or of all tiles), from the error and the time of a run long enough to know both,
error² · time being constant; for integrated light its time, which does not shrink, is set apart.

  tools/measure_tiles.py [ROOM] [--surface NAME] [--tiles M …] [--photons N] [--estimator NAME]
"""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/bin/lichtmc"
WAYS = {"counted": (), "direct integrated": ("--direct", "analytic"), "walked from tiles": ("--tiles", "backward")}


def run(room, photons, tile, options, folder):
    subprocess.run([PROGRAM, "run", room, "--photons", str(photons), "--tile", str(tile), "--threads", "1", "--only",
                    "forward", "--quiet", "-o", folder, *options], check=True)
    return json.loads((folder / "summary.json").read_text())


def error_of(folder, surface):
    """Area-weighted rms relative standard error of the tiles of a surface, or of all."""
    squares = area = 0.0
    with open(folder / "tiles.csv", newline="") as file:
        for row in csv.DictReader(file):
            if (surface and row["surface"] != surface) or float(row["irradiance"]) <= 0:
                continue
            squares += float(row["area"]) * (float(row["standard_error"]) / float(row["irradiance"])) ** 2
            area += float(row["area"])
    return math.sqrt(squares / area)


def time_to_one_percent(room, tile, options, surface, photons, folder):
    few = run(room, max(photons // 1000, 4096), tile, options, folder)
    many = run(room, photons, tile, options, folder)
    error = error_of(folder, surface)
    # Walks from tiles take at least two rounds from each: what they did, not what was asked for.
    per_history = (many["seconds"] - few["seconds"]) / max(many["histories"] - few["histories"], 1)
    once = max(many["seconds"] - per_history * many["histories"], 0.0) if len(options) > 2 else 0.0
    return once, (many["seconds"] - once) * (error / 0.01) ** 2, error


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("room", nargs="?", default=str(ROOT / "scenes/cube_paper.gltf"))
    parser.add_argument("--surface", default=None, help="one surface [all]")
    parser.add_argument("--tiles", nargs="+", type=float, default=[0.5, 0.2, 0.1, 0.05, 0.02])
    parser.add_argument("--photons", type=int, default=4_000_000)
    parser.add_argument("--estimator", default="collision")
    arguments = parser.parse_args()
    print("| tile edge | way | direct light | walks to 1 % | together | error measured |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as temporary:
        for tile in arguments.tiles:
            for name, way in WAYS.items():
                options = way + ("--estimator", arguments.estimator)
                once, walks, error = time_to_one_percent(arguments.room, tile, options, arguments.surface,
                                                         arguments.photons, pathlib.Path(temporary) / "out")
                print(f"| {tile} m | {name} | {once:.3g} s | {walks:.3g} s | {once + walks:.3g} s | {100 * error:.2g} % |",
                      flush=True)


if __name__ == "__main__":
    main()
