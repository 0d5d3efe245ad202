# What compare.sh and channel.sh have in common; sourced by them, in the root folder of the project.

[ -x build/release/bin/lichtmc ] || {
  echo "$(basename "$0"): build/release/bin/lichtmc is missing. Build it with tools/demo.sh." >&2
  exit 1
}

# LLVM 14 to 16 cannot compile all operations that Mitsuba uses. Debian 12 and 13 have 19.
find_llvm() {
  DRJIT_LIBLLVM_PATH=${DRJIT_LIBLLVM_PATH:-$(/sbin/ldconfig -p | awk '/libLLVM.*19/ { path = $NF } END { print path }')}
}

install_packages() {
  local missing=()
  find_llvm
  [ -n "$DRJIT_LIBLLVM_PATH" ] || missing+=(libllvm19)
  python3 -c 'import ensurepip' 2>/dev/null || missing+=(python3-venv)
  [ ${#missing[@]} -eq 0 ] && return
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "$(basename "$0"): these packages are missing: ${missing[*]}. Run it as root, or install sudo." >&2
      return 1
    }
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}" >&2
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
  find_llvm
}

# A copy of the list is written after the packages; if it is equal, they are installed and nothing is downloaded.
install_python_packages() {
  cmp -s tools/peers/requirements.txt build/peers/installed.txt && return
  python3 -m venv --clear build/peers/venv
  build/peers/venv/bin/pip install --quiet --disable-pip-version-check -r tools/peers/requirements.txt
  cp tools/peers/requirements.txt build/peers/installed.txt
}

# run_python SCRIPT [ARGUMENT...]
run_python() {
  install_packages
  install_python_packages
  export DRJIT_LIBLLVM_PATH
  exec build/peers/venv/bin/python -B "$@"
}
