#!/usr/bin/env bash
# Checks with Node.js: every glTF file that the project ships or writes against the Khronos validator. Installs what it
# needs (Node.js from Debian's packages, the validator from npm into build/web) and builds the program.
set -euo pipefail
cd "$(dirname "$0")/.."

install_node() {
  command -v node >/dev/null && command -v npm >/dev/null && return
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "test-web.sh: Node.js and npm are missing. Run it as root, or install sudo." >&2
      return 1
    }
    as_root=(sudo)
  fi
  echo "Installing nodejs npm" >&2
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends nodejs npm
}

# The versions are those of tools/web/package-lock.json. Nothing is fetched where that has been done: the copy of the
# lock file beside the packages, made last, says so.
install_web_packages() {
  cmp -s tools/web/package-lock.json build/web/installed.json && return
  mkdir -p build/web
  cp tools/web/package.json tools/web/package-lock.json build/web/
  npm ci --prefix build/web --no-audit --no-fund --loglevel=error
  cp tools/web/package-lock.json build/web/installed.json
}

install_node
install_web_packages
tools/install-deps.sh
cmake --preset release
cmake --build --preset release

written=(build/web/cuboid.glb build/web/cuboid.gltf)
rm -f "${written[@]}"
for file in "${written[@]}"; do
  build/release/bin/lichtmc cuboid --size 4 3 5 --reflectance 0.5 --light point:2,2.5,2.5:1000lm -o "$file"
done

node tools/web/validate.mjs build/web scenes/*.gltf scenes/*.glb "${written[@]}"
