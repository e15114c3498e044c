#!/usr/bin/env bash
# Plots as DXF through LibreCAD, an independent CAD program: it reads the unit, lines, arcs and circles at their size.
# usage: tests/full/cad.sh PROGRAM
set -euo pipefail
program=$(realpath "$1")
for tool in librecad pdftoppm; do
    if ! command -v "$tool" > /dev/null; then
        echo "skipped: DXF through LibreCAD ($tool is not installed)"
        exit 0
    fi
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# Width and height of the ink of FILE.dxf in millimetres, as LibreCAD prints it at full size.
printed() {
    QT_QPA_PLATFORM=offscreen timeout 120 librecad dxf2pdf -o "$1.pdf" "$1.dxf" > "$1.log" 2>&1 || true
    [ -s "$1.pdf" ] || { cat "$1.log"; echo "LibreCAD does not print $1.dxf"; exit 1; }
    pdftoppm -r 254 -singlefile "$1.pdf" "$1"
    python3 - "$1.ppm" <<'PYTHON'
import sys
data = open(sys.argv[1], 'rb').read()
width, height = map(int, data.split(b'\n', 2)[1].split())
pixels = data[-3 * width * height:]
rows = [pixels[3 * width * y:3 * width * (y + 1)] for y in range(height)]
inked = [y for y, row in enumerate(rows) if row.count(255) < len(row)]
left = min(len(rows[y]) - len(rows[y].lstrip(b'\xff')) for y in inked) // 3
right = max(len(rows[y].rstrip(b'\xff')) for y in inked) // 3
print(f"{(right - left) / 10:.1f} {(inked[-1] - inked[0] + 1) / 10:.1f}")
PYTHON
}
expect() {
    local size
    size=$(printed "$1")
    awk -v a="$size" -v b="$2" -v c="$3" 'BEGIN { split(a, s, " "); exit !(s[1] > b - 0.6 && s[1] < b + 0.6 &&
        s[2] > c - 0.6 && s[2] < c + 0.6) }' || { echo "LibreCAD prints $1 $size mm large instead of $2 x $3"; exit 1; }
}
printf 'axiom: F-F-F-F\nangle increment: 90\n' > square.lsys
"$program" -q draw square.lsys --step 60mm --size 100x100mm -o square.dxf
expect square 60 60
# A disc is a circle of its size.
printf 'axiom: @O(1)\n' > disc.lsys
"$program" -q draw disc.lsys --step 35mm --size 100x100mm -o disc.dxf
grep -q '^CIRCLE$' disc.dxf || { echo "a disc is not a circle"; exit 1; }
expect disc 70 70
"$program" -q draw snake-kolam -n 2 --dots --size 120x120mm -o kolam.dxf
grep -q '^42$' kolam.dxf || { echo "a kolam has no arcs"; exit 1; }
read -r width height < <(printed kolam)
echo "LibreCAD: 60 mm and 70 mm as drawn, a kolam of $width x $height mm"
