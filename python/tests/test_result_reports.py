"""What a result tells about itself: settings, walks, balance, texts; and figures with their errors."""

from __future__ import annotations

import copy
import math
import pickle

import lichtmc
import numpy as np
import pytest
import rooms


def test_facts_of_a_run() -> None:
    result = rooms.box_result()
    assert result.unit == "lm" and result.irradiance_unit == "lx"
    assert result.engine == "cuboid" and result.threads >= 1 and result.stopped_by == "photons"
    assert result.histories == rooms.PHOTONS == result.walk.histories
    assert result.rms_relative_error == result.walk.rms_relative_error > 0
    assert result.seconds == result.walk.seconds + result.receiver_walk.seconds
    assert result.ignored == [] and "receivers" in result.choices[0]
    assert any("left" in text for text in result.overrides)
    assert "two of three" in result.error_text() and result.unreached_text() == ""
    assert result.incident == pytest.approx(result.tiles.power.sum())
    assert 0 < result.incident_standard_error < 0.02 * result.incident
    assert len(result.warnings) == 1 and "maintenance" in result.warnings[0]


def test_radiometric_units() -> None:
    room = lichtmc.Room.cuboid((2, 2, 2))
    room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 1, unit="W")
    result = lichtmc.simulate(room, photons=2048)
    assert (result.unit, result.irradiance_unit) == ("W", "W/m^2")
    assert "W/m²" in repr(result)


def test_the_settings_repeat_a_run() -> None:
    result = rooms.box_with_channels()
    settings = dict(result.settings)
    assert settings["photons"] == 20_000 and settings["impulse_response"] == 0.5e-9 and settings["per_emitter"] is True
    again = lichtmc.simulate(result.room, **result.settings)
    np.testing.assert_array_equal(again.channels.h, result.channels.h)
    part = lichtmc.simulate(rooms.box_room(), histories=(1024, 3072), only="tiles", error_floor=2.0)
    assert part.settings["histories"] == (1024, 3072) or part.settings["histories"] == [1024, 3072]
    assert part.settings["photons"] is None and part.settings["error_floor"] == 2.0
    np.testing.assert_array_equal(
        lichtmc.simulate(part.room, **part.settings).tiles.irradiance, part.tiles.irradiance
    )
    with pytest.raises(KeyError, match="no setting 'photon'"):
        result.settings["photon"]


def test_balance_adds_up() -> None:
    balance = rooms.box_result().balance
    assert balance.emitted == 5000 and balance.lost == 0 and balance.escaped == 0
    assert balance.absorbed + balance.escaped + balance.residual + balance.lost == pytest.approx(5000)
    assert math.isnan(rooms.box_with_parts().balance.absorbed)
    assert repr(balance).startswith("Balance(emitted=5000.0")
    escaped = rooms.half_covered().balance.escaped
    assert 0.5 < escaped / 100 < 1


def test_reports_of_the_walks() -> None:
    result = rooms.box_result()
    walk, receiver_walk = result.walk, result.receiver_walk
    assert walk.estimator == "collision" and walk.choice == "" and walk.stopped_by == "photons"
    assert walk.impacts > walk.histories and walk.rays >= walk.impacts
    assert walk.convergence.shape[1] == 3 and walk.convergence.dtype == np.float64
    np.testing.assert_array_equal(walk.convergence[-1, 0], walk.histories)
    assert walk.convergence[-1, 2] == walk.rms_relative_error
    assert walk.figure_of_merit == pytest.approx(1 / (walk.rms_relative_error**2 * walk.seconds))
    assert receiver_walk.receiver_walk in ("two-way", "next-event", "backward") and receiver_walk.rounds > 1
    assert "collision" in repr(walk)


def test_a_chosen_estimator_is_explained() -> None:
    result = lichtmc.simulate(rooms.box_room(), photons=20_000, estimator="auto", only="tiles")
    assert result.settings["estimator"] == "auto"
    assert result.walk.estimator in ("collision", "weight", "absorption")
    assert result.walk.choice and len(result.choices) == 1


def test_the_room_is_as_it_was() -> None:
    room = rooms.box_room()
    result = lichtmc.simulate(room, photons=2048, only="tiles")
    room.set_reflectance("floor", 0.9)
    assert result.room.surfaces[0].reflectance == 0.3 and room.surfaces[0].reflectance == 0.9


def test_repr_is_a_summary() -> None:
    text = repr(rooms.box_result())
    assert text.startswith("Result of 'cuboid'")
    for word in ("10 800 tiles", "floor", "mean (lx)", "desk (task): Em", "60 000 histories", "ended by photons"):
        assert word in text, word
    assert "receiver" in repr(rooms.box_with_parts())
    assert "Channels(2 emitters" in repr(rooms.box_with_channels())
    office = lichtmc.simulate(lichtmc.Room.from_gltf(rooms.DATA / "office.glb"), photons=2048)
    assert len(repr(office).splitlines()) < 30


def test_figures_are_written_with_their_errors() -> None:
    assert str(lichtmc.Figure(349.27, 1.8)) == "349 ± 2"
    assert str(lichtmc.Figure(0.5512, 0.0098)) == "0.55 ± 0.01" or str(lichtmc.Figure(0.5512, 0.0098)) == "0.551 ± 0.010"
    assert str(lichtmc.Figure(4.4867e-06, 6.1e-08)) == "(4.49 ± 0.07)e-06"
    assert str(lichtmc.Figure(2.5e9, 1e7)) == "(2.50 ± 0.01)e+09"
    assert str(lichtmc.Figure(0.25, 0.0)) == "0.25"
    assert str(lichtmc.Figure(math.nan, math.nan)) == "–"
    assert f"{lichtmc.Figure(349.27, 1.8):.1f}" == "349.3 ± 1.8"
    assert f"{lichtmc.Figure(349.27, math.nan):.1f}" == "349.3"
    assert f"{lichtmc.Figure(349.27, 1.8)}" == "349 ± 2"


def test_figures_are_numbers() -> None:
    figure = lichtmc.Figure(349.27, 1.8)
    assert float(figure) == figure.value == 349.27 and figure.standard_error == 1.8
    assert repr(figure) == "Figure(349.27, 1.8)"
    assert eval(repr(figure), {"Figure": lichtmc.Figure}) == figure != lichtmc.Figure(349.27, 1.9)
    assert figure != 349.27 and figure is not None and len({figure, lichtmc.Figure(349.27, 1.8)}) == 1
    assert pickle.loads(pickle.dumps(figure)) == copy.deepcopy(figure) == figure
    np.testing.assert_array_equal(np.array([figure, figure], dtype=float), [349.27, 349.27])
