#!/usr/bin/env bash
# Compares `sikku derive` with npm's lindenmayer, which it fetches into a folder that is gone afterwards.
# usage: tests/bench/lindenmayer.sh PROGRAM
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/bench/lindenmayer.sh PROGRAM" >&2; exit 2; }
program=$(realpath "$1")
here=$(realpath "$(dirname "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
(cd "$folder" && npm install --no-audit --no-fund --silent lindenmayer@1.5.4)
node "$here/lindenmayer.mjs" "$program" "$folder"
