"""One room made in several ways, and the command line: the same digits."""

from __future__ import annotations

import numpy as np
import pytest

import lichtmc
from rooms import DATA, SCENES, command_line, cuboid, numbers

PHOTONS = 20_000


def run(room: lichtmc.Room, engine: str = "embree") -> lichtmc.Tiles:
    return lichtmc.simulate(room, photons=PHOTONS, engine=engine).tiles


def same_light(room: lichtmc.Room) -> lichtmc.Room:
    room.add_emitter(lichtmc.Isotropic((2, 2.25, 2.5)), 1000)
    return room


def from_arrays() -> lichtmc.Room:
    """The surfaces of the cuboid, put together to one mesh and divided again."""
    parts = lichtmc.Room.cuboid((4, 2.5, 5), 0.5, ceiling=0.75).surfaces
    first = np.cumsum([0, *(len(p.vertices) for p in parts[:-1])])
    return same_light(
        lichtmc.Room.from_triangles(
            np.concatenate([p.vertices for p in parts]),
            np.concatenate([p.faces.astype(int) + n for p, n in zip(parts, first)]),
            [p.reflectance for p in parts],
            surfaces=np.repeat(np.arange(6), [len(p.faces) for p in parts]),
            names=[p.name for p in parts],
            uvs=np.concatenate([p.uvs for p in parts]),
        )
    )


def surface_by_surface() -> lichtmc.Room:
    room = lichtmc.Room()
    for part in lichtmc.Room.cuboid((4, 2.5, 5), 0.5, ceiling=0.75).surfaces:
        room.add_surface(part.name, part.vertices, part.faces, part.reflectance, uvs=part.uvs)
    return same_light(room)


@pytest.mark.parametrize("engine", ["cuboid", "embree"])
@pytest.mark.parametrize("make", [from_arrays, surface_by_surface])
def test_arrays_give_the_digits_of_the_cuboid(make, engine):
    expected, tiles = run(cuboid(), engine), run(make(), engine)
    for name in ("irradiance", "standard_error", "area", "position"):
        assert np.array_equal(getattr(tiles, name), getattr(expected, name))


def test_the_command_line_gives_the_same_digits(tmp_path):
    file = tmp_path / "room.glb"
    command_line(
        "cuboid", "--size", 4, 2.5, 5, "--reflectance", 0.5, "--ceiling", 0.75, "--light", "point:2,2.25,2.5:1000lm",
        "-o", file,
    )  # fmt: skip
    command_line(
        "run", file, "--photons", PHOTONS, "--engine", "embree", "--estimator", "collision", "--no-report", "--no-images",
        "--quiet", "-o", tmp_path / "out",
    )  # fmt: skip
    irradiance = numbers(tmp_path / "out" / "tiles.csv", "irradiance")
    error = numbers(tmp_path / "out" / "tiles.csv", "standard_error")
    written = tmp_path / "written.glb"
    cuboid().write_gltf(written)
    for room in (
        lichtmc.Room.from_gltf(file),
        lichtmc.Room.from_bytes(file.read_bytes()),
        lichtmc.Room.from_gltf(written),
        cuboid(),
        from_arrays(),
    ):
        tiles = run(room)
        assert tiles.irradiance.tolist() == irradiance, room.source
        assert tiles.standard_error.tolist() == error, room.source


def test_options_of_reading_have_the_digits_of_the_command_line(tmp_path):
    file = SCENES / "l_room.gltf"
    command_line(
        "run", file, "--photons", PHOTONS, "--estimator", "collision", "--no-report", "--no-images", "--quiet",
        "--light", "lambert:0.5,0.8,0.5:0,-1,0:5:500lm", "--light", "point:0.5,0.7,0.25:100lm", "--max-reflectance", 0.6,
        "--maintenance-factor", 0.8, "--scale", 0.9, "-o", tmp_path / "out",
    )  # fmt: skip
    room = lichtmc.Room.from_gltf(file, scale=0.9)
    room.limit_reflectance(0.6)
    room.add_emitter(lichtmc.Lambert((0.5, 0.8, 0.5), exponent=5), 500)
    room.add_emitter(lichtmc.Isotropic((0.5, 0.7, 0.25)), 100)
    room.set_maintenance_factor(0.8)
    tiles = lichtmc.simulate(room, photons=PHOTONS).tiles
    assert tiles.irradiance.tolist() == numbers(tmp_path / "out" / "tiles.csv", "irradiance")


def test_luminaires_and_receivers_have_the_digits_of_the_command_line(tmp_path):
    lamp = DATA / "luminaires" / "c_skew.ies"
    receivers = tmp_path / "receivers.csv"
    receivers.write_text("name,x,y,z,nx,ny,nz,area,fov\na,1,1,1,0,1,0,1e-4,80\nb,2,1,1,0,1,0,1e-4,60\n", encoding="utf-8")
    room = lichtmc.Room.cuboid((4, 2.5, 5), 0.5)
    room.write_gltf(tmp_path / "room.glb")
    command_line(
        "run", tmp_path / "room.glb", "--photons", PHOTONS, "--estimator", "collision", "--receiver-walk", "two-way",
        "--light", f"ies:{lamp}:2,2.25,2.5:0.5,-1,0:30:lm=1500", "--light", f"ies:{lamp}:1,2,1",
        "--receivers", receivers, "--grid", 0.75, "--grid-spacing", 1, "--no-report", "--no-images", "--quiet",
        "-o", tmp_path / "out",
    )  # fmt: skip
    room.add_emitter(lichtmc.Luminaire(lamp, (2, 2.25, 2.5), (0.5, -1, 0), rotation_deg=30, lumens=1500))
    room.add_emitter(lichtmc.Luminaire(lichtmc.Photometry(lamp), (1, 2, 1)))
    room.read_receivers(receivers)
    room.add_receiver_grid(0.75, 1)
    again = room.copy()
    result = lichtmc.simulate(room, photons=PHOTONS, receiver_walk="two-way")
    assert result.tiles.irradiance.tolist() == numbers(tmp_path / "out" / "tiles.csv", "irradiance")
    assert result.receivers.irradiance.tolist() == numbers(tmp_path / "out" / "receivers.csv", "irradiance")
    assert [e.name for e in again.emitters] == ["c_skew", "c_skew_2"]


def test_receivers_from_arrays_have_the_digits_of_a_table(tmp_path):
    receivers = tmp_path / "receivers.csv"
    receivers.write_text("name,x,y,z,nx,ny,nz,area,fov\na,1,1,1,0,1,0,1e-4,80\nb,2,1,1,0,1,0,1e-4,60\n", encoding="utf-8")
    one, other = cuboid(), cuboid()
    one.read_receivers(receivers)
    other.add_receivers([(1, 1, 1), (2, 1, 1)], names=["a", "b"], area=1e-4, half_angle=[80, 60])
    a, b = (lichtmc.simulate(room, photons=PHOTONS, only="receivers").receivers for room in (one, other))
    assert np.array_equal(a.irradiance, b.irradiance)
    assert np.array_equal(a.gain, b.gain)
