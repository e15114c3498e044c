#!/usr/bin/env bash
# The page of `sikku play` in a real browser: it plays, pauses, changes tempo, loops bars, jumps to phrases, and sends
# no requests to the network.
# usage: tests/full/page.sh PROGRAM [SCREENSHOT.png]
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: tests/full/page.sh PROGRAM [SCREENSHOT.png]" >&2; exit 2; }
program=$(realpath "$1")
screenshot=${2:+$(realpath "$2")}
here=$(realpath "$(dirname "$0")")

. "$here/browser.sh" "the page in a browser"
"$program" --quiet play hilbert -n 3 -o x.html
timeout 120 node "$here/page.mjs" "$folder" "$browser" x.html $screenshot
"$program" --quiet play blues -o blues.html
timeout 120 node "$here/parts.mjs" "$folder" "$browser" blues.html
"$program" --quiet play rooms -o rooms.html
timeout 120 node "$here/bars.mjs" "$folder" "$browser" rooms.html
"$program" --quiet play hilbert-todi -o phrases.html
timeout 120 node "$here/phrases.mjs" "$folder" "$browser" phrases.html
