"""Arguments of functions: numbers of any kind that mean what is asked for, and clear messages for others."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from typing import Any

from lichtmc._core import InputError, Room


def count(name: str, value: Any, *, least: int = 0, most: int = 2**64 - 1) -> int:
    """A whole number: int, an integer of numpy, or a float without a fraction, as 1e6."""
    whole: int | None = None
    if isinstance(value, float) or hasattr(value, "is_integer") and not isinstance(value, (str, bool)):
        if value.is_integer():
            whole = int(value)
    elif not isinstance(value, bool):
        try:
            whole = operator.index(value)
        except TypeError:
            pass
    if whole is None or not least <= whole <= most:
        limits = f"{least} or more" if most == 2**64 - 1 else f"{least} to {most}"
        raise InputError(
            f"The argument {name} is {value!r} (allowed: a whole number, {limits}). "
            f"Give it as such, for example {name}={max(least, 1)}."
        )
    return whole


def threads_of(value: Any) -> int:
    """A number of threads; 0: one per processor."""
    return count("threads", value, most=2**31 - 1)


def require_room(value: Any, function: str) -> None:
    """The first argument of a function."""
    if not isinstance(value, Room):
        raise InputError(
            f"The first argument of {function}() is {value!r} (allowed: a Room). Make one, for example with "
            "Room.from_gltf(path)."
        )


def number(name: str, value: Any, meaning: str) -> float:
    """A real number: int, float, or one of numpy. meaning: its range and unit, for the message."""
    if not isinstance(value, (str, bytes, bool)):
        try:
            return float(value)
        except (TypeError, ValueError, OverflowError):
            pass
    raise InputError(f"The argument {name} is {value!r} (allowed: {meaning}). Give it as a number.")


def share(name: str, value: Any) -> float:
    """A number below 1, as 0.01 for 1 %: larger ones were meant in per cent. The library refuses those not above 0."""
    meaning = "above 0 and below 1; 0.01 means 1 %"
    given = number(name, value, meaning)
    if 1 <= given < math.inf:
        raise InputError(
            f"The argument {name} is {value!r}, which means {100 * given:g} % (allowed: {meaning}). For {given:g} % give "
            f"{name}={given / 100:g}."
        )
    return given


def numbers(name: str, values: Any, length: int, meaning: str) -> tuple[float, ...]:
    """A sequence of `length` real numbers."""
    try:
        given = tuple(values)
    except TypeError:
        given = ()
    if isinstance(values, (str, bytes)) or len(given) != length:
        raise InputError(f"The argument {name} is {values!r} (allowed: {length} numbers: {meaning}). Give it as such.")
    return tuple(number(name, value, meaning) for value in given)


def histories_of(name: str, value: Any) -> tuple[int, int]:
    """The first history and the one behind the last."""
    try:
        first, last = value
    except (TypeError, ValueError):
        raise InputError(
            f"The argument {name} is {value!r} (allowed: two whole numbers, the first history and the one behind the "
            f"last). Give it as such, for example {name}=(0, 1024000)."
        ) from None
    return count(name, first), count(name, last)


def optional(convert: Callable[..., Any], name: str, value: Any, *rest: Any, **limits: Any) -> Any:
    """None, or the value converted by one of these functions."""
    return None if value is None else convert(name, value, *rest, **limits)


def flag(name: str, value: Any) -> bool:
    """True or False."""
    if value is True or value is False or type(value).__name__ in ("bool", "bool_"):
        return bool(value)
    raise InputError(f"The argument {name} is {value!r} (allowed: True, False). Give one of them.")


def word(name: str, value: Any) -> str:
    """A string."""
    if isinstance(value, str):
        return value
    raise InputError(f"The argument {name} is {value!r} (allowed: a string). Give it as such.")
