#!/usr/bin/env python3
"""Measures what simulate() costs in Python more than in C++.

Usage: PYTHONPATH=build/release/python tools/measure_python.py [--turns N] [--seconds 0.05,1,10] [--threads 1,2]

Needs the target lichtmc_python_overhead (cmake --build --preset release --target lichtmc_python_overhead; the CMake
option LICHTMC_PYTHON). C++ and Python simulate the same room with the same settings in turn, in two processes that live
as long as the measurement, so that neither start-up nor a drift of the machine counts. Rooms are read anew before every
run, outside of the measured time. The results must be equal to the last digit.

Prints a table. Wall time: the median of C++, and the median of the differences of Python to C++ in the same turn. CPU time
(of the whole process: user and system): the lowest of all turns of either. On a machine with other load wall times say
little, and CPU times are lengthened by it (shared caches and cores), never shortened: the lowest is the least disturbed. Last, the
median of the CPU time of the thread that calls simulate() in Python: it only waits, so that this is what Python adds.
"""

from __future__ import annotations

import argparse
import pathlib
import statistics
import subprocess
import sys
import time

import lichtmc

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/bin/lichtmc_python_overhead"
ROOMS = {"cuboid": "cuboid", "living_room": str(ROOT / "scenes/living_room.glb")}


def room_of(name: str) -> lichtmc.Room:
    if name != "cuboid":
        return lichtmc.Room.from_gltf(name)
    room = lichtmc.Room.cuboid((5, 2.6, 4), 0.6)
    room.add_emitter(lichtmc.Lambert((2.5, 2.5, 2)), 2000, name="lamp")
    return room


class CppSide:
    """The program of python/tests/overhead.cpp, which waits for work."""

    def __init__(self) -> None:
        self.process = subprocess.Popen([PROGRAM], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def run(self, room: str, photons: int, threads: int) -> tuple[float, float, float]:
        assert self.process.stdin and self.process.stdout
        print(room, photons, threads, file=self.process.stdin, flush=True)
        wall, cpu, incident = map(float, self.process.stdout.readline().split())
        return wall, cpu, incident

    def end(self) -> None:
        assert self.process.stdin
        self.process.stdin.close()
        self.process.wait()


def run_python(name: str, photons: int, threads: int) -> tuple[float, float, float, float]:
    room = room_of(name)
    caller, cpu, wall = time.thread_time(), time.process_time(), time.perf_counter()
    result = lichtmc.simulate(room, photons=photons, threads=threads)
    return time.perf_counter() - wall, time.process_time() - cpu, result.incident, time.thread_time() - caller


def photons_for(cpp: CppSide, room: str, seconds: float, threads: int) -> int:
    """Photons that take about this time: from the difference of two runs, because each begins with a preparation."""
    short, long = 200_000, 1_000_000
    walls = {photons: min(cpp.run(room, photons, threads)[0] for _ in range(3)) for photons in (short, long)}
    rate = (long - short) / (walls[long] - walls[short])
    return max(1024, round(rate * seconds))


def measure(cpp: CppSide, room: str, seconds: float, threads: int, turns: int) -> str:
    photons = photons_for(cpp, room, seconds, threads)
    pairs = []
    for turn in range(turns):
        # Who goes first alternates, so that a trend of the machine cancels out.
        if turn % 2:
            python = run_python(room, photons, threads)
            plain = cpp.run(room, photons, threads)
        else:
            plain = cpp.run(room, photons, threads)
            python = run_python(room, photons, threads)
        if plain[2] != python[2]:
            raise SystemExit(f"{room}: C++ gives {plain[2]!r}, Python {python[2]!r}")
        pairs.append((plain, python))
    wall = statistics.median(plain[0] for plain, _ in pairs)
    more_wall = statistics.median(python[0] - plain[0] for plain, python in pairs)
    cpu = min(plain[1] for plain, _ in pairs)
    more_cpu = min(python[1] for _, python in pairs) - cpu
    cells = [
        f"{base:.3f} s | {1000 * more:+.1f} ms, {100 * more / base:+.2f} %"
        for base, more in ((wall, more_wall), (cpu, more_cpu))
    ]
    caller = 1000 * statistics.median(python[3] for _, python in pairs)
    return f"{photons:.3g} | {threads} | {turns} | {' | '.join(cells)} | {caller:.1f} ms |"


def main() -> int:
    parser = argparse.ArgumentParser(description="Measures what simulate() costs in Python more than in C++.")
    parser.add_argument("--turns", type=int, default=9)
    parser.add_argument("--seconds", default="0.05,1,10", help="lengths of the runs")
    parser.add_argument("--threads", default="1,2")
    parser.add_argument("--rooms", default="cuboid,living_room")
    arguments = parser.parse_args()
    if not PROGRAM.exists():
        raise SystemExit(f"{PROGRAM} is missing. Build the target lichtmc_python_overhead with LICHTMC_PYTHON=ON.")
    cpp = CppSide()
    print("| room | photons | threads | turns | C++, wall | Python more | C++, CPU | Python more | calling thread |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name in arguments.rooms.split(","):
        for threads in map(int, arguments.threads.split(",")):
            for seconds in map(float, arguments.seconds.split(",")):
                # Short runs are noisier, and cost little to repeat.
                turns = arguments.turns * (5 if seconds < 0.5 else 1)
                print(f"| {name} | {measure(cpp, ROOMS[name], seconds, threads, turns)}", flush=True)
    cpp.end()
    return 0


if __name__ == "__main__":
    sys.exit(main())
