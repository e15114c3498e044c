#!/usr/bin/env bash
# Makes the source distribution of the Python package, with the sources of the libraries.
# usage: packaging/sdist.sh OUTPUT_FOLDER
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: packaging/sdist.sh OUTPUT_FOLDER" >&2; exit 2; }
mkdir -p "$1"
output=$(realpath "$1")
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Only files of the project.
mkdir "$work/checkout"
{ git ls-files -z 2> /dev/null || find . -path ./build -prune -o -type f -print0; } | xargs -0 cp --parents -t "$work/checkout"
(cd "$work/checkout/python" && /usr/bin/python3 setup.py -q sdist --dist-dir "$work" > "$work/log" 2>&1) || { tail -n 40 "$work/log" >&2; exit 1; }
name=$(basename "$work"/*.tar.gz .tar.gz)
# Packed again, because setuptools writes the time into the archive.
tar -xzf "$work/$name.tar.gz" -C "$work"
packaging/archive.sh "$work" "$name" "$output/$name.tar.gz"
