#!/usr/bin/env bash
# Proves that a change of structure changed no digit: builds the program as of the commit BASE and as of the working
# tree, lets both simulate the same list of runs, and compares every figure bit by bit (tools/same_bits.py has the list
# of runs and the list of allowed differences).
#   tools/same_bits.sh BASE [RUN...]     BASE: a commit; RUN: names of single runs, default all
# The build and the results of BASE are kept in build/same_bits and used again. Takes some minutes the first time.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -ge 1 ] || { sed -n '2,6p' "$0" >&2; exit 2; }
base=$(git rev-parse --verify --quiet "$1^{commit}") || { echo "same_bits.sh: '$1' is not a commit of this repository." >&2; exit 2; }
shift
tools/install-deps.sh

folder=$PWD/build/same_bits/$base
if [ ! -x "$folder/build/bin/lichtmc" ]; then
  rm -rf "$folder"
  mkdir -p "$folder/source"
  git archive "$base" | tar -x -C "$folder/source"
  cmake -S "$folder/source" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DLICHTMC_BUILD_TESTS=OFF >/dev/null
  cmake --build "$folder/build" --target lichtmc_program
fi
cmake --preset release >/dev/null
cmake --build --preset release --target lichtmc_program
python3 tools/same_bits.py "$folder" build/release/bin/lichtmc "$@"
