"""Compares lichtmc with Mitsuba and Radiance; started by compare.sh, see README.md."""

import argparse
import datetime
import math
import pathlib
import platform
import sys

import numpy as np

import with_lichtmc
import with_mitsuba
import with_radiance
from estimates import FLOOR, TARGET, Estimate, agreement
from tasks import ROOT, TASKS


def cpu_name():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.partition(":")[2].strip()
    return platform.processor() or "unknown processor"


def figures(number):
    return f"{number:.3g}" if number < 1000 else f"{number:.0f}"


def measure(methods, turns, weights):
    """All methods in every turn, one after another, so that a slow minute of the machine meets all of them."""
    done = [[] for _ in methods]
    for seed in range(1, turns + 1):
        for k, (method, results) in enumerate(zip(methods, done)):
            if results and results[0].errors is None:
                continue  # it has no random numbers that could be others
            results.append(method.turn(1000 * k + seed))  # methods do not share random numbers
            print(f"  turn {seed} of {turns}, {method.label}: {results[-1].seconds:.2f} CPU s", file=sys.stderr)
    return [Estimate(results, weights) for results in done]


def print_times(methods, estimates, where):
    target, floor = f"{100 * TARGET:g} %", f"{100 * FLOOR:g} %"
    print(f"| program | CPU s of a turn | rms error of it | CPU s to {target} | with a floor of {floor} | median |")
    print("|---|---|---|---|---|---|")
    for method, estimate in zip(methods, estimates):
        seconds = figures(estimate.once + estimate.seconds)
        if estimate.errors is None:
            print(f"| {method.label} | {seconds} | not known | – | – | – |")
            continue
        median = float(np.median(estimate.relative_errors(where)))
        errors = estimate.rms_error(where), estimate.rms_error(where, FLOOR), median
        times = [figures(estimate.seconds_to(error)) for error in errors]
        print(f"| {method.label} | {seconds} | {100 * errors[0]:.2g} % | {' | '.join(times)} |")


def print_agreement(methods, estimates, where):
    reference = estimates[0]
    print(f"\nCompared with {methods[0].label}:\n")
    print("| program | ratio of means | rms deviation / mean | median deviation | mean z² | abs(z) > 3 | number of z |")
    print("|---|---|---|---|---|---|---|")
    for method, estimate in zip(methods[1:], estimates[1:]):
        found = agreement(estimate, reference, where)
        known = not math.isnan(found.ratio_error)
        ratio = f"{found.ratio:.5f} ± {found.ratio_error:.5f}" if known else f"{found.ratio:.4f}"
        z = f"{found.chi2:.2f} | {100 * found.beyond_3:.1f} % | {found.compared}" if found.compared else "– | – | –"
        deviations = f"{100 * found.rms_deviation:.2g} % | {100 * found.median_deviation:.2g} %"
        print(f"| {method.label} | {ratio} | {deviations} | {z} |")


def methods_of(task, folder, programs):
    methods = []
    if "lichtmc" in programs:
        methods += with_lichtmc.methods(task, folder)
    if "mitsuba" in programs:
        methods += with_mitsuba.methods(task)
    if "radiance" in programs:
        methods += with_radiance.methods(task, folder)
    return methods


def read_arguments():
    parser = argparse.ArgumentParser(
        prog="compare.sh",
        description="Compares lichtmc with Mitsuba and Radiance, on one thread: CPU time to 1 %, and whether the "
        "results agree. See tools/peers/README.md.",
    )
    tasks, programs = ", ".join(TASKS), ("lichtmc", "mitsuba", "radiance")
    parser.add_argument("tasks", nargs="*", metavar="TASK", help=f"{tasks} [all]")
    parser.add_argument(
        "--turns", type=int, default=5, metavar="N", help="measurements of every method, with other random numbers [5]"
    )
    parser.add_argument(
        "--programs", nargs="+", default=programs, choices=programs, metavar="NAME", help=f"{', '.join(programs)} [all]"
    )
    arguments = parser.parse_args()
    if unknown := [task for task in arguments.tasks if task not in TASKS]:
        parser.error(f"there is no task '{unknown[0]}'; the tasks are {tasks}")
    if arguments.turns < 2:
        parser.error("--turns must be at least 2: errors of means follow from the differences between turns")
    if set(arguments.programs) == {"radiance"}:
        parser.error("results of Radiance have no standard errors: give another program to compare them with")
    return arguments


def main():
    sys.stdout.reconfigure(line_buffering=True)
    arguments = read_arguments()
    folder = ROOT / "build/peers/work"
    folder.mkdir(parents=True, exist_ok=True)
    versions = with_lichtmc.version(), with_mitsuba.Mitsuba.label, with_radiance.version()
    print(f"{'; '.join(versions)}. One thread, {cpu_name()}, {datetime.date.today()}.")
    for name in arguments.tasks or TASKS:
        task = TASKS[name](folder)
        print(f"\n### {task.title}\n")
        methods = methods_of(task, folder, arguments.programs)
        estimates = measure(methods, arguments.turns, task.weights)
        where = np.all([estimate.lit for estimate in estimates if estimate.errors is not None], 0)
        print_times(methods, estimates, where)
        print_agreement(methods, estimates, where)
        print(f"\nErrors and deviations are those of the {where.sum()} of {len(task)} that are lit in every turn.")
        for method in methods:
            if hasattr(method, "note"):
                print(method.note)


if __name__ == "__main__":
    main()
