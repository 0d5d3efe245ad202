#!/usr/bin/env python3
"""Writes the rooms in scenes/. This script is their source: change it, not them. Twice run, it gives the same bytes.

Every surface's front faces the room. Lengths are metres, Y is up.
"""

import math
import pathlib
import sys

sys.dont_write_bytecode = True  # leaves no folder of compiled modules in the source tree

from scenes import shapes  # noqa: E402
from scenes.gltf import POINTING_DOWN, Gltf  # noqa: E402
from scenes.living_room import living_room  # noqa: E402


def point_light(power):
    """A point light of this power (lm): KHR_lights_punctual asks for its intensity in cd."""
    return {"type": "point", "intensity": power / (4.0 * math.pi)}


def cube_paper():
    """The example of H. Schulze, Lichtausbreitung in Räumen (2021), figures 3 and 4.

    A cube of edge 1 m, one corner at the origin; a generalized Lambert emitter with exponent 5 and 1 W hangs in its
    middle and points down.
    """
    gltf = Gltf()
    material = gltf.material("wall", 0.6)
    for name, normal, at in (
        ("floor", "+y", 0.0),
        ("ceiling", "-y", 1.0),
        ("wall_x0", "+x", 0.0),
        ("wall_x1", "-x", 1.0),
        ("wall_z0", "+z", 0.0),
        ("wall_z1", "-z", 1.0),
    ):
        shapes.add(gltf, name, material, [shapes.wall(normal, at, 0.0, 0.0, 1.0, 1.0)])
    extras = {"lambert_exponent": 5, "power": 1, "unit": "W"}
    gltf.light("lamp", (0.5, 0.5, 0.5), point_light(1.0), POINTING_DOWN, extras)
    return gltf


def l_room():
    """An L: the square [0, 2]² of (x, z) without its quarter [1, 2]², 1 m high; 1000 lm where its arms meet.

    The end walls do not see each other: the line of sight between them grazes the inner corner, which light that
    leaks there would show. Surfaces are cut into squares of 1 m, so that vertices meet vertices everywhere.
    """
    gltf = Gltf()
    material = gltf.material("wall", 0.5)
    squares = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
    for name, normal, at in (("floor", "+y", 0.0), ("ceiling", "-y", 1.0)):
        chart = shapes.Plane(normal, at, (0.0, 0.0))
        for x, z in squares:
            chart.rectangle(x, z, x + 1.0, z + 1.0)
        shapes.add(gltf, name, material, [chart])

    wall_x0 = shapes.Plane("+x", 0.0, (0.0, 0.0)).rectangle(0.0, 0.0, 1.0, 1.0).rectangle(0.0, 1.0, 1.0, 2.0)
    wall_z0 = shapes.Plane("+z", 0.0, (0.0, 0.0)).rectangle(0.0, 0.0, 1.0, 1.0).rectangle(1.0, 0.0, 2.0, 1.0)
    for name, chart in (
        ("wall_x0", wall_x0),
        ("wall_z0", wall_z0),
        ("end_wall_x2", shapes.wall("-x", 2.0, 0.0, 0.0, 1.0, 1.0)),
        ("end_wall_z2", shapes.wall("-z", 2.0, 0.0, 0.0, 1.0, 1.0)),
        ("notch_wall_x1", shapes.wall("-x", 1.0, 0.0, 1.0, 1.0, 2.0)),
        ("notch_wall_z1", shapes.wall("-z", 1.0, 1.0, 0.0, 2.0, 1.0)),
    ):
        shapes.add(gltf, name, material, [chart])
    gltf.light("lamp", (0.5, 0.5, 0.5), point_light(1000.0))
    return gltf


def icosphere(subdivisions):
    """Vertices on the unit sphere and triangles, outwards, of an icosahedron whose faces are quartered repeatedly."""
    golden = (1.0 + math.sqrt(5.0)) / 2.0
    length = math.sqrt(1.0 + golden * golden)
    a, b = 1.0 / length, golden / length
    vertices = [
        (-a, b, 0.0), (a, b, 0.0), (-a, -b, 0.0), (a, -b, 0.0),
        (0.0, -a, b), (0.0, a, b), (0.0, -a, -b), (0.0, a, -b),
        (b, 0.0, -a), (b, 0.0, a), (-b, 0.0, -a), (-b, 0.0, a),
    ]  # fmt: skip
    triangles = [
        (0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11),
        (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8),
        (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9),
        (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1),
    ]  # fmt: skip
    middles = {}

    def middle(i, j):
        key = (min(i, j), max(i, j))
        if key not in middles:
            point = [p + q for p, q in zip(vertices[i], vertices[j])]
            size = math.sqrt(sum(p * p for p in point))
            middles[key] = len(vertices)
            vertices.append(tuple(p / size for p in point))
        return middles[key]

    for _ in range(subdivisions):
        quarters = []
        for i, j, k in triangles:
            ij, jk, ki = middle(i, j), middle(j, k), middle(k, i)
            quarters += [(i, ij, ki), (j, jk, ij), (k, ki, jk), (ij, jk, ki)]
        triangles = quarters
    return vertices, triangles


def integrating_sphere():
    """A white sphere of radius 1 m, as 5120 triangles, about a lamp of 1000 lm in its centre.

    The vertices are shared and their normals those of the sphere. There are no texture coordinates: the engine makes
    the chart.
    """
    gltf = Gltf()
    material = gltf.material("white coating", 0.9)
    vertices, triangles = icosphere(4)
    inwards = [tuple(-p for p in vertex) for vertex in vertices]
    gltf.surface("sphere", material, vertices, inwards, None, [(i, k, j) for i, j, k in triangles])
    gltf.light("lamp", (0.0, 0.0, 0.0), point_light(1000.0))
    return gltf


def main():
    folder = pathlib.Path(__file__).resolve().parent.parent / "scenes"
    folder.mkdir(exist_ok=True)
    for name, make in (
        ("cube_paper.gltf", cube_paper),
        ("l_room.gltf", l_room),
        ("integrating_sphere.glb", integrating_sphere),
        ("living_room.glb", living_room),
    ):
        gltf = make()
        gltf.write(folder / name)
        print(f"{name}: {gltf.triangle_count()} triangles, {(folder / name).stat().st_size} bytes")


if __name__ == "__main__":
    main()
