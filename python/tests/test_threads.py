"""Runs from several Python threads."""

from __future__ import annotations

import gc
import os
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import lichtmc
import pytest
from rooms import cube, living_room, same_tiles


def test_runs_at_the_same_time_have_the_digits_of_single_ones():
    room = living_room()
    seeds = (1, 2, 3, 4)

    def run(seed: int) -> lichtmc.Result:
        return lichtmc.simulate(room, photons=100_000, seed=seed, threads=2)

    alone = [run(seed) for seed in seeds]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(run, seeds))
    assert all(same_tiles(a, b) for a, b in zip(alone, together, strict=True))


def test_python_goes_on_and_runs_overlap():
    """Each run waits until the other one has begun: with Python's lock held neither would end."""
    begun = [threading.Event(), threading.Event()]
    overlapped = []
    counted = 0

    def run(number: int) -> None:
        def progress(at: lichtmc.Progress) -> None:
            if at.stage == "tiles":
                begun[number].set()
                overlapped.append(begun[1 - number].wait(timeout=60))

        lichtmc.simulate(living_room(), photons=300_000, threads=1, progress=progress)

    threads = [threading.Thread(target=run, args=(number,)) for number in (0, 1)]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        counted += 1
        time.sleep(0.001)
    assert overlapped and all(overlapped)
    assert counted > 10


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
def test_the_caller_leaves_python_free():
    """Another thread works while a run without a callback goes on, and then ends it."""

    def work_and_end() -> None:
        for _ in range(10):
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    room = living_room()
    lichtmc.simulate(room, photons=1000, threads=1)
    other = threading.Thread(target=work_and_end)
    try:
        other.start()
        stopped_by = lichtmc.simulate(room, max_time=60.0, threads=1).stopped_by
    except KeyboardInterrupt:  # before the first history
        stopped_by = "interrupt"
    other.join()
    assert stopped_by == "interrupt"


def test_a_room_may_change_while_a_run_goes_on():
    room = cube()
    expected = lichtmc.simulate(room, photons=200_000, tile=0.5)
    lamps = len(room.emitters)

    def progress(at: lichtmc.Progress) -> None:
        room.add_emitter(lichtmc.Isotropic((0.3, 0.3, 0.3)), 1.0, unit=room.unit)

    found = lichtmc.simulate(room, photons=200_000, tile=0.5, progress=progress)
    assert len(room.emitters) > lamps == len(found.room.emitters)
    assert same_tiles(found, expected)


def test_many_threads_change_and_simulate_one_room():
    room = cube()

    def work(number: int) -> int:
        room.set_reflectance("*", 0.5)
        return len(lichtmc.simulate(room, photons=2000, tile=0.5, threads=1, seed=number).tiles)

    with ThreadPoolExecutor(8) as pool:
        assert set(pool.map(work, range(32))) == {24}


def test_results_may_be_dropped_in_another_thread():
    def drop(held: list) -> None:
        held.clear()
        gc.collect()

    result = lichtmc.simulate(cube(), photons=5000, tile=0.5)
    kept = result.tiles.irradiance
    expected = kept.copy()
    held = [result]
    del result
    thread = threading.Thread(target=drop, args=(held,))
    thread.start()
    thread.join()
    assert (kept == expected).all()


def test_no_thread_is_left():
    def count() -> int:
        with open("/proc/self/status") as status:
            return next(int(line.split()[1]) for line in status if line.startswith("Threads:"))

    lichtmc.simulate(cube(), photons=5000, tile=0.5)
    before = count()
    for _ in range(5):
        lichtmc.simulate(living_room(), photons=50_000, threads=4)
    # A thread that has been joined may be listed for a moment.
    for _ in range(100):
        if count() <= before:
            break
        time.sleep(0.01)
    assert count() <= before
