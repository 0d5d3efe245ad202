"""mitransient on one thread: the transient path tracer of Mitsuba 3, from the receiver to the lamp.

Its receiver is an irradiance meter with a field of view of 90°, its lamp a Lambertian surface; both need an extent.
Standard errors are not among its results. CPU time of rendering; a first pass, which compiles, does not count.
"""

import math
import time

import drjit as dr
import mitsuba as mi
import numpy as np

import gltf_room
from channel_tasks import AREA, EYE, LAMP, SPEED_OF_LIGHT
from with_mitsuba import mesh_of  # also chooses the variant llvm_ad_mono and one thread

import mitransient  # after the choice of the variant, for which it registers what it has

GAP = 1e-4  # m, between ceiling and lamp, floor and receiver


def square(centre, upwards, nested):
    """A black horizontal square of the receiver's area."""
    half, side = math.sqrt(AREA) / 2, 1.0 if upwards else -1.0
    matrix = np.eye(4)
    matrix[:3, :3] = np.array([[half, 0, 0], [0, 0, -half * side], [0, side, 0]]).T
    matrix[:3, 3] = centre + np.array([0.0, GAP * side, 0.0])
    black = {"type": "diffuse", "reflectance": {"type": "spectrum", "value": 0.0}}
    return {"type": "rectangle", "to_world": mi.ScalarTransform4f(matrix.tolist()), "bsdf": black, **nested}


def versions():
    dr.eval(dr.arange(mi.Float, 2))  # loads LLVM
    llvm = ".".join(map(str, dr.detail.llvm_version()))
    return f"{Mitransient.label} with Mitsuba {mi.__version__} ({mi.variant()}, LLVM {llvm})"


class Mitransient:
    """paths: of a turn."""

    label = f"mitransient {mitransient.__version__}"

    def __init__(self, room, bins, paths):
        self.bins, self.paths = bins, paths
        film = {
            "type": "transient_hdr_film",
            "width": 1,
            "height": 1,
            "temporal_bins": bins.count,
            "bin_width_opl": bins.width_ns * 1e-9 * SPEED_OF_LIGHT,
            "start_opl": 0.0,
            "rfilter": {"type": "box"},
        }
        radiance = {"type": "spectrum", "value": 1.0 / (math.pi * AREA)}  # 1 W
        meter = {"type": "irradiancemeter", "sampler": {"type": "independent"}, "film": film}
        scene = {
            "type": "scene",
            "lamp": square(LAMP, False, {"emitter": {"type": "area", "radiance": radiance}}),
            "eye": square(EYE, True, {"sensor": meter}),
        }
        groups = gltf_room.triangles_by_reflectance(gltf_room.read_parts(room))
        for k, (reflectance, triangles) in enumerate(groups.items()):
            scene[f"surfaces_{k}"] = mesh_of(f"surfaces_{k}", triangles, reflectance)
        self.scene = mi.load_dict(scene)
        # All reflections; Russian roulette from the fifth on, as by default.
        self.integrator = mi.load_dict({"type": "transient_path", "max_depth": -1, "temporal_filter": "box"})
        self.turn(0)

    def turn(self, seed):
        """CPU time, h of the compared bins in 1/s, and no errors."""
        begin = time.process_time()
        _, irradiance = self.integrator.render(self.scene, seed=seed, spp=self.paths)
        values = np.array(irradiance, float).ravel()
        dr.sync_thread()
        seconds = time.process_time() - begin
        return seconds, self.bins.compared(values) * AREA / (self.bins.width_ns * 1e-9), None
