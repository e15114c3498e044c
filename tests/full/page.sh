#!/usr/bin/env bash
# The page of `sikku play` in a real browser: it plays, pauses, changes tempo, asks the network for nothing.
# usage: tests/full/page.sh PROGRAM [SCREENSHOT.png]
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: tests/full/page.sh PROGRAM [SCREENSHOT.png]" >&2; exit 2; }
program=$(realpath "$1")
screenshot=${2:+$(realpath "$2")}
here=$(realpath "$(dirname "$0")")

skip() { echo "skipped: the page in a browser ($1)"; exit 0; }
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    skip "chromium is not installed"
command -v npm > /dev/null || skip "npm is not installed"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund --no-save playwright-core > npm.log 2>&1 ||
    skip "npm cannot install playwright-core: $(tail -n 1 npm.log)"
"$program" --quiet play hilbert -n 3 -o x.html
timeout 120 node "$here/page.mjs" "$folder" "$browser" x.html $screenshot
