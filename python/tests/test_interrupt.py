"""Ctrl-C and exceptions from callbacks: runs stop, and nothing goes on."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
import traceback

import lichtmc
import pytest
from rooms import ENVIRONMENT, SCENES, cube, living_room

# What each program does before: it tells when it works, and at its end how many threads there are.
BEGINNING = f"""
import lichtmc, sys, time
room = lichtmc.Room.from_gltf({str(SCENES / "living_room.glb")!r})
told = False
def tell(progress):
    global told
    if not told and getattr(progress, "stage", "tiles") == "tiles":
        told = True
        print("working", flush=True)
def threads():
    for _ in range(200):  # a thread that has been joined may be listed for a moment
        with open("/proc/self/status") as status:
            count = next(int(line.split()[1]) for line in status if line.startswith("Threads:"))
        if count == 1: break
        time.sleep(0.01)
    return count
"""


def interrupted(program: str, *, signals: int = 1, between: float = 0.0) -> list[str]:
    """Runs a program and sends it SIGINT once it prints "working"; returns what it prints after that."""
    environment = {**ENVIRONMENT, "OPENBLAS_NUM_THREADS": "1"}
    with subprocess.Popen(
        [sys.executable, "-c", BEGINNING + program], stdout=subprocess.PIPE, text=True, env=environment
    ) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "working\n"
            for _ in range(signals):
                time.sleep(between)
                process.send_signal(signal.SIGINT)
            output = process.communicate(timeout=60)[0]
        finally:
            process.kill()
    assert process.returncode == 0, output
    return output.split()


def test_ctrl_c_ends_simulate_with_what_it_has():
    program = """
result = lichtmc.simulate(room, max_time=1000, progress=tell)
print(result.stopped_by, len(result.tiles), (result.tiles.irradiance > 0).any(), threads())
"""
    stopped_by, tiles, some_light, threads = interrupted(program)
    assert (stopped_by, some_light, threads) == ("interrupt", "True", "1")
    assert int(tiles) > 0


def test_ctrl_c_ends_simulate_without_a_callback():
    program = """
import threading
began = time.monotonic()
lichtmc.simulate(room, photons=10_000)
longer = 0.5 + 3.0 * (time.monotonic() - began)  # than the preparation, on this machine
threading.Timer(longer, lambda: print("working", flush=True)).start()
print(lichtmc.simulate(room, max_time=1000).stopped_by, threads())
"""
    assert interrupted(program) == ["interrupt", "1"]


def test_ctrl_c_ends_resume():
    program = """
first = lichtmc.simulate(room, photons=10_000)
print(lichtmc.resume(first, max_time=1000, progress=tell).stopped_by, threads())
"""
    assert interrupted(program) == ["interrupt", "1"]


def test_ctrl_c_ends_a_study():
    program = """
try:
    print("Study", len(lichtmc.study(room, seconds=1000, progress=tell).rows) >= 0, threads())
except KeyboardInterrupt:
    print("KeyboardInterrupt", True, threads())
"""
    assert interrupted(program, between=1.0)[1:] == ["True", "1"]


def test_a_second_ctrl_c_is_raised():
    # The first callback after the first Ctrl-C waits for the second.
    program = """
import time
def tell_slowly(progress):
    tell(progress)
    if told: time.sleep(1.0)
try:
    lichtmc.simulate(room, max_time=1000, progress=tell_slowly)
except KeyboardInterrupt:
    print("raised", threads())
"""
    assert interrupted(program, signals=2, between=0.3) == ["raised", "1"]


def test_other_signal_handlers_run():
    program = """
import signal
seen = []
signal.signal(signal.SIGINT, lambda *_: seen.append(1))
result = lichtmc.simulate(room, max_time=2, progress=tell)
print(len(seen), result.stopped_by)
"""
    assert interrupted(program) == ["1", "max-time"]


def test_ctrl_c_during_the_preparation_of_a_room():
    program = """
import numpy
edge = numpy.linspace(0.0, 10.0, 301)  # a floor of 180 000 triangles
x, z = numpy.meshgrid(edge, edge, indexing="ij")
corners = numpy.stack([x, 0.05 * numpy.sin(7 * x) * numpy.sin(5 * z), z], axis=-1).reshape(-1, 3)
first = (numpy.arange(300)[:, None] * 301 + numpy.arange(300)).ravel()
faces = numpy.concatenate([first[:, None] + [0, 1, 301], first[:, None] + [1, 302, 301]])
large = lichtmc.Room.from_triangles(corners, faces, 0.5)
large.add_emitter(lichtmc.Isotropic((5.0, 3.0, 5.0)), 1000.0)
steps = []
def tell_steps(progress):
    if not steps: print("working", flush=True)
    steps.append(progress.step)
try:
    lichtmc.simulate(large, max_time=1000, tile=0.1, progress=tell_steps)
except KeyboardInterrupt:
    print("raised", "" in steps, threads())
print(lichtmc.simulate(large, photons=10_000, tile=0.1).stopped_by)  # what was prepared is whole
"""
    assert interrupted(program) == ["raised", "False", "1", "photons"]


class Unhappy(Exception):
    pass


def test_an_exception_from_a_callback_is_raised_with_its_traceback():
    def fail(progress):
        if progress.stage == "tiles":
            raise Unhappy("enough")

    began = time.monotonic()
    with pytest.raises(Unhappy, match="enough") as caught:
        lichtmc.simulate(living_room(), max_time=1000, progress=fail)
    assert time.monotonic() - began < 60
    assert [frame.name for frame in traceback.extract_tb(caught.value.__traceback__)][-1] == "fail"


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
def test_a_keyboard_interrupt_from_a_callback_is_a_ctrl_c():
    def stop(progress):
        if progress.stage == "tiles" and progress.histories > 0 and not seen:
            seen.append(progress)
            raise KeyboardInterrupt

    seen: list[lichtmc.Progress] = []
    assert lichtmc.simulate(living_room(), max_time=1000, progress=stop).stopped_by == "interrupt"
    assert len(seen) == 1


def test_a_system_exit_from_a_callback_is_raised():
    def leave(progress):
        sys.exit(3)

    with pytest.raises(SystemExit):
        lichtmc.simulate(living_room(), max_time=1000, progress=leave)


def test_a_callback_may_simulate():
    inner = []

    def nested(progress):
        if not inner:
            inner.append(lichtmc.simulate(cube(), photons=2000, tile=0.5))

    lichtmc.simulate(living_room(), photons=100_000, progress=nested)
    assert inner[0].stopped_by == "photons"


def test_what_is_no_callback_is_refused():
    with pytest.raises(lichtmc.InputError, match="progress is of type str"):
        lichtmc.simulate(cube(), photons=1000, progress="bar")
