"""Rooms from the arrays of a mesh."""

from __future__ import annotations

import numpy as np
import pytest

import lichtmc

SQUARE = [(0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 0, 0)]
HALVES = [(0, 1, 2), (0, 2, 3)]


def test_one_surface_by_default():
    room = lichtmc.Room.from_triangles(SQUARE, HALVES)
    assert repr(room) == "<Room 'triangles': 1 surface, 0 emitters, 0 receivers>"
    surface = room.surfaces[0]
    assert (surface.name, surface.material, surface.reflectance, surface.area) == ("surface_0", "", 0.5, 1.0)
    assert not surface.two_sided
    assert surface.measured
    assert surface.uvs is None
    assert repr(surface) == "<Surface 'surface_0': 1 m², reflectance 0.5, 2 triangles>"


def test_arrays_of_surfaces():
    surface = lichtmc.Room.from_triangles(SQUARE, HALVES, uvs=np.array(SQUARE)[:, [0, 2]]).surfaces[0]
    assert (surface.vertices.shape, surface.vertices.dtype) == ((4, 3), np.float64)
    assert (surface.faces.shape, surface.faces.dtype) == ((2, 3), np.uint32)
    assert (surface.uvs.shape, surface.uvs.dtype) == ((4, 2), np.float64)
    for array in (surface.vertices, surface.faces, surface.uvs):
        assert not array.flags.writeable
    assert np.array_equal(surface.vertices, SQUARE)
    assert np.array_equal(surface.faces, HALVES)
    assert np.array_equal(surface.uvs, np.array(SQUARE)[:, [0, 2]])


@pytest.mark.parametrize("kind", ["int8", "uint8", "int32", "uint32", "int64", "uint64"])
def test_faces_of_any_kind_of_integers(kind):
    assert lichtmc.Room.from_triangles(SQUARE, np.array(HALVES, dtype=kind)).surfaces[0].area == 1.0


def test_vertices_of_any_order_in_memory():
    vertices = np.asfortranarray(np.array(SQUARE, dtype="float32"))
    assert lichtmc.Room.from_triangles(vertices[:, ::1], np.array(HALVES)[::-1]).surfaces[0].area == 1.0


def test_faces_are_divided_into_surfaces_that_have_their_own_vertices():
    vertices = [(9, 9, 9), *SQUARE, (0, 5, 0)]
    faces = [(1, 2, 3), (1, 4, 5), (1, 3, 4)]
    room = lichtmc.Room.from_triangles(
        vertices, faces, [0.2, 0.7], surfaces=[0, 1, 0], names=["floor", "wall"], two_sided=True, source="mesh"
    )
    floor, wall = room.surfaces
    assert (room.source, floor.name, wall.name) == ("mesh", "floor", "wall")
    assert (floor.reflectance, wall.reflectance) == (0.2, 0.7)
    assert (floor.area, wall.area) == (1.0, 2.5)
    assert floor.two_sided
    assert (len(floor.vertices), len(wall.vertices)) == (4, 3)
    assert np.array_equal(wall.vertices[wall.faces[0]], [SQUARE[0], SQUARE[3], (0, 5, 0)])
    assert np.array_equal(floor.vertices[floor.faces[1]], [SQUARE[0], SQUARE[2], SQUARE[3]])


def test_names_by_number():
    room = lichtmc.Room.from_triangles(SQUARE, HALVES, surfaces=[1, 0])
    assert [s.name for s in room.surfaces] == ["surface_0", "surface_1"]


def test_faces_on_a_line_are_left_out():
    room = lichtmc.Room.from_triangles([*SQUARE, (0.5, 0, 0.5)], [*HALVES, (0, 1, 1), (0, 2, 4)])
    assert len(room.surfaces[0].faces) == 2
    room.add_emitter(lichtmc.Isotropic((0.5, 1, 0.5)), 1)
    assert any("2 triangles" in f.text and "no area" in f.text for f in room.check().findings)


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        (([(0, 0, 0), (1, 0, 0)], HALVES), {}, r"vertices has the shape \(2, 3\)"),
        (([(0, 0)], HALVES), {}, r"vertices has the shape \(1, 2\)"),
        (("room.obj", HALVES), {}, "array of vertices is 'room.obj' .allowed: numbers"),
        ((None, HALVES), {}, "array of vertices is None"),
        (([[0, 0, 0], [1, 0], [1, 1, 1]], HALVES), {}, "allowed: numbers"),
        ((SQUARE, [0, 1, 2]), {}, r"faces has the shape \(3,\) .allowed: \(m, 3\)"),
        ((SQUARE, [(0, 1, 2, 3)]), {}, "into triangles"),
        ((SQUARE, []), {}, "array of faces"),
        ((SQUARE, [(0.0, 1.0, 2.0)]), {}, "type of the array of faces is float64"),
        ((SQUARE, [(0, 1, 4)]), {}, r"row 0 of the array of faces is 4 .allowed: 0 to 3"),
        ((SQUARE, [(0, 1, 2), (0, -1, 2)]), {}, "row 1 of the array of faces is -1"),
        (([*SQUARE[:3], (np.nan, 0, 0)], HALVES), {}, "finite numbers"),
        (([*SQUARE[:3], (np.inf, 0, 0)], HALVES), {}, "finite numbers"),
        ((SQUARE, [(0, 1, 1)]), {}, "no triangle with an area"),
        ((SQUARE, HALVES, 1.5), {}, "is 1.5 .allowed: 0 to 1"),
        ((SQUARE, HALVES, np.nan), {}, "is nan .allowed: 0 to 1"),
        ((SQUARE, HALVES, [0.5, 0.6]), {}, r"reflectance has the shape \(2,\) .allowed: \(1,\), one for each surface"),
        ((SQUARE, HALVES, {}), {}, "reflectance is {}"),
        ((SQUARE, HALVES), {"surfaces": [0]}, r"has the shape \(1,\) .allowed: \(2,\)"),
        ((SQUARE, HALVES), {"surfaces": [0, 2]}, "surface of face 1 is 2"),
        ((SQUARE, HALVES), {"surfaces": [1, 1]}, "Surface 0 has no faces"),
        ((SQUARE, HALVES), {"surfaces": [0, -1]}, "surface of face 1 is -1"),
        ((SQUARE, HALVES), {"surfaces": ["a", "b"]}, "allowed: integers"),
        ((SQUARE, HALVES), {"names": ["a", "b"]}, "number of names is 2 .allowed: 1"),
        ((SQUARE, HALVES), {"names": [1]}, "allowed: a text"),
        ((SQUARE, HALVES), {"surfaces": [0, 1], "names": ["a", "a"]}, "two surfaces with the name 'a'"),
        ((SQUARE, HALVES), {"uvs": [(0, 0)]}, r"texture coordinates has the shape \(1, 2\) .allowed: \(4, 2\)"),
        ((SQUARE, HALVES), {"two_sided": 2}, "True or False"),
        ((SQUARE, HALVES), {"source": None}, "source of the room is None"),
    ],
)
def test_wrong_arrays_are_refused(arguments, options, message):
    with pytest.raises(lichtmc.InputError, match=message):
        lichtmc.Room.from_triangles(*arguments, **options)


def test_surfaces_are_added():
    room = lichtmc.Room.from_triangles(SQUARE, HALVES, names="floor")
    room.add_surface("top", np.array(SQUARE) + (0, 1, 0), HALVES, 0.8, material="wood", two_sided=True, measured=False)
    top = room.surfaces[1]
    assert (top.name, top.material, top.reflectance, top.two_sided, top.measured) == ("top", "wood", 0.8, True, False)
    with pytest.raises(lichtmc.InputError, match="already a surface with the name 'top'"):
        room.add_surface("top", SQUARE, HALVES)
    with pytest.raises(lichtmc.InputError, match="name of the surface is 3"):
        room.add_surface(3, SQUARE, HALVES)
    with pytest.raises(lichtmc.InputError, match="allowed: a number"):
        room.add_surface("other", SQUARE, HALVES, "white")
    assert len(room.surfaces) == 2
