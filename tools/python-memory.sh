#!/usr/bin/env bash
# Runs the tests of the lifetime of arrays, of pickles and of threads under valgrind (Debian's package), with the Python
# package of a build: no access to memory that was freed, none beyond its end, no memory that the package has lost.
#
# Usage: tools/python-memory.sh [PYTHON [BUILD]]    a Python with numpy and pytest [python3], and the folder of the build
#                                                   with LICHTMC_PYTHON [build/release]
set -euo pipefail
cd "$(dirname "$0")/.."

python=${1:-python3}
build=${2:-build/release}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The dynamic linker reads strings word by word, when a library has a search path.
cat > "$work/suppressions" <<'END'
{
  dynamic linker
  Memcheck:Addr8
  fun:strncmp
  fun:is_dst
}
END

# Python's own allocator would hide what is freed. Tests with other processes are left out: those are not checked.
PYTHONPATH="$PWD/$build/python" PYTHONMALLOC=malloc valgrind --quiet --error-exitcode=9 --num-callers=30 \
  --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=none --log-file="$work/log" \
  --suppressions="$work/suppressions" \
  "$python" -m pytest -q -p no:cacheprovider python/tests/test_lifetime.py python/tests/test_pickle.py \
  python/tests/test_threads.py \
  -k "not other_processes and not leaves_python_free and not goes_on_and and not digits_of_single" || {
  status=$?
  cat "$work/log" >&2
  exit $status
}

# What Python and numpy lose is theirs; what this package loses has one of its functions among the callers.
if grep -A40 "definitely lost" "$work/log" | grep -E "lichtmc::|_core\.(abi3|cpython)" >&2; then
  echo "python-memory.sh: the package has lost memory (above)" >&2
  exit 1
fi
echo "no access to memory that was freed, and none lost"
