"""Plots by matplotlib: what they show, and what happens without it."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import lichtmc
import numpy as np
import pytest
import rooms

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402


@pytest.fixture(autouse=True)
def _closed_figures() -> Iterator[None]:
    yield
    pyplot.close("all")


def texts(ax: Any) -> list[str]:
    return [text.get_text() for text in ax.texts]


def test_a_flat_surface_is_drawn_to_scale() -> None:
    result = rooms.box_result()
    floor = result.surfaces["floor"]
    ax = result.plot_surface("floor")
    image = ax.images[0]
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x (m)", "z (m)")
    np.testing.assert_allclose(image.get_extent(), (0, 6, 0, 4), atol=1e-9)
    np.testing.assert_allclose(ax.get_ylim(), (4, 0), atol=1e-9)  # from above: z downwards
    np.testing.assert_array_equal(image.get_array(), floor.grid)
    assert ax.get_title() == f"floor: {floor.figure} lx" and ax.get_aspect() == 1
    assert image.colorbar.ax.get_ylabel() == "illuminance (lx)"
    ax.figure.canvas.draw()


def test_a_wall_is_seen_from_inside() -> None:
    result = rooms.box_result()
    ax = result.plot_surface("wall_x0")  # in the plane x = 0, seen towards −x: z to the left
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("z (m)", "y (m)")
    np.testing.assert_allclose((*ax.get_xlim(), *ax.get_ylim()), (4, 0, 0, 3), atol=1e-9)
    wall = result.surfaces["wall_x0"]
    image, extent = ax.images[0].get_array(), ax.images[0].get_extent()
    k, i = 3, 5  # the tile there has the colour of the irradiance there
    z, y = extent[0] + (i + 0.5) / image.shape[1] * (extent[1] - extent[0]), 3 * (k + 0.5) / image.shape[0]
    nearest = np.argmin(np.linalg.norm(wall.grid_position.reshape(-1, 3) - (0, y, z), axis=1))
    assert image[k, i] == wall.grid.ravel()[nearest]
    ax = result.plot_surface("wall_x1")
    np.testing.assert_allclose(ax.get_xlim(), (0, 4), atol=1e-9)


def test_a_tilted_surface_is_drawn_too() -> None:
    room = lichtmc.Room.from_triangles(
        [(0, 0, 0), (2, 0, 2), (2, 1, 2), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)], names=["slanting wall"], two_sided=True
    )
    room.add_emitter(lichtmc.Isotropic((0, 0.5, 2)), 10)
    result = lichtmc.simulate(room, photons=20_000)
    ax = result.plot_surface(0)
    assert ax.get_xlabel() == "along the surface (m)" and ax.get_ylabel() == "y (m)"
    np.testing.assert_allclose(np.ptp(ax.get_xlim()), np.hypot(2, 2), rtol=1e-6)


def test_a_curved_surface_is_drawn_by_its_tiles() -> None:
    angles = np.linspace(0, np.pi, 13)
    points = [(np.cos(a), y, np.sin(a)) for y in (0.0, 1.0) for a in angles]
    faces = [f for k in range(12) for f in ((k, k + 1, k + 14), (k, k + 14, k + 13))]
    room = lichtmc.Room.from_triangles(points, faces, 0.5, names=["niche"])
    room.add_emitter(lichtmc.Isotropic((0, 0.5, 0)), 10)
    ax = lichtmc.simulate(room, photons=4096).plot_surface("niche", scale="log")
    assert ax.get_xlabel() == "column of the tile" and ax.get_ylabel() == "row of the tile"
    ax.figure.canvas.draw()


def test_options_of_plots_of_surfaces() -> None:
    result = rooms.box_result()
    figure, axes = pyplot.subplots(1, 2)
    ax = result.plot_surface("floor", axes[0], error=True, colours="inferno", scale_max=50)
    assert ax is axes[0]
    np.testing.assert_array_equal(ax.images[0].get_array(), result.surfaces["floor"].grid_error)
    assert ax.images[0].norm.vmax == 50 and ax.images[0].cmap.name == "inferno"
    assert ax.images[0].colorbar.ax.get_ylabel() == "standard error (lx)"
    ax = result.plot_surface("floor", axes[1], isolines=[100, 150])
    assert {text for text in texts(ax)} <= {"100", "150"} and len(texts(ax)) > 0
    figure.canvas.draw()
    assert result.plot_surface("floor", scale="log").images[0].norm.vmin > 0
    gable = rooms.half_covered().plot_surface("gable").images[0].get_array()
    assert np.ma.count(gable) == rooms.half_covered().surfaces["gable"].tiles


def table_over_a_floor() -> lichtmc.Result:
    """A closed box of 1.2 m stands on the floor, a hair above it: light does not reach what is below."""
    room = lichtmc.Room.cuboid((4, 3, 4), 0.5)
    low, high, up = 1.2, 2.4, 1e-4
    corners = [(x, y, z) for y in (up, 1.0) for x, z in ((low, low), (high, low), (high, high), (low, high))]
    sides = [(k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4) for k in range(4)]
    quads = [(0, 1, 2, 3), (7, 6, 5, 4), *[side[::-1] for side in sides]]
    faces = [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))]
    room.add_surface("box", corners, faces, 0.5, two_sided=True)
    room.add_emitter(lichtmc.Isotropic((0.6, 2.5, 0.6)), 2000)
    return lichtmc.simulate(room, photons=400_000, tile=0.2)


def test_isolines_follow_the_tiles_and_dark_ones_are_hatched() -> None:
    result = table_over_a_floor()
    floor = result.surfaces["floor"]
    ax = result.plot_surface("floor", isolines=True)
    dark = int(np.sum(floor.grid == 0))  # of 36 tiles; a photon may slip below the box
    assert 30 <= dark <= 36 and ax.get_title().endswith("hatched: no photon arrived")
    np.testing.assert_array_equal(np.ma.getmaskarray(ax.images[0].get_array()), floor.grid == 0)
    hatched = next(collection for collection in ax.collections if collection.get_hatch())
    assert len(hatched.get_paths()) == dark
    lines = next(collection for collection in ax.collections if hasattr(collection, "levels"))
    checked = 0
    for level, path in zip(lines.levels, lines.get_paths()):
        for x, z in path.vertices:
            rows = slice(max(0, int(z / 0.2 - 1)), int(z / 0.2 + 2))  # tiles around, within one of the point
            columns = slice(max(0, int(x / 0.2 - 1)), int(x / 0.2 + 2))
            near, errors = floor.grid[rows, columns], floor.grid_error[rows, columns]
            assert np.any(near > 0)
            assert np.min(near - 4 * errors) <= level <= np.max(near + 4 * errors)
            checked += 1
    assert checked > 20


def test_smoothing_keeps_edges_of_shadows() -> None:
    from lichtmc import _plot_grid

    light = np.where(np.arange(24) < 12, 100.0, 20.0) * np.ones((24, 24))
    errors = 0.05 * light
    values = light + errors * np.random.default_rng(1).standard_normal(light.shape)
    smooth = _plot_grid._smoothed(values, errors)
    assert np.all(np.abs(smooth - values) <= 3 * errors)
    assert np.all(smooth[:, :12] > 80) and np.all(smooth[:, 12:] < 36)
    far = np.abs(np.arange(24) - 11.5) > 6
    assert np.std((smooth - light)[:, far] / errors[:, far]) < 0.3


def test_areas() -> None:
    result = rooms.box_result()
    desk = result.areas["desk"]
    ax = result.plot_area("desk")
    np.testing.assert_array_equal(ax.images[0].get_array(), desk.grid)
    np.testing.assert_allclose(ax.images[0].get_extent(), (1, 3, 1, 2.5), atol=1e-9)
    assert texts(ax) == [f"{value:.0f}" for value in desk.grid.ravel()]
    assert ax.get_title().replace("\n", " ") == desk.text.replace(": ", " ", 1).replace(", target", " target")
    ax = result.plot_area("desk", values=False, isolines=3)
    assert len(texts(ax)) < desk.points
    ax.figure.canvas.draw()


def test_impulse_responses() -> None:
    result = rooms.box_with_channels()
    for options in ({}, {"log": True}, {"log": False}, {"stacked": False, "errors": False}, {"unit": "us"}):
        ax = result.plot_channel("left", "phone", **options)
        labels = [text.get_text() for text in ax.get_legend().get_texts()]
        orders = ["line of sight", "1 reflection", "2 reflections", "3 or more reflections"]
        assert [label for label in labels if label in orders] == orders
        as_lines = ax.get_yscale() == "log" or options.get("stacked") is False
        assert ("sum" in labels) == as_lines
        if "log" in options:
            assert (ax.get_yscale() == "log") == options["log"]
        assert any("± standard error" in label for label in labels) == options.get("errors", True)
        assert ax.get_title().startswith("left → phone: H(0) = ") and ax.get_ylabel() == "h(t) (1/s)"
        assert ax.get_xlabel() == f"time since emission ({'µs' if options.get('unit') == 'us' else 'ns'})"
        ax.figure.canvas.draw()
    assert any("line of sight" in text for text in texts(result.plot_channel(0, 0, log=False)))  # cut, and it says so
    together = rooms.box_with_channels(per_emitter=False).plot_channel()
    assert together.get_title().startswith("all emitters → phone")


def test_noisy_bins_are_shown_together() -> None:
    result = rooms.box_with_channels()
    channels = result.channels
    h, error = channels.h[0, 0].sum(axis=0), channels.standard_error_all[0, 0]
    ax = result.plot_channel(0, 0, log=True)
    edges = next(patch for patch in ax.patches if patch.get_label() == "sum").get_data()
    firsts = np.rint(edges.edges / (channels.bin_width * 1e9)).astype(int)
    counts = np.diff(firsts)
    assert firsts[0] == 0 and firsts[-1] == len(h) and 1 <= counts.min() < counts.max() <= len(h) // 20
    for first, last, value in zip(firsts, firsts[1:], edges.values):
        assert value == pytest.approx(h[first:last].mean(), rel=1e-12) or np.isnan(value) and not h[first:last].any()
        if last - first > 1:
            assert not np.any(error[first:last] <= 0.2 * np.where(h[first:last] > 0, h[first:last], np.nan))


def test_pictures_have_a_colour_bar() -> None:
    picture = rooms.box_result().render(width=320, height=240)
    ax = picture.plot()
    np.testing.assert_array_equal(ax.images[0].get_array(), picture.rgba)
    bar = ax.figure.axes[0].child_axes[0]
    assert bar.get_ylabel() == "illuminance (lx)" and bar.get_ylim() == (picture.low, picture.high)
    _, axes = pyplot.subplots()
    log = rooms.box_result().render(width=64, height=48, scale="log")
    assert log.plot(axes) is axes and axes.figure.axes[1].get_yscale() == "log"
    axes.figure.canvas.draw()


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda r: r.plot_surface("flor"), KeyError, "no surface 'flor'.*'floor'"),
        (lambda r: r.plot_surface("floor", scale="logarithmic"), lichtmc.InputError, "'auto', 'linear', 'log'"),
        (lambda r: r.plot_surface("floor", scale_max=0), lichtmc.InputError, "scale_max is 0"),
        (lambda r: r.plot_surface("floor", isolines=[]), lichtmc.InputError, "isolines"),
        (lambda r: r.plot_area("bed"), KeyError, "no area 'bed'"),
        (lambda r: r.plot_channel(), lichtmc.InputError, "no impulse responses.*impulse_response="),
    ],
)
def test_wrong_arguments_are_refused(call: Any, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        call(rooms.box_result())


def test_wrong_channels_are_refused() -> None:
    result = rooms.box_with_channels()
    with pytest.raises(KeyError, match="no receiver 'fone'.*'phone'"):
        result.plot_channel(0, "fone")
    with pytest.raises(IndexError, match="no emitter number 2: the channels have 2"):
        result.plot_channel(2)
    with pytest.raises(lichtmc.InputError, match="unit is 'h'"):
        result.plot_channel(unit="h")


def test_without_matplotlib() -> None:
    """Nothing but the plots needs it, and they say what to install."""
    program = """
import sys
sys.modules["matplotlib"] = None
import lichtmc
room = lichtmc.Room.cuboid((2, 2, 2))
room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 100)
result = lichtmc.simulate(room, photons=2048)
for plot in (lambda: result.plot_surface("floor"), lambda: result.plot_channel(), lambda: result.plot_area(0)):
    try:
        plot()
    except ImportError as error:
        print(error)
"""
    done = subprocess.run(
        [sys.executable, "-c", program], env=rooms.ENVIRONMENT, check=True, capture_output=True, text=True, timeout=120
    )
    assert done.stdout.splitlines() == ['Plots need matplotlib. Install it: pip install "lichtmc[plot]"'] * 3
