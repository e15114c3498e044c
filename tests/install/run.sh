#!/bin/sh
# Installs a build into an empty folder, then builds and runs other projects against it, including every program of
# docs/library.md. With --headers, compiles each installed header by itself instead.
# Usage: run.sh CMAKE BUILD_FOLDER [--headers]
set -eu
cmake=$1
build=$2
here=$(dirname "$(readlink -f "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
quietly() { "$@" > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }
quietly "$cmake" --install "$build" --prefix "$work/prefix"

cxx=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
if [ "${3:-}" = --headers ]; then
    cd "$work/prefix/include"
    headers=$(find sikku -name '*.h' | sort)
    echo "$headers" | xargs -P "$(nproc)" -I {} sh -c 'echo "#include <$1>" | "$2" -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I . -x c++ -' \
        header {} "$cxx" || { echo "an installed header does not compile by itself"; exit 1; }
    echo "$(echo "$headers" | wc -l) installed headers compile by themselves"
    exit
fi

# Blocks of C++ in the manual are complete programs: program-1.cpp, program-2.cpp, …
mkdir "$work/programs"
awk -v folder="$work/programs" '/^```cpp$/ { file = folder "/program-" ++count ".cpp"; next }
    /^```/ { file = "" }
    file { print > file }' "$here/../../docs/library.md"

generator=$(sed -n 's/^CMAKE_GENERATOR:[A-Z]*=//p' "$build/CMakeCache.txt")
sanitize=$(sed -n 's/^SIKKU_SANITIZE:[A-Z]*=//p' "$build/CMakeCache.txt")
# Programs anywhere find the patterns and the image module of a prefix that was not configured.
quietly "$cmake" -G "$generator" -S "$here" -B "$work/build" -DPROGRAMS="$work/programs" \
    -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_RUNTIME_OUTPUT_DIRECTORY="$work/consumers" \
    -DCMAKE_CXX_COMPILER="$cxx" ${sanitize:+-DCMAKE_CXX_FLAGS="-fsanitize=$sanitize"}
quietly "$cmake" --build "$work/build"
"$work/consumers/consumer"
cd "$work/programs"
for source in program-*.cpp; do
    program=${source%.cpp}
    "$work/consumers/$program" > "$program.out" || { cat "$program.out"; echo "$program of docs/library.md fails"; exit 1; }
done
echo "$(ls program-*.cpp | wc -l) programs of docs/library.md work"

if command -v pkg-config > /dev/null; then
    PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name sikku.pc)")
    export PKG_CONFIG_PATH
    # The output of pkg-config is split into options. With gnu++20, `linux` is a macro.
    # shellcheck disable=SC2046
    quietly "$cxx" -std=gnu++20 ${sanitize:+-fsanitize=$sanitize} program-1.cpp -o "$work/consumers/by-hand" $(pkg-config --cflags --libs sikku)
    "$work/consumers/by-hand" > /dev/null
    echo "pkg-config works"
else
    echo "skipped: pkg-config (it is not installed)"
fi

# The installed program finds its patterns and its image module from anywhere.
cd /
sikku=$work/prefix/bin/sikku
[ "$("$sikku" derive fibonacci-words)" = abaababa ]
"$sikku" draw snake-kolam --dpi 20 -o "$work/snake.png"
"$sikku" -q show "$work/snake.png" | cmp - "$work/prefix/share/sikku/patterns/kolams/snake-kolam.lsys"
"$sikku" kolam --grid 3x3 --seed 2 -o "$work/kolam.lsys" -q
"$sikku" draw "$work/kolam.lsys" --dots --size 60x60mm --dpi 150 -o "$work/kolam.png"
"$sikku" -q kolam --read "$work/kolam.png" -o "$work/read.lsys"
echo "installation works"
