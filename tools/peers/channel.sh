#!/usr/bin/env bash
# Compares impulse responses by lichtmc and mitransient: CPU time and results, side by side; see tools/peers/README.md.
#   tools/peers/channel.sh [OPTIONS]     tools/peers/channel.sh --help lists them
# Installs what is missing, as compare.sh does. The program lichtmc must be built (tools/demo.sh).
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/peers/packages.sh
run_python tools/peers/channel.py "$@"
