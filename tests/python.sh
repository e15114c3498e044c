#!/usr/bin/env bash
# Tests the Python module in a build folder, checks its types, and installs it as pip does.
# Usage: python.sh BUILD_FOLDER [arguments of pytest]
set -euo pipefail
cd "$(dirname "$0")/.."
build=$(readlink -f "$1")
shift
python=$(sed -n 's/^_\{0,1\}Python_EXECUTABLE:[A-Z]*=//p' "$build/CMakeCache.txt" | head -n 1)
export PYTHONPATH=$build/python SIKKU_PROGRAM=$build/bin/sikku PYTHONDONTWRITEBYTECODE=1

# Programs see the stub of the options, python/src/sikku/outputs.pyi; outputs.py itself is checked with the package.
for files in "python/src/sikku/*.py python/src/sikku/lib/*.pyi python/stub.py" "python/tutorial.py python/tests/typed_options.py"; do
    # shellcheck disable=SC2086
    MYPYPATH=python/src "$python" -m mypy --strict --cache-dir "$build/python/mypy" $files
done
"$python" -m pytest -q -p no:cacheprovider -W error python/tests "$@"

# A new environment, without a network.
environment=$(mktemp -d)
trap 'rm -rf "$environment"' EXIT
"$python" -m venv --system-site-packages "$environment"
SIKKU_BUILD=$build PYTHONPATH='' "$environment/bin/pip" install --quiet --no-build-isolation --no-index ./python \
    > "$environment/log" 2>&1 || { cat "$environment/log"; exit 1; }
cd /
PYTHONPATH='' "$environment/bin/python" -c 'import sikku
assert sikku.__file__.startswith("'"$environment"'"), sikku.__file__
assert len(sikku.patterns()) > 100
assert sikku.load("snake-kolam").draw("png", dpi=20).startswith(b"\x89PNG")'
echo "pip install ./python works"
