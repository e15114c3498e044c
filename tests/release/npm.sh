#!/usr/bin/env bash
# Installs the npm package of a release into an empty folder, and uses it in node and in a page.
# usage: tests/release/npm.sh DIST
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/release/npm.sh DIST" >&2; exit 2; }
here=$(dirname "$(readlink -f "$0")")
archive=$(find "$(realpath "$1")" -regex '.*/sikku-[0-9.]*\.tgz')
esbuild=$(realpath "$here/../../studio/node_modules/.bin/esbuild")
tsc=$(realpath "$here/../../studio/node_modules/.bin/tsc")
size=$(stat -c %s "$archive")
[ "$size" -le 2500000 ] || { echo "the npm package has $size bytes; at most 2,500,000 are wanted" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
echo '{"name": "user", "private": true, "type": "module"}' > package.json
npm install --silent --offline --no-audit --no-fund "$archive"
# The examples of its README.
awk '/^```js$/ { inside = 1; next } /^```/ { inside = 0 } inside' node_modules/sikku/README.md > readme.mjs
node readme.mjs > readme.out
grep -q '<svg' hilbert.svg
grep -q '^[0-9]\{30,\}$' readme.out  # a count of n = 60, exact
grep -q 'angle' readme.out           # the error of `angel`
midicsv hilbert.mid > /dev/null
cat > errors.mjs <<'END'
import assert from "node:assert/strict";
import { start } from "sikku";
const sikku = await start();
const wrong = (work) => { try { work(); } catch (error) { return [error.name, error.kind, error.option]; } };
assert.deepEqual(wrong(() => sikku.draw("hilbert", "svg", { n: -1 })), ["SikkuError", "setting", "derivation length"]);
assert.deepEqual(wrong(() => sikku.draw("hilbert", "svg", { size: "zz" })), ["SikkuError", "setting", "size"]);
assert.deepEqual(wrong(() => sikku.draw("hilbert", "svg", { "angle factor": "x" })), ["SikkuError", "setting", "angle factor"]);
assert.deepEqual(wrong(() => sikku.draw({ text: "axiom = F(a)" })), ["SikkuError", "pattern", undefined]);
assert.deepEqual(wrong(() => sikku.draw("nothing")), ["SikkuError", "other", undefined]);
assert.deepEqual(wrong(() => sikku.draw()), ["TypeError", undefined, undefined]);
assert.throws(() => sikku.draw("hilbert", "tif"), /use `sikku draw`/);
assert.throws(() => sikku.play("hilbert", "wav"), /use `sikku play`/);
END
node errors.mjs
cat > types.ts <<'END'
import { start } from "sikku";
const sikku = await start();
const svg: Uint8Array | string = sikku.draw("hilbert", "svg", { n: 3 });
console.log(svg.length);
END
"$tsc" --noEmit --strict --target es2022 --module nodenext --moduleResolution nodenext types.ts
# A page made with esbuild reports to the server what it has drawn.
cat > page.ts <<'END'
import { start } from "sikku";
start("sikku.wasm").then((sikku) => {
    const svg = sikku.draw("hilbert", "svg", { n: 3, size: "40x40mm" });
    document.body.innerHTML = typeof svg === "string" ? svg : new TextDecoder().decode(svg);
    return `drawn-${document.querySelectorAll("svg path").length}`;
}).catch((error) => `failed-${error}`).then((report) => fetch(report));
END
"$esbuild" page.ts --bundle --format=esm --outfile=page.js --log-level=warning
cp node_modules/sikku/sikku.wasm .
echo '<!DOCTYPE html><meta charset="utf-8"><body><script type="module" src="page.js"></script>' > index.html
if command -v chromium > /dev/null; then
    python3 -u -m http.server 0 --bind 127.0.0.1 > server.out 2>&1 &
    server=$!
    trap 'kill $server $browser 2> /dev/null; wait; rm -rf "$work"' EXIT
    browser=
    timeout 30 sh -c 'until grep -q port server.out; do sleep 0.1; done'
    port=$(sed -n 's/.* port \([0-9]*\) .*/\1/p' server.out)
    chromium --headless --no-sandbox --disable-gpu --user-data-dir="$work/profile" --remote-debugging-port=0 \
        "http://127.0.0.1:$port/index.html" > /dev/null 2>&1 &
    browser=$!
    timeout 60 sh -c "until grep -q 'drawn-\|failed-' server.out; do sleep 0.1; done" || true
    grep -q 'GET /drawn-1 ' server.out || { cat server.out; echo "the page draws nothing" >&2; exit 1; }
    echo "npm package: $size bytes; README's examples run in node, and a page made with esbuild draws"
else
    echo "npm package: $size bytes; README's examples run in node"
    echo "skipped: the page made with esbuild (chromium is not installed)"
fi
