#!/usr/bin/env bash
# The site of packaging/site.sh in Chromium and Firefox: links, weights, widths, accessibility in light and dark, search,
# player, studio in the page, offline use; a second build has the same bytes; code in a hostile pattern does not run.
# usage: tests/full/site.sh PROGRAM [STUDIO_FOLDER] [SCREENSHOTS]
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: tests/full/site.sh PROGRAM [STUDIO_FOLDER] [SCREENSHOTS]" >&2; exit 2; }
program=$(realpath "$1")
here=$(realpath "$(dirname "$0")")
root=$(realpath "$here/../..")
studio=$(realpath -m "${2:-$root/build/studio}")
screenshots=${3:+$(realpath -m "$3")}

. "$here/browser.sh" "the site in browsers"
command -v cmark-gfm > /dev/null || skip "the site in browsers" "cmark-gfm is not installed"
if [ ! -f "$studio/sikku-studio.html" ] && [ $# -eq 1 ] && command -v em++ > /dev/null; then
    "$root/studio/build.sh" > studio.log 2>&1 || { tail -n 60 studio.log; exit 1; }
fi
[ -f "$studio/sikku-studio.html" ] || skip "the site in browsers" "$studio has no sikku-studio.html"
# Newer versions of playwright-core use features that Debian's Firefox does not support.
npm install --silent --no-audit --no-fund --no-save axe-core@4.14.1 playwright-core@1.60.0 > npm.log 2>&1 ||
    skip "the site in browsers" "npm cannot install axe-core: $(tail -n 1 npm.log)"

started=$(date +%s)
"$root/packaging/site.sh" x "$program" "$studio"
echo "site: built in $(($(date +%s) - started)) s"

# A few patterns of each kind, twice from different folders, and one whose texts contain code.
few() {
    local folder=$1 name file
    # The patterns that the texts link to, and some others.
    for name in $(grep -oh 'pattern/[a-z0-9-]*\.html' "$root"/packaging/site/text/*.md) anklets-of-krishna hilbert moss-leaf blues \
        simple-leaf penrose-kite-dart; do
        name=${name#pattern/}
        file=$(find "$root/patterns" -name "${name%.html}.*")
        mkdir -p "$folder/$(basename "$(dirname "$file")")"
        cp "$file" "$folder/$(basename "$(dirname "$file")")"
    done
    cat > "$folder/kolams/hostile.lsys" << 'END'
title: </title><script>document.title='broken'</script><img src=x onerror="document.title='broken'"> "'&amp; ‮desrever‬ ﷽
source: " onmouseover="document.title='broken'" x="</dd></dl><h1>broken</h1>
description: ]]> --> </script><!-- <style>*{display:none}</style> ‮⁦ javascript:document.title='broken'
define r = 0.5 /* "><script>document.title='broken'</script> */
axiom: F(r)
F(x) : x < 1 --> F(x)<script>
stroke: 1mm #</code><b>
variant "><b>x</b>: r = 0.7
END
}
site() {
    PYTHONDONTWRITEBYTECODE=1 python3 "$root/packaging/site/build.py" "$@" --program "$program" \
        --studio "$studio/sikku-studio.html" --version 0.0.0
}
few a/patterns
few another/folder
site a/site --patterns a/patterns > /dev/null 2> warnings
grep -q "warning: hostile: not drawn" warnings || { cat warnings; echo "the hostile pattern was drawn"; exit 1; }
site second --patterns another/folder > /dev/null 2>&1
diff -r a/site second || { echo "a second build has other bytes"; exit 1; }
echo "site: two builds have the same bytes"

# Bad input: a message names its place, and no file is replaced.
. "$here/refused.sh"
mkdir mine && echo kept > mine/file
refused "is not a site" site mine --patterns a/patterns
[ "$(cat mine/file)" = kept ]
refused "is missing; ./demo builds it" "$root/packaging/site.sh" y ./nothing "$studio"
refused "is missing; studio/build.sh" "$root/packaging/site.sh" y "$program" .
mkdir -p bad/kolams && cp a/patterns/kolams/hostile.lsys 'bad/kolams/<b>.lsys'
refused "a name consists of" site y --patterns bad
mkdir -p twice/kolams twice/plants && touch twice/kolams/x.lsys twice/plants/x.lsys
refused "has the same name as" site y --patterns twice
[ ! -e y ]

timeout 1200 node "$here/site.mjs" "$folder" "$browser" x a/site ${screenshots:+"$screenshots"}
