"""The three tasks: a room, its lamp, and where the irradiance is wanted."""

import dataclasses
import pathlib

import numpy as np

import gltf_room
import tile_points
from with_lichtmc import lichtmc

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LIVING_ROOM_LAMP = (2.5, 2.2, 2.0)
LIVING_ROOM_POWER = 1000.0  # lm
DESK_HEIGHT = 0.85  # m
SPACING = 0.142  # m


@dataclasses.dataclass
class Lamp:
    """A point lamp: isotropic, or downwards with intensity proportional to cos^exponent of the angle to -Y."""

    position: tuple
    power: float
    exponent: float | None = None


@dataclasses.dataclass
class Task:
    name: str  # word of the command line
    title: str
    room: pathlib.Path
    lamp: Lamp
    options: list  # of lichtmc run, for the room and what is measured
    reflecting: dict  # {reflectance: triangles}
    points: np.ndarray | None = None  # [point, axis], m; normals are +Y. Else tiles:
    tiles: tile_points.TilePoints | None = None

    def __len__(self):
        return len(self.points if self.tiles is None else self.tiles)

    @property
    def weights(self):
        """Of the results in means and rms errors, as lichtmc weights them: areas of tiles; receivers count alike."""
        return np.ones(len(self)) if self.tiles is None else self.tiles.areas


def tiles_of(room, options, folder, surface=None):
    """The tiles that a run of lichtmc has. A few photons: only the geometry is used."""
    lichtmc("run", room, *options, "--photons", 10000, "--estimator", "collision", "--quiet", "-o", folder)
    return tile_points.TilePoints(folder, surface)


def cube(folder):
    """The cube of H. Schulze, Lichtausbreitung in Räumen (2021), figure 3."""
    room, options = ROOT / "scenes/cube_paper.gltf", ["--only", "tiles", "--tile", "0.1"]
    return Task(
        "cube",
        "Cube of edge 1 m, reflectance 0.6, lamp cos⁵ downwards in its centre: 100 tiles of the floor",
        room,
        Lamp((0.5, 0.5, 0.5), 1.0, 5.0),
        options,
        gltf_room.triangles_by_reflectance(gltf_room.read_parts(room)),
        tiles=tiles_of(room, options, folder / "cube_tiles", "floor"),
    )


def furnished_room(folder):
    """The living room with one lamp in place of its own: the room, the options for the lamp, and its parts."""
    room = folder / "living_room_without_lamps.glb"
    gltf_room.write_without_emitters(ROOT / "scenes/living_room.glb", room)
    light = "point:{},{},{}:{:g}lm".format(*LIVING_ROOM_LAMP, LIVING_ROOM_POWER)
    return room, ["--light", light], gltf_room.read_parts(room)


def desk_points(parts):
    """A square grid, centred over the bounds of the room, as far as it lies above the floor."""
    corners = np.concatenate([part.triangles.reshape(-1, 3) for part in parts])
    floor = np.concatenate([part.triangles.reshape(-1, 3) for part in parts if part.node == "floor"])

    def line(axis):
        low, high = corners[:, axis].min(), corners[:, axis].max()
        count = int((high - low) / SPACING)
        at = (low + high) / 2 + SPACING * (np.arange(count) - (count - 1) / 2)
        return at[(at > floor[:, axis].min()) & (at < floor[:, axis].max())]

    z, x = (grid.ravel() for grid in np.meshgrid(line(2), line(0), indexing="ij"))
    return np.stack([x, np.full_like(x, DESK_HEIGHT), z], 1)


def desk(folder):
    room, light, parts = furnished_room(folder)
    points = desk_points(parts)
    table = folder / "desk_points.csv"
    normals = np.tile([0.0, 1.0, 0.0], (len(points), 1))
    np.savetxt(table, np.hstack([points, normals]), "%.9g", ",", header="x,y,z,nx,ny,nz", comments="")
    return Task(
        "points",
        f"Living room, 2228 triangles, one isotropic lamp: {len(points)} points at desk height",
        room,
        Lamp(LIVING_ROOM_LAMP, LIVING_ROOM_POWER),
        [*light, "--receivers", table, "--only", "receivers"],
        gltf_room.triangles_by_reflectance(parts),
        points=points,
    )


def living_room_tiles(folder):
    room, light, parts = furnished_room(folder)
    options = [*light, "--only", "tiles", "--tile", "0.25"]
    tiles = tiles_of(room, options, folder / "living_room_tiles")
    return Task(
        "tiles",
        f"Living room, 2228 triangles, one isotropic lamp: {len(tiles)} tiles of 0.25 m",
        room,
        Lamp(LIVING_ROOM_LAMP, LIVING_ROOM_POWER),
        options,
        gltf_room.triangles_by_reflectance(parts),
        tiles=tiles,
    )


TASKS = {"cube": cube, "points": desk, "tiles": living_room_tiles}
