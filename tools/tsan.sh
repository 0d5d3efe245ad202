#!/usr/bin/env bash
# Runs the tests in which threads meet under the thread sanitizer: runs split over threads, sessions and teams, backward
# walks, pilots, studies, pictures; and the program itself, with checkpoints, a report and a signal. Takes a quarter of an
# hour on two cores, so it stands beside the suite.
#   tools/tsan.sh [CTEST-OPTION...]
set -euo pipefail
cd "$(dirname "$0")/.."
tools/install-deps.sh
tests=(verify_states verify_interruptions verify_reproducibility verify_receivers verify_automatic test_study test_picture
  test_paths test_report extreme_counts)
cmake --preset tsan
cmake --build --preset tsan --target "${tests[@]}" lichtmc_program
# These need many millions of flights to be sure of a mean, and threads meet in them as in all others.
statistics="every floor tile's centre|backward at tile centres|within a tenth of the best"
ctest --preset tsan -R "^($(IFS='|'; echo "${tests[*]}")):" -E "$statistics" "$@"

export TSAN_OPTIONS="suppressions=$PWD/tests/tsan.supp halt_on_error=1 second_deadlock_stack=1"
out=build/tsan/run
rm -rf "$out"
timeout --preserve-status -s INT 10 build/tsan/bin/lichtmc run scenes/living_room.glb --tile 0.5 --photons 1G --checkpoint 0.2s -o "$out"
build/tsan/bin/lichtmc resume "$out" --photons 1M
echo "The program ran under the thread sanitizer without a report of it."
