#!/usr/bin/env bash
# Builds and tests the studio, which writes the bytes of each NATIVE_BUILD: these contain bin/sikku and bin/sikku-bridge.
# Usage: studio/check.sh NATIVE_BUILD… [--quick]
set -euo pipefail
cd "$(dirname "$0")/.."
natives=()
quick=
for argument in "$@"; do
    if [ "$argument" = --quick ]; then quick=--quick; else natives+=("$(readlink -f "$argument")"); fi
done
studio/build.sh
node --test studio/tests/*.test.mjs
# Each comparison takes one core for minutes.
compare() {
    local state=0
    node studio/tests/parity.mjs "$1" $quick > "$1/parity.log" 2>&1 || state=$?
    echo "parity with $1"
    cat "$1/parity.log"
    return $state
}
export -f compare
export quick
printf '%s\n' "${natives[@]}" | xargs -P "$(nproc)" -I {} bash -euo pipefail -c 'compare "$1"' bash {}
page=build/studio/sikku-studio.html
if command -v chromium > /dev/null; then
    node studio/tests/page.mjs $page
    node studio/tests/views.mjs $page
    node studio/tests/another.mjs $page
    node studio/tests/newcomers.mjs $page
    node studio/tests/play_and_bench.mjs $page
    # Every timbre is rendered and measured.
    [ -n "$quick" ] || node studio/tests/sound_in_browser.mjs
else
    echo "skipped: the page in Chromium (not installed)"
fi
if command -v firefox-esr > /dev/null; then
    node studio/tests/firefox.mjs $page
    [ -n "$quick" ] || node studio/tests/newcomers.mjs $page --firefox
else
    echo "skipped: the page in Firefox (not installed)"
fi
