#!/usr/bin/env bash
# Kolams where it takes long or needs a browser: the larger enumerations, and an animated print in Chromium.
# usage: tests/full/kolam.sh PROGRAM [SCREENSHOT.png]
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: tests/full/kolam.sh PROGRAM [SCREENSHOT.png]" >&2; exit 2; }
program=$(realpath "$1")
screenshot=${2:+$(realpath "$2")}
here=$(realpath "$(dirname "$0")")

# In a process of their own, whose memory those of decoders include.
for tests in 'PictureProcess.*' 'DotGridEnumeration.*:Photograph.*:PhotographPrints.*'; do
    SIKKU_FULL=1 "$(dirname "$program")/art_tests" --gtest_filter="$tests" --gtest_brief=1
done

. "$here/browser.sh" "an animated kolam in a browser"
"$program" --quiet draw snake-kolam -n 3 --dots --animate 8 --size 100x100mm -o snake.svg
timeout 120 node "$here/kolam.mjs" "$folder" "$browser" snake.svg $screenshot
