"""Plots of impulse responses: Result.plot_channel()."""

from __future__ import annotations

import difflib
import math
from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lichtmc import _core
from lichtmc._plot_base import grouped_number_text, pyplot

Array = NDArray[np.float64]

_TIME_UNITS = {"s": (1.0, "s"), "ms": (1e3, "ms"), "us": (1e6, "µs"), "µs": (1e6, "µs"), "ns": (1e9, "ns")}
_SHOWN_GAIN = 0.999  # of the gain, that the time axis shows
_TALL = 3.0  # how many times as high as the reflected light the line of sight may be before it is cut


def _index(names: Sequence[str], key: int | str, what: str) -> int:
    if isinstance(key, str):
        if key in names:
            return list(names).index(key)
        near = difflib.get_close_matches(key, names, n=5) or list(names)[:5]
        raise KeyError(f"There is no {what} {key!r} in the channels (there are: {', '.join(map(repr, near))}).")
    if not -len(names) <= key < len(names):
        raise IndexError(f"There is no {what} number {key}: the channels have {len(names)}.")
    return int(key) % len(names)


def _order_text(order: str) -> str:
    if order == "0":
        return "line of sight"
    if order == "1+":
        return "reflected"
    number = order.rstrip("+")
    text = f"{number} or more reflections" if order.endswith("+") else f"{number} reflections"
    return "1 reflection" if order == "1" else text


def _order_colours(count: int) -> list[Any]:
    from matplotlib import colormaps

    return [colormaps["viridis"](x) for x in np.linspace(0.0, 0.9, max(2, count))][:count]


def _channel_title(channels: _core.Channels, e: int, r: int) -> str:
    gain = channels.gain[e, r]
    emitter = "all emitters" if channels.emitters[e] == "all" else channels.emitters[e]
    decibels = f" = {10 * math.log10(gain.value):.2f} dB".replace("-", "−") if gain.value > 0 else ""
    return f"{emitter} → {channels.receivers[r]}: H(0) = {gain}{decibels}"


def _draw_stack(ax: Any, edges: Array, h: Array, names: list[str]) -> None:
    base = np.zeros(h.shape[1])
    for row, name, colour in zip(h, names, _order_colours(len(names))):
        ax.stairs(base + row, edges, baseline=base, fill=True, color=colour, label=name, linewidth=0)
        base = base + row


def _draw_lines(ax: Any, edges: Array, h: Array, names: list[str], log: bool) -> None:
    few = 3  # bins: a pulse, not a curve
    for row, name, colour in zip(h, names, _order_colours(len(names))):
        if np.count_nonzero(row) <= few:
            ax.vlines((edges[:-1] + edges[1:])[row > 0] / 2, 0.0, row[row > 0], color=colour, label=name)
            continue
        shown = np.where(row > 0, row, np.nan) if log else row
        ax.stairs(shown, edges, baseline=None, color=colour, label=name, linewidth=1.2)


def _draw_band(ax: Any, edges: Array, total: Array, errors: Array, log: bool, label: str) -> None:
    low, high = total - errors, total + errors
    if log:
        low = np.maximum(low, np.min(total[total > 0], initial=1e-300) * 1e-3)
    known = np.isfinite(errors)
    ax.stairs(
        np.where(known, high, total), edges, baseline=np.where(known, low, total), fill=True, color="0.2", alpha=0.35,
        linewidth=0, label=label,
    )  # fmt: skip


def _cut_line_of_sight(ax: Any, edges: Array, h: Array, errors: Array) -> bool:
    """A line of sight in one bin would leave nothing to see of the rest."""
    reflected = float((h[1:].sum(axis=0) + np.where(h[0] > 0, 0.0, np.nan_to_num(errors))).max())
    peak = int(np.argmax(h[0]))
    highest = float(h[:, peak].sum())
    if not 0 < reflected < highest / _TALL:
        return False
    ax.set_ylim(0.0, 1.15 * reflected)
    ax.annotate(
        f"line of sight: up to {grouped_number_text(highest)} 1/s", xy=((edges[peak] + edges[peak + 1]) / 2, 1.15 * reflected),
        xytext=(5, -3), textcoords="offset points", va="top", fontsize="small",
    )  # fmt: skip
    return True


def _channels_of(result: _core.Result) -> _core.Channels:
    if result.channels is None:
        raise _core.InputError(
            "The result has no impulse responses (allowed: results of simulate(…, impulse_response=…) with receivers). "
            "Simulate the room again with the width of the bins, for example impulse_response=0.2e-9."
        )
    return result.channels


def _limit_axes(ax: Any, edges: Array, h: Array, errors: Array, log: bool) -> None:
    """From the first light to the last of note; of the heights those of reflected light."""
    total = h.sum(axis=0)
    lit = np.nonzero(total > 0)[0]
    if len(lit) == 0:
        return
    shares = np.cumsum(total) / total.sum()
    last = int(lit[-1]) if log else max(int(np.searchsorted(shares, _SHOWN_GAIN)), int(np.argmax(h[0])) + 1)
    first = max(0.0, edges[lit[0]] - 0.05 * (edges[last] - edges[lit[0]]))
    ax.set_xlim(first, edges[min(last + 1, len(edges) - 1)])
    if log:
        top = float(total.max())
        ax.set_yscale("log")
        ax.set_ylim(max(1e-6 * top, 0.5 * float(h[h > 0].min())), 2 * top)
    elif not _cut_line_of_sight(ax, edges, h, errors):
        ax.set_ylim(bottom=0.0)


def plot_channel(
    result: _core.Result, emitter: int | str = 0, receiver: int | str = 0, ax: Any = None, *, stacked: bool = True,
    log: bool = False, errors: bool = True, unit: str = "ns",
) -> Any:  # fmt: skip
    """See Result.plot_channel()."""
    plotting = pyplot()
    channels = _channels_of(result)
    if unit not in _TIME_UNITS:
        raise _core.InputError(f"The argument unit is {unit!r} (allowed: 's', 'ms', 'us', 'ns'). Choose one of these.")
    factor, unit_text = _TIME_UNITS[unit]
    e, r = _index(channels.emitters, emitter, "emitter"), _index(channels.receivers, receiver, "receiver")
    h, error = channels.h[e, r], channels.standard_error_all[e, r]
    edges = np.arange(h.shape[1] + 1) * channels.bin_width * factor
    names = [_order_text(order) for order in channels.orders]
    seen = [k for k in range(len(names)) if h[k].any()]  # an order without light has no colour in the legend
    if ax is None:
        _, ax = plotting.subplots(figsize=(7.5, 4.2), layout="constrained")
    stacked = stacked and not log
    draw = _draw_stack if stacked else partial(_draw_lines, log=log)
    draw(ax, edges, h[seen], [names[k] for k in seen])
    if errors:
        _draw_band(ax, edges, h.sum(axis=0), error, log, "± standard error" if stacked else "sum ± standard error")
    _limit_axes(ax, edges, h, error, log)
    ax.set_xlabel(f"time since emission ({unit_text})")
    ax.set_ylabel("h(t) (1/s)")
    ax.set_title(_channel_title(channels, e, r), fontsize="medium")
    ax.legend(fontsize="small", frameon=False)
    return ax
