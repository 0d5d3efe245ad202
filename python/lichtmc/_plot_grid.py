"""Plots of surfaces and calculation areas: Result.plot_surface(), Result.plot_area()."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lichtmc import _core
from lichtmc._plot_base import number_text, pyplot

Array = NDArray[np.float64]
Isolines = bool | int | Sequence[float]

_UP = np.array([0.0, 1.0, 0.0])
_MOST_TEXTS = 400  # cells of an area that get their values written
_TOP_SHARE = 0.99  # of the area, that the colour scale covers
_BRIGHT = 10.0  # times the median: brighter tops of a scale make it logarithmic
_DECADES = 3  # of a logarithmic scale, below its top
_AGREES = 3.0  # standard errors
_ALIGNED = 1e-6  # sine of an angle that only rounding explains
# At which ends of a colour bar values lie beyond it: above, below.
EXTEND = {(True, True): "both", (True, False): "max", (False, True): "min", (False, False): "neither"}


# --- Where cells lie on the paper -------------------------------------------------------------------------------------


@dataclass
class _Paper:
    """Corners of cells, (rows + 1, columns + 1), on the two axes of a plot."""

    across: Array
    upwards: Array
    across_label: str
    upwards_label: str
    across_falls: bool = False  # the coordinate decreases to the right
    upwards_falls: bool = False  # it decreases upwards
    metres: bool = True

    def part(self, rows: slice, columns: slice) -> _Paper:
        def cut(corners: Array) -> Array:
            return corners[rows.start : rows.stop + 1, columns.start : columns.stop + 1]

        return replace(self, across=cut(self.across), upwards=cut(self.upwards))

    def centres(self) -> tuple[Array, Array]:
        def middle(corners: Array) -> Array:
            return (corners[:-1, :-1] + corners[1:, :-1] + corners[:-1, 1:] + corners[1:, 1:]) / 4

        return middle(self.across), middle(self.upwards)

    def is_upright(self) -> bool:
        """Whether rows and columns of cells are parallel to the axes."""

        def constant(corners: Array, axis: int) -> bool:
            spread = float(np.ptp(corners))
            return bool(np.all(np.ptp(corners, axis=axis) <= _ALIGNED * spread))

        return (constant(self.across, 0) and constant(self.upwards, 1)) or (
            constant(self.across, 1) and constant(self.upwards, 0)
        )


def _unit(vector: Array) -> Array:
    return vector / np.linalg.norm(vector)


def _axis_name(direction: Array) -> str | None:
    """ "x", "y" or "z" if the direction is parallel to that axis."""
    for name, k in (("x", 0), ("y", 1), ("z", 2)):
        if abs(direction[k]) > 1 - _ALIGNED:
            return name
    return None


def _flat_paper(corners: Array, u: Array, v: Array, middle: Array) -> _Paper:
    """Of cells with the edges u and v: level ones as seen from above, others as seen from `middle`."""
    normal = _unit(np.cross(u, v))
    if abs(normal[1]) > 1 - _ALIGNED:
        return _Paper(corners[..., 0], corners[..., 2], "x (m)", "z (m)", upwards_falls=True)
    if np.dot(middle - corners.reshape(-1, 3).mean(axis=0), normal) < 0:
        normal = -normal
    right = _unit(np.cross(_UP, normal))
    up = np.cross(normal, right)
    across, upwards = corners @ right, corners @ up
    name = _axis_name(right)
    if name is not None:
        falls = bool(right[0] + right[2] < 0)
        across, label = (-across if falls else across), f"{name} (m)"
    else:
        falls, across, label = False, across - across.min(), "along the surface (m)"
    if abs(normal[1]) < _ALIGNED:
        return _Paper(across, upwards, label, "y (m)", across_falls=falls)
    return _Paper(across, upwards - upwards.min(), label, "up the surface (m)", across_falls=falls)


def cell_paper(rows: int, columns: int) -> _Paper:
    across, upwards = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    return _Paper(across, upwards, "column of the tile", "row of the tile", metres=False)


def _edges_of_cells(position: Array, area: Array) -> tuple[Array, Array, Array] | None:
    """Corner of the grid and edges of a cell, m; None if the tiles are not cells of one plane grid."""
    whole = np.nan_to_num(area) > 0.999 * np.nanmax(area, initial=0.0)  # the points of these are their centres
    rows, columns = np.nonzero(whole)
    numbers = np.column_stack([np.ones(len(rows)), columns + 0.5, rows + 0.5])
    fit, _, rank, _ = np.linalg.lstsq(numbers, position[whole], rcond=None)
    if rank < 3:
        return None
    corner, u, v = fit
    size = min(np.linalg.norm(u), np.linalg.norm(v))
    if size == 0 or np.abs(numbers @ fit - position[whole]).max() > 1e-3 * size:
        return None
    rows, columns = np.nonzero(np.isfinite(area))
    off = np.column_stack([np.ones(len(rows)), columns + 0.5, rows + 0.5]) @ fit - position[rows, columns]
    return (corner, u, v) if np.linalg.norm(off, axis=1).max() <= np.linalg.norm(u) + np.linalg.norm(v) else None


def _corners(rows: int, columns: int, corner: Array, u: Array, v: Array) -> Array:
    return corner + np.arange(columns + 1.0)[None, :, None] * u + np.arange(rows + 1.0)[:, None, None] * v


def _reached(result: _core.Result, surface: _core.SurfaceResult) -> NDArray[np.bool_]:
    """Cells with a tile that light can reach; all tiles if it reaches none."""
    tiles = result.tiles
    reached = np.zeros((surface.rows, surface.columns), dtype=bool)
    reached[tiles.row[surface.tile_slice], tiles.column[surface.tile_slice]] = ~tiles.unreached[surface.tile_slice]
    return reached if reached.any() else np.isfinite(surface.grid_area)


def _surface_paper(result: _core.Result, surface: _core.SurfaceResult, reached: NDArray[np.bool_]) -> _Paper:
    edges = _edges_of_cells(surface.grid_position, np.where(reached, surface.grid_area, np.nan))
    if edges is None:
        return cell_paper(surface.rows, surface.columns)
    middle = np.average(result.tiles.position, axis=0, weights=result.tiles.area)
    return _flat_paper(_corners(surface.rows, surface.columns, *edges), edges[1], edges[2], middle)


def _span(used: NDArray[np.bool_]) -> slice:
    numbers = np.nonzero(used)[0]
    return slice(int(numbers[0]), int(numbers[-1]) + 1)


# --- Drawing ----------------------------------------------------------------------------------------------------------


def _new_axes(paper: _Paper) -> Any:
    width, height = float(np.ptp(paper.across)), float(np.ptp(paper.upwards))
    longest = 6.4
    least = 1.2
    scale = longest / max(width, height)
    _, ax = pyplot().subplots(
        figsize=(max(least, scale * width) + 1.6, max(least, scale * height) + 0.9), layout="compressed"
    )
    return ax


def _norm(values: Array, weights: Array, scale: str, scale_max: float | None) -> tuple[Any, str]:
    """The colour scale, and at which end values lie beyond it."""
    from matplotlib.colors import LogNorm, Normalize

    if scale not in ("auto", "linear", "log"):
        raise _core.InputError(
            f"The argument scale is {scale!r} (allowed: 'auto', 'linear', 'log'). Choose one of these."
        )
    known = np.isfinite(values)
    order = np.argsort(values[known])
    sorted_values, shares = values[known][order], np.cumsum(weights[known][order])
    top = 1.0
    if len(sorted_values) > 0 and sorted_values[-1] > 0:
        top = float(sorted_values[np.searchsorted(shares, _TOP_SHARE * shares[-1])]) or float(sorted_values[-1])
    top = top if scale_max is None else float(scale_max)
    if not top > 0 or not math.isfinite(top):
        raise _core.InputError(
            f"The argument scale_max is {scale_max!r} (allowed: a number above 0). Give the irradiance of the top colour."
        )
    above = bool(np.any(values[known] > top))
    if scale == "auto" and len(sorted_values) > 0:
        median = float(sorted_values[np.searchsorted(shares, 0.5 * shares[-1])])
        scale = "log" if scale_max is None and 0 < _BRIGHT * median < top else "linear"
    if scale != "log":
        return Normalize(0.0, top), "max" if above else "neither"
    positive = sorted_values[sorted_values > 0]
    low = max(top * 10.0**-_DECADES, float(positive[0]) if len(positive) > 0 else 0.0)
    low = low if low < top else top / 10
    below = bool(np.any(values[known] < low))
    return LogNorm(low, top), EXTEND[above, below]


def _draw_cells(ax: Any, paper: _Paper, values: Array, norm: Any, colours: str) -> Any:
    shown = np.ma.masked_invalid(values)
    if not paper.is_upright():
        return ax.pcolormesh(paper.across, paper.upwards, shown, norm=norm, cmap=colours, rasterized=True)
    if np.ptp(paper.across[:, 0]) > np.ptp(paper.across[0]):  # rows run upwards
        shown, across, upwards = shown.T, paper.across[:, 0], paper.upwards[0]
    else:
        across, upwards = paper.across[0], paper.upwards[:, 0]
    if across[0] > across[-1]:
        shown, across = shown[:, ::-1], across[::-1]
    if upwards[0] > upwards[-1]:
        shown, upwards = shown[::-1], upwards[::-1]
    extent = (across[0], across[-1], upwards[0], upwards[-1])
    return ax.imshow(shown, extent=extent, origin="lower", norm=norm, cmap=colours, interpolation="nearest")


def _hatch(ax: Any, paper: _Paper, cells: NDArray[np.bool_]) -> None:
    ax.pcolor(
        paper.across, paper.upwards, np.ma.masked_where(~cells, cells.astype(float)), facecolor="none", edgecolor="0.6",
        hatch="////", linewidth=0,
    )  # fmt: skip


def _smoothed(values: Array, errors: Array) -> Array:
    """By a Gaussian that leaves 1 % of statistical error, so that isolines show the light and not its noise.

    Where it changes more than the noise of a cell, as at edges of shadows, the cell keeps its value. Values that are NaN
    remain so, and have no influence.
    """
    mean = float(np.nanmedian(values))
    error = float(np.nan_to_num(np.nanmedian(errors))) / mean if mean > 0 else 0.0
    widest = 2.5  # cells: wider ones would move the lines
    width = min(error / (2 * math.sqrt(math.pi) * 0.01), min(values.shape) / 8, widest)
    if not width > 0.3:
        return values
    reach = np.arange(-math.ceil(3 * width), math.ceil(3 * width) + 1)
    kernel = np.exp(-0.5 * (reach / width) ** 2)

    def spread(table: Array) -> Array:
        for axis in (0, 1):
            padding = [(0, 0), (0, 0)]
            padding[axis] = (len(reach) // 2, len(reach) // 2)
            windows = np.lib.stride_tricks.sliding_window_view(np.pad(table, padding), len(reach), axis=axis)
            table = windows @ kernel
        return table

    known = np.isfinite(values)
    smooth = spread(np.where(known, values, 0.0)) / np.maximum(spread(known.astype(float)), 1e-300)
    agrees = np.abs(smooth - values) <= _AGREES * np.nan_to_num(errors)
    return np.where(agrees, smooth, values)


def _levels(isolines: Isolines, top: float) -> Array:
    from matplotlib.ticker import MaxNLocator

    if isinstance(isolines, (bool, int, np.integer)):
        count = 6 if isolines is True else int(isolines)
        levels = np.asarray(MaxNLocator(nbins=count + 1).tick_values(0.0, top))
        return levels[(levels > 0) & (levels < top)]
    levels = np.sort(np.asarray(isolines, dtype=float).ravel())
    if len(levels) == 0 or not np.all(np.isfinite(levels)):
        raise _core.InputError(
            f"The argument isolines is {isolines!r} (allowed: True, a number of lines, or their irradiances). Give one of "
            "these."
        )
    return levels


def _draw_isolines(ax: Any, paper: _Paper, values: Array, errors: Array, isolines: Isolines, top: float) -> None:
    if isolines is False or min(values.shape) < 3:
        return
    smooth = _smoothed(values, errors)
    levels = _levels(isolines, top)
    levels = levels[(levels > np.nanmin(smooth)) & (levels < np.nanmax(smooth))]
    if len(levels) == 0:
        return
    across, upwards = paper.centres()
    lines = ax.contour(across, upwards, np.ma.masked_invalid(smooth), levels=levels, colors="white", linewidths=0.8)
    ax.clabel(lines, fmt="%g", fontsize="small")


def _write_values(ax: Any, paper: _Paper, values: Array, image: Any) -> None:
    if values.size > _MOST_TEXTS:
        return
    figure = ax.figure
    figure.canvas.draw()  # the layout determines the size of a cell
    corners = ax.transData.transform(np.column_stack([paper.across[:2, :2].ravel(), paper.upwards[:2, :2].ravel()]))
    cell = np.ptp(corners, axis=0) * 72 / figure.dpi
    longest = max(len(number_text(value)) for value in values.ravel().tolist())
    size = min(10.0, 0.85 * cell[0] / (0.6 * longest), 0.6 * cell[1])
    if size < 4:
        return
    across, upwards = paper.centres()
    for index in np.ndindex(*values.shape):
        value = float(values[index])
        if not math.isfinite(value):
            continue
        red, green, blue, _ = image.cmap(image.norm(value))
        dark = 0.2126 * red + 0.7152 * green + 0.0722 * blue < 0.45
        ax.text(
            across[index], upwards[index], number_text(value), ha="center", va="center", fontsize=size,
            color="white" if dark else "black",
        )  # fmt: skip


def _finish(ax: Any, paper: _Paper, title: str) -> None:
    ax.set_aspect("equal")
    low, high = float(paper.across.min()), float(paper.across.max())
    ax.set_xlim((high, low) if paper.across_falls else (low, high))
    low, high = float(paper.upwards.min()), float(paper.upwards.max())
    ax.set_ylim((high, low) if paper.upwards_falls else (low, high))
    ax.set_xlabel(paper.across_label)
    ax.set_ylabel(paper.upwards_label)
    ax.set_title(title, fontsize="medium")


def add_colour_bar(ax: Any, paper: _Paper, image: Any, label: str, extend: str) -> None:
    from matplotlib.colors import LogNorm
    from matplotlib.ticker import FuncFormatter, LogLocator

    width, height = float(np.ptp(paper.across)), float(np.ptp(paper.upwards))
    if ax.figure.get_layout_engine() is None:  # room for it must be taken from the axes
        box = ax.get_window_extent()
        remaining = 0.8  # of the width of the axes
        shrink = min(1.0, remaining * box.width / box.height * height / width)
        bar = ax.figure.colorbar(image, ax=ax, extend=extend, shrink=shrink, aspect=20 * shrink)
    else:
        thickness = 0.035 * max(1.0, height / width)
        bar = ax.figure.colorbar(image, cax=ax.inset_axes((1 + thickness, 0, thickness, 1)), extend=extend)
    bar.set_label(label)
    if isinstance(image.norm, LogNorm):
        bar.locator, bar.formatter = LogLocator(subs=(1.0, 2.0, 5.0)), FuncFormatter(lambda value, _: f"{value:g}")
        bar.minorticks_off()
        bar.update_ticks()


def _unit_text(result: _core.Result) -> tuple[str, str]:
    return ("illuminance", "lx") if result.unit == "lm" else ("irradiance", "W/m²")


def _plot_grid(
    result: _core.Result, ax: Any, paper: _Paper, values: Array, errors: Array, weights: Array, title: str, *,
    error: bool, texts: bool, isolines: Isolines, colours: str, scale: str, scale_max: float | None,
) -> Any:  # fmt: skip
    pyplot()
    dark = np.zeros_like(values, dtype=bool) if error else values == 0
    if dark.all():  # nothing else to show
        dark = np.zeros_like(dark)
    shown = errors if error else np.where(dark, np.nan, values)
    norm, extend = _norm(shown, weights, scale, scale_max)
    ax = _new_axes(paper) if ax is None else ax
    image = _draw_cells(ax, paper, shown, norm, colours)
    if dark.any():
        _hatch(ax, paper, dark)
        title += "\nhatched: no photon arrived"
    word, unit = _unit_text(result)
    _finish(ax, paper, title)
    add_colour_bar(ax, paper, image, f"{'standard error' if error else word} ({unit})", extend)
    _draw_isolines(ax, paper, shown, np.zeros_like(errors) if error else errors, isolines, norm.vmax)
    if texts:
        _write_values(ax, paper, shown, image)
    return ax


def plot_surface(
    result: _core.Result, surface: str | int, ax: Any = None, *, error: bool = False, isolines: Isolines = False,
    colours: str = "viridis", scale: str = "auto", scale_max: float | None = None,
) -> Any:  # fmt: skip
    """See Result.plot_surface()."""
    pyplot()
    one = result.surfaces[surface]
    reached = _reached(result, one)
    rows, columns = _span(np.any(reached, axis=1)), _span(np.any(reached, axis=0))
    paper = _surface_paper(result, one, reached).part(rows, columns)

    def shown(grid: Array) -> Array:
        return np.where(reached, grid, np.nan)[rows, columns]

    _, unit = _unit_text(result)
    return _plot_grid(
        result, ax, paper, shown(one.grid), shown(one.grid_error), np.nan_to_num(shown(one.grid_area)),
        f"{one.name}: {one.figure} {unit}", error=error, texts=False, isolines=isolines, colours=colours, scale=scale, scale_max=scale_max,
    )  # fmt: skip


def plot_area(
    result: _core.Result, area: str | int, ax: Any = None, *, error: bool = False, values: bool = True,
    isolines: Isolines = False, colours: str = "viridis", scale: str = "auto", scale_max: float | None = None,
) -> Any:  # fmt: skip
    """See Result.plot_area()."""
    pyplot()
    one = result.areas[area]
    paper = _flat_paper(
        _corners(one.rows, one.columns, one.corner, one.u, one.v), one.u, one.v, one.corner + one.normal
    )
    title = one.text.replace(": ", "\n", 1).replace(", target", "\ntarget", 1)
    return _plot_grid(
        result, ax, paper, one.grid, one.grid_error, np.ones_like(one.grid), title,
        error=error, texts=values, isolines=isolines, colours=colours, scale=scale, scale_max=scale_max,
    )  # fmt: skip
