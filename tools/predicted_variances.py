#!/usr/bin/env python3
"""Variances of the three estimators in the integrating sphere, measured beside those that theory predicts.

In a sphere every flight hits a tile with its share a of the area, whatever came before. With the same reflectance rho
everywhere the relative variance of a tile's irradiance is, for one photon,
    weight (never cut off)  (1 - a)/a (1 - rho)/(1 + rho)
    collision               (1 - a)/a (1 - rho) + rho
    absorption              (1 - a)/a

Usage: tools/predicted_variances.py [REFLECTANCE ...]      (default 0.1 0.3 0.6 0.9 0.99; needs build/release)
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PREDICTED = {
    "weight": lambda a, rho: (1 - a) / a * (1 - rho) / (1 + rho),
    "collision": lambda a, rho: (1 - a) / a * (1 - rho) + rho,
    "absorption": lambda a, rho: (1 - a) / a,
}


def measure(estimator, rho, folder):
    photons = round(4e6 * (1 - rho))  # about as many flights for each reflectance
    subprocess.run([ROOT / "build/release/bin/lichtmc", "run", ROOT / "scenes/integrating_sphere.glb", "-o", folder,
                    "--estimator", estimator, "--photons", str(photons), "--tile", "0.5", "--only", "forward", "--quiet",
                    "--reflectance", f"white coating={rho}"], check=True, stdout=subprocess.DEVNULL)
    summary = json.loads((folder / "summary.json").read_text())
    with open(folder / "tiles.csv", newline="", encoding="utf-8") as file:
        areas = [float(row["area"]) for row in csv.DictReader(file)]
    return summary, areas


def main():
    print("| rho | estimator | flights per photon | variance per photon, predicted | measured | ratio |")
    print("|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for rho in map(float, sys.argv[1:] or ["0.1", "0.3", "0.6", "0.9", "0.99"]):
            for estimator, law in PREDICTED.items():
                summary, areas = measure(estimator, rho, pathlib.Path(folder))
                total = sum(areas)
                predicted = sum(area * law(area / total, rho) for area in areas) / total
                measured = summary["rms_relative_error"] ** 2 * summary["histories"]
                print(f"| {rho:g} | {estimator} | {summary['rays'] / summary['histories']:.2f} | {predicted:.3g} | "
                      f"{measured:.3g} | {measured / predicted:.3f} |", flush=True)


if __name__ == "__main__":
    main()
