#!/usr/bin/env bash
# Runs the tests in which threads meet under the thread sanitizer: runs split over threads, sessions and teams, backward
# walks, pilots, studies, pictures. Takes a quarter of an hour on two cores, so it stands beside the suite.
#   tools/tsan.sh [CTEST-OPTION...]
set -euo pipefail
cd "$(dirname "$0")/.."
tools/install-deps.sh
tests=(verify_states verify_interruptions verify_reproducibility verify_receivers verify_automatic test_study test_picture
  test_paths test_report extreme_counts)
cmake --preset tsan
cmake --build --preset tsan --target "${tests[@]}"
ctest --preset tsan -R "^($(IFS='|'; echo "${tests[*]}")):" "$@"
