"""Plots of impulse responses: Result.plot_channel()."""

from __future__ import annotations

import difflib
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lichtmc import _core
from lichtmc._plot_base import grouped_number_text, pyplot

Array = NDArray[np.float64]

_TIME_UNITS = {"s": (1.0, "s"), "ms": (1e3, "ms"), "us": (1e6, "µs"), "µs": (1e6, "µs"), "ns": (1e9, "ns")}
_SHOWN_GAIN = 0.999  # of the gain, that the time axis shows
_NOISY = 0.2  # relative standard error, above which bins are shown together
_MOST_TOGETHER = 20  # that part of all bins at most
_LOW = 0.02  # of the top of a linear axis: not distinguishable from 0
_SIGNIFICANT = 2.0  # standard errors: a logarithmic axis ends behind the last such bin
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


@dataclass
class _Response:
    """What is shown of an impulse response: bins, of which some are several of the channel together."""

    edges: Array  # (bins + 1,), in the unit of the plot
    orders: Array  # (orders, bins), 1/s
    error: Array  # (bins,), of the sum of the orders

    @property
    def total(self) -> Array:
        return np.asarray(self.orders.sum(axis=0))


def _first_of_groups(total: Array, error: Array) -> list[int]:
    """The first bins of groups that have small enough errors together."""
    most = max(1, len(total) // _MOST_TOGETHER)
    noisy = ~(error <= _NOISY * total) | (total == 0)
    noisy[: int(np.argmax(total > 0))] = False  # before the first light
    firsts: list[int] = []
    total_so_far = variance = 0.0
    is_open = False  # whether the last group takes further bins
    for k in range(len(total)):
        if not noisy[k] or not is_open:
            firsts.append(k)
            total_so_far = variance = 0.0
        total_so_far += total[k]
        variance += float(np.nan_to_num(error[k], nan=total[k])) ** 2
        is_open = bool(noisy[k]) and k + 1 - firsts[-1] < most and not math.sqrt(variance) <= _NOISY * total_so_far
    return firsts


def _response(channels: _core.Channels, e: int, r: int, unit: float) -> _Response:
    h, error = channels.h[e, r], channels.standard_error_all[e, r]
    firsts = _first_of_groups(h.sum(axis=0), error)
    edges = np.append(firsts, h.shape[1])
    counts = np.diff(edges)
    known = np.add.reduceat(np.isfinite(error).astype(float), firsts) == counts
    together = np.sqrt(np.add.reduceat(np.nan_to_num(error) ** 2, firsts)) / counts
    return _Response(
        edges * channels.bin_width * unit, np.add.reduceat(h, firsts, axis=1) / counts, np.where(known, together, np.nan)
    )


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
    total = h.sum(axis=0)
    if len(names) > 2:  # else it would hide them
        shown = np.where(total > 0, total, np.nan) if log else total
        ax.stairs(shown, edges, baseline=None, color="black", label="sum", linewidth=0.9, zorder=3)
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


def _linear_top(response: _Response) -> tuple[float, bool]:
    """Of the h axis, and whether the line of sight is cut: in one bin it would leave nothing to see of the rest."""
    h, total = response.orders, response.total
    without_sight = np.where(h[0] > 0, 0.0, np.nan_to_num(response.error))
    reflected = float((h[1:].sum(axis=0) + without_sight).max())
    if 0 < reflected < total[np.argmax(h[0])] / _TALL:
        return 1.15 * reflected, True
    return 1.05 * float((total + np.nan_to_num(response.error)).max()), False


def _shown_bins(response: _Response, log: bool) -> tuple[int, int]:
    """The first bin with light, and the last one that the time axis shows."""
    total = response.total
    lit = np.nonzero(total > 0)[0]
    if log:
        clear = np.nonzero(total > _SIGNIFICANT * response.error)[0]
        return int(lit[0]), int(clear[-1] if len(clear) > 0 else lit[-1])
    shares = np.cumsum(total * np.diff(response.edges))
    last = int(np.searchsorted(shares, _SHOWN_GAIN * shares[-1]))
    return int(lit[0]), max(last, int(np.argmax(response.orders[0])) + 1)


def _is_empty_if_linear(response: _Response) -> bool:
    """Whether most of the linear plot would be an empty stretch above a line at the bottom."""
    total = response.total
    if not total.any():
        return False
    first, last = _shown_bins(response, log=False)
    shown = slice(first, last + 1)
    widths = np.diff(response.edges)[shown]
    low = total[shown] < _LOW * _linear_top(response)[0]
    return float(widths[low].sum()) > 0.5 * float(widths.sum())


def _channels_of(result: _core.Result) -> _core.Channels:
    if result.channels is None:
        raise _core.InputError(
            "The result has no impulse responses (allowed: results of simulate(…, impulse_response=…) with receivers). "
            "Simulate the room again with the width of the bins, for example impulse_response=0.2e-9."
        )
    return result.channels


def _set_limits(ax: Any, response: _Response, log: bool) -> None:
    edges, total = response.edges, response.total
    first, last = _shown_bins(response, log)
    ax.set_xlim(
        max(0.0, edges[first] - 0.05 * (edges[last] - edges[first])), edges[min(last + 1, len(edges) - 1)]
    )
    if log:
        shown = total[first : last + 1]
        top = float(total.max())
        ax.set_yscale("log")
        ax.set_ylim(max(1e-6 * top, 0.4 * float(shown[shown > 0].min())), 2 * top)
        return
    limit, is_cut = _linear_top(response)
    ax.set_ylim(0.0, limit)
    if is_cut:
        peak = int(np.argmax(response.orders[0]))
        ax.annotate(
            f"line of sight: up to {grouped_number_text(float(total[peak]))} 1/s", xy=((edges[peak] + edges[peak + 1]) / 2, limit),
            xytext=(5, -3), textcoords="offset points", va="top", fontsize="small",
        )  # fmt: skip


def plot_channel(
    result: _core.Result, emitter: int | str = 0, receiver: int | str = 0, ax: Any = None, *, stacked: bool = True,
    log: bool | None = None, errors: bool = True, unit: str = "ns",
) -> Any:  # fmt: skip
    """See Result.plot_channel()."""
    plotting = pyplot()
    channels = _channels_of(result)
    if unit not in _TIME_UNITS:
        raise _core.InputError(f"The argument unit is {unit!r} (allowed: 's', 'ms', 'us', 'ns'). Choose one of these.")
    factor, unit_text = _TIME_UNITS[unit]
    e, r = _index(channels.emitters, emitter, "emitter"), _index(channels.receivers, receiver, "receiver")
    response = _response(channels, e, r, factor)
    h, edges = response.orders, response.edges
    names = [_order_text(order) for order in channels.orders]
    seen = [k for k in range(len(names)) if h[k].any()]  # an order without light has no colour in the legend
    if ax is None:
        _, ax = plotting.subplots(figsize=(7.5, 4.2), layout="constrained")
    log = _is_empty_if_linear(response) if log is None else log
    stacked = stacked and not log
    draw = _draw_stack if stacked else partial(_draw_lines, log=log)
    draw(ax, edges, h[seen], [names[k] for k in seen])
    if errors:
        label = "± standard error" if stacked else "sum ± standard error"
        _draw_band(ax, edges, response.total, response.error, log, label)
    if h.any():
        _set_limits(ax, response, log)
    ax.set_xlabel(f"time since emission ({unit_text})")
    ax.set_ylabel("h(t) (1/s)")
    ax.set_title(_channel_title(channels, e, r), fontsize="medium")
    ax.legend(fontsize="small", frameon=False)
    return ax
