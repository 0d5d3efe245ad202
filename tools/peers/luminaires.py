"""Compares an office with luminaires by lichtmc and by Radiance; started by luminaires.sh, see README.md."""

import argparse
import csv
import pathlib
import sys

import numpy as np

import gltf_room
import luminaires_with_radiance
import with_radiance
from estimates import FLOOR
from office import write_office
from tasks import ROOT
from with_lichtmc import lichtmc, read_columns, version

DESCRIPTION = """Illuminances of an office under a grid of luminaires with a photometric file, direct and reflected
light, by lichtmc and by Radiance. Exit status 1 if a receiver differs by more than the tolerance and three standard
errors. See tools/peers/README.md."""
COLUMNS = "name,x,y,z,lichtmc,lichtmc_error,radiance,radiance_error,direct_lichtmc,direct_radiance".split(",")


def read_arguments():
    parser = argparse.ArgumentParser(prog="luminaires.sh", description=DESCRIPTION)
    add = parser.add_argument
    file = ROOT / "tests/data/luminaires/c_skew.ies"
    add("--room", type=pathlib.Path, metavar="FILE", help="glTF file; its own lamps are left out [an office]")
    add("--luminaire", type=pathlib.Path, default=file, metavar="FILE", help="IES file [%(default)s]")
    add("--columns", type=int, default=4, metavar="N", help="luminaires along X [%(default)s]")
    add("--rows", type=int, default=3, metavar="N", help="luminaires along Z [%(default)s]")
    add("--below", type=float, default=0.5, metavar="M", help="below the top of the room, m [%(default)s]")
    add("--rotation", type=float, default=0.0, metavar="DEG", help="from 0° towards 90° [%(default)s]")
    add("--area", action="store_true", help="light from all over the opening; direct light only")
    add("--grid", type=float, default=0.75, metavar="M", help="receivers above the floor, m [%(default)s]")
    add("--spacing", type=float, default=0.75, metavar="M", help="of the receivers, m [%(default)s]")
    add("--error", default="0.2%", metavar="P", help="of lichtmc [%(default)s]")
    add("--turns", type=int, default=16, metavar="N", help="independent answers of Radiance [%(default)s]")
    add("--tolerance", type=float, default=1.0, metavar="P", help="in per cent [%(default)s]")
    add("--csv", type=pathlib.Path, metavar="FILE", help="writes the figures with all digits")
    arguments = parser.parse_args()
    if arguments.turns < 2:
        parser.error("--turns must be at least 2: errors of Radiance follow from the differences between turns")
    if not arguments.luminaire.is_file():
        parser.error(f"there is no file {arguments.luminaire}")
    return arguments


def surfaces_of(room, folder):
    """{reflectance: triangles}, as a run of lichtmc has them. A few photons: only the geometry is used."""
    lamp = ["--light", "point:0,0,0:1lm"]
    lichtmc("run", room, *lamp, "--photons", 1000, "--only", "tiles", "--tile", 1, "--quiet", "-o", folder)
    return gltf_room.lit_triangles(folder / "room_lit.glb")


def positions_of(reflecting, arguments):
    """The middles of equal parts of the room's bounds, [luminaire, axis] in m."""
    corners = np.concatenate([triangles.reshape(-1, 3) for triangles in reflecting.values()])
    low, high = corners.min(0), corners.max(0)

    def middles(axis, count):
        return low[axis] + (high[axis] - low[axis]) * (np.arange(count) + 0.5) / count

    z, x = np.meshgrid(middles(2, arguments.rows), middles(0, arguments.columns), indexing="ij")
    return np.round(np.stack([x, np.full_like(x, high[1] - arguments.below), z], 2).reshape(-1, 3), 3)


def run_lichtmc(room, positions, arguments, folder):
    """The columns of receivers.csv, by their names."""
    options = ["--grid", arguments.grid, "--grid-spacing", arguments.spacing, "--only", "receivers"]
    for x, y, z in positions:
        place = f"ies:{arguments.luminaire}:{x},{y},{z}:0,-1,0:{arguments.rotation:g}"
        options += ["--light", place + (":area" if arguments.area else "")]
    if arguments.area:
        options += ["--reflectance", "*=0"]
    lichtmc("run", room, *options, "--target-error", arguments.error, "--no-report", "--quiet", "-o", folder)
    names = ["x", "y", "z", "nx", "ny", "nz", "irradiance", "direct", "standard_error"]
    table = dict(zip(names, read_columns(folder / "receivers.csv", *names)))
    with open(folder / "receivers.csv", newline="") as file:
        table["name"] = [row["name"] for row in csv.DictReader(file)]
    return table


def print_table(rows):
    print("| receiver | x, y, z in m | lichtmc, lx | Radiance, lx | ratio | ratio of direct light |")
    print("|---|---|---|---|---|---|")
    for name, x, y, z, ours, ours_error, theirs, theirs_error, direct, their_direct in rows:
        ratios = f"{ours / theirs:.4f}" if theirs else "–", f"{direct / their_direct:.5f}" if their_direct else "–"
        values = f"{ours:.2f} ± {ours_error:.2f} | {theirs:.2f} ± {theirs_error:.2f} | {' | '.join(ratios)}"
        print(f"| {name} | {x:.3f}, {y:.3f}, {z:.3f} | {values} |")


def judge(rows, tolerance):
    """Prints the deviations; whether all are within the tolerance and three standard errors."""
    ours, ours_error, theirs, theirs_error, direct, their_direct = np.array([row[4:] for row in rows]).T
    base = np.maximum(theirs, FLOOR * theirs.mean())
    deviations = (ours - theirs) / base
    errors = np.hypot(ours_error, theirs_error) / base
    where = np.argmax(abs(deviations))
    z = deviations / errors
    ratios = ours.mean() / theirs.mean(), direct.mean() / their_direct.mean()
    print(f"\nRatio of the means: {ratios[0]:.5f}; of direct light: {ratios[1]:.6f}.")
    print(
        f"Deviations at {len(rows)} receivers: rms {rms(deviations):.3%}, largest {deviations[where]:+.3%} ± "
        f"{errors[where]:.3%} ({rows[where][0]}). Standard errors, rms: lichtmc {rms(ours_error / base):.3%}, "
        f"Radiance {rms(theirs_error / base):.3%}. Mean z²: {np.mean(z**2):.2f}."
    )
    apart = (direct - their_direct) / np.maximum(their_direct, FLOOR * their_direct.mean())
    print(f"Direct light: rms {rms(apart):.4%}, largest {apart[np.argmax(abs(apart))]:+.4%}.")
    beyond = abs(deviations) > tolerance + 3 * errors
    print(f"{beyond.sum()} of {len(rows)} receivers differ by more than {tolerance:.2%} and three standard errors.")
    return not beyond.any()


def rms(values):
    return float(np.sqrt(np.mean(values**2)))


def main():
    arguments = read_arguments()
    folder = ROOT / "build/peers/work"
    folder.mkdir(parents=True, exist_ok=True)
    room = folder / "office.glb"
    if arguments.room:
        gltf_room.write_without_emitters(arguments.room, room, keep_receivers=True)
    else:
        write_office(room)
    reflecting = surfaces_of(room, folder / "luminaires_surfaces")
    positions = positions_of(reflecting, arguments)
    try:
        radiance = luminaires_with_radiance.Radiance(
            reflecting, arguments.luminaire, positions, arguments.rotation, arguments.area, folder
        )
    except luminaires_with_radiance.FileError as error:
        sys.exit(f"luminaires.sh: {error}. Give another --luminaire.")
    found = run_lichtmc(room, positions, arguments, folder / "luminaires")
    points, normals = (np.stack([found[axis] for axis in axes], 1) for axes in (("x", "y", "z"), ("nx", "ny", "nz")))
    theirs, errors = radiance.illuminances(points, normals, arguments.turns, reflected=not arguments.area)
    direct, _ = radiance.illuminances(points, normals, arguments.turns, reflected=False)
    ours = found["irradiance"], found["standard_error"]
    rows = list(zip(found["name"], *points.T, *ours, theirs, errors, found["direct"], direct))
    print(f"{version()}; {with_radiance.version()}.")
    print(f"{len(positions)} luminaires {arguments.luminaire.name} at y = {positions[0, 1]:g} m:", end=" ")
    print("; ".join(f"({x:g}, {z:g})" for x, _, z in positions) + f" (x, z), rotation {arguments.rotation:g}°.\n")
    print_table(rows)
    if arguments.csv:
        with open(arguments.csv, "w", newline="") as file:
            csv.writer(file).writerows([COLUMNS, *rows])
    sys.exit(0 if judge(rows, arguments.tolerance / 100) else 1)


if __name__ == "__main__":
    main()
