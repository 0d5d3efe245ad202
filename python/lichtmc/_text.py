"""Results in words, for people who print them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lichtmc import _core

_MOST_SURFACES = 12
_MOST_RECEIVERS = 8


def _count(number: int, word: str, words: str = "") -> str:
    return f"{number:,} ".replace(",", " ") + (word if number == 1 else words or word + "s")


def _percent(share: float) -> str:
    return "unknown" if share != share else f"{100 * share:.2g} %"


def _walk_text(walk: Any, of: str) -> str:
    return (
        f"{of}: rms relative standard error {_percent(walk.rms_relative_error)} after "
        f"{_count(walk.histories, 'history', 'histories')} ({walk.estimator}, "
        f"{walk.seconds:.2g} s, ended by {walk.stopped_by})"
    )


def _table(rows: Sequence[tuple[str, ...]]) -> list[str]:
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return ["  " + "  ".join(text.ljust(width) for text, width in zip(row, widths)).rstrip() for row in rows]


def _surface_lines(result: _core.Result, unit: str) -> list[str]:
    surfaces = result.surfaces.values()
    rows = [("surface", f"mean ({unit})", "lowest", "highest", "area (m²)")]
    for one in surfaces[:_MOST_SURFACES]:
        rows.append((one.name, str(one.figure), f"{one.minimum:.3g}", f"{one.maximum:.3g}", f"{one.area:.3g}"))
    lines = _table(rows)
    if len(surfaces) > _MOST_SURFACES:
        lines.append(f"  … and {_count(len(surfaces) - _MOST_SURFACES, 'more surface')}")
    return lines


def _receiver_lines(result: _core.Result, unit: str) -> list[str]:
    receivers = result.receivers
    if len(receivers) > _MOST_RECEIVERS or len(result.areas) > 0:
        return []
    rows = [("receiver", f"irradiance ({unit})" if result.unit == "W" else f"illuminance ({unit})")]
    rows += [(receivers[k].name, str(receivers[k].figure)) for k in range(len(receivers))]
    return _table(rows)


def end_text(result: _core.Result) -> str:
    """How a run has ended, a line for each of its walks."""
    walks = []
    if result.walk is not None:
        walks.append(_walk_text(result.walk, _count(len(result.tiles), "tile")))
    if result.receiver_walk is not None:
        walks.append(_walk_text(result.receiver_walk, _count(len(result.receivers), "receiver")))
    return "\n".join(walks)


def result_text(result: _core.Result) -> str:
    """The most important figures of a result, some lines."""
    unit = "W/m²" if result.unit == "W" else "lx"
    lines = [f"Result of {result.room.source!r}"]
    if result.walk is not None:
        lines.append(_walk_text(result.walk, _count(len(result.tiles), "tile")))
        lines += _surface_lines(result, unit)
    if result.receiver_walk is not None:
        lines.append(_walk_text(result.receiver_walk, _count(len(result.receivers), "receiver")))
        lines += _receiver_lines(result, unit)
    lines += ["  " + area.text for area in result.areas.values()]
    if result.channels is not None:
        lines.append(f"  {result.channels!r}")
    if result.warnings:
        lines.append(_count(len(result.warnings), "warning") + ", see .warnings")
    return "\n".join(lines)
