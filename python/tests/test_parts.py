"""The parts of emitters, and scenes with dimmed emitters."""

from __future__ import annotations

import json
from pathlib import Path

import lichtmc
import numpy as np
import pytest
import rooms


def test_arrays_of_parts() -> None:
    result = rooms.box_with_parts()
    parts = result.parts
    shape = (len(result.receivers), 2)
    assert parts.names == ["left", "right"] and len(parts) == 2
    np.testing.assert_array_equal(parts.power, [3000, 2000])
    np.testing.assert_array_equal(parts.maintenance_factor, [1, 1])
    for name in ("irradiance", "standard_error", "direct", "direct_error", "reflected"):
        values = getattr(parts, name)
        assert values.shape == shape and values.dtype == np.float64 and not values.flags.writeable, name
    for name in ("direct", "direct_error", "reflected"):
        assert np.shares_memory(getattr(parts, name), getattr(parts, name)), name
    assert parts.covariance.shape == (len(result.receivers), 2, 2)
    np.testing.assert_array_equal(parts.irradiance, parts.direct + parts.reflected)
    np.testing.assert_allclose(parts.standard_error**2, np.einsum("kii->ki", parts.covariance))
    assert rooms.box_result().parts is None
    assert repr(parts).startswith("EmitterParts(2 parts, ")


def test_all_parts_together_are_the_run() -> None:
    result = rooms.box_with_parts()
    np.testing.assert_allclose(result.parts.irradiance.sum(axis=1), result.receivers.irradiance, rtol=1e-12)
    error = np.sqrt(result.parts.covariance.sum(axis=(1, 2)))
    np.testing.assert_allclose(error, result.receivers.standard_error, rtol=1e-9)
    scene = result.dim({})
    np.testing.assert_allclose(scene.receivers.irradiance, result.receivers.irradiance, rtol=1e-12)
    assert scene.areas["desk"].mean.value == pytest.approx(result.areas["desk"].mean.value)


def test_dimming_is_linear() -> None:
    result = rooms.box_with_parts()
    factors = np.array([0.3, 1.2])
    scene = result.dim(factors)
    np.testing.assert_array_equal(scene.factors, factors)
    assert scene.power == pytest.approx(0.3 * 3000 + 1.2 * 2000)
    np.testing.assert_allclose(scene.receivers.irradiance, result.parts.irradiance @ factors, rtol=1e-12)
    error = np.sqrt(np.einsum("i,kij,j->k", factors, result.parts.covariance, factors))
    np.testing.assert_allclose(scene.receivers.standard_error, error, rtol=1e-9)
    desk = scene.areas["desk"]
    matrix = result.parts.irradiance[desk.receivers]
    assert desk.mean.value == pytest.approx((matrix @ factors).mean())
    np.testing.assert_array_equal(desk.grid.ravel(), scene.receivers.irradiance[desk.receivers])
    assert scene.receivers["phone"].irradiance == scene.receivers.irradiance[0]
    assert "'right': 1.2" in repr(scene)


def test_names_and_patterns() -> None:
    result = rooms.box_with_parts()
    np.testing.assert_array_equal(result.dim({"left": 0.5}).factors, [0.5, 1])
    np.testing.assert_array_equal(result.dim({"*": 0.25}).factors, [0.25, 0.25])
    np.testing.assert_array_equal(result.dim({"r?ght": 0}).factors, [1, 0])
    np.testing.assert_array_equal(result.dim([1, 2]).factors, [1, 2])


def test_a_scene_outlives_its_result() -> None:
    result = lichtmc.simulate(rooms.box_room(), photons=2048, per_emitter=True, only="receivers")
    expected = result.parts.irradiance @ [0.5, 0.5]
    values = result.dim({"*": 0.5}).receivers.irradiance
    del result
    np.testing.assert_allclose(values, expected)


@pytest.mark.parametrize(
    ("factors", "message"),
    [
        ({"middle": 1}, "no emitter 'middle'.*'left', 'right'"),
        ({"left": -1}, "'left' is -1 .allowed: a finite number, 0 or more"),
        ({"left": "half"}, "factor of 'left' is 'half' .allowed: a number of 0 or more"),
        ({"left": 1, "l*": 2}, "two factors"),
        ({1: 1}, "name of an emitter is 1"),
        ([1, 2, 3], r"shape \(3,\) .allowed: \(2,\)"),
        (0.5, r"shape \(1,\) .allowed: \(2,\)"),
        ([1, np.nan], "'right' is nan"),
        ("left", "array of factors is 'left'"),
        (None, "array of factors is None"),
    ],
)
def test_wrong_factors_are_refused(factors: object, message: str) -> None:
    with pytest.raises(lichtmc.InputError, match=message):
        rooms.box_with_parts().dim(factors)


def test_a_result_without_parts_cannot_be_dimmed() -> None:
    with pytest.raises(lichtmc.InputError, match="per_emitter=True"):
        rooms.box_result().dim({"left": 0.5})


def test_a_written_scene_is_that_of_the_program(tmp_path: Path) -> None:
    file = tmp_path / "room.glb"
    room = lichtmc.Room.cuboid((5, 3, 4), 0.5)
    room.add_emitter(lichtmc.Lambert((1.5, 2.9, 2)), 1000, name="a")
    room.add_emitter(lichtmc.Lambert((3.5, 2.9, 2)), 1000, name="b")
    room.write_gltf(file)
    rooms.command_line(
        "run", file, "-o", tmp_path / "run", "--photons", 8192, "--estimator", "collision", "--only", "receivers",
        "--per-emitter", "--plane", "0.75", "--no-report", "--quiet",
    )  # fmt: skip
    rooms.command_line("scene", tmp_path / "run", "--dim", "a=0.4", "-o", tmp_path / "program")
    same = lichtmc.Room.from_gltf(file)
    same.add_working_plane(0.75)
    result = lichtmc.simulate(same, photons=8192, only="receivers", per_emitter=True)
    result.dim({"a": 0.4}).write(tmp_path / "python")
    names = sorted(path.relative_to(tmp_path / "program") for path in (tmp_path / "program").rglob("*.*"))
    assert names == sorted(path.relative_to(tmp_path / "python") for path in (tmp_path / "python").rglob("*.*"))
    for name in ("receivers.csv", "areas.csv", "areas/plane.csv", "areas/plane.svg", "areas/plane.dxf"):
        assert (tmp_path / "python" / name).read_bytes() == (tmp_path / "program" / name).read_bytes(), name
    written, program = (json.loads((tmp_path / who / "scene.json").read_text()) for who in ("python", "program"))
    written.pop("room"), program.pop("room")
    assert written == program
    (tmp_path / "other").mkdir()
    (tmp_path / "other/summary.json").write_text("{}")
    with pytest.raises(lichtmc.InputError, match="holds the results of a run"):
        result.dim({}).write(tmp_path / "other")
