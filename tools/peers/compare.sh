#!/usr/bin/env bash
# Compares lichtmc with Mitsuba and Radiance: CPU time and results, side by side; see tools/peers/README.md.
#   tools/peers/compare.sh [OPTIONS] [TASK...]     tools/peers/compare.sh --help lists them
# Installs what is missing: LLVM, which Mitsuba loads, and venv as Debian packages; the versions of requirements.txt
# from PyPI into build/peers/venv. The program lichtmc must be built (tools/demo.sh).
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/peers/packages.sh
run_python tools/peers/compare.py "$@"
