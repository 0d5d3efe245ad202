#!/usr/bin/env bash
# Installs missing packages, builds, and runs the whole test suite. Arguments are passed to ctest, for example:
#   tools/test.sh -R furnace
set -euo pipefail
cd "$(dirname "$0")/.."
tools/install-deps.sh
cmake --preset release
cmake --build --preset release
ctest --preset release --parallel "$(nproc)" "$@"
