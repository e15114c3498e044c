#!/usr/bin/env bash
# Draws every pattern that comes along and lays them out on one sheet, docs/patterns.png.
# Usage: docs/contact-sheet.sh PROGRAM (needs ImageMagick and pngquant)
set -euo pipefail
sikku=$(readlink -f "$1")
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for kind in kolams tilings curves plants; do
    for file in patterns/"$kind"/*.lsys; do
        name=$(basename "$file" .lsys)
        "$sikku" -q draw "$file" --size 380x380px --margin 12px --dpi 192 -o "$work/$name.png"
        printf '%s\n' -label "$name" "$work/$name.png" >> "$work/list"
    done
done
mapfile -t list < "$work/list"
montage "${list[@]}" -tile 10x -geometry 190x190+5+3 -font DejaVu-Sans -pointsize 12 -fill '#444' -background white "$work/sheet.png"
pngquant --force --speed 1 --output docs/patterns.png 256 "$work/sheet.png"
