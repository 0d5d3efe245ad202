"""Runs in pieces: resume() and merge()."""

from __future__ import annotations

import warnings
from collections.abc import Iterable

from lichtmc import _core
from lichtmc._arguments import count, number, optional, share, threads_of
from lichtmc._progress import listener
from lichtmc._simulate import OnProgress, ResultWarning, warn_of
from lichtmc._text import end_text


def _require_result(value: object, what: str) -> _core.Result:
    if not isinstance(value, _core.Result):
        raise _core.InputError(
            f"{what} is of type {type(value).__name__} (allowed: a Result). Give what simulate() or Result.load() "
            "has returned."
        )
    return value


def resume(
    result: _core.Result,
    *,
    photons: int | None = None,
    target_error: float | None = None,
    max_time: float | None = None,
    threads: int = 0,
    progress: bool | OnProgress | None = None,
) -> _core.Result:
    """Continues a run: the new result has the digits of one run with these rules. The old result does not change.

    The first rule that is met ends the run. Without any, the run continues to its own rules: that completes a run
    that Ctrl-C has stopped. All other settings are those of the run. If the result meets a rule already (fewer photons
    than it has, or no rule for a run that was complete), the new result is the same as the old.

    Args:
        result: Of simulate(), resume(), merge() (without gaps) or Result.load().
        photons: The total from the start of the run, not how many are added: after 100 000 photons, 300_000 adds
            200 000.
        target_error: Stop at this relative standard error, above 0 and below 1: 0.01 means 1 %. Errors are checked after
            32 768 photons at the earliest, then each time that there are a quarter more.
        max_time: Stop after this time of the continuation, s.
        threads: Number of threads; 0: one per processor.
        progress: As for simulate().

    Raises:
        InputError: A rule is not valid, or the result has gaps.
        RuntimeError: Memory or the tracing device fails.
    """
    _require_result(result, "The first argument of resume()")
    rules = (
        optional(count, "photons", photons, least=1),
        optional(share, "target_error", target_error),
        optional(number, "max_time", max_time, "above 0, in s"),
    )
    workers = threads_of(threads)
    with listener(progress, max_time=max_time) as told:
        resumed = _core.resume(result, *rules, workers, told.callback)
        told.end(lambda: end_text(resumed))
    return warn_of(resumed, stacklevel=2)


def merge(
    results: Iterable[_core.Result], *, threads: int = 0, progress: bool | OnProgress | None = None
) -> _core.Result:
    """Adds results of parts of one run: the sum has the digits of one run of all their histories.

    Parts are made with `histories` of simulate(), for example on several machines: histories=(0, 1024_000) and
    histories=(1024_000, 2048_000). All but the last end at a multiple of 1024. Order has no influence. A gap is
    allowed; it is told by a ResultWarning.

    Args:
        results: Results of the same room with the same settings, whose histories do not overlap; one or more.
        threads: Number of threads for the direct light, which is computed again; 0: one per processor.
        progress: As for simulate().

    Raises:
        InputError: Rooms, settings or versions differ, or histories overlap.
    """
    if isinstance(results, _core.Result):
        raise _core.InputError(
            "The argument of merge() is one Result (allowed: a list of them). Give the parts as a list."
        )
    workers = threads_of(threads)
    parts = [_require_result(part, f"results[{k}]") for k, part in enumerate(results)]
    with listener(progress) as told:
        merged, gaps = _core.merge(parts, workers, told.callback)
        told.end(lambda: end_text(merged))
    for text in gaps:
        warnings.warn(text, ResultWarning, stacklevel=2)
    return warn_of(merged, stacklevel=2)
