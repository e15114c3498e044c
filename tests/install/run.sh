#!/bin/sh
# Installs a build into an empty folder, then builds and runs other projects against it, including every program of
# docs/library.md. Usage: run.sh CMAKE BUILD_FOLDER
set -eu
cmake=$1
build=$2
here=$(dirname "$(readlink -f "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
quietly() { "$@" > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }
quietly "$cmake" --install "$build" --prefix "$work/prefix"

# Blocks of C++ in the manual are complete programs: program-1.cpp, program-2.cpp, …
mkdir "$work/programs"
awk -v folder="$work/programs" '/^```cpp$/ { file = folder "/program-" ++count ".cpp"; next }
    /^```/ { file = "" }
    file { print > file }' "$here/../../docs/library.md"

cxx=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
generator=$(sed -n 's/^CMAKE_GENERATOR:[A-Z]*=//p' "$build/CMakeCache.txt")
sanitize=$(sed -n 's/^SIKKU_SANITIZE:[A-Z]*=//p' "$build/CMakeCache.txt")
# Programs beside the installed one find its patterns and its image module, even if the package was moved.
quietly "$cmake" -G "$generator" -S "$here" -B "$work/build" -DPROGRAMS="$work/programs" \
    -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_RUNTIME_OUTPUT_DIRECTORY="$work/prefix/bin" \
    -DCMAKE_CXX_COMPILER="$cxx" ${sanitize:+-DCMAKE_CXX_FLAGS="-fsanitize=$sanitize"}
quietly "$cmake" --build "$work/build"
"$work/prefix/bin/consumer"
cd "$work/programs"
for source in program-*.cpp; do
    program=${source%.cpp}
    "$work/prefix/bin/$program" > "$program.out" || { cat "$program.out"; echo "$program of docs/library.md fails"; exit 1; }
done
echo "$(ls program-*.cpp | wc -l) programs of docs/library.md work"

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
