#!/usr/bin/env bash
# 300 random scores as MusicXML, read by MuseScore and by Verovio: onsets, letters, signs and octaves are those written.
# usage: tests/full/readers.sh PROGRAM
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/full/readers.sh PROGRAM" >&2; exit 2; }
program=$(realpath "$1")
here=$(realpath "$(dirname "$0")")
count=300
skip() { echo "skipped: scores through MuseScore and Verovio ($1)"; exit 0; }
musescore=$(command -v musescore3 || command -v mscore) || skip "MuseScore is not installed"
command -v npm > /dev/null || skip "npm is not installed"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund --no-save verovio@6.3.0 > npm.log 2>&1 ||
    skip "npm cannot install verovio: $(tail -n 1 npm.log)"
python3 "$here/readers.py" make "$program" "$folder" "$count"
QT_QPA_PLATFORM=offscreen timeout 600 "$musescore" -j jobs.json > musescore.log 2>&1 || { tail musescore.log; exit 1; }
timeout 600 node "$here/verovio.mjs" "$folder" "$folder" "$count"
python3 "$here/readers.py" compare "$folder" "$count"
