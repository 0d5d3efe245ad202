"""The methods Result.plot_…() and Picture.plot(): plots by matplotlib, which is imported when one of them is called."""

from __future__ import annotations

from lichtmc._plot_channel import plot_channel
from lichtmc._plot_grid import plot_area, plot_surface
from lichtmc._plot_picture import plot_picture

__all__ = ["plot_area", "plot_channel", "plot_picture", "plot_surface"]
