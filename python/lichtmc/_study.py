"""Studies: time against error in a room."""

from __future__ import annotations

from collections.abc import Callable

from lichtmc import _core
from lichtmc._arguments import count, number, optional, require_room, threads_of
from lichtmc._progress import listener


def study(
    room: _core.Room,
    seconds: float = 600.0,
    *,
    tile: float | None = None,
    seed: int = 1,
    threads: int = 0,
    progress: bool | Callable[[_core.StudyProgress], object] | None = None,
) -> _core.Study:
    """Measures time against error in a room, and recommends settings.

    Every estimator runs, forward and backward, with direct light sampled and integrated, with growing numbers of
    histories; the estimator "weight" cut off after 2 … 50 flights; and other sizes of tiles. All are compared with a
    reference of 30 times as many histories. Receivers are not studied.

    Ctrl-C ends the study; what was measured so far is returned. If that is nothing, and after a second Ctrl-C,
    KeyboardInterrupt is raised.

    Args:
        room: The room.
        seconds: Approximate time of the study, s, 5 or more.
        tile: Edge of a tile, m; half and twice this edge are measured too. Default: 0.1 m, more in large rooms.
        seed: Of the random numbers; the reference has another one.
        threads: Number of threads; 0: one per processor.
        progress: True, or a function that is called with a StudyProgress some times a second.

    Raises:
        InputError: The room or an argument is not valid, or the time is too short for a reference.
    """
    require_room(room, "study")
    arguments = (
        number("seconds", seconds, "5 or more, in s"),
        optional(number, "tile", tile, "above 0, in m"),
        count("seed", seed),
        threads_of(threads),
    )
    with listener(progress) as told:
        found = _core.study(room, *arguments, told.callback)
        told.end(lambda: str(found))
    return found
