"""Printed texts compared: words exactly, numbers to their last digits.

lichtmc is deterministic: on processors with the same vector instructions the same program prints the same text. Between
AVX2 and AVX-512 the rounding differs (Embree computes in float), so that a flight that ends within about 10⁻⁶ of the
room's size of an edge of a face or tile may end on its other side. Along 0.1 m tiles in a room of 5 m that is one flight
in 10⁴ at most; from there on such a history is another one. If a share f of the histories is others, a mean with the
standard error s changes by √(2 f) s: 0.014 s for f = 10⁻⁴. Errors are printed with two digits at most, so one unit of
the last digit is at least s/100, and the change has a standard deviation of at most 1.4 units. Five units are exceeded
in one of 3000 cases. Numbers without a decimal point (counts, settings) must be equal in any case.
"""

from __future__ import annotations

import re
from pathlib import Path

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
UNITS_OF_LAST_DIGIT = 5.0


def instruction_set() -> str:
    """The vector instructions of this processor, on which last digits depend."""
    flags = Path("/proc/cpuinfo").read_text(encoding="ascii", errors="replace")
    for name, flag in (("AVX-512", "avx512f"), ("AVX2", "avx2")):
        if re.search(rf"\b{flag}\b", flags):
            return name
    return "other"


def _last_digit(number: str) -> float:
    """The value of one unit of the last printed digit; 0 for a whole number, which must be equal."""
    mantissa, _, exponent = number.partition("e")
    decimals = len(mantissa.partition(".")[2])
    if not decimals and not exponent:
        return 0.0
    return 10.0 ** (int(exponent or "0") - decimals)


def difference(expected: str, actual: str, *, exact: bool) -> str:
    """What differs first between two printed texts, or "" if nothing does. Widths of blanks do not count."""
    words = [" ".join(NUMBER.sub("#", text).split()) for text in (expected, actual)]
    if words[0] != words[1]:
        return f"the words differ:\n{expected}\nexpected, but printed was\n{actual}"
    for old, new in zip(NUMBER.findall(expected), NUMBER.findall(actual), strict=True):
        if old == new:
            continue
        tolerance = UNITS_OF_LAST_DIGIT * max(_last_digit(old), _last_digit(new))
        # Half of a unit more in the last place: both were rounded.
        if exact or abs(float(old) - float(new)) > tolerance * (1 + 1e-9):
            return f"{old} expected, {new} printed in\n{actual}"
    return ""
