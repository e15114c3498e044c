#!/bin/sh
# Installs a build into an empty folder, then builds and runs another project against it.
# Usage: run.sh CMAKE BUILD_FOLDER
set -eu
cmake=$1
build=$2
here=$(dirname "$(readlink -f "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$cmake" --install "$build" --prefix "$work/prefix" > "$work/log" || { cat "$work/log"; exit 1; }
cxx=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
generator=$(sed -n 's/^CMAKE_GENERATOR:[A-Z]*=//p' "$build/CMakeCache.txt")
sanitize=$(sed -n 's/^SIKKU_SANITIZE:[A-Z]*=//p' "$build/CMakeCache.txt")
"$cmake" -G "$generator" -S "$here" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$cxx" \
    ${sanitize:+-DCMAKE_CXX_FLAGS="-fsanitize=$sanitize"} > "$work/log" || { cat "$work/log"; exit 1; }
"$cmake" --build "$work/build" > "$work/log" || { cat "$work/log"; exit 1; }
"$work/build/consumer"
# The installed program finds its patterns and its image module from anywhere.
cd /
sikku=$work/prefix/bin/sikku
[ "$("$sikku" derive fibonacci-words)" = abaababa ]
"$sikku" draw snake-kolam --dpi 20 -o "$work/snake.png"
"$sikku" -q show "$work/snake.png" | cmp - "$work/prefix/share/sikku/patterns/kolams/snake-kolam.lsys"
echo "installation works"
