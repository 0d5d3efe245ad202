"""Arrays live as long as someone holds them, whatever becomes of the objects that they come from.

tools/python-memory.sh runs these tests under valgrind, which detects every access to memory that was freed.
"""

from __future__ import annotations

import gc
import pickle
from collections.abc import Iterator, Mapping, Sequence

import lichtmc
import numpy as np
import pytest
from rooms import cube


def lit_room() -> lichtmc.Room:
    """A room with something of each kind that results have arrays of."""
    room = lichtmc.Room.cuboid((2.0, 2.0, 2.0), 0.5)
    room.add_emitter(lichtmc.Lambert((1.0, 1.9, 1.0)), 1000.0, name="lamp")
    room.add_emitter(lichtmc.Isotropic((0.5, 1.5, 0.5)), 100.0, name="bulb")
    room.add_receivers([(1.0, 0.5, 1.0), (0.5, 0.5, 1.0)], names=["a", "b"])
    room.add_area("desk", (0.5, 0.7, 0.5), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    return room


def quick_run(**settings: object) -> lichtmc.Result:
    return lichtmc.simulate(lit_room(), photons=4096, tile=0.5, threads=2, **settings)


def arrays_in(thing: object, path: str, depth: int = 3) -> Iterator[tuple[str, np.ndarray]]:
    """All arrays that can be reached by attributes and elements of an object of lichtmc."""
    if isinstance(thing, np.ndarray):
        yield path, thing
    elif depth and isinstance(thing, Mapping):
        for key in thing:
            yield from arrays_in(thing[key], f"{path}[{key!r}]", depth - 1)
    elif depth and isinstance(thing, Sequence) and not isinstance(thing, (str, bytes)):
        for k, element in enumerate(thing):
            yield from arrays_in(element, f"{path}[{k}]", depth - 1)
    elif depth and type(thing).__module__.startswith("lichtmc"):
        for name in dir(thing):
            if name.startswith("_"):
                continue
            value = getattr(thing, name)
            if not callable(value):
                yield from arrays_in(value, f"{path}.{name}", depth - 1)
        if hasattr(thing, "__len__") and hasattr(thing, "__getitem__"):
            for k in range(min(len(thing), 2)):
                try:
                    element = thing[k]
                except (KeyError, TypeError):
                    continue
                yield from arrays_in(element, f"{path}[{k}]", depth - 1)


def check_they_live(make) -> set[str]:
    """The arrays in make() keep their values when all else is gone; returns their paths."""
    arrays = dict(arrays_in(make(), ""))
    copies = {path: array.copy() for path, array in arrays.items()}
    gc.collect()
    garbage = [np.full(array.size + 1, 7, dtype=np.uint8) for array in arrays.values()]  # takes freed memory
    for path, array in arrays.items():
        assert array.tobytes() == copies[path].tobytes(), path
        if not array.flags.owndata:
            assert not array.flags.writeable, path
    del garbage
    return set(arrays)


def test_arrays_of_results():
    found = check_they_live(lambda: quick_run(per_emitter=True))
    assert {".tiles.irradiance", ".tiles.position", ".receivers.irradiance", ".parts.irradiance"} <= found


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
def test_arrays_of_channels():
    found = check_they_live(lambda: quick_run(impulse_response=1e-9, orders=1, estimator="weight"))
    assert {".channels.h", ".channels.time"} <= found


def test_arrays_of_surfaces_and_areas():
    assert any("grid" in path for path in check_they_live(lambda: quick_run().surfaces["floor"]))
    assert any("grid" in path for path in check_they_live(lambda: quick_run().areas["desk"]))


def test_arrays_of_rooms():
    check_they_live(lit_room)
    check_they_live(lambda: lit_room().surfaces)


def test_arrays_of_comparisons():
    assert ".a" in check_they_live(lambda: lichtmc.compare(quick_run(seed=1), quick_run(seed=2))[0])


def test_arrays_of_scenes():
    check_they_live(lambda: quick_run(per_emitter=True).dim({"lamp": 0.5}))


def test_pictures():
    picture = np.asarray(quick_run().render(width=64, height=48))
    kept = picture.copy()
    gc.collect()
    assert np.array_equal(picture, kept)


def test_what_was_unpickled_lives():
    data = pickle.dumps(quick_run(per_emitter=True))
    check_they_live(lambda: pickle.loads(data))


def test_objects_that_were_never_made():
    """After a failed unpickling the object is empty: its use is an error."""
    room = lichtmc.Room.__new__(lichtmc.Room)
    with pytest.raises(lichtmc.InputError):
        room.__setstate__(cube().__getstate__()[:-1])
    with pytest.raises(TypeError), pytest.warns(RuntimeWarning):
        room.copy()


def test_a_failing_callback_leaves_nothing():
    class Tracked:
        pass

    import weakref

    def run() -> weakref.ref:
        tracked = Tracked()

        def fail(progress: lichtmc.Progress) -> None:
            raise ValueError(tracked)

        with pytest.raises(ValueError):
            lichtmc.simulate(cube(), photons=10**9, tile=0.5, progress=fail)
        return weakref.ref(tracked)

    left = run()
    gc.collect()
    assert left() is None
