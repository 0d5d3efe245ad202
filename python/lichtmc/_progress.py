"""Progress for people: a bar by tqdm if it is installed, else a line of text.

On a terminal the line is written anew, in a notebook it is an output that changes; elsewhere, as in a file, there is a
line every few seconds. A last line says how a run of more than two seconds has ended.
"""

from __future__ import annotations

import importlib.util
import math
import os
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Protocol

from lichtmc import _core

_LINE_INTERVAL = 5.0  # s
_USUAL_COLUMNS = 80  # of a terminal that does not tell
_SHORT = 2.0  # s: the end of such runs is not told
_NO_LIMIT = 2**62  # of histories: other stop rules alone end the run


class _Shown(Protocol):
    def __call__(self, progress: Any) -> None: ...
    def end(self, text: str) -> None: ...
    def close(self) -> None: ...


def _count(number: float) -> str:
    for suffix in ("", "k", "M", "G", "T"):
        if number < 999.5:
            break
        number /= 1000
    return f"{number:.3g}{suffix}"


def _duration(seconds: float) -> str:
    whole = math.ceil(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"


def _error_text(progress: _core.Progress) -> str:
    return "" if math.isnan(progress.rms_relative_error) else f"error {100 * progress.rms_relative_error:.2g} %"


def _is_limited(progress: _core.Progress) -> bool:
    return progress.target < _NO_LIMIT


def _text(progress: _core.Progress | _core.StudyProgress, max_time: float | None) -> str:
    """What a line says. max_time: of the run, s."""
    if isinstance(progress, _core.StudyProgress):
        of = f"{progress.done + 1} of {progress.of}: " if progress.of else ""
        return f"{of}{progress.what}, {progress.seconds:.0f} s of about {progress.of_seconds:.0f} s"
    if progress.stage == "preparation":
        return progress.step
    if progress.stage == "pilot":
        return "choosing the estimator"
    done = _count(progress.histories)
    if _is_limited(progress):
        done += f" of {_count(progress.target)}"
    if progress.stage == "direct light":
        return f"direct light of {done}"
    parts = [f"{done} histories for the {progress.stage}"]
    if error := _error_text(progress):
        parts.append(error)
    left = [progress.seconds_to_target]
    if _is_limited(progress) and progress.histories:
        left.append(progress.seconds * (progress.target - progress.histories) / progress.histories)
    if max_time is not None:
        left.append(max_time - progress.seconds)
    known = [seconds for seconds in left if not math.isnan(seconds)]
    if known:
        parts.append(f"about {_duration(max(min(known), 0.0))} left")
    return ", ".join(parts)


def repr_of(progress: _core.Progress) -> str:
    """As "tiles: 1.2e+06 of 2e+06, 3.1 s, error 2.1 %"."""
    if progress.stage == "preparation":
        return f"preparation: {progress.step}"
    parts = [f"{progress.stage}: {progress.histories:.3g}"]
    if _is_limited(progress):
        parts[0] += f" of {progress.target:.3g}"
    parts.append(f"{progress.seconds:.1f} s")
    if error := _error_text(progress):
        parts.append(error)
    return ", ".join(parts)


class _Bar:
    """One bar of tqdm for each stage, removed at its end; in a notebook tqdm draws it as a widget."""

    def __init__(self, tqdm: Any) -> None:
        self._tqdm = tqdm
        self._bar: Any = None
        self._stage = ""

    def __call__(self, progress: Any) -> None:
        if isinstance(progress, _core.StudyProgress):
            self._show("study", progress.of or None, progress.done, progress.what)
        elif progress.stage not in ("preparation", "pilot"):
            total = progress.target if _is_limited(progress) else None
            self._show(progress.stage, total, progress.histories, _error_text(progress))

    def _show(self, stage: str, total: int | None, done: int, text: str) -> None:
        if stage != self._stage:
            self.close()
            self._stage = stage
            self._bar = self._tqdm(total=total, desc=stage, unit="", unit_scale=True, leave=False)
        self._bar.total = total
        self._bar.set_postfix_str(text, refresh=False)
        self._bar.update(done - self._bar.n)

    def end(self, text: str) -> None:
        pass  # the bars remain

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
            self._bar = None


def _columns() -> int:
    """Of the terminal that stderr is; stdout may be a file, and COLUMNS of another terminal."""
    try:
        return os.get_terminal_size(sys.stderr.fileno()).columns or _USUAL_COLUMNS
    except (AttributeError, OSError, ValueError):  # stderr has been replaced by an object without a file
        return _USUAL_COLUMNS


class _TerminalLine:
    """A line on stderr that is written anew, and removed at the end."""

    def __init__(self, max_time: float | None) -> None:
        self._max_time = max_time
        self._drawn = False

    def __call__(self, progress: Any) -> None:
        text = _text(progress, self._max_time)[: _columns() - 1]  # a line that wraps would not be written anew
        print(f"\r{text}\x1b[K", end="", file=sys.stderr, flush=True)
        self._drawn = True

    def end(self, text: str) -> None:
        self.close()
        print(text, file=sys.stderr, flush=True)

    def close(self) -> None:
        if self._drawn:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)
        self._drawn = False


class _Lines:
    """A line on stderr every few seconds."""

    def __init__(self, max_time: float | None) -> None:
        self._max_time = max_time
        self._last = time.monotonic()

    def __call__(self, progress: Any) -> None:
        now = time.monotonic()
        if now - self._last >= _LINE_INTERVAL:
            self._last = now
            print(_text(progress, self._max_time), file=sys.stderr, flush=True)

    def end(self, text: str) -> None:
        print(text, file=sys.stderr, flush=True)

    def close(self) -> None:
        pass


class _NotebookLine:
    """An output of a notebook's cell that changes; empty after a short run."""

    def __init__(self, display: Callable[..., Any], max_time: float | None) -> None:
        self._display = display
        self._max_time = max_time
        self._handle: Any = None

    def _show(self, text: str) -> None:
        data = {"text/plain": text}
        if self._handle is None:
            self._handle = self._display(data, raw=True, display_id=True)
        else:
            self._handle.update(data, raw=True)

    def __call__(self, progress: Any) -> None:
        self._show(_text(progress, self._max_time))

    def end(self, text: str) -> None:
        self._show(text)
        self._handle = None

    def close(self) -> None:
        if self._handle is not None:
            self._show("")


def _notebook_display() -> Callable[..., Any] | None:
    """IPython's display() if this is a kernel of a notebook."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    if shell is None or not hasattr(shell, "kernel"):
        return None
    from IPython.display import display

    return display


def _installed(module: str) -> bool:
    return importlib.util.find_spec(module) is not None


def _shown(max_time: float | None) -> _Shown:
    display = _notebook_display()
    if display is not None:
        if _installed("tqdm") and _installed("ipywidgets"):
            from tqdm.notebook import tqdm as notebook_tqdm  # type: ignore[import-untyped]

            return _Bar(notebook_tqdm)
        return _NotebookLine(display, max_time)
    if not sys.stderr.isatty():
        return _Lines(max_time)
    if _installed("tqdm"):
        from tqdm import tqdm  # type: ignore[import-untyped]

        return _Bar(tqdm)
    return _TerminalLine(max_time)


class Listener:
    """Where a run tells its progress."""

    def __init__(self, callback: Callable[[Any], object] | None, shown: _Shown | None = None) -> None:
        self.callback = callback
        self._shown = shown
        self._began = time.monotonic()

    def end(self, text: Callable[[], str]) -> None:
        """Tells how the run has ended, if it was not a short one."""
        if self._shown is not None and time.monotonic() - self._began > _SHORT:
            self._shown.end(text())


@contextmanager
def listener(
    progress: bool | Callable[[Any], object] | None, *, max_time: float | None = None
) -> Iterator[Listener]:
    """What `progress` (of simulate() and its like) asks for. max_time: of the run, s."""
    if progress is None or progress is False:
        yield Listener(None)
    elif progress is True:
        shown = _shown(max_time)
        try:
            yield Listener(shown, shown)
        finally:
            shown.close()
    elif callable(progress):
        yield Listener(progress)
    else:
        raise _core.InputError(
            f"The argument progress is of type {type(progress).__name__} (allowed: True, False, None, or a function "
            "that takes a Progress). Give one of these."
        )
