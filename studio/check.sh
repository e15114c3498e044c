#!/usr/bin/env bash
# Builds and tests the studio. NATIVE_BUILD contains bin/sikku and bin/sikku-bridge.
# Usage: studio/check.sh NATIVE_BUILD [--quick]
set -euo pipefail
cd "$(dirname "$0")/.."
native=$(readlink -f "$1")
studio/build.sh
node --test studio/tests/*.test.mjs
node studio/tests/parity.mjs "$native" ${2:+"$2"}
page=build/studio/sikku-studio.html
if command -v chromium > /dev/null; then
    node studio/tests/page.mjs $page
    node studio/tests/views.mjs $page
    node studio/tests/play_and_bench.mjs $page
    # Every timbre is rendered and measured.
    [ "${2:-}" = --quick ] || node studio/tests/sound_in_browser.mjs
else
    echo "skipped: the page in Chromium (not installed)"
fi
if command -v firefox-esr > /dev/null; then
    node studio/tests/firefox.mjs $page
else
    echo "skipped: the page in Firefox (not installed)"
fi
