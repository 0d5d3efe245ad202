"""Calculation areas of a room."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import lichtmc
from rooms import DATA, VERTICES, command_line, cuboid, numbers


def test_areas_are_laid_out_at_once():
    room = cuboid()
    assert room.add_area("desk", (1, 0.75, 1), (1.6, 0, 0), (0, 0, 0.8), role="task", target_lx=500) == "desk"
    area = room.areas[0]
    assert (area.name, area.role, area.quantity, area.target_lx) == ("desk", "task", "horizontal", 500)
    assert area.target_uniformity is None
    assert area.points == area.columns * area.rows == len(room.receivers)
    assert area.position.shape == (area.points, 3)
    assert np.all(area.position[:, 1] == 0.75)
    assert area.normal.tolist() == [0, 1, 0]
    assert area.left_out == {}
    assert area.margin == 0
    assert area.text.startswith("Area 'desk': ")
    assert repr(area) == f"<{area.text}>"
    assert isinstance(area.notes, list)
    assert "1 area" in repr(room)


def test_what_an_area_leaves_out_is_told(recwarn):
    room = cuboid()
    room.add_area("inner", (1, 0.75, 1), (1.6, 0, 0), (0, 0, 0.8))
    room.add_area("asked for", (0, 0.75, 0), (1.6, 0, 0), (0, 0, 0.8), margin=0.5)
    room.add_area("task", (0, 0.75, 0), (1.6, 0, 0), (0, 0, 0.8), role="task")
    room.add_working_plane(0.75)
    room.add_area_on("floor")
    assert not recwarn.list
    told = "The usual margin of 0.5 m from walls leaves 1.1 m × 0.3 m of its 1.6 m × 0.8 m."
    with pytest.warns(lichtmc.RoomWarning, match="Area 'desk': .* Give role='task' or margin=0") as caught:
        room.add_area("desk", (0, 0.75, 0), (1.6, 0, 0), (0, 0, 0.8))
    assert told in str(caught[0].message)
    assert caught[0].filename == __file__
    with pytest.warns(lichtmc.RoomWarning, match="5 points outside the rooms.* check its place") as caught:
        room.add_area("half", (-0.5, 0.8, 1), (1, 0, 0), (0, 0, 0.5), spacing=0.1, role="task")
    assert "margin=0" not in str(caught[0].message)
    areas = {area.name: area for area in room.areas}
    assert areas["desk"].notes == [told] and areas["desk"].left_out == {}
    assert told in repr(areas["desk"])
    result = lichtmc.simulate(room, photons=1000, only="receivers")
    assert told[:-1] in repr(result.areas["desk"])
    assert "; left out: 25 points outside the rooms" in repr(result.areas["half"])


def test_warnings_may_be_errors():
    room = cuboid()
    with warnings.catch_warnings():
        warnings.simplefilter("error", lichtmc.RoomWarning)
        with pytest.raises(lichtmc.RoomWarning):
            room.add_area("desk", (0, 0.75, 0), (1.6, 0, 0), (0, 0, 0.8))


def test_properties():
    room = cuboid()
    room.add_area(
        "faces", (1, 1.2, 1), (2, 0, 0), (0, 0, 2), quantity="semicylindrical", direction=(0, 0, 1), spacing=0.5,
        target_uniformity=0.6, margin=0,
    )  # fmt: skip
    room.add_area("cells", (1, 1, 1), (2, 0, 0), (0, 0, 2), cells=True, role=None)
    faces, cells = room.areas
    assert (faces.quantity, faces.columns, faces.target_uniformity) == ("semicylindrical", 4, 0.6)
    assert room.receivers.law[0] == "semicylindrical"
    assert cells.role == ""


def test_working_planes_and_areas_on_surfaces():
    room = cuboid()
    assert room.add_working_plane(0.75) == ["plane"]
    assert room.add_working_plane(0.8, 1.0, name="middle", spacing=0.5) == ["middle"]
    assert room.add_area_on("floor") == ["floor"]
    assert room.add_area_on("wall_x*", name="side", margin=0.25) == ["side_1", "side_2"]
    plane, middle, floor, *sides = room.areas
    assert (plane.margin, middle.margin, floor.margin, sides[0].margin) == (0.5, 1.0, 0, 0.25)
    assert plane.position[:, 0].min() > 0.5
    assert middle.position[:, 0].min() > 1.0
    assert floor.quantity == "normal"
    assert sides[0].normal.tolist() == [1, 0, 0]


def test_points_are_receivers_whatever_is_added_when():
    room = cuboid()
    room.add_receivers((1, 1, 1), names="first")
    room.add_working_plane(0.75)
    room.add_receivers([(2, 1, 1), (3, 1, 1)], names=["second", "third"])
    room.add_area("desk", (1, 0.75, 1), (1, 0, 0), (0, 0, 1))
    room.add_receiver_grid(1.0, 2.0)
    receivers = room.receivers
    assert receivers.names[:3] == ["first", "second", "third"]
    assert receivers.names[3].startswith("grid_")
    for area in room.areas:
        assert np.array_equal(receivers.position[area.receivers], area.position)
        assert receivers.names[area.receivers.start].startswith(area.name + "_")
    result = lichtmc.simulate(room, photons=5000, only="receivers")
    for area in room.areas:
        found = result.areas[area.name]
        assert found.points == area.points
        assert float(found.mean) == pytest.approx(result.receivers.irradiance[area.receivers].mean())


def test_the_order_of_calls_does_not_change_digits():
    one, other = cuboid(), cuboid()
    one.add_receivers([(1, 1, 1), (2, 1, 1)], names=["a", "b"])
    one.add_working_plane(0.75)
    other.add_working_plane(0.75)
    other.add_receivers([(1, 1, 1), (2, 1, 1)], names=["a", "b"])
    a = lichtmc.simulate(one, photons=5000, only="receivers")
    b = lichtmc.simulate(other, photons=5000, only="receivers")
    assert np.array_equal(a.receivers.irradiance, b.receivers.irradiance)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda room: room.add_area("desk", (1, 1), (1, 0, 0), (0, 0, 1)), "corner of the area has the shape"),
        (lambda room: room.add_area("desk", (1, 1, 1), (1, 0, 0), (2, 0, 0)), "area in m²"),
        (lambda room: room.add_area("desk", (9, 1, 9), (1, 0, 0), (0, 0, 1)), "desk"),
        (lambda room: room.add_area("", (1, 1, 1), (1, 0, 0), (0, 0, 1)), "no name"),
        (lambda room: room.add_area(1, (1, 1, 1), (1, 0, 0), (0, 0, 1)), "name of the area is 1"),
        (lambda room: room.add_area("a", (1, 1, 1), (1, 0, 0), (0, 0, 1), colour="red"), "'colour' .* not known"),
        (lambda room: room.add_area("a", (1, 1, 1), (1, 0, 0), (0, 0, 1), spacing=0), "spacing"),
        (lambda room: room.add_area("a", (1, 1, 1), (1, 0, 0), (0, 0, 1), spacing="fine"), "spacing of the area is 'fine'"),
        (lambda room: room.add_area("a", (1, 1, 1), (1, 0, 0), (0, 0, 1), quantity="round"), "'cylindrical'"),
        (lambda room: room.add_area("a", (1, 1, 1), (1, 0, 0), (0, 0, 1), cells="yes"), "True or False"),
        (lambda room: room.add_area("a", (1, 1, 1), (1, 0, 0), (0, 0, 1), target_uniformity=60), "60"),
        (lambda room: room.add_area("a", (1, 1, 1), (1, 0, 0), (0, 0, 1), quantity="semicylindrical"), "direction"),
        (lambda room: room.add_working_plane("desk"), "height of the working plane is 'desk'"),
        (lambda room: room.add_working_plane(0.75, 5), "margin"),
        (lambda room: room.add_working_plane(5), "plane"),
        (lambda room: room.add_area_on("table"), "'table'"),
        (lambda room: room.add_area_on(1), "surface of the area is 1"),
    ],
)
def test_wrong_areas_are_refused(change, message):
    room = cuboid()
    with pytest.raises(lichtmc.InputError, match=message):
        change(room)
    assert (room.areas, len(room.receivers)) == ([], 0)


def test_two_areas_of_one_name_are_refused():
    room = cuboid()
    room.add_working_plane(0.75)
    with pytest.raises(lichtmc.InputError, match="two calculation areas with the name 'plane'"):
        room.add_working_plane(0.85)
    assert len(room.areas) == 1


def test_areas_of_the_command_line_have_the_same_digits(tmp_path):
    file = DATA / "office.glb"
    command_line(
        "run", file, "--photons", 4000, "--only", "receivers", "--receiver-walk", "next-event", "--no-report", "--quiet",
        "--estimator", "collision", "--plane", "0.75:0.4:role=task", "--area", "desk:1,0.9,-2:1,0,0:0,0,1",
        "-o", tmp_path / "out",
    )  # fmt: skip
    room = lichtmc.Room.from_gltf(file)
    room.add_area("desk", (1, 0.9, -2), (1, 0, 0), (0, 0, 1))
    room.add_working_plane(0.75, 0.4, role="task")
    result = lichtmc.simulate(room, photons=4000, only="receivers", receiver_walk="next-event")
    assert result.receivers.irradiance.tolist() == numbers(tmp_path / "out" / "receivers.csv", "irradiance")
    assert result.receivers.standard_error.tolist() == numbers(tmp_path / "out" / "receivers.csv", "standard_error")


def file_with_an_area() -> bytes:
    """A .gltf with a face that is a calculation area, and no emitter."""
    import base64
    import json

    corners = np.array([*VERTICES, (1, 0.75, 1), (1, 0.75, 2), (3, 0.75, 2), (3, 0.75, 1)], dtype="<f4")
    walls = [0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3]
    indices = np.array([*walls, 8, 9, 10, 8, 10, 11], dtype="<u4")
    data = corners.tobytes() + indices.tobytes()
    accessor = {"bufferView": 1, "componentType": 5125, "type": "SCALAR"}
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"name": "walls", "mesh": 0}, {"name": "desk", "mesh": 1, "extras": {"calculation_area": "task"}}],
        "meshes": [
            {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]},
            {"primitives": [{"attributes": {"POSITION": 0}, "indices": 2}]},
        ],
        "accessors": [
            {
                "bufferView": 0, "componentType": 5126, "count": 12, "type": "VEC3",
                "min": corners.min(axis=0).tolist(), "max": corners.max(axis=0).tolist(),
            },  # fmt: skip
            {**accessor, "count": 36},
            {**accessor, "byteOffset": 144, "count": 6},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": corners.nbytes},
            {"buffer": 0, "byteOffset": corners.nbytes, "byteLength": indices.nbytes},
        ],
        "buffers": [
            {
                "byteLength": len(data),
                "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode(),
            }
        ],
    }
    return json.dumps(document).encode()


def test_areas_of_a_file_are_laid_out_when_they_are_needed():
    room = lichtmc.Room.from_bytes(file_with_an_area(), reflectance={"walls": 0.5})
    assert "1 area" in repr(room)
    room.add_emitter(lichtmc.Isotropic((2, 2, 2.5)), 1000)
    result = lichtmc.simulate(room, photons=2000, only="receivers")
    assert list(result.areas) == ["desk"]
    assert [area.name for area in room.areas] == ["desk"]
    assert len(room.receivers) == result.areas["desk"].points
    fresh = lichtmc.Room.from_bytes(file_with_an_area())
    fresh.add_working_plane(0.8)
    assert [area.name for area in fresh.areas] == ["desk", "plane"]
