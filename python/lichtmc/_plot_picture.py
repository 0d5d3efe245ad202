"""Pictures of rooms with a colour bar: Picture.plot()."""

from __future__ import annotations

from typing import Any

import numpy as np

from lichtmc import _core
from lichtmc._plot_base import pyplot
from lichtmc._plot_grid import EXTEND, add_colour_bar, cell_paper


def plot_picture(picture: _core.Picture, ax: Any = None) -> Any:
    """See Picture.plot()."""
    plotting = pyplot()
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LogNorm, Normalize

    rows, columns = picture.rgba.shape[:2]
    if ax is None:
        width = 8.0
        _, ax = plotting.subplots(figsize=(width + 1.2, width * rows / columns), layout="compressed")
    ax.imshow(picture.rgba, interpolation="antialiased")
    ax.set_axis_off()
    norm = (LogNorm if picture.logarithmic else Normalize)(picture.low, picture.high)
    colours = ScalarMappable(norm, picture.colours)
    word, unit = ("illuminance", "lx") if picture.irradiance_unit == "lx" else ("irradiance", "W/m²")
    known = picture.irradiance[np.isfinite(picture.irradiance)]
    above = bool(np.any(known > picture.high * (1 + 1e-6)))
    below = bool(np.any(known < picture.low))
    paper = cell_paper(rows, columns)
    extend = EXTEND[above, below]
    if known.size > 0:
        add_colour_bar(ax, paper, colours, f"{word} ({unit})", extend)
    return ax
