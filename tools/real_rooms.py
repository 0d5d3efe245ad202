#!/usr/bin/env python3
"""Simulates rooms that nobody made for this program and prints what came of it as two tables, for docs/rooms.md.

Usage: tools/real_rooms.py FOLDER [PHOTONS]     FOLDER holds the files named below; PHOTONS: 5M where nothing is said
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(__file__).resolve().parent.parent / "build/release/bin/lichtmc"

# What each needs: the options that `lichtmc check` asks for. A room without a lamp gets one where check says it is inside.
ROOMS = {
    "webxr_garage/garage.gltf": ["--max-reflectance", "0.9"],
    "webxr_cube-room/cube-room.gltf": ["--max-reflectance", "0.9"],
    "bevy_VolumetricFogExample.glb": [],
    "bevy_CornellBox.glb": ["--scale", "0.01"],
    "fazil_cornell-box.glb": ["--max-reflectance", "0.9"],
    "godot_living_room.glb": [],
    "godot_occlusion_room.glb": [],
    "habitat_simple_room.glb": ["--up", "z", "--max-reflectance", "0.9"],
    "trimesh_no_indices_3storybuilding.glb": ["--max-reflectance", "0.9", "--tile", "0.5"],
    "playcanvas_house.glb": ["--scale", "20", "--max-reflectance", "0.9"],
}


def lichtmc(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)


def tile_of(options):
    return float(options[options.index("--tile") + 1]) if "--tile" in options else 0.1


def numbers_of(folder):
    """Every number of the tables."""
    for name in ("tiles.csv", "surfaces.csv"):
        with open(folder / name, newline="") as file:
            for row in csv.DictReader(file):
                yield from (float(v) for k, v in row.items() if k not in ("surface", "name", "material", "unit"))


def main():
    folder = pathlib.Path(sys.argv[1])
    photons = sys.argv[2] if len(sys.argv) > 2 else "5M"
    charts, runs = [], []
    for name, options in ROOMS.items():
        room = folder / name
        facts = json.loads(lichtmc("check", "--json", room, *options).stdout)
        lamp = [] if facts["emitters"] else ["--light", "point:{:.3f},{:.3f},{:.3f}:1000lm".format(*facts["inside"])]
        made = [s for s in facts["surfaces"] if "chart" in s]
        area = lambda surfaces: sum(s["area"] for s in surfaces)
        cells = lambda surfaces: sum(s["area"] * s["cells_over_area"] for s in surfaces)
        large = [s for s in made if s["area"] >= 100 * tile_of(options) ** 2]
        worst = max((s["cells_over_area"] for s in large), default=math.nan)
        triangles = sum(s["triangles"] for s in made)
        tiles = sum(s["tiles"] / (2 if s["two_sided"] else 1) for s in made)
        charts.append([name, facts["triangles"], f"{len(made)} of {len(facts['surfaces'])}",
                       f"{cells(made) / area(made):.2f}" if made else "-", f"{worst:.2f}" if large else "-",
                       f"{area(made) / tiles / tile_of(options) ** 2:.2f}" if made else "-", f"{triangles / tiles:.2f}" if made else "-"])
        with tempfile.TemporaryDirectory() as out:
            done = lichtmc("run", room, "-o", out, "--photons", photons, "--quiet", *options, *lamp)
            if done.returncode != 0:
                sys.exit(f"{name}: {done.stderr}")
            out = pathlib.Path(out)
            s = json.loads((out / "summary.json").read_text())
            bad = sum(not math.isfinite(x) for x in numbers_of(out))
        gap = abs(s["absorbed"] + s["escaped"] + s["residual"] + s["lost"] - s["emitted"]) / s["emitted"]
        runs.append([name, " ".join(options + lamp), f"{s['impacts']:.3g}", f"{s['absorbed'] / s['emitted']:.4f}", f"{s['escaped'] / s['emitted']:.4f}",
                     s["lost_histories"], f"{gap:.0e}" if gap else "0", bad, f"{100 * s['rms_relative_error']:.1f} %", f"{s['seconds']:.1f} s"])
        print(name, "done", file=sys.stderr)
    print("| room | triangles | surfaces with charts made here | cells / area | the worst surface | area of a tile / tile² | triangles per tile |")
    print("|---|---|---|---|---|---|---|")
    for row in charts:
        print("|", " | ".join(map(str, row)), "|")
    print("\n| room | options | impacts | absorbed | escaped | lost | gap in the balance | numbers not finite | error of the tiles | time |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for row in runs:
        print("|", " | ".join(map(str, row)), "|")


main()
