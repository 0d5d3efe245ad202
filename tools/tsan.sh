#!/usr/bin/env bash
# Runs the tests with several threads under the thread sanitizer: runs divided between threads, sessions and ranks, backward
# walks, pilots, studies, pictures; and the program itself, with checkpoints, a report and a signal. Takes a quarter of an
# hour on two cores, so it is not part of the suite.
#   tools/tsan.sh [CTEST-OPTION...]
set -euo pipefail
cd "$(dirname "$0")/.."
tools/install-deps.sh
tests=(verify_states verify_interruptions verify_reproducibility verify_receivers verify_automatic test_study test_picture
  test_paths test_report extreme_counts)
cmake --preset tsan
cmake --build --preset tsan --target "${tests[@]}" lichtmc_program
# Excluded: they require many millions of flights for their statistics, and use threads in the same way as the others.
statistics="every floor tile's centre|backward at tile centres|within a tenth of the best"
ctest --preset tsan -R "^($(IFS='|'; echo "${tests[*]}")):" -E "$statistics" "$@"

export TSAN_OPTIONS="suppressions=$PWD/tests/tsan.supp halt_on_error=1 second_deadlock_stack=1"
out=build/tsan/run
rm -rf "$out"
timeout --preserve-status -s INT 10 build/tsan/bin/lichtmc run scenes/living_room.glb --tile 0.5 --photons 1G --checkpoint 0.2s -o "$out"
build/tsan/bin/lichtmc resume "$out" --photons 1M
echo "The thread sanitizer reported nothing for the program."
