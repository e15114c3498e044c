#!/usr/bin/env bash
# Builds and tests the studio. NATIVE_BUILD has bin/sikku and bin/sikku-bridge.
# Usage: studio/check.sh NATIVE_BUILD [--quick]
set -euo pipefail
cd "$(dirname "$0")/.."
native=$(readlink -f "$1")
studio/build.sh
node --test studio/tests/*.test.mjs
node studio/tests/parity.mjs "$native" ${2:+"$2"}
node studio/tests/page.mjs build/studio/sikku-studio.html
