#!/usr/bin/env bash
# Checks that all sources compile with clang and libc++ 13, the standard library of Debian's emscripten; nothing is
# built. Usage: libcxx.sh BUILD_FOLDER, which has the generated headers
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
library=/usr/lib/llvm-13/include/c++/v1
for needed in "$library" /usr/include/fast_float; do
    [ -d "$needed" ] || { echo "skipped: compiling with libc++ 13 ($needed is not there)"; exit 0; }
done
command -v clang++ > /dev/null || { echo "skipped: compiling with libc++ 13 (clang is not installed)"; exit 0; }
options=(-std=c++20 -fsyntax-only -nostdinc++ -isystem "$library" -I. "-I$build/art" "-I$build/music")
for folder in harfbuzz fribidi; do options+=(-isystem "/usr/include/$folder"); done
for name in VERSION MODULES_FROM_DATA {DATA,PATTERNS,MODULES,STUDIO}_{RELATIVE,INSTALLED}; do
    options+=("-DSIKKU_$name=\"\"")
done
mapfile -t sources < <(find engine art music cli studio/editor -name '*.cpp' | sort)
printf '%s\0' "${sources[@]}" | xargs -0 -n 1 -P "$(nproc)" clang++ "${options[@]}"
echo "libc++ 13: ${#sources[@]} sources"
