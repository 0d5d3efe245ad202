"""The end of a Python program: quiet, whatever it still holds."""

from __future__ import annotations

import subprocess
import sys

from rooms import ENVIRONMENT

PROGRAM = """
import lichtmc, threading
room = lichtmc.Room.cuboid((2, 2, 2), 0.5)
room.add_emitter(lichtmc.Lambert((1, 1.9, 1)), 1000)
room.add_receivers([(1, 0.5, 1)])
result = lichtmc.simulate(room, photons=5000, tile=0.5, progress=lambda progress: None)
views = [result.tiles.irradiance, result.surfaces["floor"].grid, result.receivers.irradiance, room.surfaces]
comparisons = lichtmc.compare(result, lichtmc.simulate(room, photons=5000, tile=0.5, seed=2))
def fail(progress):
    raise ValueError("from a callback")
try:
    lichtmc.simulate(room, photons=10**9, tile=0.5, progress=fail)
except ValueError as error:
    kept = error  # with its traceback, and all that its frames hold
try:
    lichtmc.Result.load("nowhere")
except lichtmc.InputError as error:
    also_kept = error
threading.Thread(target=lambda: lichtmc.simulate(room, photons=200_000, tile=0.1)).start()
"""


def test_nothing_is_said_at_the_end_of_a_program():
    """nanobind reports objects that are left, Python threads that fail."""
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, env=ENVIRONMENT, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


DAEMON = """
import lichtmc, threading, time
room = lichtmc.Room.cuboid((2, 2, 2), 0.5)
room.add_emitter(lichtmc.Lambert((1, 1.9, 1)), 1000)
started = threading.Semaphore(0)
def work():
    while True:  # also begins anew while the program ends
        lichtmc.simulate(room, photons=10**9, tile=0.5, threads=1, progress=lambda progress: started.release())
def read():
    while True:
        lichtmc.Room.cuboid((2, 2, 2)).check()
for target in (work, work, read):
    threading.Thread(target=target, daemon=True).start()
for _ in range(4):
    started.acquire()
"""


def test_a_program_ends_while_daemon_threads_simulate():
    """Python ends such threads by unwinding their stacks, or lets them wait for ever."""
    done = subprocess.run([sys.executable, "-c", DAEMON], capture_output=True, text=True, env=ENVIRONMENT, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
