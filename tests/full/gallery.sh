#!/usr/bin/env bash
# The page of `sikku gallery` in a real browser: it is searched, filtered, looked at by mouse, keys and fingers, and
# asks for nothing but its own files.
# usage: tests/full/gallery.sh PROGRAM [SCREENSHOT.png]
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: tests/full/gallery.sh PROGRAM [SCREENSHOT.png]" >&2; exit 2; }
program=$(realpath "$1")
screenshot=${2:+$(realpath "$2")}
here=$(realpath "$(dirname "$0")")

. "$here/browser.sh" "the gallery in a browser"
"$program" --quiet gallery kolams tilings -o x
timeout 180 node "$here/gallery.mjs" "$folder" "$browser" x $screenshot
