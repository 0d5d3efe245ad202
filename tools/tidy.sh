#!/usr/bin/env bash
# Runs clang-tidy (Debian package clang-tidy) on the sources of library and program with the checks in .clang-tidy.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v run-clang-tidy >/dev/null || { echo "tidy.sh: clang-tidy is missing. Install it: apt-get install clang-tidy" >&2; exit 1; }
cmake --preset release >/dev/null
run-clang-tidy -quiet -p build/release "$PWD/(src|apps)/.*\.cpp"
