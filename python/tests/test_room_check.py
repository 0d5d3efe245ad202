"""Checks of rooms, and paths of photons."""

from __future__ import annotations

import _thread
import json
import threading

import numpy as np
import pytest

import lichtmc
from rooms import DATA, SCENES, command_line, cuboid, of_others


def test_a_sound_room():
    inspection = cuboid().check()
    assert inspection.faults == []
    assert inspection.warnings == []
    assert (inspection.closed, inspection.convex, inspection.cuboid) == (True, True, True)
    assert inspection.low.tolist() == [0, 0, 0]
    assert inspection.high.tolist() == [4, 2.5, 5]
    assert inspection.tiles == 8500
    assert inspection.memory > 0
    assert {f.severity for f in inspection.findings} == {"note"}
    assert "accepts this room: 0 faults, 0 warnings" in str(inspection)
    assert repr(inspection).startswith("<Inspection: 0 faults, 0 warnings, ")


def test_receivers_outside_the_room():
    room = lichtmc.Room.cuboid((4, 2.5, 5))
    room.add_emitter(lichtmc.Lambert((2, 2.5, 2.5)), 1000)  # in the plane of the ceiling
    room.add_receivers([(10, 0, 0), (1, -1, 1), (1, 1, 1)])
    text = "2 receivers of 3 lie outside the room, which extends from x, y, z = 0 to 4, 0 to 2.5, 0 to 5 m."
    inspection = room.check()
    assert not inspection.closed  # the lamp is neither inside nor outside
    assert [f.topic for f in inspection.warnings if text in f.text] == ["receivers"]
    with pytest.warns(lichtmc.ResultWarning, match="outside the room") as caught:
        result = lichtmc.simulate(room, photons=1000, only="receivers")
    assert [text in str(warning.message) for warning in caught] == [True]
    assert result.receivers.irradiance[:2].tolist() == [0, 0]


def test_tiles_of_a_check():
    assert cuboid().check(tile=0.5).tiles == 340
    with pytest.raises(lichtmc.InputError, match="edge of a tile is 'small'"):
        cuboid().check("small")
    with pytest.raises(lichtmc.InputError, match="0"):
        cuboid().check(0)


def test_faults_and_warnings():
    inspection = lichtmc.Room.cuboid((4, 2.5, 5)).check()
    fault = inspection.faults[0]
    assert (fault.severity, fault.topic) == ("fault", "emitters")
    assert fault.text
    assert fault.advice
    assert str(fault).startswith("fault (emitters): ")
    assert repr(fault) == f"<{fault}>"
    assert "would reject this room: 1 fault" in str(inspection)
    assert inspection.findings[0].text == fault.text
    room = lichtmc.Room.cuboid((4, 2.5, 5), 1.0, floor=0.5)
    room.add_emitter(lichtmc.Isotropic((2, 2, 2)), 1000)
    assert "reflectance" in {f.topic for f in room.check().findings}
    assert all(f.severity == "warning" for f in room.check().warnings)


@pytest.mark.parametrize("name", ["living_room.glb", "l_room.gltf", "office.glb", "fazil_cornell-box.glb"])
def test_findings_are_those_of_the_command_line(name):
    if name.startswith("fazil"):
        file = of_others("real", name)
    else:
        file = (DATA if name == "office.glb" else SCENES) / name
    room = lichtmc.Room.from_gltf(file)
    inspection = room.check()
    # No room with a fault: then the command line has an exit status.
    expected = json.loads(command_line("check", file, "--json"))
    assert inspection.to_json() == expected
    found = [{"severity": f.severity, "topic": f.topic, "text": f.text, "advice": f.advice} for f in inspection.findings]
    assert found == [{key: one[key] for key in found[0]} for one in expected["findings"]]
    assert (len(inspection.faults), len(inspection.warnings)) == (expected["faults"], expected["warnings"])


def test_a_check_uses_the_preparation_of_runs():
    room = cuboid()
    assert room.check().tiles == len(lichtmc.simulate(room, photons=1000).tiles)


def test_areas_that_cannot_be_laid_out_are_findings():
    room = cuboid()
    room.add_area("desk", (1, 0.75, 1), (1, 0, 0), (0, 0, 1))
    assert [a["name"] for a in room.check().to_json()["areas"]] == ["desk"]


def test_paths():
    room = cuboid()
    paths = room.paths(20)
    assert len(paths) == 20
    for number, path in enumerate(paths):
        assert path.history == number
        assert len(path) == len(path.points) == len(path.weights) == len(path.surfaces)
        assert (path.points.dtype, path.weights.dtype, path.surfaces.dtype) == (np.float64, np.float64, np.int64)
        assert path.points.shape[1] == 3
        assert np.allclose(path.points[0], (2, 2.25, 2.5), atol=1e-5)
        assert path.surfaces[0] == -1
        assert path.surfaces[1:].min() >= 0
        assert path.end == "absorbed"
        assert np.all(path.weights == 1)
        assert not path.points.flags.writeable
        assert repr(path) == f"<Path {number}: {len(path)} points, absorbed>"
    assert np.array_equal(room.paths(3)[2].points, paths[2].points)
    assert len(room.paths(1, seed=2**64 - 1)) == 1
    for seed in (2**64, -1, 0.5, True, "1"):
        with pytest.raises(lichtmc.InputError, match=r"seed is .*0 to 18446744073709551615"):
            room.paths(1, seed=seed)
    assert not np.array_equal(room.paths(1, seed=2)[0].points, paths[0].points)
    assert room.paths(5, estimator="weight")[0].weights.min() < 1
    assert len(room.paths()) == 50


def test_paths_of_an_area_light_begin_on_its_surface():
    room = lichtmc.Room.cuboid((4, 2.5, 5))
    room.add_emitter(lichtmc.AreaLight("ceiling"), 100)
    assert room.surfaces[room.paths(1)[0].surfaces[0]].name == "ceiling"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"count": 0}, "number of paths is 0"),
        ({"count": 2.5}, "number of paths is 2.5"),
        ({"count": "many"}, "number of paths is 'many'"),
        ({"seed": -1}, "seed is -1"),
        ({"estimator": "best"}, "estimator is 'best' .allowed: 'auto', 'collision'"),
    ],
)
def test_wrong_paths_are_refused(options, message):
    with pytest.raises(lichtmc.InputError, match=message):
        cuboid().paths(**options)


def test_paths_of_a_room_without_emitters_are_refused():
    with pytest.raises(lichtmc.InputError, match="no emitter"):
        lichtmc.Room.cuboid((4, 2.5, 5)).paths(1)


def test_ctrl_c_ends_a_check_when_it_has_ended():
    room = lichtmc.Room.from_gltf(SCENES / "living_room.glb")
    timer = threading.Timer(0.1, _thread.interrupt_main)
    with pytest.raises(KeyboardInterrupt):
        timer.start()
        for _ in range(1000):
            room.check()
    assert room.check().tiles > 0
