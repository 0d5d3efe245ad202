"""Pickles and copies of rooms and results: exact, and refused when damaged."""

from __future__ import annotations

import copy
import ctypes
import json
import multiprocessing
import pickle
import resource
import struct
import threading
from pathlib import Path

import lichtmc
import pytest
from rooms import DATA, SCENES, cube, living_room, same, same_tiles
from test_lifetime import arrays_in


@pytest.fixture(scope="module")
def result() -> lichtmc.Result:
    return lichtmc.simulate(cube(), photons=20_000, tile=0.5)


def full_room() -> lichtmc.Room:
    """A room with a member of each kind."""
    room = lichtmc.Room.from_gltf(SCENES / "living_room.glb")
    lamp = DATA / "luminaires" / "c_0_180.ies"
    room.add_emitter(lichtmc.Luminaire(lamp, (1.0, 2.0, 1.0)), name="first")
    room.add_emitter(lichtmc.Luminaire(lamp, (2.0, 2.0, 1.0), rotation_deg=30.0, scale=2.0), name="second")
    room.add_emitter(lichtmc.Isotropic((1.0, 1.5, 2.0)), 10.0, name="bulb", delay=1e-9, maintenance_factor=0.8)
    room.add_emitter(lichtmc.Spot((1.0, 2.0, 2.0), inner_deg=5.0, outer_deg=20.0), 10.0, name="spot")
    room.add_receivers([(1.0, 1.0, 1.0)], names=["Zürich"], half_angle=60.0, concentrator_index=1.5, filter_gain=0.9)
    room.add_working_plane(0.75, target_lx=300.0, target_uniformity=0.6)
    room.limit_reflectance(0.9)
    return room


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
@pytest.mark.parametrize("settings", [{"per_emitter": True}, {"impulse_response": 1e-9, "frequencies": (0, 1e8, 1e7)}])
def test_all_of_a_result_is_the_same_after_pickling(settings):
    result = lichtmc.simulate(full_room(), photons=2000, tile=0.5, **settings)
    again = pickle.loads(pickle.dumps(result))
    assert pickle.dumps(again) == pickle.dumps(result)
    expected, found = dict(arrays_in(result, "")), dict(arrays_in(again, ""))
    assert expected.keys() == found.keys() and len(found) > 20
    for path, array in expected.items():
        assert same(array, found[path]), path
    assert json.dumps(again.summary()) == json.dumps(result.summary())


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
@pytest.mark.parametrize("make", [cube, living_room, full_room])
def test_a_room_is_the_same_after_pickling(make):
    room = make()
    again = pickle.loads(pickle.dumps(room))
    assert pickle.dumps(again) == pickle.dumps(room)
    assert same_tiles(
        lichtmc.simulate(again, photons=3000, tile=0.5), lichtmc.simulate(room, photons=3000, tile=0.5)
    )


def test_a_result_is_the_same_after_pickling(result):
    again = pickle.loads(pickle.dumps(result))
    assert pickle.dumps(again) == pickle.dumps(result)
    assert same_tiles(again, result)
    assert again.warnings == result.warnings
    assert again.stopped_by == result.stopped_by


def test_an_unpickled_result_can_be_continued(result):
    more = lichtmc.resume(pickle.loads(pickle.dumps(result)), photons=40_000)
    assert same_tiles(more, lichtmc.simulate(cube(), photons=40_000, tile=0.5))


def test_copies(result):
    room = cube()
    for copied in (copy.copy(room), copy.deepcopy(room)):
        assert copied is not room
        assert pickle.dumps(copied) == pickle.dumps(room)
    assert copy.copy(result) is result
    assert copy.deepcopy([result])[0] is result


def test_a_room_is_pickled_while_another_thread_changes_it():
    room = living_room()
    for number in range(20_000):
        room.add_emitter(lichtmc.Isotropic((1.0, 1.0, 1.0)), 1.0, name=f"lamp {number}")
    kept = len(room.emitters) - len(room.overrides)
    stop = threading.Event()

    def change() -> None:
        number = 0
        while not stop.is_set():
            room.add_emitter(lichtmc.Isotropic((1.0, 1.0, 1.0)), 1.0, name=f"another lamp {number}")
            number += 1

    thread = threading.Thread(target=change)
    thread.start()
    try:
        for _ in range(10):
            again = pickle.loads(pickle.dumps(room))
            # Each change adds an emitter and a sentence.
            assert len(again.emitters) - len(again.overrides) == kept
    finally:
        stop.set()
        thread.join()


def _sealed(state: bytes, content: bytes) -> bytes:
    """Content with the first line that it would have if lichtmc had written it."""

    class Hash(ctypes.Structure):
        _fields_ = (("low", ctypes.c_uint64), ("high", ctypes.c_uint64))

    try:
        xxh3 = ctypes.CDLL("libxxhash.so.0").XXH3_128bits
    except (OSError, AttributeError):
        pytest.skip("requires the library xxHash")
    xxh3.argtypes, xxh3.restype = (ctypes.c_char_p, ctypes.c_size_t), Hash
    checksum = xxh3(content, len(content))
    beginning = state[: state.index(b"\n")].rsplit(b", ", 1)[0].decode()
    line = f"{beginning}, {len(content)} bytes follow; XXH3-128 {checksum.high:016x}{checksum.low:016x}\n"
    return line.encode() + content


def test_wrong_numbers_of_elements_take_little_memory():
    """The checksum does not detect them if it was made for them."""
    state = cube().__getstate__()
    content = state[state.index(b"\n") + 1:]
    assert _sealed(state, content) == state
    (length,) = struct.unpack_from("<Q", content)
    place = 8 + length + 4  # of the number of surfaces, after the source and the quantity
    assert struct.unpack_from("<Q", content, place) == (len(cube().surfaces),)
    zeros = bytes(2_000_000)
    forged = _sealed(state, content[:place] + struct.pack("<Q", len(zeros)) + zeros)
    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    limits = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (used + 100_000_000, limits[1]))
    try:
        with pytest.raises(lichtmc.InputError, match="damaged"):
            _read(lichtmc.Room, forged)
    finally:
        resource.setrlimit(resource.RLIMIT_AS, limits)


def _forged(state: bytes, found: bytes, replacement: bytes) -> bytes:
    content = state[state.index(b"\n") + 1:]
    assert content.count(found) == 1 and len(found) == len(replacement)
    return _sealed(state, content.replace(found, replacement))


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
def test_numbers_that_do_not_fit_each_other_are_refused():
    """Views would show other memory."""
    room = lichtmc.Room.from_triangles([(0.25, 0, 0), (1.25, 0, 0), (0.25, 0, 1)], [(0, 2, 1)], reflectance=0.5)
    room.add_emitter(lichtmc.Isotropic((0.5, 1, 0.25)), 10.0, name="first")
    room.add_emitter(lichtmc.Isotropic((0.5, 1.5, 0.25)), 20.0, name="second")
    room.add_receivers([(0.5, 0.5, 0.25)])
    triangle = struct.pack("<Q3I", 1, 0, 1, 2)
    with pytest.raises(lichtmc.InputError, match="damaged"):
        _read(lichtmc.Room, _forged(room.__getstate__(), triangle, struct.pack("<Q3I", 1, 0, 1, 1_000_000)))

    result = lichtmc.simulate(room, photons=2000, tile=0.5, per_emitter=True)
    state = result.__getstate__()
    _read(lichtmc.Result, state)
    receivers = b"second" + struct.pack("<ddQ", 20.0, 1.0, 1)
    with pytest.raises(lichtmc.InputError, match="damaged"):
        _read(lichtmc.Result, _forged(state, receivers, b"second" + struct.pack("<ddQ", 20.0, 1.0, 100_000_000)))


def _read(cls: type, state: bytes) -> None:
    cls.__new__(cls).__setstate__(state)


@pytest.mark.parametrize("of_result", [False, True])
def test_damaged_bytes_are_refused(result, of_result):
    thing = result if of_result else cube()
    state = thing.__getstate__()
    cls = type(thing)
    _read(cls, state)
    step = max(1, len(state) // 50)
    for position in range(0, len(state), step):
        damaged = bytearray(state)
        damaged[position] ^= 0x10
        with pytest.raises(lichtmc.InputError):
            _read(cls, bytes(damaged))
        with pytest.raises(lichtmc.InputError):
            _read(cls, state[:position])
    with pytest.raises(lichtmc.InputError, match="damaged"):
        _read(cls, state + b"\0")
    with pytest.raises(lichtmc.InputError):
        _read(cls, b"")


def test_bytes_of_another_kind_or_version_are_refused(result):
    with pytest.raises(lichtmc.InputError, match="its beginning is not 'lichtmc room'"):
        _read(lichtmc.Room, result.__getstate__())
    old = result.__getstate__().replace(b"layout 1,", b"layout 0,", 1)
    with pytest.raises(lichtmc.InputError, match="layout 0.*layout 1"):
        _read(lichtmc.Result, old)
    other = result.__getstate__().replace(lichtmc.__version__.encode(), b"0.0.1", 1)
    with pytest.raises(lichtmc.InputError, match="version 0.0.1"):
        _read(lichtmc.Result, other)


def _simulate(task: tuple[lichtmc.Room, int]) -> lichtmc.Result:
    room, seed = task
    return lichtmc.simulate(room, photons=5000, tile=0.5, seed=seed, threads=1)


def test_rooms_go_to_other_processes_and_results_come_back():
    room = cube()
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        results = pool.map(_simulate, [(room, seed) for seed in (1, 2)])
    for seed, found in zip((1, 2), results, strict=True):
        assert same_tiles(found, _simulate((room, seed)))
