#!/usr/bin/env bash
# One SIGTERM to each of many commands, at several moments of its work: each ends with status 143 within a second (half a
# second is the aim; machines are busy) and leaves no file behind but those that it finished.
# usage: tests/full/latency.sh PROGRAM
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/full/latency.sh PROGRAM" >&2; exit 2; }
program=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 "$(dirname "$0")/latency.py" "$program" "$folder"
