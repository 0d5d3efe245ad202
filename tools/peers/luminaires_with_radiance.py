"""Luminaires with a photometric file in Radiance: ies2rad, xform, oconv and rtrace -I, without interpolation."""

import pathlib
import subprocess

import numpy as np
import pyradiance

import with_radiance

EFFICACY = 179.0  # lm/W, by which Radiance converts
RADIUS = 0.002  # m, of the sphere that is a luminaire without extent
LIFT = 1e-5  # m: points on a table top must not be below it in the numbers of Radiance

# Hemispheres are sampled anew at every point (-aa 0), by independent random numbers; paths end by Russian roulette
# (-lr < 0), and after 20 reflections at the latest. Direct light: every luminaire from every point (-dt 0 -dc 1).
DIRECT = "-u+ -dt 0 -dc 1 -st 1"
POINT, AREA = "-ds 0 -dj 0", "-ds 0.05 -dj 1"  # the middle of a source, or random points in parts of it
REFLECTED = "-ab 20 -aa 0 -as 0 -ad 256 -lw 0.002 -lr -20"


class FileError(Exception):
    """Radiance does not read this file, or not as the standard says."""


def header_of(file):
    """Photometric type (1, 2, 3: C, B, A) and horizontal angles of an LM-63 file."""
    lines = file.read_bytes().decode("latin-1").splitlines()
    starts = [n for n, line in enumerate(lines) if line.upper().startswith("TILT=")]
    if not starts:
        raise FileError(f"{file} is not an IES LM-63 file: Radiance reads no other")
    if lines[starts[0]].strip().upper() != "TILT=NONE":
        raise FileError(f"{file} has TILT factors: Radiance applies them, lichtmc does not")
    numbers = [float(x) for line in lines[starts[0] + 1 :] for x in line.replace(",", " ").split()]
    vertical, horizontal = int(numbers[3]), int(numbers[4])
    return int(numbers[5]), numbers[13 + vertical : 13 + vertical + horizontal]


def program(name, *arguments):
    """What one of Radiance's programs prints; pyradiance 1.3.1 calls ies2rad with a wrong option for metres."""
    command = [pathlib.Path(pyradiance.__file__).parent / "bin" / name, *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise FileError(f"{name} of Radiance: {done.stderr.strip()}")
    return done.stdout


def check(file):
    kind, angles = header_of(file)
    if kind != 1:
        raise FileError(f"{file} is of photometric type {'CBA'[kind - 1]}: ies2rad reads type C, not B and A")
    if (angles[0], angles[-1]) == (90.0, 270.0):
        raise FileError(f"{file} has the angles 90 to 270°: ies2rad turns it by 180°")


def luminaire(file, folder, area):
    """Radiance's description of the luminaire at the origin, aim −Z and 0° towards +X."""
    check(file)
    root = folder / "luminaire"
    program("ies2rad", "-dm", *(() if area else ("-i", RADIUS)), "-o", root, file)
    description = root.with_suffix(".rad")
    # A light is a body, which would cover another luminaire. Rays from a point to one illum pass through the others; but
    # reflected rays end at them, so that openings are compared by direct light only.
    description.write_text(description.read_text().replace("' light '", "' illum '"))
    return description


def turned(description, position, rotation):
    """Its aim downwards (−Y), 0° towards +X, then by the rotation from 0° towards 90°."""
    return program("xform", "-rz", rotation, "-rx", -90, "-t", *position, description)


class Radiance:
    """The room with its luminaires."""

    def __init__(self, reflecting, file, positions, rotation, area, folder):
        description = luminaire(file, folder, area)
        lamps = folder / "luminaires.rad"
        lamps.write_text("".join(turned(description, position, rotation) for position in positions))
        room = folder / "luminaires_room.rad"
        room.write_text("\n".join(with_radiance.surface_lines(reflecting)) + "\n")
        self.octree = folder / "luminaires.oct"
        self.octree.write_bytes(pyradiance.oconv(room, lamps))
        self.direct = f"{DIRECT} {AREA if area else POINT}"

    def illuminances(self, points, normals, turns, reflected):
        """Means and standard errors at the points, lx, from this number of independent answers."""
        parameters = f"{self.direct} {REFLECTED if reflected else '-ab 0'}"
        rays = np.repeat(np.hstack([points + LIFT * normals, normals]), turns, 0)
        answer = with_radiance.trace(self.octree, rays, irradiance=True, params=parameters.split())
        values = EFFICACY * np.array(answer.split(), float).reshape(len(points), turns, 3)[..., 0]
        return values.mean(1), values.std(1, ddof=1) / np.sqrt(turns)
