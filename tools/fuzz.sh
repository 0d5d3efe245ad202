#!/usr/bin/env bash
# Tests the readers of rooms, of tables of receivers and of photometric files with malformed files, under the address and undefined-behaviour sanitizers, as built by clang without precompiled headers. Requires clang.
#   tools/fuzz.sh [SECONDS]     default 60, a quarter of it each for tables and for photometric files; ends with 1 if a reader fails on a file, with 77
#                               if clang is missing
# Seeds are the room files of LICHTMC_ROOMS (../shared/rooms), scenes/ and tests/fuzz/rooms/, for tables and photometric files tests/fuzz/receivers/ and
# tests/data/luminaires/. New inputs that reach new code are kept in build/fuzz/corpus,
# files on which a reader fails in build/fuzz.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
command -v clang++ >/dev/null || { echo "fuzz.sh: clang is missing. Install it: apt-get install clang libclang-rt-dev" >&2; exit 77; }
# In Debian libFuzzer is in the package libclang-rt-dev.
printf '#include <cstddef>\n#include <cstdint>\nextern "C" int LLVMFuzzerTestOneInput(const std::uint8_t*, std::size_t) { return 0; }\n' |
  clang++ -fsanitize=fuzzer,address,undefined -x c++ - -o /dev/null 2>/dev/null ||
  { echo "fuzz.sh: this clang has no libFuzzer. Install it: apt-get install libclang-rt-dev" >&2; exit 77; }
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target fuzz_gltf fuzz_photometry fuzz_receivers
mkdir -p build/fuzz/corpus build/fuzz/seeds build/fuzz/corpus_receivers build/fuzz/corpus_photometry
rooms=${LICHTMC_ROOMS:-../shared/rooms}
folders=(scenes tests/fuzz/rooms)
if [ -d "$rooms" ]; then folders+=("$rooms"); else echo "fuzz.sh: the folder $rooms does not exist; only scenes/ and tests/fuzz/rooms/ are seeds" >&2; fi
# Only small files: the fuzzer changes single bytes.
n=0
while IFS= read -r -d '' file; do
  n=$((n + 1))
  cp -f "$file" "build/fuzz/seeds/$n-$(basename "$file")"
done < <(find "${folders[@]}" \( -name '*.gltf' -o -name '*.glb' \) -size -40k -print0)
cd build/fuzz
./bin/fuzz_receivers -max_total_time="$((seconds / 4))" -timeout=20 -rss_limit_mb=2048 -max_len=4096 -dict=../../tests/fuzz/csv.dict \
  -print_final_stats=1 corpus_receivers ../../tests/fuzz/receivers
./bin/fuzz_photometry -max_total_time="$((seconds / 4))" -timeout=20 -rss_limit_mb=2048 -max_len=8192 -dict=../../tests/fuzz/photometry.dict \
  -print_final_stats=1 corpus_photometry ../../tests/data/luminaires
./bin/fuzz_gltf -max_total_time="$((seconds - seconds / 4 * 2))" -timeout=20 -rss_limit_mb=2048 -max_len=65536 -dict=../../tests/fuzz/gltf.dict -print_final_stats=1 \
  corpus seeds
