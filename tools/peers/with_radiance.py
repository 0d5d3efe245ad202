"""Radiance on one thread: rtrace -I with its ambient cache, which interpolates indirect light between some points.

Its results have no statistical errors: indirect light ends after a number of reflections (-ab), and what is
interpolated is not exact. CPU time of rtrace, less that of a single point without indirect light.
"""

import math

import numpy as np
import pyradiance

from estimates import Turn, child_seconds

RADIUS = 0.002  # m, of the lamp: Radiance has no lamps without extent

COMMON = "-ab 8 -lr 12 -lw 0.0001 -dj 0 -ds 0 -dt 0 -dc 1"  # eight reflections; exact direct light, no sampling of it
SETTINGS = {
    "coarse": "-ad 128 -as 32 -aa 0.3 -ar 32",
    "fine": "-ad 512 -as 128 -aa 0.2 -ar 64",
}
# Points closer than this before another surface count as dark without a calculation: here those under the rug and inside
# the books. The ambient cache carries values from there to the outside of thin bodies: the rug would get 60 % of its
# light.
GAP = 0.02  # m
# Points of each tile, of low discrepancy: direct light varies by some 20 % in tiles of the cube, and more where the edge
# of a shadow crosses a tile. The means over tiles of the cube are then exact to 0.4 %.
POINTS = {"cube": 256, "points": 1, "tiles": 256}


def version():
    return pyradiance.rtrace(b"", "", version=True).decode().strip()


def surface_lines(reflecting):
    """Radiance's description of {reflectance: triangles}, which reflect by Lambert's law."""
    lines = []
    for k, (reflectance, triangles) in enumerate(reflecting.items()):
        lines.append(f"void plastic material_{k} 0 0 5 {reflectance} {reflectance} {reflectance} 0 0")
        for n, corners in enumerate(triangles):
            lines.append(f"material_{k} polygon p_{k}_{n} 0 0 9 " + " ".join(f"{x:.9g}" for x in corners.ravel()))
    return lines


def trace(octree, rays, **options):
    """The answer of rtrace to rays [..., (point, direction)], as text."""
    text = "\n".join(" ".join(f"{x:.9g}" for x in ray) for ray in rays.reshape(-1, 6)) + "\n"
    return pyradiance.rtrace(text.encode(), octree, header=False, **options)


def scene_text(task, distribution):
    """Radiance's description of the room. A lamp that points downwards is a disc; one in all directions is a sphere."""
    lamp = task.lamp
    if lamp.exponent is None:
        radiance = lamp.power / (4 * math.pi) / (math.pi * RADIUS**2)
        lines = [
            f"void light lamp_light 0 0 3 {radiance} {radiance} {radiance}",
            "lamp_light sphere lamp 0 0 4 {} {} {} {}".format(*lamp.position, RADIUS),
        ]
    else:
        # The intensity of a disc falls with the cosine already.
        axial = lamp.power * (lamp.exponent + 1) / (2 * math.pi)
        radiance = axial / (math.pi * RADIUS**2)
        distribution.write_text(f"fall(c) : if(c, c^{lamp.exponent - 1}, 0);\nfallen = fall(Dy);\n")
        lines = [
            f"void brightfunc lamp_distribution 2 fallen {distribution} 0 0",
            f"lamp_distribution light lamp_light 0 0 3 {radiance} {radiance} {radiance}",
            "lamp_light ring lamp 0 0 8 {} {} {} 0 -1 0 0 {}".format(*lamp.position, RADIUS),
        ]
    return "\n".join(lines + surface_lines(task.reflecting)) + "\n"


class Radiance:
    def __init__(self, task, folder, label, parameters):
        self.label = f"Radiance, {label}"
        self.note = f"{self.label}: rtrace -I {COMMON} {parameters}"
        self.parameters = f"{COMMON} {parameters}".split()
        scene = folder / f"{task.name}.rad"
        scene.write_text(scene_text(task, folder / f"{task.name}.cal"))
        self.octree = folder / f"{task.name}.oct"
        self.octree.write_bytes(pyradiance.oconv(scene))
        if task.tiles is None:
            places = task.points[:, None]
            normals = np.broadcast_to(np.array([0.0, 1.0, 0.0]), places.shape)
        else:
            places, normals = task.tiles.sample(POINTS[task.name], np.random.default_rng(2), even=True)
        self.rays = np.concatenate([places, normals], 2)  # [point or tile, sample, coordinate]
        self.open = self._free_distances() > GAP  # [point or tile, sample]

    def _free_distances(self):
        """Distance from each point along its normal to the next surface, m."""
        starts = self.rays.copy()
        starts[..., :3] += 1e-5 * starts[..., 3:]
        return np.array(trace(self.octree, starts, outspec="L").split(), float).reshape(self.rays.shape[:2])

    def _irradiance(self, rays, parameters):
        """CPU time of rtrace, and the irradiance at these points."""
        before = child_seconds()
        answer = trace(self.octree, rays, irradiance=True, params=parameters)
        return child_seconds() - before, np.array(answer.split(), float).reshape(-1, 3)[:, 0]

    def turn(self, seed):
        start, _ = self._irradiance(self.rays[:1, :1], ["-ab", "0"])
        seconds, found = self._irradiance(self.rays[self.open], self.parameters)
        values = np.zeros(self.open.shape)
        values[self.open] = found
        return Turn(seconds - start, values.mean(1), None)


def methods(task, folder):
    return [Radiance(task, folder, label, parameters) for label, parameters in SETTINGS.items()]
