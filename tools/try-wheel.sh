#!/usr/bin/env bash
# Tries a wheel of build/wheel as a user has it: in a new virtual environment pip installs it with numpy, then the first
# Python example of README.md and the command line run. No compiler and no package but python3-venv is needed; for a
# convincing trial, run it on a system without them.
#   tools/try-wheel.sh FOLDER     with the wheels; pip chooses the one for this system's python3
set -euo pipefail
cd "$(dirname "$0")/.."
wheels=$(realpath "${1:-build/wheel}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for program in cc c++ gcc clang; do
  if command -v "$program" >/dev/null; then echo "note: this system has the compiler $program"; fi
done
began=$(date +%s%N)
since() { echo "$1: $((($(date +%s%N) - began) / 100000000))" | sed -E 's/([0-9])$/.\1 s/; s/: \./: 0./'; }
python3 -m venv "$work/venv"
since "virtual environment"
# Not from PyPI, where somebody else could use the name.
"$work/venv/bin/pip" install --quiet --disable-pip-version-check --no-index --no-deps --find-links "$wheels" lichtmc
"$work/venv/bin/pip" install --quiet --disable-pip-version-check numpy
since "pip install"
awk '/^```python$/ && !done {on=1; next} /^```$/ && on {on=0; done=1} on' README.md >"$work/example.py"
[ -s "$work/example.py" ] || { echo "README.md has no Python example" >&2; exit 1; }
"$work/venv/bin/python" "$work/example.py"
since "the example of README.md"
"$work/venv/bin/lichtmc" --version
"$work/venv/bin/lichtmc" run scenes/cube_paper.gltf --photons 1e6 -o "$work/out"
since "lichtmc run"
[ -s "$work/out/tiles.csv" ] && [ -s "$work/out/report.html" ]
[ $((($(date +%s%N) - began) / 1000000000)) -lt 60 ] || { echo "It took more than a minute" >&2; exit 1; }
