#!/usr/bin/env bash
# Makes ten thousand outputs, described in tests/bytes/bytes.toml, and some reports, and prints the SHA-256 and the name of
# each, sorted by name: the list is the same on every machine. COMMAND may be preceded by others, such as `env LC_ALL=C`
# or `qemu-aarch64`.
# usage: tests/bytes.sh JOBS COMMAND… > LIST
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: tests/bytes.sh JOBS COMMAND… > LIST" >&2; exit 2; }
jobs=$1
shift
file=$(dirname "$(readlink -f "$0")")/bytes/bytes.toml
folder=$(mktemp -d)
trap 'rm -rf "$folder" "$folder.errors"' EXIT
# Patterns that draw nothing, or have no solid, fail everywhere.
"$@" --quiet gallery --file "$file" -o "$folder" --jobs "$jobs" --keep-going 2> "$folder.errors" || true
# Errors of the gallery itself leave no file.
made=$(find "$folder" -type f | wc -l)
[ "$made" -ge 10000 ] || { head -n 20 "$folder.errors" >&2; echo "only $made files were made" >&2; exit 1; }
rm -f "$folder/gallery.jsonl" "$folder/index.html"
mkdir "$folder/reports"
for pattern in hilbert dragon dekking-spline snake-kolam bag-of-candies kolam-11-to-1-b731bgbw penrose-rhombs hat pinwheel rauzy; do
    for report in kolam measure tiling; do
        # A report that exits with status 1 prints the reason.
        "$@" "$report" "$pattern" --json > "$folder/reports/$pattern.$report.json" 2>> "$folder.errors" || true
    done
done
# Galleries make no models with several files and no animations.
for pattern in hilbert hat lilac; do "$@" --quiet draw "$pattern" -o "$folder/reports/$pattern.obj" 2>> "$folder.errors"; done
"$@" --quiet draw hilbert --generations 1:4 --size 40x40mm --dpi 60 -o "$folder/reports/hilbert.gif"
cd "$folder"
find . -type f | LC_ALL=C sort | xargs sha256sum
