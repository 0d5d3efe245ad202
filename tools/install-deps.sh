#!/usr/bin/env bash
# Installs the Debian packages (12 "bookworm" and 13 "trixie") that are required to build and test lichtmc.
# Requires root or sudo; not interactive. Does nothing if all packages are installed.
set -euo pipefail

packages=(
  build-essential cmake ninja-build ccache   # to build
  libembree-dev                              # ray tracing (3.13 or 4.3)
  libglm-dev                                 # vectors of the public interface
  libtinygltf-dev                            # glTF
  libdraco-dev                               # compressed meshes
  libmeshoptimizer-dev                       # compressed meshes
  libstb-dev                                 # pictures
  libwebp-dev                                # textures in WebP
  libopenexr-dev                             # tile maps as images
  libhdf5-dev libxxhash-dev                  # states of runs, their checksums
  libmatio-dev                               # impulse responses for MATLAB
  libopenmpi-dev openmpi-bin                 # runs on several machines
  libhwy-dev                                 # SIMD random numbers
  libcli11-dev                               # command line
  libcereal-dev                              # pickles of the Python package
  nlohmann-json3-dev                         # summary.json, writing of glTF
  catch2                                     # tests
  python3                                    # test scripts of the command line, pictures of the paper
  python3-dev python3-venv                   # the Python package (pip install .)
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "install-deps.sh: these packages are missing: ${missing[*]}. Run it as root, or install sudo." >&2
    exit 1
  }
  as_root=(sudo)
fi

echo "Installing ${missing[*]}" >&2
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
