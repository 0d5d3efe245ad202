#!/usr/bin/env python3
"""Lets two builds of the program simulate the same runs and compares their figures bit by bit; see same_bits.sh.

Usage: same_bits.py BASE_FOLDER PROGRAM [RUN...]

BASE_FOLDER/build/bin/lichtmc is the program to compare with; its results are kept in BASE_FOLDER/results. Rooms that
scenes/ lacks (textured, open, two-sided, mirrored, an empty cuboid with every emitter) are made here.
"""

import csv
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import zlib

sys.dont_write_bytecode = True  # leaves no folder of compiled modules in the source tree

from scenes import shapes  # noqa: E402
from scenes.gltf import POINTING_DOWN, Gltf  # noqa: E402

SCENES = pathlib.Path(__file__).resolve().parent.parent / "scenes"

# Differences that are meant, by the key of summary.json, each with its reason. Figures of light and their standard
# errors never stand here.
EXCEPTIONS = {
    "version": "names the program, not a figure; tile images have it in their header, too",
    "settings": "the settings as asked for, which 0.1.0 did not list",
}
# The same for keys of single runs.
EXCEPTIONS_OF_RUNS = {
    # 0.1.0 counted the rays of direct light at receivers once per session or part; now once, as in one run.
    "merged": {"rays", "shadow_rays"},
    # Since 0.2.0 tiles that no light can reach (here the outer side of the two-sided wall) are not among those without
    # hits.
    "two_sided_collision": {"tiles_without_hits"},
    "two_sided_absorption": {"tiles_without_hits"},
    "resumed": {"rays", "shadow_rays", "tiles_without_hits"},
    "two_ranks": {"tiles_without_hits"},
}
# Figures that were added to what is written for a surface: left out if the base does not have them.
ADDED_TO_SURFACES = {
    "absorbed": "the power that a surface absorbs, since 0.2.0",
    "unreached_area": "the area that no light can reach, since 0.2.0",
    "unreached_tiles": "the tiles of it, since 0.2.0",
    "covered_area": "the area that other surfaces in one plane cover, since 0.2.0",
}
# Figures of summary.json that a base may not have.
ADDED = {"unreached_tiles", "tile_images", "luminaires", "areas", "maintenance_factor"}
# The same, also within other keys.
ADDED_ANYWHERE = {"rms_relative_error_without_floor", "error_floor", "concentrator_index", "filter_gain", "delay_ns",
                  "file", "total_power", "watts", "total_watts", "efficacy", "scale", "maintenance_factor",
                  "initial_power"}  # fmt: skip
# Keys of summary.json that hold times or follow from one: two runs of one program differ in them.
TIMES = {"seconds", "impacts_per_second", "figure_of_merit", "checkpoint_seconds"}

WALLS = (("floor", "+y", 0.0), ("ceiling", "-y", 2.5), ("wall_x0", "+x", 0.0), ("wall_x1", "-x", 3.0),
         ("wall_z0", "+z", 0.0), ("wall_z1", "-z", 2.0))  # fmt: skip
SIZE = (3.0, 2.5, 2.0)


def add_walls(gltf, material, without=(), double_sided=None):
    """Six rectangles about 3 m × 2.5 m × 2 m."""
    for name, normal, at in WALLS:
        if name in without:
            continue
        axis = "xyz".index(normal[1])
        u, v = (k for k in range(3) if k != axis)
        kind = double_sided if double_sided is not None and name == "wall_x0" else material
        shapes.add(gltf, name, kind, [shapes.wall(normal, at, 0.0, 0.0, SIZE[u], SIZE[v])])


def add_lamps(gltf):
    """One emitter of each law that a file can hold, and receivers with and without a field of view."""
    point = {"type": "point", "intensity": 40.0}
    gltf.light("point", (0.7, 2.0, 0.6), point)
    gltf.light("lambert", (2.2, 2.3, 1.2), point, POINTING_DOWN, {"lambert_exponent": 3.5, "power": 400})
    spot = {"type": "spot", "intensity": 90.0, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.7}}
    gltf.light("spot", (1.5, 2.4, 0.4), spot, POINTING_DOWN)
    panel = gltf.material("panel", 0.4, luminance_cd_m2=300.0)
    shapes.add(gltf, "area_light", panel, [shapes.wall("-y", 2.45, 1.0, 0.8, 1.6, 1.4)])
    gltf.node({"name": "wide", "translation": [1.0, 0.8, 1.0], "rotation": [math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)],
               "extras": {"receiver": {"area": 1e-4, "fov": 90}}})
    gltf.node({"name": "narrow", "translation": [2.0, 0.5, 1.5], "rotation": [0.6, 0.0, 0.0, 0.8],
               "extras": {"receiver": {"area": 1e-4, "fov": 35}}})


def png(columns, rows, pixels):
    """A grey picture of 8 bits."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    lines = b"".join(b"\0" + bytes(pixels[r * columns : (r + 1) * columns]) for r in range(rows))
    header = struct.pack(">IIBBBBB", columns, rows, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b"")


def textured():
    """A room whose floor takes its reflectance from a picture."""
    gltf = Gltf()
    add_walls(gltf, gltf.material("wall", 0.7), without=("floor",))
    picture = png(8, 8, [(37 * k * k + 11 * k) % 220 for k in range(64)])
    while len(gltf.binary) % 4:
        gltf.binary.append(0)
    gltf.json.setdefault("bufferViews", []).append(
        {"buffer": 0, "byteOffset": len(gltf.binary), "byteLength": len(picture)})
    gltf.binary += picture
    gltf.json["images"] = [{"bufferView": len(gltf.json["bufferViews"]) - 1, "mimeType": "image/png"}]
    gltf.json["textures"] = [{"source": 0}]
    carpet = gltf.material("carpet", 0.5)
    del gltf.json["materials"][carpet]["extras"]
    gltf.json["materials"][carpet]["pbrMetallicRoughness"] = {"baseColorTexture": {"index": 0}}
    shapes.add(gltf, "floor", carpet, [shapes.wall("+y", 0.0, 0.0, 0.0, 3.0, 2.0)])
    add_lamps(gltf)
    return gltf


def opened():
    """A room without a ceiling and without one wall, with a box on its floor."""
    gltf = Gltf()
    material = gltf.material("wall", 0.6)
    add_walls(gltf, material, without=("ceiling", "wall_z1"))
    shapes.add(gltf, "box", gltf.material("wood", 0.3), shapes.box((0.5, 0.0, 0.5), (1.2, 0.7, 1.1), without=("-y",)))
    add_lamps(gltf)
    return gltf


def two_sided():
    """A screen with a tile map on either side, and a wall whose material is two-sided."""
    gltf = Gltf()
    material = gltf.material("wall", 0.6)
    both = gltf.material("both", 0.5, double_sided=True)
    add_walls(gltf, material, double_sided=both)
    shapes.add(gltf, "screen", both, [shapes.wall("+x", 1.8, 0.2, 0.3, 1.6, 1.5)])
    add_lamps(gltf)
    return gltf


def mirrored():
    """The room with the box, turned inside out by a node of negative scale."""
    gltf = opened()
    nodes = gltf.json["scenes"][0]["nodes"]
    parent = {"name": "mirror", "scale": [-1.0, 1.0, 1.0], "children": list(nodes)}
    gltf.json["nodes"].append(parent)
    gltf.json["scenes"][0]["nodes"] = [len(gltf.json["nodes"]) - 1]
    return gltf


def lamps():
    """An empty cuboid, which the closed form serves, with every point emitter."""
    gltf = Gltf()
    add_walls(gltf, gltf.material("wall", 0.6))
    gltf.light("point", (0.7, 2.0, 0.6), {"type": "point", "intensity": 40.0})
    gltf.light("lambert", (2.2, 2.3, 1.2), {"type": "point", "intensity": 40.0}, POINTING_DOWN, {"lambert_exponent": 3.5})
    spot = {"type": "spot", "intensity": 90.0, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.7}}
    gltf.light("spot", (1.5, 2.4, 0.4), spot, POINTING_DOWN)
    gltf.node({"name": "narrow", "translation": [2.0, 0.5, 1.5], "rotation": [0.6, 0.0, 0.0, 0.8],
               "extras": {"receiver": {"area": 1e-4, "fov": 35}}})
    return gltf


MADE = {"textured": textured, "open": opened, "two_sided": two_sided, "mirrored": mirrored, "lamps": lamps}

# name: (room, options). Every run has a number of histories, or a target error, so that time decides nothing.
RUNS = {
    "cube_collision": ("cube_paper.gltf", "--photons 400000"),
    "cube_weight": ("cube_paper.gltf", "--photons 300000 --estimator weight"),
    "cube_absorption": ("cube_paper.gltf", "--photons 300001 --estimator absorption"),
    "cube_truncated": ("cube_paper.gltf", "--photons 200000 --estimator weight --max-bounces 7"),
    "cube_embree": ("cube_paper.gltf", "--photons 200000 --engine embree"),
    "cube_embree_fast": ("cube_paper.gltf", "--photons 100000 --engine embree-fast --estimator weight"),
    "cube_analytic": ("cube_paper.gltf", "--photons 200000 --direct analytic"),
    "cube_analytic_weight": ("cube_paper.gltf", "--photons 100000 --direct analytic --estimator weight --engine embree"),
    "cube_analytic_absorption": ("cube_paper.gltf", "--photons 100000 --direct analytic --estimator absorption"),
    "cube_tiles_backward": ("cube_paper.gltf", "--photons 300000 --tiles backward --tile 0.25"),
    "cube_many_tiles": ("cube_paper.gltf", "--photons 200000 --tile 0.01"),
    "cube_many_tiles_weight": ("cube_paper.gltf", "--photons 200000 --tile 0.01 --estimator weight"),
    "cube_target": ("cube_paper.gltf", "--target-error 3%"),
    "cube_auto": ("cube_paper.gltf", "--photons 1000000 --estimator auto"),
    "cube_auto_target": ("cube_paper.gltf", "--target-error 2% --estimator auto --tile 0.05"),
    "living_auto_target": ("living_room.glb", "--target-error 14% --estimator auto --tile 0.5 --receivers POINTS"),
    "cube_grid": ("cube_paper.gltf", "--photons 300000 --grid 0.4 --grid-spacing 0.2 --estimator weight"),
    "l_room_collision": ("l_room.gltf", "--photons 200000"),
    "l_room_grid": ("l_room.gltf", "--photons 100000 --grid 0.5 --only backward --estimator absorption"),
    "sphere_weight": ("integrating_sphere.glb", "--photons 60000 --estimator weight"),
    "living_collision": ("living_room.glb", "--photons 200000 --tile 0.25"),
    "living_auto": ("living_room.glb", "--photons 400000 --estimator auto --tile 0.5 --receivers POINTS"),
    "living_analytic": ("living_room.glb", "--photons 50000 --direct analytic --tile 1"),
    "living_receivers": ("living_room.glb", "--only backward --target-error 3% --receivers POINTS"),
    "living_tiles_backward_auto": ("living_room.glb", "--photons 100000 --tiles backward --tile 2 --estimator auto"),
    "textured_collision": ("textured", "--photons 100000"),
    "textured_weight": ("textured", "--photons 100000 --estimator weight"),
    "textured_absorption": ("textured", "--photons 100000 --estimator absorption"),
    "open_weight": ("open", "--photons 100000 --estimator weight"),
    "open_collision_analytic": ("open", "--photons 100000 --direct analytic --tile 0.3"),
    "two_sided_collision": ("two_sided", "--photons 100000"),
    "two_sided_absorption": ("two_sided", "--photons 100000 --estimator absorption --direct analytic --tile 0.3"),
    "mirrored_collision": ("mirrored", "--photons 100000"),
    "mirrored_tiles_backward": ("mirrored", "--photons 60000 --tiles backward --tile 0.5 --estimator weight"),
    "lamps_collision": ("lamps", "--photons 200000"),
    "lamps_analytic_truncated": ("lamps", "--photons 100000 --direct analytic --estimator weight --max-bounces 5"),
    "lamps_part": ("lamps", "--histories 102400:153600 --estimator weight"),
    # Sessions, parts and ranks; see simulate().
    "resumed": ("two_sided", "--photons 100000 --tile 0.3"),
    "resumed_auto": ("textured", "--photons 400000 --tile 0.3 --estimator auto --direct analytic"),
    "merged": ("open", "--tile 0.3 --estimator weight"),
    "two_ranks": ("two_sided", "--photons 100000 --tile 0.3 --target-error 20%"),
    "paths": ("living_room.glb", ""),
}
# Receivers in living_room, 0.85 m over the floor: POINTS in the list above. The points of --grid depend on the version.
POINTS = "x,y,z,nx,ny,nz\n" + "".join(f"{0.3 + 0.5 * k},0.85,{0.3 + 0.5 * j},0,1,0\n" for k in range(9) for j in range(7))
COMPARED = ("tiles.csv", "surfaces.csv", "receivers.csv")


def call(words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=600, check=False)
    if done.returncode != 0:
        raise SystemExit(f"same_bits.py: {' '.join(map(str, words))} ended with {done.returncode}:\n{done.stderr}")


def knows_error_floor(program):
    return "--error-floor" in subprocess.run([program, "run", "--help"], capture_output=True, text=True, check=True).stdout


def simulate(program, name, room, options, folder):
    """One run of the list, into folder, with the estimator and the error measure that were the defaults before 0.3.0."""
    if "--estimator" not in options:
        options = [*options, "--estimator", "collision"]
    if name != "paths" and knows_error_floor(program):
        options = [*options, "--error-floor", "0"]
    run = [program, "run", room, "--quiet", "--no-report", *options, "-o", folder]
    if name in ("resumed", "resumed_auto"):
        at = options.index("--photons") + 1
        call([*run[: 5 + at], str(int(options[at]) // 2 + 100), *run[6 + at :]])
        call([program, "resume", folder, "--quiet", "--no-report", "--photons", options[at]])
    elif name == "merged":
        parts = [f"{folder}.part{k}" for k in range(3)]
        for part, histories in zip(parts, ("0:20480", "20480:51200", "51200:90000")):
            call([*run[:-2], "--histories", histories, "-o", part])
        call([program, "merge", *reversed(parts), "--quiet", "--no-report", "-o", folder])
    elif name == "two_ranks":
        call(["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2", *run, "--threads", "1"])
    elif name == "paths":
        folder.mkdir()  # the walk whose flights are written down
        call([program, "paths", room, "--quiet", "--photons", "300", "-o", folder])
    else:
        call(run)


def images(folder):
    """The tile images by their names, without the version of the program in their headers."""
    if not (folder / "summary.json").exists():
        return {}
    version = json.loads((folder / "summary.json").read_text())["version"].encode()
    return {file.relative_to(folder).as_posix(): file.read_bytes().replace(version, b"VERSION")
            for file in sorted(folder.glob("tiles/*.exr"))}  # fmt: skip


def added_since(base):
    """The figures of ADDED_TO_SURFACES that a result does not have."""
    heading = (base / "surfaces.csv").read_text().splitlines()[0] if (base / "surfaces.csv").exists() else ""
    return ADDED_TO_SURFACES.keys() - set(heading.split(","))


def table(file, added):
    """The rows of a table, without these columns."""
    with file.open(newline="") as text:
        rows = list(csv.reader(text))
    kept = [k for k, name in enumerate(rows[0]) if file.name != "surfaces.csv" or name not in added]
    return [[row[k] for k in kept] for row in rows]


def without(value, keys):
    if isinstance(value, dict):
        return {key: without(part, keys) for key, part in value.items() if key not in keys}
    if isinstance(value, list):
        return [without(part, keys) for part in value]
    return value


def numbers_of(summary, run):
    """summary.json without times, exceptions and sentences (choices, warnings, ignored, mended)."""
    sentences = ("choices", "warnings", "ignored", "mended", "overrides", "room")
    left_out = TIMES | ADDED_ANYWHERE | EXCEPTIONS.keys() | EXCEPTIONS_OF_RUNS.get(run, set())
    return without({key: value for key, value in summary.items() if key not in sentences}, left_out)


def differences(base, new, run):
    added = added_since(base)
    for name in COMPARED + ("paths.csv",):
        if (base / name).exists() != (new / name).exists():
            yield f"{name} is there in one of them only"
        elif (base / name).exists() and table(base / name, added) != table(new / name, added):
            yield f"{name} differs"
    pictures_a, pictures_b = images(base), images(new)
    if pictures_a.keys() != pictures_b.keys():
        yield "there are other tile images"
    for name in pictures_a.keys() & pictures_b.keys():
        if pictures_a[name] != pictures_b[name]:
            yield f"{name} differs"
    if (base / "summary.json").exists():
        a, b = (numbers_of(json.loads((folder / "summary.json").read_text()), run) for folder in (base, new))
        a["surfaces"], b["surfaces"] = (without(summary["surfaces"], added) for summary in (a, b))
        a["units"], b["units"] = (without(summary["units"], added) for summary in (a, b))
        for key in sorted((a.keys() | b.keys()) - (ADDED - a.keys())):
            if key not in a or key not in b or a[key] != b[key]:
                yield f"summary.json: {key} is {a.get(key)!r:.200} and {b.get(key)!r:.200}"


def main():
    if len(sys.argv) < 3:
        raise SystemExit(__doc__)
    base_folder = pathlib.Path(sys.argv[1])
    program = pathlib.Path(sys.argv[2]).resolve()
    names = sys.argv[3:] or list(RUNS)
    unknown = [name for name in names if name not in RUNS]
    if unknown:
        raise SystemExit(f"same_bits.py: there is no run {unknown[0]} (allowed: {', '.join(RUNS)}).")
    results = base_folder / "results"
    fresh = pathlib.Path("build/same_bits/new")
    rooms = pathlib.Path("build/same_bits/rooms")
    for folder in (results, rooms):
        folder.mkdir(parents=True, exist_ok=True)
    shutil.rmtree(fresh, ignore_errors=True)
    fresh.mkdir(parents=True)
    for room, make in MADE.items():
        make().write(rooms / f"{room}.glb")
    points = rooms / "points.csv"
    points.write_text(POINTS)
    failed = 0
    for name in names:
        room, options = RUNS[name]
        options = options.replace("POINTS", str(points))
        file = rooms / f"{room}.glb" if room in MADE else SCENES / room
        if not (results / name / "done").exists():
            shutil.rmtree(results / name, ignore_errors=True)
            simulate(base_folder / "build/bin/lichtmc", name, file, options.split(), results / name)
            (results / name / "done").touch()
        simulate(program, name, file, options.split(), fresh / name)
        found = list(differences(results / name, fresh / name, name))
        failed += bool(found)
        print(f"{name}: {'the same bits' if not found else 'DIFFERENT'}")
        for line in found:
            print("  " + line)
    print(f"{len(names) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
