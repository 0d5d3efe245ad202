"""Pickles and copies of rooms and results: exact, and refused when damaged."""

from __future__ import annotations

import copy
import multiprocessing
import pickle

import lichtmc
import pytest
from rooms import cube, living_room, same_tiles


@pytest.fixture(scope="module")
def result() -> lichtmc.Result:
    return lichtmc.simulate(cube(), photons=20_000, tile=0.5)


@pytest.mark.parametrize("make", [cube, living_room])
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
