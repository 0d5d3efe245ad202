"""Receivers and calculation areas of a result."""

from __future__ import annotations

import lichtmc
import numpy as np
import pytest
import rooms


def test_arrays_of_receivers() -> None:
    receivers = rooms.box_result().receivers
    assert receivers.names[:2] == ["phone", "tablet"] and len(receivers) == len(receivers.names)
    for name in ("irradiance", "standard_error", "direct", "indirect", "gain"):
        values = getattr(receivers, name)
        assert values.shape == (len(receivers),) and values.dtype == np.float64
        assert np.shares_memory(values, getattr(receivers, name)) and not values.flags.writeable
    assert receivers.position.shape == receivers.normal.shape == (len(receivers), 3)
    np.testing.assert_array_equal(receivers.position[:2], [(1, 0.8, 1), (4, 0.8, 3)])
    np.testing.assert_allclose(receivers.irradiance, receivers.direct + receivers.indirect)


def test_one_receiver() -> None:
    result = rooms.box_result()
    receivers = result.receivers
    phone = receivers["phone"]
    assert phone.name == "phone" and phone.irradiance == receivers.irradiance[0] == receivers[0].irradiance
    assert phone.direct + phone.indirect == pytest.approx(phone.irradiance)
    assert phone.gain == pytest.approx(phone.irradiance * 1e-4 / 5000)
    np.testing.assert_array_equal(phone.position, (1, 0.8, 1))
    np.testing.assert_array_equal(phone.normal, (0, 1, 0))
    assert phone.figure.standard_error == receivers.standard_error[0]
    assert "phone" in receivers and "camera" not in receivers
    with pytest.raises(KeyError, match="no receiver 'fone'.*'phone'"):
        receivers["fone"]
    with pytest.raises(IndexError):
        receivers[len(receivers)]
    assert len(list(receivers)) == len(receivers)


def test_receivers_of_one_name_need_their_numbers() -> None:
    room = lichtmc.Room.cuboid((2, 2, 2))
    room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 100)
    room.add_receivers([(0.5, 0.5, 0.5), (1.5, 0.5, 0.5)], names=["here", "there"])
    result = lichtmc.simulate(room, photons=2048, only="receivers")
    assert result.receivers["there"].irradiance == result.receivers[-1].irradiance


def test_a_run_for_tiles_has_no_receivers() -> None:
    result = lichtmc.simulate(rooms.box_room(), photons=2048, only="tiles")
    assert len(result.receivers) == 0 and result.receivers.position.shape == (0, 3)
    assert len(result.areas) == 0 and result.receiver_walk is None
    with pytest.raises(KeyError, match="the result has no areas"):
        result.areas["desk"]


def test_figures_of_an_area() -> None:
    result = rooms.box_result()
    assert list(result.areas) == ["desk", "plane"]
    desk = result.areas["desk"]
    assert (desk.role, desk.quantity, desk.points) == ("task", "horizontal", 30)
    assert desk.mean.value == pytest.approx(desk.grid.mean())
    assert desk.lowest == desk.grid.min() and desk.highest == desk.grid.max()
    assert desk.uniformity.value == pytest.approx(desk.minimum.value / desk.mean.value)
    assert desk.diversity.value == pytest.approx(desk.minimum.value / desk.maximum.value)
    assert desk.initial_mean.value == desk.mean.value
    assert (desk.target_lx, desk.target_uniformity) == (500, 0.6)
    assert (desk.verdict, desk.mean_verdict, desk.uniformity_verdict) == ("fail", "fail", "pass")
    assert result.areas["plane"].target_lx is None and result.areas["plane"].verdict == ""
    assert desk.text.startswith("desk (task): Em ") and "target 500 lx, 0.60: fail" in desk.text
    assert desk.above_floor == pytest.approx(0.75) and desk.margin == 0 and desk.left_out == {}
    assert str(desk.mean) in desk.text


def test_grid_of_an_area() -> None:
    result = rooms.box_result()
    desk = result.areas["desk"]
    assert desk.grid.shape == desk.grid_error.shape == desk.grid_direct.shape == (desk.rows, desk.columns) == (5, 6)
    assert desk.position.shape == (5, 6, 3)
    np.testing.assert_array_equal(desk.grid.ravel(), result.receivers.irradiance[desk.receivers])
    np.testing.assert_allclose(desk.position.reshape(-1, 3), result.receivers.position[desk.receivers], atol=1e-12)
    np.testing.assert_allclose(desk.position[2, 4], desk.corner + 4.5 * desk.u + 2.5 * desk.v)
    np.testing.assert_allclose(desk.normal, (0, 1, 0))
    assert np.shares_memory(desk.grid, result.receivers.irradiance) and not desk.grid.flags.writeable


def test_cells_without_a_point_are_nan() -> None:
    room = lichtmc.Room.cuboid((4, 3, 4))
    room.add_emitter(lichtmc.Isotropic((2, 2, 2)), 1000)
    room.add_area("through the wall", (2, 1, 1), (4, 0, 0), (0, 0, 2), role="task", spacing=0.5)
    result = lichtmc.simulate(room, photons=2048, only="receivers")
    area = result.areas[0]
    missing = sum(area.left_out.values())
    assert missing > 0 and missing + area.points == area.rows * area.columns
    assert np.isnan(area.grid).sum() == missing
    np.testing.assert_array_equal(area.grid[np.isfinite(area.grid)], result.receivers.irradiance[area.receivers])
    inside = area.position[..., 0] < 4
    assert np.isfinite(area.grid[inside]).all() and np.isnan(area.grid[~inside]).all()
