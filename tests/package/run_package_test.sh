#!/usr/bin/env bash
# Installs the built project into a fresh folder, builds another project against the installed package only, and runs it.
#   run_package_test.sh SOURCE_DIR BUILD_DIR
set -euo pipefail
source=$1 build=$2
work=$build/package_test
rm -rf "$work"
cmake --install "$build" --prefix "$work/prefix" >/dev/null
cmake -G Ninja -S "$source/tests/package/consumer" -B "$work/consumer" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release >"$work/configure.log" ||
  { cat "$work/configure.log"; exit 1; }
cmake --build "$work/consumer" || exit 1
out=$("$work/consumer/consumer")
echo "$out"
[ "$(wc -l <<<"$out")" -eq 6 ] || { echo "expected one line for each of the six surfaces"; exit 1; }
"$work/prefix/bin/lichtmc" --version
# The examples in the documents are those built here.
same_example() {  # DOCUMENT EXAMPLE
  awk '/^```cpp$/{on=1; next} /^```$/{on=0} on' "$source/$1" >"$work/example.cpp"
  diff "$work/example.cpp" "$source/tests/package/consumer/$2" || { echo "the example in $1 is not tests/package/consumer/$2"; exit 1; }
}
same_example README.md main.cpp
same_example docs/lighting.md areas.cpp
out=$(cd "$source/tests/data" && "$work/consumer/areas")
echo "$out"
[[ $out == "desks: Em 27"* ]] || { echo "expected an Em of about 274 lx"; exit 1; }  # known to 0.4 %: 274.5 ± 0.5 lx
# The installed headers include only the standard library and GLM.
if grep -rhoE '#include <[a-z0-9_]+/' "$work/prefix/include" | sort -u | grep -vE '<glm/'; then
  echo "a public header includes another library"; exit 1
fi
