#!/usr/bin/env bash
# From a bare machine to a first result: installs missing packages, builds the program, simulates the living room in scenes/.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/install-deps.sh
cmake --preset release
# The program only; tools/test.sh builds the tests as well.
cmake --build --preset release --target lichtmc_program
build/release/bin/lichtmc run scenes/living_room.glb -o out/living_room "$@"
echo "The report: $PWD/out/living_room/report.html"
