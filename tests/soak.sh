#!/usr/bin/env bash
# Long runs, not part of the suite: 10^10 impacts in a cube, more than 2^32 histories, and 10^9 in a real room. Tests that
# no photon is lost in the cube, that the powers balance to 1e-12, that ten short runs agree with the long run and with
# each other, and that the ten results have no trend.
#
# Usage: tests/soak.sh [FOLDER_OF_LICHTMC] [ROOM.gltf]      (default: build/release/bin, garage of ../shared/rooms if present)
#        SOAK_SHARE=0.01 tests/soak.sh                      one hundredth of the impacts
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${1:-build/release/bin}
room=${2:-${LICHTMC_ROOMS:-../shared/rooms}/real/webxr_garage/garage.gltf}
share=${SOAK_SHARE:-1}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# rho 0.5: two impacts per photon, so that 10^10 impacts take 5*10^9 photons, more than 2^32.
"$bin/lichtmc" cuboid --size 1 1 1 --reflectance 0.5 --light lambert:0.5,0.5,0.5:0,-1,0:5:1W -o "$work/cube.glb" > "$work/log"

# soak NAME PHOTONS ARGUMENTS...: a long run, then ten runs of one tenth with other seeds.
soak() {
  local name=$1 photons=$2
  shift 2
  mkdir -p "$work/$name"
  echo "$name: $photons photons, then ten runs of one tenth"
  "$bin/lichtmc" run "$@" --photons "$photons" --seed 100 -o "$work/$name/long" > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  for k in 1 2 3 4 5 6 7 8 9 10; do
    "$bin/lichtmc" run "$@" --photons "$((photons / 10))" --seed "$k" -o "$work/$name/$k" > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  done
}

count() { python3 -c "print(int($1 * $share))"; }
soak cube "$(count 5e9)" "$work/cube.glb" --engine cuboid --tile 0.1
rooms=(cube)
if [ -e "$room" ]; then
  # About 2.2 impacts per photon.
  soak room "$(count 4.6e8)" "$room" --max-reflectance 0.9 --tile 0.25
  rooms+=(room)
else
  echo "skipped: $room does not exist; give a room as the second argument"
fi

python3 - "$work" "${rooms[@]}" <<'PYTHON'
import json, math, pathlib, sys

work, rooms = pathlib.Path(sys.argv[1]), sys.argv[2:]
failed = False

def check(what, holds):
    global failed
    failed = failed or not holds
    print(f"  {'ok  ' if holds else 'FAIL'} {what}")

# Two-sided probability 1e-6 for a normal variable; for chi-square with n degrees of freedom by Wilson and Hilferty.
Z = 4.8916
def chi_limit(n):
    return n * (1 - 2 / (9 * n) + 4.7534 * math.sqrt(2 / (9 * n))) ** 3

for name in rooms:
    read = lambda run: json.loads((work / name / str(run) / "summary.json").read_text())
    long, short = read("long"), [read(k) for k in range(1, 11)]
    print(f"{name}: {long['impacts']:.4g} impacts, {long['histories']:.4g} photons, {long['seconds']:.1f} s, "
          f"{long['impacts_per_second']:.3g} impacts/s; ten runs: {sum(s['impacts'] for s in short):.4g} impacts")
    for run in [long] + short:
        total = run["absorbed"] + run["escaped"] + run["residual"] + run["lost"]
        worst = abs(total / run["emitted"] - 1)
        if worst > 1e-12 or run is long:
            check(f"balance closes to {worst:.2g} (seed {run['seed']}, allowed 1e-12)", worst <= 1e-12)
        if name == "cube" and (run["lost"] != 0 or run is long):
            check(f"lost {run['lost']} (seed {run['seed']})", run["lost"] == 0)
    if name != "cube":
        print(f"       lost {long['lost'] / long['emitted']:.3g} of the power, {long['lost_histories']} photons; "
              f"{long['retraced']} flights traced again")
    mean, error = long["incident"], long["incident_standard_error"]
    if name == "cube":
        z = (mean - 2.0) / error
        check(f"incident power {mean:.8f} +- {error:.2g} W, exact 2: z = {z:.2f}", abs(z) < Z)
    values = [(s["incident"], s["incident_standard_error"]) for s in short]
    weights = [1 / (e * e) for _, e in values]
    mean_of_ten = sum(w * v for w, (v, _) in zip(weights, values)) / sum(weights)
    error_of_ten = 1 / math.sqrt(sum(weights))
    z = (mean_of_ten - mean) / math.hypot(error, error_of_ten)
    check(f"ten runs {mean_of_ten:.8f} +- {error_of_ten:.2g}, the long one {mean:.8f} +- {error:.2g}: z = {z:.2f}",
          abs(z) < Z)
    chi = sum(w * (v - mean_of_ten) ** 2 for w, (v, _) in zip(weights, values))
    check(f"the ten runs with each other: chi-square {chi:.1f}, allowed {chi_limit(9):.1f}", chi < chi_limit(9))
    # Slope over the number of the run, in units of its standard error.
    weight = [k - 4.5 for k in range(10)]
    slope = sum(w * v for w, (v, _) in zip(weight, values))
    slope_error = math.sqrt(sum((w * e) ** 2 for w, (_, e) in zip(weight, values)))
    check(f"trend of the ten runs: z = {slope / slope_error:.2f}", abs(slope / slope_error) < Z)
sys.exit(1 if failed else 0)
PYTHON
