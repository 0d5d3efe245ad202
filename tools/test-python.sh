#!/usr/bin/env bash
# Tests of the Python package: installs it into a virtual environment in build/python/venv, with the library as tools/test.sh builds
# it (only what is missing is compiled), and runs python/tests, the notebooks of docs/notebooks among them; writes the pages of
# the interface from the docstrings to build/python/api. Arguments are passed to pytest, for example:
#   tools/test-python.sh -k tiles
# PYTHON (default: python3) is the Python that the environment is made with, 3.11 to 3.13.
set -euo pipefail
cd "$(dirname "$0")/.."
python=${PYTHON:-python3}
venv=build/python/venv
requirements=python/requirements-test.txt

# A copy of the requirements is written after the packages; if it is equal, they are installed and nothing is downloaded.
install_requirements() {
  local installed=$venv/installed.txt version
  version=$("$python" --version)
  { echo "# $version"; cat "$requirements"; } | cmp -s - "$installed" && return
  rm -rf "$venv"
  "$python" -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check -r "$requirements"
  { echo "# $version"; cat "$requirements"; } >"$installed"
}

# The library of build/release; the tests of C++ are not built.
install_package() {
  [ -e build/release/CMakeCache.txt ] || cmake --preset release -DLICHTMC_BUILD_TESTS=OFF
  "$venv/bin/pip" install --quiet --disable-pip-version-check --no-build-isolation --no-deps --force-reinstall \
    -C build-dir=build/release .
}

tools/install-deps.sh
install_requirements
install_package

passed=0 failed=0
# check NAME COMMAND...: one more that passed or failed.
check() {
  local name=$1
  shift
  if "$@"; then
    echo "ok     $name"
    passed=$((passed + 1))
  else
    echo "FAILED $name"
    failed=$((failed + 1))
  fi
}

status=0
junit=build/python/tests.xml
rm -f "$junit"
"$venv/bin/python" -m pytest -q --disable-warnings --junitxml="$junit" python/tests "$@" || status=$?
if [ -e "$junit" ]; then
  read -r passed failed < <("$venv/bin/python" - "$junit" <<'PYTHON'
import sys
import xml.etree.ElementTree

suite = xml.etree.ElementTree.parse(sys.argv[1]).getroot().find("testsuite")
failed = int(suite.get("failures")) + int(suite.get("errors"))
print(int(suite.get("tests")) - failed - int(suite.get("skipped")), failed)
PYTHON
  )
fi
check "the Python sources are clean under pyflakes" "$venv/bin/python" -m pyflakes python/lichtmc python/tests
check "lichtmc is the command line" "$venv/bin/lichtmc" --version
check "python -m lichtmc is the command line" "$venv/bin/python" -m lichtmc --version
# As a user's type checker sees the stubs that were installed.
awk '/^```python$/ && !done {on=1; next} /^```$/ && on {on=0; done=1} on' README.md >build/python/example.py
check "the example of README.md is correct by the stubs" "$venv/bin/mypy" --strict --cache-dir build/python/mypy build/python/example.py
rm -rf build/python/api
check "the pages of the interface in build/python/api" "$venv/bin/python" tools/python_pages.py build/python/api
echo "$passed passed, $failed failed"
[ "$status" -eq 0 ] && [ "$failed" -eq 0 ]
