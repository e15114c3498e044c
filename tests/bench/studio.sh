#!/usr/bin/env bash
# Times the studio in Chromium: the first picture, keystrokes, sliders, zoom, variations, memory. Run it on a quiet
# machine, after ./demo --studio.
# Usage: studio.sh [PAGE]
set -euo pipefail
cd "$(dirname "$0")/../.."
page=$(readlink -f "${1:-build/studio/sikku-studio.html}")
node studio/tests/page.mjs "$page" --only '*' --measure
node studio/tests/views.mjs "$page" --measure
