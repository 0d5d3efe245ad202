"""Runs: simulate() and how it tells its progress."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Literal

from lichtmc import _core
from lichtmc._arguments import count, flag, histories_of, number, numbers, optional, require_room, share, threads_of, word
from lichtmc._progress import listener
from lichtmc._text import end_text

Estimator = Literal["collision", "weight", "absorption", "auto"]
Engine = Literal["auto", "cuboid", "embree", "embree-fast"]
Measured = Literal["all", "tiles", "receivers"]
WalkDirection = Literal["forward", "backward"]
ReceiverWalk = Literal["auto", "two-way", "next-event", "backward"]
Direct = Literal["sampled", "analytic"]
OnProgress = Callable[[_core.Progress], object]


class ResultWarning(UserWarning):
    """What affects the meaning of the figures of a result: each of Result.warnings is issued as one."""


def warn_of(result: _core.Result, *, stacklevel: int) -> _core.Result:
    """Issues the warnings of a result, as of the line that is `stacklevel` calls above the caller."""
    for text in result.warnings:
        warnings.warn(text, ResultWarning, stacklevel=stacklevel + 1)
    return result


def simulate(
    room: _core.Room,
    *,
    photons: int | None = None,
    target_error: float | None = None,
    max_time: float | None = None,
    seed: int = 1,
    threads: int = 0,
    estimator: Estimator = "collision",
    engine: Engine = "auto",
    tile: float = 0.1,
    only: Measured = "all",
    tile_walk: WalkDirection = "forward",
    receiver_walk: ReceiverWalk = "auto",
    direct: Direct = "sampled",
    max_bounces: int | None = None,
    error_floor: float | None = None,
    error_floor_share: float = 0.01,
    histories: tuple[int, int] | None = None,
    impulse_response: float | None = None,
    time_span: float | None = None,
    orders: int = 0,
    frequencies: tuple[float, float, float] | None = None,
    squared_weights: bool = False,
    per_emitter: bool = False,
    progress: bool | OnProgress | None = None,
) -> _core.Result:
    """Simulates a room: the irradiance (W/m²) or illuminance (lx) of every tile and receiver, with its standard error.

    The same room, settings and seed give the same digits for any number of threads, and those of the command line.
    The first stop rule that is met ends the run: `photons`, `target_error`, `max_time`.

    Ctrl-C stops the run; the result then contains what was simulated so far, and its `stopped_by` is "interrupt". A
    second Ctrl-C raises KeyboardInterrupt.

    Args:
        room: The room. The result keeps it as it is now.
        photons: Histories to simulate, 1 or more: for the tiles, and the same number for all receivers together.
            Default: a million if there is no other stop rule, else no limit.
        target_error: Stop at this relative standard error, above 0 and below 1: 0.01 means 1 %. Of tiles: the rms, weighted by
            area; of receivers: the rms.
        max_time: Stop after this time, s.
        seed: Of the random numbers.
        threads: Number of threads; 0: one per processor.
        estimator: "collision", "weight", "absorption", or "auto": the most efficient one, by a short pilot of each.
            With `max_bounces` or `impulse_response` give "weight": the command line then takes it by itself,
            simulate() does not.
        engine: "auto", "cuboid", "embree" or "embree-fast".
        tile: Edge of a tile, m.
        only: "all", "tiles" or "receivers": what is measured.
        tile_walk: "forward" or "backward": photons from the emitters, or walks from the tiles.
        receiver_walk: "auto", "two-way", "next-event" or "backward".
        direct: "sampled", or "analytic": the direct light of tiles is integrated, photons score reflected light only.
        max_bounces: Ends each history after this many flights. With estimator="weight" only: others, also the default,
            raise an InputError.
        error_floor: Irradiance (W/m² or lx) to which relative errors refer where it is darker.
        error_floor_share: The same as a share of the mean irradiance, if `error_floor` is not given.
        histories: (first, behind the last): a part of a run, for merge(). In place of `photons`.
        impulse_response: Width of the bins, s: measures impulse responses at the receivers. Give estimator="weight"
            with it: with the default, late bins have large errors, and a warning says so.
        time_span: Of the impulse responses, s. Default: chosen from the room.
        orders: Light of 0, 1, … `orders` reflections is kept apart in the impulse responses.
        frequencies: (first, last, step) in Hz, at which the frequency response is accumulated.
        squared_weights: Adds the rms delay spread with the weights h².
        per_emitter: Keeps the part of each emitter apart: at receivers and areas, or in the impulse responses.
        progress: True: a progress bar (by tqdm if it is installed). Or a function that is called with a Progress
            some times a second, in the calling thread; an exception from it ends the run and is raised. With True,
            a run of more than two seconds says how it ended, also where there is no terminal.

    Raises:
        InputError: The room or an argument is not valid.
        RuntimeError: Memory or the tracing device fails.
    """
    require_room(room, "simulate")
    settings = _core.make_settings(
        photons=optional(count, "photons", photons, least=1),
        target_error=optional(share, "target_error", target_error),
        max_time=optional(number, "max_time", max_time, "above 0, in s"),
        seed=count("seed", seed),
        threads=threads_of(threads),
        estimator=word("estimator", estimator),
        engine=word("engine", engine),
        tile=number("tile", tile, "above 0, in m"),
        only=word("only", only),
        tile_walk=word("tile_walk", tile_walk),
        receiver_walk=word("receiver_walk", receiver_walk),
        direct=word("direct", direct),
        max_bounces=optional(count, "max_bounces", max_bounces, least=1, most=4_000_000_000),
        error_floor=optional(number, "error_floor", error_floor, "0 or more, in W/m² or lx"),
        error_floor_share=number("error_floor_share", error_floor_share, "0 or more; 0.01 means 1 %"),
        histories=optional(histories_of, "histories", histories),
        impulse_response=optional(number, "impulse_response", impulse_response, "above 0, in s"),
        time_span=optional(number, "time_span", time_span, "above 0, in s"),
        orders=count("orders", orders, most=2**32 - 1),
        frequencies=optional(numbers, "frequencies", frequencies, 3, "first, last, step in Hz"),
        squared_weights=flag("squared_weights", squared_weights),
        per_emitter=flag("per_emitter", per_emitter),
    )
    with listener(progress, max_time=max_time) as told:
        result = _core.simulate(room, settings, told.callback)
        told.end(lambda: end_text(result))
    return warn_of(result, stacklevel=2)
