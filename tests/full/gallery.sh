#!/usr/bin/env bash
# The page of `sikku gallery` in a real browser: it is searched, filtered, looked at by mouse, keys and fingers, and
# asks for nothing but its own files.
# usage: tests/full/gallery.sh PROGRAM [SCREENSHOT.png]
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: tests/full/gallery.sh PROGRAM [SCREENSHOT.png]" >&2; exit 2; }
program=$(realpath "$1")
screenshot=${2:+$(realpath "$2")}
here=$(realpath "$(dirname "$0")")

skip() { echo "skipped: the gallery in a browser ($1)"; exit 0; }
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    skip "chromium is not installed"
command -v npm > /dev/null || skip "npm is not installed"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund --no-save playwright-core > npm.log 2>&1 ||
    skip "npm cannot install playwright-core: $(tail -n 1 npm.log)"
"$program" --quiet gallery kolams tilings -o x
timeout 180 node "$here/gallery.mjs" "$folder" "$browser" x $screenshot
