#!/usr/bin/env bash
# Runs clang-tidy (Debian package clang-tidy) on the sources of library and program with the checks in .clang-tidy.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v run-clang-tidy >/dev/null || { echo "tidy.sh: clang-tidy is missing. Install it: apt-get install clang-tidy" >&2; exit 1; }
cmake --preset release -B build/tidy -DLICHTMC_PCH=OFF -DLICHTMC_UNITY=OFF >/dev/null  # clang cannot read GCC's precompiled headers
run-clang-tidy -quiet -p build/tidy "$PWD/(src|apps)/.*\.cpp"
