#!/usr/bin/env bash
# Tests with Node.js and a browser: the Khronos validator on every glTF file that the project ships or writes; lit rooms in
# three.js; reports in headless Chromium, on screen and on paper. Installs the requirements (Node.js, Chromium and
# poppler-utils, which reads printed pages, as Debian packages, the rest from npm into build/web) and builds the program.
set -euo pipefail
cd "$(dirname "$0")/.."

# The packages have the names of the programs, except those of node and pdftotext. Programs from other sources are used if present.
install_packages() {
  local missing=()
  command -v node >/dev/null || missing+=(nodejs)
  command -v npm >/dev/null || missing+=(npm)
  command -v chromium >/dev/null || missing+=(chromium)
  command -v pdftotext >/dev/null || missing+=(poppler-utils)
  [ ${#missing[@]} -eq 0 ] && return
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "test-web.sh: these packages are missing: ${missing[*]}. Run it as root, or install sudo." >&2
      return 1
    }
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}" >&2
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
}

# The versions are those of tools/web/package-lock.json. A copy of the lock file is written after the packages; if it is
# equal, they are installed and nothing is downloaded.
install_web_packages() {
  cmp -s tools/web/package-lock.json build/web/installed.json && return
  mkdir -p build/web
  cp tools/web/package.json tools/web/package-lock.json build/web/
  npm ci --prefix build/web --no-audit --no-fund --loglevel=error
  cp tools/web/package-lock.json build/web/installed.json
}

install_packages
install_web_packages
tools/install-deps.sh
cmake --preset release
cmake --build --preset release

written=(build/web/cuboid.glb build/web/cuboid.gltf)
rm -f "${written[@]}"
for file in "${written[@]}"; do
  build/release/bin/lichtmc cuboid --size 4 3 5 --reflectance 0.5 --light point:2,2.5,2.5:1000lm -o "$file"
done

simulated=(cube_paper.gltf living_room.glb l_room.gltf integrating_sphere.glb)
results=()
for room in "${simulated[@]}"; do
  results+=("build/web/out/${room%.*}")
  build/release/bin/lichtmc run "scenes/$room" --photons 2e5 --paths 20 --quiet -o "${results[-1]}"
done
# 100 000 tiles; the other colour map and the other scale.
build/release/bin/lichtmc run scenes/cube_paper.gltf --tile 0.00775 --scale-type log --colormap inferno --quiet \
  -o build/web/out/many_tiles
results+=(build/web/out/many_tiles)
# Lighting reports: an office with three areas and luminaires of two types, the same of areas alone, and a room without
# areas.
words=(--project "House in <Elm> Street" --author "A. B. Cooper" --date "1 May 2026")
lamps=()
for luminaire in c_lambert.ies:2,2.4,-1.5 c_lambert.ies:4,2.4,-1.5 c_skew.ies:2,2.4,-3.5; do
  lamps+=(--light "ies:tests/data/luminaires/$luminaire")
done
areas=(--plane 0.75:0.5:spacing=0.5:target_lx=300:target_uniformity=0.6
  --area desk_0:0.8,0.8755,-2:1.6,0,0:0,0,0.8:target_lx=500:target_uniformity=0.6:role=task
  --area whiteboard:0.5,1,-0.01:0,1.2,0:3,0,0:target_lx=300:role=wall)
office=(run tests/data/office.glb "${areas[@]}" "${lamps[@]}" "${words[@]}" --quiet)
build/release/bin/lichtmc "${office[@]}" --photons 1e6 -o build/web/out/office
build/release/bin/lichtmc "${office[@]}" --photons 1e5 --only receivers --maintenance-factor 0.8 -o build/web/out/office_areas
build/release/bin/lichtmc run scenes/living_room.glb --photons 2e5 --report-style lighting "${words[@]}" --quiet \
  -o build/web/out/lighting
printed=(build/web/out/office build/web/out/office_areas build/web/out/lighting build/web/out/living_room)
build/release/bin/lichtmc paths scenes/living_room.glb --quiet -o build/web/out/paths
lit=("${results[@]/%//room_lit.glb}")

status=0
counts=build/web/counts.txt
: >"$counts"
# The last line of each check contains the numbers of passed and failed tests.
check() {
  local log=build/web/check.log
  if ! "$@" 2>&1 | tee "$log"; then status=1; fi
  tail -1 "$log" >>"$counts"
}
check node tools/web/validate.mjs build/web scenes/*.gltf scenes/*.glb "${written[@]}" "${lit[@]}" build/web/out/paths/paths.glb
check node tools/web/check_lit_room.mjs build/web "${lit[@]}"
check node tools/web/check_report.mjs build/web "${results[@]}"
check node tools/web/check_print.mjs build/web "${printed[@]}"
awk '{ passed += $1; failed += $3 } END { printf "%d passed, %d failed\n", passed, failed }' "$counts"
exit "$status"
