"""Light in rooms: illuminance (lx) or irradiance (W/m²) on all surfaces of a room, each with its standard error.

lichtmc follows photons from the light sources of a room to their absorption on diffusely reflecting surfaces (Monte
Carlo). A room is a :class:`Room`; :func:`simulate` gives a :class:`Result`, whose arrays are numpy arrays.

Units are m, s, W or lm, W/m² or lx. Points and directions have glTF's axes, Y up. Arrays are read-only.
"""

from __future__ import annotations

from lichtmc import _core
from lichtmc._compare import compare
from lichtmc._continue import merge, resume
from lichtmc._core import (
    Advice,
    Area,
    AreaLight,
    AreaResult,
    AreaResults,
    Balance,
    Channels,
    Comparison,
    DesignArea,
    DesignAreas,
    DesignComparison,
    DesignTotals,
    Emitter,
    EmitterParts,
    Error,
    Figure,
    Figures,
    Finding,
    InputError,
    Inspection,
    Isotropic,
    Lambert,
    Luminaire,
    Path,
    Photometry,
    Picture,
    Progress,
    ReceiverResult,
    ReceiverResults,
    Result,
    Room,
    RoomReceivers,
    RoomWarning,
    Scene,
    Settings,
    Spot,
    Study,
    StudyProgress,
    Surface,
    SurfaceResult,
    Surfaces,
    Tiles,
    WalkReport,
    __version__,
    compare_designs,
)
from lichtmc._simulate import ResultWarning, simulate
from lichtmc._study import study

RuntimeError = _core.RuntimeError

# In the order of the pages of the interface: what everybody needs first.
# Without RuntimeError: `from lichtmc import *` would put it in place of Python's own.
__all__ = [
    "Room",
    "simulate",
    "Result",
    "resume",
    "merge",
    "compare",
    "compare_designs",
    "study",
    "Isotropic",
    "Lambert",
    "Spot",
    "AreaLight",
    "Luminaire",
    "Photometry",
    "Emitter",
    "Surface",
    "RoomReceivers",
    "Area",
    "Path",
    "Inspection",
    "Finding",
    "Tiles",
    "Surfaces",
    "SurfaceResult",
    "ReceiverResults",
    "ReceiverResult",
    "AreaResults",
    "AreaResult",
    "Figure",
    "Channels",
    "Figures",
    "EmitterParts",
    "Scene",
    "Balance",
    "WalkReport",
    "Settings",
    "Picture",
    "Progress",
    "Comparison",
    "DesignComparison",
    "DesignAreas",
    "DesignArea",
    "DesignTotals",
    "Study",
    "Advice",
    "StudyProgress",
    "Error",
    "InputError",
    "ResultWarning",
    "RoomWarning",
    "__version__",
]
