#!/usr/bin/env bash
# Plots as SVG through vpype, an independent reader: its layers are the pens, and its lengths are those reported.
# usage: tests/full/vpype.sh PROGRAM
set -euo pipefail
program=$(realpath "$1")
if ! command -v vpype > /dev/null; then
    echo "skipped: layers of plots through vpype (it is not installed)"
    exit 0
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat > pens.lsys <<'PATTERN'
title: Three pens
axiom: F+F+F+F'F+F+F+F'F+F
angle increment: 90
palette: black red navy
stroke: 0.3mm
PATTERN
"$program" draw pens.lsys --plotter --profile axidraw --pen '2 speed=50 down=40' -o pens.svg 2> report
vpype read pens.svg stat > stat
layers=$(grep -c '^Layer ' stat || true)
[ "$layers" -eq 3 ] || { cat stat; echo "vpype reads $layers layers instead of 3"; exit 1; }
# Metres drawn, as the program and as vpype report them, the latter in pixels of 1/96 inch.
drawn=$(sed -n 's/^.*plot: *\([0-9.]*\) m drawn.*/\1/p' report)
read_back=$(awk '/^Totals/ { t = 1 } t && /Length:/ { printf "%.2f", $2 * 25.4 / 96 / 1000; exit }' stat)
awk -v a="$drawn" -v b="$read_back" 'BEGIN { exit !(a - b < 0.02 && b - a < 0.02) }' ||
    { cat stat; echo "vpype measures $read_back m instead of $drawn m"; exit 1; }
echo "vpype: 3 layers, $read_back m"
