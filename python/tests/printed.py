"""Printed texts compared: words exactly, numbers to their last digits.

lichtmc is deterministic: where Embree and the processor's vector instructions are the same, the same program prints the same
text. Between AVX2 and AVX-512, or versions of Embree, the rounding of its floats differs, so that a flight that ends
within about 10⁻⁶ of the room's size of an edge of a face or tile may end on its other side. Along 0.1 m tiles in a room
of 5 m that is one flight in 10⁴ at most; from there on such a history is another one. If a share f of the histories is
others, a mean with the standard error s changes by √(2 f) s: 0.014 s for f = 10⁻⁴. Errors are printed with two digits
at most, so one unit of the last digit is at least s/100, and the change has a standard deviation of at most 1.4 units.
Five units are exceeded in one of 3000 cases. "349 ± 2" is a figure rounded to its error: by 1 it differs if it was near
the limit between both. Other numbers without a decimal point (counts, settings) must be equal in any case.
"""

from __future__ import annotations

import platform
import re
from pathlib import Path

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
UNITS_OF_LAST_DIGIT = 5.0


def arithmetic() -> str:
    """What last digits depend on: the vector instructions of this processor, and the system (for the version of Embree)."""
    flags = Path("/proc/cpuinfo").read_text(encoding="ascii", errors="replace")
    known = {"AVX-512": "avx512f", "AVX2": "avx2"}
    instructions = next((name for name, flag in known.items() if re.search(rf"\b{flag}\b", flags)), "other")
    return f"{instructions}, {' '.join(platform.libc_ver())}"


def _tolerance(printed: re.Match[str]) -> float:
    """How far a number may be from this one; 0 for a whole number that is no figure with an error."""
    mantissa, _, exponent = printed[0].partition("e")
    decimals = len(mantissa.partition(".")[2])
    if decimals or exponent:
        return UNITS_OF_LAST_DIGIT * 10.0 ** (int(exponent or "0") - decimals)
    is_figure = printed.string[printed.end() :].startswith(" ±") or printed.string[: printed.start()].endswith("± ")
    return 1.0 if is_figure else 0.0


def difference(expected: str, actual: str, *, exact: bool) -> str:
    """What differs first between two printed texts, or "" if nothing does. Widths of blanks do not count."""
    expected, actual = (" ".join(text.split()) for text in (expected, actual))
    words = [NUMBER.sub("#", text) for text in (expected, actual)]
    if words[0] != words[1]:
        return f"the words differ:\n{expected}\nexpected, but printed was\n{actual}"
    for old, new in zip(NUMBER.finditer(expected), NUMBER.finditer(actual), strict=True):
        if old[0] == new[0]:
            continue
        tolerance = max(_tolerance(old), _tolerance(new)) * (1 + 1e-9)
        if exact or abs(float(old[0]) - float(new[0])) > tolerance:
            return f"{old[0]} expected, {new[0]} printed in\n{actual}"
    return ""
