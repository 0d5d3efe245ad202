"""What all plots share: matplotlib, which is imported when a plot is made, and numbers in texts."""

from __future__ import annotations

import math
from typing import Any


def pyplot() -> Any:
    """matplotlib.pyplot."""
    try:
        from matplotlib import pyplot as module
    except ImportError as missing:
        raise ImportError('Plots need matplotlib. Install it: pip install "lichtmc[plot]"') from missing
    return module


def number_text(value: float) -> str:
    """A value in three digits, without a power of ten."""
    if value == 0 or not math.isfinite(value):
        return "0" if value == 0 else "–"
    decimals = max(0, 2 - math.floor(math.log10(abs(value))))
    return f"{value:.{min(decimals, 9)}f}"


def grouped_number_text(value: float) -> str:
    """The same with a space between thousands, for large values."""
    return f"{float(f'{value:.3g}'):,.0f}".replace(",", "\u2009") if value >= 1000 else number_text(value)
