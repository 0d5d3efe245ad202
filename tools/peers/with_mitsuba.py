"""Mitsuba 3 on one thread: its path integrator, called with rays that leave the points in cosine distribution.

The irradiance is the direct light by a sample of the lamp, plus pi times the mean radiance along these rays. CPU time
of rendering: a first pass, which compiles, does not count, nor do the random points on tiles, which numpy makes.
"""

import math
import time

import drjit as dr
import mitsuba as mi
import numpy as np

from estimates import Turn

mi.set_variant("llvm_ad_mono")
dr.set_thread_count(1)


class CosineLamp(mi.Emitter):
    """A point lamp with intensity proportional to cos^exponent of the angle to -Y; Mitsuba has none."""

    def __init__(self, props):
        super().__init__(props)
        self.position = mi.Point3f([float(props[axis]) for axis in "xyz"])
        self.exponent = float(props["exponent"])
        self.axial = float(props["power"]) * (self.exponent + 1) / (2 * math.pi)  # intensity on the axis
        self.m_flags = +mi.EmitterFlags.DeltaPosition

    def sample_direction(self, it, sample, active=True):
        record = dr.zeros(mi.DirectionSample3f, dr.width(it.p))
        record.p = self.position
        record.delta = True
        record.emitter = mi.EmitterPtr(self)
        record.pdf = 1.0
        offset = self.position - it.p
        record.dist = dr.norm(offset)
        record.d = offset / record.dist
        intensity = self.axial * dr.power(dr.maximum(record.d.y, 0.0), self.exponent)
        return record, mi.Spectrum(intensity / dr.square(record.dist)) & active

    def pdf_direction(self, it, ds, active=True):
        return mi.Float(0.0)

    def eval(self, si, active=True):
        return mi.Spectrum(0.0)


mi.register_emitter("cosine_lamp", CosineLamp)


def mesh_of(name, triangles, reflectance):
    diffuse = {"type": "diffuse", "reflectance": {"type": "spectrum", "value": reflectance}}
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict({"type": "twosided", "nested": diffuse})
    mesh = mi.Mesh(name, 3 * len(triangles), len(triangles), properties)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = triangles.astype(np.float32).ravel()
    parameters["faces"] = np.arange(3 * len(triangles), dtype=np.uint32)
    parameters.update()
    return mesh


def scene_of(task):
    lamp = task.lamp
    if lamp.exponent is None:
        intensity = {"type": "spectrum", "value": lamp.power / (4 * math.pi)}
        emitter = {"type": "point", "position": list(lamp.position), "intensity": intensity}
    else:
        emitter = {"type": "cosine_lamp", "exponent": lamp.exponent, "power": lamp.power}
        emitter |= dict(zip("xyz", lamp.position))
    scene = {"type": "scene", "lamp": emitter}
    for k, (reflectance, triangles) in enumerate(task.reflecting.items()):
        scene[f"surfaces_{k}"] = mesh_of(f"surfaces_{k}", triangles, reflectance)
    return mi.load_dict(scene)


def columns(array, kind):
    return kind(*[mi.Float(np.ascontiguousarray(column, np.float32)) for column in array.reshape(-1, 3).T])


class Mitsuba:
    """samples: paths of each point or tile in a pass; passes: of a turn."""

    label = f"Mitsuba {mi.__version__}, path"

    def __init__(self, task, samples, passes):
        self.task, self.samples, self.passes = task, samples, passes
        self.scene = scene_of(task)
        self.integrator = mi.load_dict({"type": "path", "max_depth": -1})
        self.random = np.random.default_rng(1)
        self._pass(0)

    def _points(self):
        """Points and normals of a pass: [point or tile, sample, axis]."""
        if self.task.tiles is not None:
            return self.task.tiles.sample(self.samples, self.random)
        points = np.repeat(self.task.points[:, None], self.samples, 1)
        return points, np.broadcast_to(np.array([0.0, 1.0, 0.0]), points.shape)

    def _interaction(self, points, normals):
        found = dr.zeros(mi.SurfaceInteraction3f, points[..., 0].size)
        found.p, found.n = columns(points, mi.Point3f), columns(normals, mi.Normal3f)
        found.sh_frame = mi.Frame3f(found.n)
        dr.eval(found)
        return found

    def _direct(self, at):
        """Light of the lamp; one lamp of no extent, so that the sample is exact."""
        sample, weight = self.scene.sample_emitter_direction(at, mi.Point2f(0.5), True)
        return weight[0] * dr.maximum(dr.dot(sample.d, at.n), 0.0)

    def _pass(self, seed):
        """CPU time, and sums of the samples and of their squares for each point or tile."""
        count = len(self.task)
        points, normals = self._points()
        every = self._interaction(points, normals)
        # Receivers do not move: their direct light is the same in all samples.
        still = None if self.task.tiles is not None else self._interaction(points[:, 0], normals[:, 0])
        begin = time.process_time()
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(seed, count * self.samples)
        direction = every.sh_frame.to_world(mi.warp.square_to_cosine_hemisphere(sampler.next_2d()))
        radiance, _, _ = self.integrator.sample(self.scene, sampler, mi.RayDifferential3f(every.spawn_ray(direction)))
        score = math.pi * radiance[0]
        if still is None:
            score += self._direct(every)
        group = dr.arange(mi.UInt32, count * self.samples) // self.samples
        sums = [dr.zeros(mi.Float, count) for _ in range(2)]
        dr.scatter_reduce(dr.ReduceOp.Add, sums[0], score, group)
        dr.scatter_reduce(dr.ReduceOp.Add, sums[1], dr.square(score), group)
        dr.eval(sums)
        exact = self._direct(still) if still is not None else dr.zeros(mi.Float, count)
        dr.eval(exact)
        dr.sync_thread()
        seconds = time.process_time() - begin
        return seconds, np.array(sums[0], float), np.array(sums[1], float), np.array(exact, float)

    def turn(self, seed):
        done = [self._pass(seed * self.passes + k) for k in range(self.passes)]
        count = self.samples * self.passes
        seconds = np.median([each[0] for each in done]) * self.passes
        mean = np.sum([each[1] for each in done], 0) / count
        variance = np.maximum(np.sum([each[2] for each in done], 0) / count - mean**2, 0.0) * count / (count - 1)
        return Turn(seconds, mean + done[0][3], np.sqrt(variance / count))


def methods(task):
    samples, passes = {"cube": (512, 30), "points": (256, 30), "tiles": (64, 50)}[task.name]
    return [Mitsuba(task, samples, passes)]
