"""Impulse responses: shapes, units, the digits of the program, what they must add up to."""

from __future__ import annotations

from pathlib import Path

import lichtmc
import numpy as np
import pytest
import rooms

FIGURES = [
    "gain", "line_of_sight", "diffuse", "rician_k", "mean_delay", "mean_excess_delay", "rms_delay_spread",
    "diffuse_mean_delay", "diffuse_rms_delay_spread", "squared_rms_delay_spread", "squared_diffuse_rms_delay_spread",
    "bandwidth_electrical", "bandwidth_optical", "beyond",
]  # fmt: skip
EMITTERS, ORDERS, BINS = 2, 4, 200


def receivers() -> int:
    return len(rooms.box_with_channels().receivers)


def test_axes() -> None:
    channels = rooms.box_with_channels().channels
    assert channels.emitters == ["left", "right"]
    assert channels.receivers == rooms.box_with_channels().receivers.names
    assert channels.orders == ["0", "1", "2", "3+"]
    assert channels.bin_width == 0.5e-9 and channels.time_span == pytest.approx(100e-9)
    np.testing.assert_allclose(channels.time, (np.arange(BINS) + 0.5) * 0.5e-9)
    np.testing.assert_array_equal(channels.powers, [3000, 2000])
    np.testing.assert_array_equal(channels.delays, [0, 0])
    assert repr(channels).startswith("Channels(2 emitters, ")


def test_arrays_are_views_with_their_shapes() -> None:
    channels = rooms.box_with_channels().channels
    frequencies = len(channels.frequencies)
    shapes = {
        "h": (EMITTERS, receivers(), ORDERS, BINS),
        "standard_error": (EMITTERS, receivers(), ORDERS, BINS),
        "h_all": (EMITTERS, receivers(), BINS),
        "standard_error_all": (EMITTERS, receivers(), BINS),
        "response": (EMITTERS, receivers(), frequencies),
        "magnitude_error": (EMITTERS, receivers(), frequencies),
        "first_arrival": (EMITTERS, receivers()),
        "first_reflection": (EMITTERS, receivers()),
    }
    for name, shape in shapes.items():
        values = getattr(channels, name)
        assert values.shape == shape, name
        assert values.dtype == (np.complex128 if name == "response" else np.float64), name
        assert np.shares_memory(values, getattr(channels, name)) and not values.flags.writeable, name


def test_figures_are_views_too() -> None:
    channels = rooms.box_with_channels().channels
    for name in FIGURES:
        figures = getattr(channels, name)
        assert figures.shape == figures.value.shape == figures.standard_error.shape == (EMITTERS, receivers()), name
        assert np.shares_memory(figures.value, getattr(channels, name).value), name
        assert not figures.value.flags.writeable
    assert channels.order_gain.shape == channels.order_beyond.shape == (EMITTERS, receivers(), ORDERS)
    gain = channels.gain[1, -1]
    assert isinstance(gain, lichtmc.Figure) and gain.value == channels.gain.value[1, -1]
    assert gain.standard_error == channels.gain.standard_error[1, -1]
    np.testing.assert_array_equal(np.asarray(channels.gain), channels.gain.value)
    with pytest.raises(IndexError, match="one number for each of their 2 dimensions"):
        channels.gain[0]
    with pytest.raises(IndexError):
        channels.gain[0, 10_000]
    assert np.isnan(channels.squared_rms_delay_spread.value).all()  # not asked for


def test_h_adds_up() -> None:
    result = rooms.box_with_channels()
    channels = result.channels
    np.testing.assert_allclose(channels.h_all, channels.h.sum(axis=2), rtol=1e-9, atol=1e-9 * channels.h_all.max())
    inside = channels.h.sum(axis=3) * channels.bin_width
    np.testing.assert_allclose(
        inside + channels.order_beyond.value, channels.order_gain.value, rtol=1e-9, atol=1e-9 * inside.max()
    )
    np.testing.assert_allclose(channels.order_gain.value.sum(axis=2), channels.gain.value, rtol=1e-9)
    np.testing.assert_allclose(channels.line_of_sight.value + channels.diffuse.value, channels.gain.value, rtol=1e-9)
    np.testing.assert_allclose(np.abs(channels.response[..., 0]), channels.gain.value, rtol=0.02)
    # Received power by both emitters over both powers is the gain of the receiver.
    together = (channels.powers @ channels.gain.value) / channels.powers.sum()
    np.testing.assert_allclose(together, result.receivers.gain, rtol=1e-6)


def test_the_first_light_comes_on_the_straight_line() -> None:
    channels = rooms.box_with_channels().channels
    distance = np.linalg.norm(np.subtract((2, 2.9, 2), (1, 0.8, 1)))
    assert channels.first_arrival[0, 0] == pytest.approx(distance / 299_792_458.0, rel=1e-12)
    bin_of_arrival = int(channels.first_arrival[0, 0] / channels.bin_width)
    assert channels.h[0, 0, 0].nonzero()[0].tolist() == [bin_of_arrival]


def test_emitters_together() -> None:
    together = rooms.box_with_channels(per_emitter=False).channels
    assert together.emitters == ["all"] and together.h.shape[0] == 1
    assert rooms.box_result().channels is None


def test_frequencies_asked_for() -> None:
    result = lichtmc.simulate(
        rooms.box_room(), photons=4096, only="receivers", estimator="weight", impulse_response=1e-9,
        frequencies=(0, 100e6, 50e6), squared_weights=True,
    )  # fmt: skip
    channels = result.channels
    np.testing.assert_array_equal(channels.frequencies, [0, 50e6, 100e6])
    assert not channels.from_bins
    np.testing.assert_allclose(channels.response[..., 0].real, channels.gain.value, rtol=1e-6)
    assert np.isfinite(channels.squared_rms_delay_spread.value).all()


def test_digits_of_the_program(tmp_path: Path) -> None:
    file = tmp_path / "room.glb"
    room = lichtmc.Room.cuboid((3, 3, 3), 0.7)
    room.add_emitter(lichtmc.Lambert((1.5, 2.9, 1.5)), 1, unit="W")
    room.add_receivers([(1, 0.5, 1)], area=1e-4, names=["detector"])
    room.write_gltf(file)
    rooms.command_line(
        "run", file, "-o", tmp_path / "out", "--photons", 8192, "--estimator", "weight", "--only", "receivers", "--quiet",
        "--impulse-response", "1ns", "--time-span", "40ns", "--orders", 1, "--no-report",
    )  # fmt: skip
    result = lichtmc.simulate(
        lichtmc.Room.from_gltf(file), photons=8192, estimator="weight", only="receivers", impulse_response=1e-9,
        time_span=40e-9, orders=1,
    )  # fmt: skip
    channels = result.channels
    written = rooms.table(tmp_path / "out/impulse_response.csv")
    order = np.array(written["order"])
    for name, row in {"0": channels.h[0, 0, 0], "1": channels.h[0, 0, 1], "2+": channels.h[0, 0, 2]}.items():
        values = np.array(written["h"], dtype=float)[order == name]
        if len(values) == len(row):
            np.testing.assert_array_equal(values, row)
        else:  # bins without light may be left out
            np.testing.assert_array_equal(values[values > 0], row[row > 0])
    errors = np.array(written["standard_error"], dtype=float)[order == "1"]
    np.testing.assert_array_equal(errors[errors > 0], channels.standard_error[0, 0, 1][channels.standard_error[0, 0, 1] > 0])
