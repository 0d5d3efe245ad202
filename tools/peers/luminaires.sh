#!/usr/bin/env bash
# Compares an office under twelve luminaires with a photometric file by lichtmc and by Radiance; see tools/peers/README.md.
#   tools/peers/luminaires.sh [OPTIONS]     tools/peers/luminaires.sh --help lists them
# Installs what is missing, as compare.sh does. The program lichtmc must be built (tools/demo.sh).
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/peers/packages.sh
run_python tools/peers/luminaires.py "$@"
