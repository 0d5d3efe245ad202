"""Rooms: how they are read, made, copied, changed and written."""

from __future__ import annotations

import copy
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import lichtmc
from rooms import DATA, ENVIRONMENT, SCENES, cuboid, of_others


def test_cuboid_has_six_named_walls_with_their_reflectances():
    room = lichtmc.Room.cuboid((4, 2.5, 5), 0.5, floor=0.2, ceiling=0.8, walls=0.6, x1=0.1)
    assert {s.name: s.reflectance for s in room.surfaces} == {
        "floor": 0.2, "ceiling": 0.8, "wall_x0": 0.6, "wall_x1": 0.1, "wall_z0": 0.6, "wall_z1": 0.6
    }  # fmt: skip
    assert [s.area for s in room.surfaces] == [20.0, 20.0, 12.5, 12.5, 10.0, 10.0]
    assert room.source == "cuboid"
    assert (room.unit, room.irradiance_unit) == ("lm", "lx")
    assert (room.emitters, room.areas, room.ignored, len(room.receivers)) == ([], [], [], 0)
    assert repr(room) == "<Room 'cuboid': 6 surfaces, 0 emitters, 0 receivers>"


@pytest.mark.parametrize("size", [np.array([4, 2.5, 5]), (4, 2.5, 5), np.array([4, 2.5, 5], dtype="float32")])
def test_sizes_are_any_three_numbers(size):
    assert lichtmc.Room.cuboid(size).surfaces[0].area == 20.0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((5,), r"size of the cuboid has the shape \(1,\) \(allowed: \(3,\)\)"),
        (((1, 2),), "shape"),
        (((1, 0, 3),), "above 0"),
        (((1, np.nan, 3),), "finite number above 0"),
        ((("1", "2", "3"),), "allowed: numbers"),
        (((1, 2, 3), 1.5), "is 1.5 .allowed: 0 to 1"),
        (((1, 2, 3), "white"), "reflectance is 'white' .allowed: a number"),
        (((1, 2, 3), None), "reflectance is None"),
    ],
)
def test_wrong_cuboids_are_refused(arguments, message):
    with pytest.raises(lichtmc.InputError, match=message):
        lichtmc.Room.cuboid(*arguments)


def test_errors_are_value_errors():
    with pytest.raises(ValueError, match=r"none.glb \(No such file or directory\)\. Give the name of a .gltf or .glb file\.$"):
        lichtmc.Room.from_gltf("none.glb")
    with pytest.raises(lichtmc.InputError, match="name of a file"):
        lichtmc.Room.from_gltf(5)
    with pytest.raises(lichtmc.InputError, match="from_bytes"):
        lichtmc.Room.from_gltf(b"glTF")


def test_files_are_read_by_str_and_path():
    file = SCENES / "living_room.glb"
    room = lichtmc.Room.from_gltf(file)
    assert room.source == str(file)
    assert repr(room) == repr(lichtmc.Room.from_gltf(str(file)))
    assert len(room.surfaces) > 10
    assert len(room.emitters) > 0


def test_options_of_reading():
    file = DATA / "office.glb"
    plain = lichtmc.Room.from_gltf(file)
    small = lichtmc.Room.from_gltf(file, scale=0.1, unit="W", without="chair*", reflectance={"walls": 0.25})
    assert small.unit == "W"
    assert small.irradiance_unit == "W/m^2"
    assert len(small.surfaces) < len(plain.surfaces)
    assert sum(s.area for s in small.surfaces) < 0.0101 * sum(s.area for s in plain.surfaces)
    assert {s.reflectance for s in small.surfaces if s.material == "walls"} == {0.25}
    assert any("interpreted in W" in text for text in small.overrides)
    assert any("multiplied by 0.1" in text for text in small.overrides)
    turned = lichtmc.Room.from_gltf(file, up="z")
    assert np.array_equal(turned.surfaces[0].vertices[:, 1], plain.surfaces[0].vertices[:, 2])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"scale": 0}, "scale is 0"),
        ({"scale": "cm"}, "scale is 'cm' .allowed: a number"),
        ({"up": "x"}, "'y' or 'z'"),
        ({"unit": "lux"}, "'lm' for luminous flux"),
        ({"scene": "none"}, "none"),
        ({"scene": 1}, "scene is 1 .allowed: a text"),
        ({"without": "nothing like this"}, "nothing like this"),
        ({"without": 3}, "list of what is left out"),
        ({"uv_set": -1}, "UV set is -1"),
        ({"uv_set": 1.5}, "UV set is 1.5"),
        ({"reflectance": 0.5}, "a dict"),
        ({"reflectance": {"walls": 2}}, "0 to 1"),
        ({"reflectance": {"walls": "x"}}, "allowed: a number"),
        ({"reflectance": {1: 0.5}}, "name in reflectance"),
        ({"follow_links": "yes"}, "True or False"),
    ],
)
def test_wrong_options_are_refused(options, message):
    file = DATA / "office.glb"
    with pytest.raises(lichtmc.InputError, match=message):
        lichtmc.Room.from_gltf(file, **options)


def test_bytes_are_read_as_the_file():
    file = DATA / "office.glb"
    data = file.read_bytes()
    from_file = lichtmc.Room.from_gltf(file)
    for content in (data, bytearray(data), memoryview(data)):
        room = lichtmc.Room.from_bytes(content, name="office")
        assert room.source == "office"
        assert [s.name for s in room.surfaces] == [s.name for s in from_file.surfaces]
        assert np.array_equal(room.surfaces[3].vertices, from_file.surfaces[3].vertices)
        assert [e.power for e in room.emitters] == [e.power for e in from_file.emitters]
    assert lichtmc.Room.from_bytes(data, scale=2).surfaces[0].area == pytest.approx(4 * from_file.surfaces[0].area)


def test_gltf_texts_are_read_from_bytes():
    room = lichtmc.Room.from_bytes((SCENES / "l_room.gltf").read_bytes())
    assert room.source == "bytes"
    assert len(room.surfaces) > 0


@pytest.mark.parametrize(
    ("data", "message"),
    [("room.glb", r"of the type str .*Room.from_gltf\(\)"), (b"", "0 bytes"), (b"text", "not valid glTF"), (3, "type int")],
)
def test_wrong_bytes_are_refused(data, message):
    with pytest.raises(lichtmc.InputError, match=message):
        lichtmc.Room.from_bytes(data)


def test_bytes_that_name_files_are_refused():
    folder = of_others("real", "webxr_garage")
    file = next(folder.rglob("*.gltf"))
    with pytest.raises(lichtmc.InputError, match="have no folder .allowed: embedded data"):
        lichtmc.Room.from_bytes(file.read_bytes())


@pytest.mark.parametrize("name", ["godot_living_room.glb", "bevy_CornellBox.glb", "playcanvas_house.glb"])
def test_files_of_others_are_read_from_bytes_too(name):
    file = of_others("real", name)
    assert len(lichtmc.Room.from_bytes(file.read_bytes()).surfaces) == len(lichtmc.Room.from_gltf(file).surfaces)


@pytest.mark.parametrize("ending", ["glb", "gltf"])
def test_written_rooms_are_read_back(tmp_path, ending):
    room = cuboid()
    room.add_emitter(lichtmc.Spot((1, 2, 1), inner_deg=10, outer_deg=30), 200, name="spot")
    room.add_receivers([(1, 1, 1), (2, 1, 2)], names=["a", "b"])
    file = tmp_path / f"room.{ending}"
    room.write_gltf(file)
    again = lichtmc.Room.from_gltf(file)
    assert [s.name for s in again.surfaces] == [s.name for s in room.surfaces]
    assert np.array_equal(again.surfaces[1].vertices, room.surfaces[1].vertices)
    assert [e.name for e in again.emitters] == ["emitter_1", "spot"]
    assert again.receivers.names == ["a", "b"]
    assert again.unit == "lm"


def test_files_with_other_endings_are_not_written(tmp_path):
    with pytest.raises(lichtmc.InputError, match="allowed: .glb or .gltf"):
        cuboid().write_gltf(tmp_path / "room.obj")
    with pytest.raises(lichtmc.InputError, match="file to write is 3"):
        cuboid().write_gltf(3)


def test_copies_are_rooms_of_their_own():
    room = cuboid()
    for other in (room.copy(), copy.copy(room), copy.deepcopy(room)):
        other.set_reflectance("floor", 0.1)
        other.add_emitter(lichtmc.Isotropic((1, 1, 1)), 5)
        assert (other.surfaces[0].reflectance, len(other.emitters)) == (0.1, 2)
    assert (room.surfaces[0].reflectance, len(room.emitters)) == (0.5, 1)


def test_results_and_views_keep_the_room_as_it_was():
    room = cuboid()
    result = lichtmc.simulate(room, photons=2000)
    floor = room.surfaces[0]
    corners = floor.vertices.copy()
    room.set_reflectance("floor", 0.1)
    room.add_surface("table", [(1, 0.7, 1), (1, 0.7, 2), (2, 0.7, 2)], [(0, 1, 2)])
    assert result.room.surfaces[0].reflectance == 0.5
    assert len(result.room.surfaces) == 6
    assert floor.reflectance == 0.5
    assert np.array_equal(floor.vertices, corners)
    changed = result.room
    changed.add_emitter(lichtmc.Isotropic((1, 1, 1)), 5)
    assert len(result.room.emitters) == 1


def test_a_view_keeps_the_surface_alive():
    vertices = cuboid().surfaces[1].vertices
    assert vertices[:, 1].tolist() == [2.5] * 4


def test_preparation_is_dropped_when_surfaces_change():
    room = cuboid()
    before = lichtmc.simulate(room, photons=5000)
    room.add_surface("table", [(1, 0.7, 1), (1, 0.7, 4), (3, 0.7, 4), (3, 0.7, 1)], [(0, 1, 2), (0, 2, 3)])
    with_table = lichtmc.simulate(room, photons=5000)
    assert len(with_table.tiles) > len(before.tiles)
    fresh = cuboid()
    fresh.add_surface("table", [(1, 0.7, 1), (1, 0.7, 4), (3, 0.7, 4), (3, 0.7, 1)], [(0, 1, 2), (0, 2, 3)])
    assert np.array_equal(with_table.tiles.irradiance, lichtmc.simulate(fresh, photons=5000).tiles.irradiance)


def test_changes_without_surfaces_keep_the_digits_of_a_fresh_room():
    room = cuboid()
    lichtmc.simulate(room, photons=2000)
    room.set_reflectance("floor", 0.9)
    room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 300)
    fresh = cuboid()
    fresh.set_reflectance("floor", 0.9)
    fresh.add_emitter(lichtmc.Isotropic((1, 1, 1)), 300)
    assert np.array_equal(
        lichtmc.simulate(room, photons=5000).tiles.irradiance, lichtmc.simulate(fresh, photons=5000).tiles.irradiance
    )


def test_many_changes_of_a_large_room_copy_nothing():
    n = 300_000
    vertices = np.random.default_rng(1).random((n, 3))
    room = lichtmc.Room.from_triangles(vertices, np.arange(n).reshape(-1, 3))
    address = room.surfaces[0].vertices.ctypes.data
    for k in range(1000):
        room.add_emitter(lichtmc.Isotropic((0.5, 0.5, 0.5)), 1)
        room.add_receivers((0.1, 0.1, 0.1))
    room.set_reflectance("*", 0.25)
    assert room.surfaces[0].vertices.ctypes.data == address
    assert (len(room.emitters), len(room.receivers)) == (1000, 1000)


def test_a_failed_change_leaves_the_room_as_it_was():
    room = cuboid()
    room.add_receivers((1, 1, 1))
    before = (repr(room), room.overrides, [s.reflectance for s in room.surfaces])
    for change in (
        lambda: room.add_emitter(lichtmc.Isotropic((1, 1, 1)), -1),
        lambda: room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 1, unit="W"),
        lambda: room.add_receivers([(1, 1, 1), (np.nan, 1, 1)]),
        lambda: room.add_surface("floor", np.eye(3), [(0, 1, 2)]),
        lambda: room.add_surface("new", np.eye(3), [(0, 1, 2)], 1.5),
        lambda: room.add_area("desk", (9, 9, 9), (1, 0, 0), (0, 0, 1)),
        lambda: room.set_reflectance("wall*", 2),
        lambda: room.set_reflectance("none", 0.5),
        lambda: room.measure_only(["floor", "none"]),
        lambda: room.set_delay("none", 1e-9),
        lambda: room.set_maintenance_factor(0),
        lambda: room.limit_reflectance(-1),
    ):
        with pytest.raises(lichtmc.InputError):
            change()
    assert (repr(room), room.overrides, [s.reflectance for s in room.surfaces]) == before
    assert all(s.measured for s in room.surfaces)


def test_overrides():
    room = cuboid()
    room.set_reflectance("wall_*", 0.9)
    room.limit_reflectance(0.6)
    assert [s.reflectance for s in room.surfaces] == [0.5, 0.6, 0.6, 0.6, 0.6, 0.6]
    room.measure_only("floor")
    assert [s.measured for s in room.surfaces] == [True] + 5 * [False]
    room.measure_only(["floor", "ceiling"])
    assert [s.measured for s in room.surfaces] == [True, True] + 4 * [False]
    room.set_delay("emitter_1", 1e-9)
    assert room.emitters[0].delay == 1e-9
    room.set_maintenance_factor(0.8)
    assert (room.emitters[0].power, room.emitters[0].maintenance_factor) == (800, 0.8)
    assert len(room.overrides) == 7
    assert len(lichtmc.simulate(room, photons=1000).tiles) < len(lichtmc.simulate(cuboid(), photons=1000).tiles)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda room: room.set_reflectance("flor", 0.5), "surfaces: 'floor'"),
        (lambda room: room.set_reflectance("floor", "0.5"), "reflectance is '0.5' .allowed: a number"),
        (lambda room: room.set_reflectance(0, 0.5), "name of a material or surface is 0"),
        (lambda room: room.measure_only([]), "is empty"),
        (lambda room: room.measure_only(0), "texts"),
        (lambda room: room.measure_only([0]), "position 0 is 0 .allowed: a text"),
        (lambda room: room.set_delay("emitter_1", "1 ns"), "delay is '1 ns'"),
        (lambda room: room.set_delay("emitter_1", -1), "0 or more"),
        (lambda room: room.set_maintenance_factor(True), "allowed: a number"),
        (lambda room: room.limit_reflectance(None), "highest reflectance is None"),
    ],
)
def test_wrong_overrides_are_refused(change, message):
    with pytest.raises(lichtmc.InputError, match=message):
        change(cuboid())


def test_an_empty_room_is_filled_surface_by_surface():
    room = lichtmc.Room("hall")
    room.add_surface("floor", [(0, 0, 0), (0, 0, 5), (4, 0, 5), (4, 0, 0)], [(0, 1, 2), (0, 2, 3)], 0.3)
    room.add_surface("roof", [(0, 3, 0), (4, 3, 0), (4, 3, 5), (0, 3, 5)], [(0, 1, 2), (0, 2, 3)], 0.3)
    room.add_emitter(lichtmc.Isotropic((2, 2, 2)), 10, unit="W")
    assert repr(room) == "<Room 'hall': 2 surfaces, 1 emitter (10 W), 0 receivers>"
    assert lichtmc.simulate(room, photons=1000).tiles.irradiance.sum() > 0
    with pytest.raises(lichtmc.InputError, match="no triangle with an area in empty"):
        lichtmc.simulate(lichtmc.Room("empty"), photons=1000)


def test_malformed_files_are_refused_or_read_as_from_disk():
    files = [file for file in sorted(of_others("malformed").rglob("*.gl*")) if file.stat().st_size > 0]
    assert files
    refused = 0
    for file in files:
        outcomes = []
        for read in (lambda: lichtmc.Room.from_gltf(file), lambda: lichtmc.Room.from_bytes(file.read_bytes(), name=str(file))):
            try:
                outcomes.append(repr(read()))
            except lichtmc.InputError as error:
                outcomes.append(str(error))
        refused += str(file) + ":" in outcomes[0]
        assert outcomes[0] == outcomes[1] or "have no folder" in outcomes[1], file
    assert refused > 0


class Failing:
    """A value that fails when it is read."""

    def __init__(self, error: type[BaseException]) -> None:
        self.error = error

    def fail(self, *_: object, **__: object) -> float:
        raise self.error

    __float__ = __index__ = __iter__ = __fspath__ = __array__ = fail


@pytest.mark.parametrize("call", [
    lambda value: lichtmc.Room.cuboid((1, 1, 1), value),
    lambda value: lichtmc.Room.cuboid(value),
    lambda value: cuboid().paths(value),
    lambda value: cuboid().paths(1, seed=value),
    lambda value: cuboid().measure_only(value),
    lambda value: lichtmc.Room.from_gltf(value),
    lambda value: lichtmc.Room.from_triangles([(0, 0, 0), (1, 0, 0), (0, 0, 1)], value),
])
def test_only_an_error_about_a_value_is_an_input_error(call):
    for error in (KeyboardInterrupt, MemoryError):
        with pytest.raises(error):
            call(Failing(error))
    for error in (TypeError, ValueError, OverflowError):
        with pytest.raises(lichtmc.InputError):
            call(Failing(error))


def test_names_of_files_need_not_be_unicode(tmp_path):
    file = os.fsencode(tmp_path) + b"/r\xffom.gltf"
    copy = os.fsdecode(file)
    Path(copy).write_bytes((SCENES / "cube_paper.gltf").read_bytes())
    room = lichtmc.Room.from_gltf(copy)
    assert room.source == copy and "r\\udcffom.gltf" in repr(room)
    assert "r\\xffom.gltf" in str(room.check())
    with pytest.raises(lichtmc.InputError, match=r"r.xffom.gltf"):
        room.set_reflectance("none", 0.5)
    words = [sys.executable, "-m", "lichtmc", "check", file]
    done = subprocess.run(words, capture_output=True, timeout=120, env=ENVIRONMENT)
    assert done.returncode == 0 and b"om.gltf" in done.stdout, done.stderr
    with pytest.raises(lichtmc.InputError, match=r"n.xffne.gltf"):
        lichtmc.Room.from_gltf(os.fsdecode(b"n\xffne.gltf"))
