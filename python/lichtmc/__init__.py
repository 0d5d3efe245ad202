"""Light in rooms: illuminance (lx) or irradiance (W/m²) on all surfaces of a room, each with its standard error.

lichtmc follows photons from the light sources of a room to their absorption on diffusely reflecting surfaces (Monte
Carlo). A room is a :class:`Room`; :func:`simulate` gives a :class:`Result`, whose arrays are numpy arrays.

Units are m, s, W or lm, W/m² or lx. Points and directions have glTF's axes, Y up. Arrays are read-only.
"""

from __future__ import annotations

from lichtmc._core import Error, InputError, Progress, Result, Room, RuntimeError, Settings, Tiles, __version__
from lichtmc._core import (
    AreaResult,
    AreaResults,
    Balance,
    Channels,
    EmitterParts,
    Figure,
    Figures,
    Picture,
    ReceiverResult,
    ReceiverResults,
    Scene,
    SurfaceResult,
    Surfaces,
    WalkReport,
)
from lichtmc._simulate import ResultWarning, simulate

__all__ = [
    "AreaResult",
    "AreaResults",
    "Balance",
    "Channels",
    "EmitterParts",
    "Error",
    "Figure",
    "Figures",
    "InputError",
    "Picture",
    "Progress",
    "ReceiverResult",
    "ReceiverResults",
    "Result",
    "ResultWarning",
    "Room",
    "RuntimeError",
    "Scene",
    "Settings",
    "SurfaceResult",
    "Surfaces",
    "Tiles",
    "WalkReport",
    "simulate",
    "__version__",
]
