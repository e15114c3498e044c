#!/usr/bin/env bash
# A gallery under disturbance: 200 random kills of whole runs and shards that work at the same time, many runs at once
# without kills, a full disk, low limits. Each phase ends with a whole run, after which the folder must hold the bytes
# of one undisturbed run.
# usage: tests/full/chaos.sh PROGRAM [SEED]
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: tests/full/chaos.sh PROGRAM [SEED]" >&2; exit 2; }
program=$(realpath "$1")
here=$(realpath "$(dirname "$0")")
command -v python3 > /dev/null || { echo "skipped: a gallery under disturbance (python3 is not installed)"; exit 0; }
folder=$(mktemp -d)
trap 'umount "$folder/disk" 2> /dev/null || true; rm -rf "$folder"' EXIT
chmod 755 "$folder"
python3 "$here/chaos.py" "$program" "$folder" "${2:-$RANDOM}"
