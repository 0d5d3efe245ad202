"""Progress for people: a bar by tqdm if it is installed, else a line of text."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any


def _error_text(progress: Any) -> str:
    return "" if math.isnan(progress.rms_relative_error) else f"error {100 * progress.rms_relative_error:.2g} %"


class _Bar:
    """One bar of tqdm for each stage; in a notebook tqdm draws it as a widget."""

    def __init__(self, tqdm: Any) -> None:
        self._tqdm = tqdm
        self._bar: Any = None
        self._stage = ""

    def __call__(self, progress: Any) -> None:
        if progress.stage == "preparation":
            return
        if progress.stage != self._stage:
            self.close()
            self._stage = progress.stage
            limited = progress.target < 2**62
            self._bar = self._tqdm(
                total=progress.target if limited else None, desc=progress.stage, unit="", unit_scale=True
            )
        self._bar.set_postfix_str(_error_text(progress), refresh=False)
        self._bar.update(progress.histories - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


class _Line:
    """A line on stderr that is written anew; a notebook shows it the same way."""

    def __init__(self) -> None:
        self._length = 0

    def __call__(self, progress: Any) -> None:
        if progress.stage == "preparation":
            text = f"lichtmc: {progress.step}"
        else:
            text = f"lichtmc: {progress.stage}, {progress.histories:.3g}"
            if progress.target < 2**62:
                text += f" of {progress.target:.3g}"
            text += f", {progress.seconds:.0f} s"
            if error := _error_text(progress):
                text += f", {error}"
        print("\r" + text.ljust(self._length), end="", file=sys.stderr, flush=True)
        self._length = len(text)

    def close(self) -> None:
        if self._length:
            print(file=sys.stderr)


@contextmanager
def listener(progress: bool | Callable[[Any], object] | None) -> Iterator[Callable[[Any], object] | None]:
    """The callback that `progress` (of simulate()) asks for, or None."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        try:
            from tqdm.auto import tqdm  # type: ignore[import-untyped]
        except ImportError:
            shown: _Bar | _Line = _Line()
        else:
            shown = _Bar(tqdm)
        try:
            yield shown
        finally:
            shown.close()
    else:
        yield progress
