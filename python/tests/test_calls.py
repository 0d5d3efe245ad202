"""Calls with keywords that a function does not have, or without an argument that it needs."""

from __future__ import annotations

import inspect

import pytest

import lichtmc
from rooms import cuboid

POINT = (1, 1, 1)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda room: lichtmc.Room.cuboid((5, 3, 4), wall=0.5), "Room.cuboid() has no argument 'wall' (allowed: size, "
         "reflectance, floor, ceiling, walls, x0, x1, z0, z1)."),
        (lambda room: lichtmc.Room.cuboid(sizes=POINT), "Room.cuboid() has no argument 'sizes'"),
        (lambda room: lichtmc.Room.cuboid(walls=0.5), "Room.cuboid() needs the argument 'size' (its arguments: size, "),
        (lambda room: lichtmc.Lambert(POINT, m=1), "Lambert() has no argument 'm' (allowed: position, axis, exponent)."),
        (lambda room: lichtmc.Lambert(pos=POINT), "Lambert() has no argument 'pos'"),
        (lambda room: lichtmc.Spot(POINT, half_angle=30), "Spot() has no argument 'half_angle' (allowed: position, axis, "
         "inner_deg, outer_deg)."),
        (lambda room: lichtmc.Isotropic(), "Isotropic() needs the argument 'position' (its arguments: position)."),
        (lambda room: lichtmc.AreaLight(name="x"), "AreaLight() has no argument 'name' (allowed: surface, exponent)."),
        (lambda room: lichtmc.Luminaire("x.ies"), "Luminaire() needs the argument 'position'"),
        (lambda room: lichtmc.Photometry(file="x.ies"), "Photometry() has no argument 'file'"),
        (lambda room: lichtmc.Photometry.from_text(), "Photometry.from_text() needs the argument 'text'"),
        (lambda room: lichtmc.Room.from_gltf("x.glb", axis="z"), "Room.from_gltf() has no argument 'axis'"),
        (lambda room: lichtmc.Room.from_bytes(b"", path="x"), "Room.from_bytes() has no argument 'path'"),
        (lambda room: lichtmc.Room.from_triangles([POINT], triangles=[]), "from_triangles() has no argument 'triangles'"),
        (lambda room: room.add_receivers(POINT, fov=85), "add_receivers() has no argument 'fov' (allowed: positions, "
         "normals, names, half_angle, area, concentrator_index, filter_gain, law, facing, cell_u, cell_v)."),
        (lambda room: room.add_area("desk", center=POINT, u=POINT, v=POINT), "add_area() needs the argument 'corner' (its "
         "arguments: name, corner, u, v, **properties)."),
        (lambda room: room.add_working_plane(), "add_working_plane() needs the argument 'height'"),
        (lambda room: room.add_area_on(name="x"), "add_area_on() needs the argument 'surface'"),
        (lambda room: room.add_surface("x", [POINT]), "add_surface() needs the argument 'faces'"),
        (lambda room: room.add_emitter(lichtmc.Isotropic(POINT), lumens=5), "add_emitter() has no argument 'lumens'"),
        (lambda room: room.set_power("emitter_1"), "set_power() needs the argument 'power'"),
        (lambda room: room.paths(photons=5), "paths() has no argument 'photons' (allowed: count, seed, estimator)."),
        (lambda room: room.paths(other_keywords=5), "paths() has no argument 'other_keywords'"),
    ],
)  # fmt: skip
def test_the_message_names_the_argument(call, message):
    with pytest.raises(TypeError) as caught:
        call(cuboid())
    assert message in str(caught.value)


def test_the_signature_is_that_of_the_documentation():
    assert "other_keywords" not in lichtmc.Room.add_receivers.__nb_signature__[0][0]
    assert "Ellipsis" not in (inspect.getdoc(lichtmc.Room.add_receivers) or "")


def test_a_number_that_is_too_large_is_told():
    with pytest.raises(lichtmc.InputError, match="argument max_time is 1000"):
        lichtmc.simulate(lichtmc.Room.cuboid((1, 1, 1)), max_time=10**400)
