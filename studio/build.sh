#!/usr/bin/env bash
# Builds the studio: build/studio/sikku-studio.html. `./demo --studio` installs the packages that this needs.
set -euo pipefail
cd "$(dirname "$0")/.."
mkdir -p build
cmake --preset studio > build/studio.log 2>&1 || { cat build/studio.log; exit 1; }
cmake --build --preset studio -j "$(nproc)"
cd studio
if [ ! node_modules/.package-lock.json -nt package-lock.json ]; then
    npm ci --no-audit --no-fund --loglevel=error
fi
npx tsc --noEmit
node build.mjs
