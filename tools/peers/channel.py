"""Compares impulse responses by lichtmc and mitransient; started by channel.sh, see README.md."""

import argparse
import dataclasses
import datetime
import math
import os
import pathlib
import sys

import numpy as np

import with_mitransient
from channel_tasks import BINS, read_table, reference, write_eye, write_room
from compare import cpu_name, figures
from estimates import TARGET
from tasks import ROOT
from with_lichtmc import cpu_seconds, version

PATHS = {0.2: 1_000_000, 1.0: 250_000}  # of a turn, by the width of the bins in ns: about 1 %


class Lichtmc:
    """A turn is one run of the program. CPU time of the process, less that of a run of one path."""

    def __init__(self, room, eye, bins, paths, folder, label, options=()):
        self.label, self.bins, self.paths, self.folder = f"lichtmc, {label}", bins, paths, folder
        width, span = f"{bins.width_ns}ns", f"{bins.span_ns}ns"
        self.options = [room, "--receivers", eye, "--only", "receivers", "--impulse-response", width]
        self.options += ["--time-span", span, "--threads", 1, "--no-report", "--no-images", "--quiet", *options]

    def _run(self, *options):
        return cpu_seconds("run", *self.options, *options, "-o", self.folder / "channel")

    def turn(self, seed):
        """CPU time, h of the compared bins in 1/s, and its standard errors; the pilot is part of the time."""
        start = self._run("--photons", 1, "--estimator", "weight", "--receiver-walk", "backward")
        seconds = self._run("--photons", self.paths, "--seed", seed) - start
        table = self.folder / "channel/impulse_response.csv"
        column = read_table(table, lambda row: row["order"] == "all")
        return seconds, self.bins.compared(column("h")), self.bins.compared(column("standard_error"))


@dataclasses.dataclass
class Estimate:
    """The turns of one method, with different random numbers."""

    seconds: float  # CPU time of a turn, median
    values: np.ndarray  # mean of h in every bin
    scatter: np.ndarray  # standard error of one turn in every bin, from the differences between turns
    own: np.ndarray | None  # the same, as the program states it: rms of the turns
    sums: np.ndarray  # of all compared bins, of every turn

    @classmethod
    def of(cls, turns):
        values = np.array([values for _, values, _ in turns])
        own = None
        if turns[0][2] is not None:
            own = np.sqrt(np.mean([errors**2 for _, _, errors in turns], 0))
        seconds = float(np.median([seconds for seconds, _, _ in turns]))
        return cls(seconds, values.mean(0), values.std(0, ddof=1), own, values.sum(1))

    def rms(self, errors):
        """Relative to the values."""
        return math.sqrt(np.mean((errors / self.values) ** 2))

    @property
    def error(self):
        """Relative standard error of a turn: root mean square over the bins, as stated, or else by scatter."""
        return self.rms(self.scatter if self.own is None else self.own)

    @property
    def seconds_to_target(self):
        return self.seconds * (self.error / TARGET) ** 2


def instructions():
    """The widest of lichtmc's vector instructions that this processor has."""
    flags = pathlib.Path("/proc/cpuinfo").read_text().split()
    return next((name for flag, name in (("avx512f", "AVX-512"), ("avx2", "AVX2")) if flag in flags), "SSE")


def measure(methods, turns):
    """All methods in every turn, one after another, so that a slow minute of the machine meets all of them."""
    done = [[] for _ in methods]
    for seed in range(1, turns + 1):
        for k, method in enumerate(methods):
            done[k].append(method.turn(1000 * k + seed))
            print(f"  turn {seed} of {turns}, {method.label}: {done[k][-1][0]:.2f} CPU s", file=sys.stderr)
    return [Estimate.of(each) for each in done]


def print_times(methods, estimates):
    print(f"| program | CPU s of a turn | rms error of a bin | by scatter | CPU s to {100 * TARGET:g} % | ratio |")
    print("|---|---|---|---|---|---|")
    for method, one in zip(methods, estimates):
        own = "not known" if one.own is None else f"{100 * one.rms(one.own):.3g} %"
        ratio = one.seconds_to_target / estimates[0].seconds_to_target
        errors = f"{own} | {100 * one.rms(one.scatter):.3g} %"
        print(f"| {method.label} | {figures(one.seconds)} | {errors} | {figures(one.seconds_to_target)} | {ratio:.3g} |")


def deviations(values, variances, of, of_variances):
    """Mean squared relative deviation over the mean that the standard errors let expect: 1 if both agree."""
    return np.mean((values - of) ** 2 / of**2) / np.mean((variances + of_variances) / of**2)


def print_agreement(methods, estimates, turns):
    first = estimates[0]
    print(f"\nCompared with {methods[0].label}:\n")
    print("| program | ratio of sums | squared deviations of bins / expected |")
    print("|---|---|---|")
    for method, one in zip(methods[1:], estimates[1:]):
        ratio = one.sums.mean() / first.sums.mean()
        spread = [each.sums.std(ddof=1) / math.sqrt(turns) / each.sums.mean() for each in (one, first)]
        squared = deviations(one.values, one.scatter**2 / turns, first.values, first.scatter**2 / turns)
        print(f"| {method.label} | {ratio:.5f} ± {ratio * math.hypot(*spread):.5f} | {squared:.2f} |")


def print_reference(bins, room, folder, paths, turns):
    """lichtmc with the field of view of the reference table."""
    eye = write_eye(folder, 85)
    method = Lichtmc(room, eye, bins, paths * turns, folder, "closed form")
    _, values, errors = method.turn(1)
    exact, exact_errors = reference(bins)
    ratio, squared = values.sum() / exact.sum(), deviations(values, errors**2, exact, exact_errors**2)
    print(
        f"\nHalf angle 85°, {paths * turns} paths, beside tests/data/channel/{bins.reference}: ratio of sums "
        f"{ratio:.5f}, squared deviations of bins / expected {squared:.2f}."
    )


def read_arguments():
    parser = argparse.ArgumentParser(
        prog="channel.sh",
        description="Compares impulse responses by lichtmc and mitransient, on one core: CPU time to 1 % in a bin, and "
        "whether the results agree. See tools/peers/README.md.",
    )
    parser.add_argument(
        "--turns", type=int, default=10, metavar="N", help="measurements of every method, with other random numbers [10]"
    )
    parser.add_argument(
        "--size", type=float, default=1.0, metavar="F", help="paths of a turn, times this: 0.1 for a quick test [1]"
    )
    arguments = parser.parse_args()
    if arguments.turns < 3:
        parser.error("--turns must be at least 3: errors of mitransient follow from the differences between turns")
    if not 0.01 <= arguments.size <= 1000:
        parser.error("--size must be between 0.01 and 1000")
    return arguments


def main():
    sys.stdout.reconfigure(line_buffering=True)
    arguments = read_arguments()
    core = min(os.sched_getaffinity(0))
    os.sched_setaffinity(0, {core})  # also of the programs that are started
    folder = ROOT / "build/peers/work"
    folder.mkdir(parents=True, exist_ok=True)
    room, eye = write_room(folder), write_eye(folder, 90)
    machine = f"One thread on core {core}, {cpu_name()} with {instructions()}, {datetime.date.today()}"
    print(f"{version()}; {with_mitransient.versions()}. {machine}.")
    print("Configuration A of Barry et al. 1993, half angle of the field of view 90°, the only one of mitransient.")
    for bins in BINS:
        paths = round(PATHS[bins.width_ns] * arguments.size)
        methods = [
            Lichtmc(room, eye, bins, paths, folder, "closed form"),
            Lichtmc(room, eye, bins, paths, folder, "Embree", ["--engine", "embree"]),
            with_mitransient.Mitransient(room, bins, paths),
        ]
        print(f"\n### {bins.title[0].upper() + bins.title[1:]}: {paths} paths in a turn, {arguments.turns} turns\n")
        estimates = measure(methods, arguments.turns)
        print_times(methods, estimates)
        print_agreement(methods, estimates, arguments.turns)
        print_reference(bins, room, folder, paths, arguments.turns)
    print(
        "\nowcsimpy is left out: it is not on PyPI, its sources need NumPy 1.23, Cython 0.29 and changed imports, and its "
        "errors, of the patches' size, do not fall with the time of a run."
    )


main()
