#!/usr/bin/env bash
# Compares the bytes of outputs of the program built by g++ and clang at -O0 to -O3. Builds those that are not given.
# usage: tests/full/compilers.sh PROGRAM-BY-G++-O1 PROGRAM-BY-G++-O2
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: tests/full/compilers.sh PROGRAM-BY-G++-O1 PROGRAM-BY-G++-O2" >&2; exit 2; }
programs=("$(realpath "$1")" "$(realpath "$2")")
cd "$(dirname "$0")/../.."
for compiler in g++ clang++; do
    for level in 0 1 2 3; do
        build=$compiler-O$level folder=build/compilers/$compiler-O$level
        case $build in g++-O1 | g++-O2) continue ;; esac
        if ! command -v "$compiler" > /dev/null; then
            echo "skipped: outputs of $build (it is not installed)"
            continue
        fi
        mkdir -p "$folder"
        # Linking the whole program at once also finds types of one name with two definitions.
        whole=()
        [ "$build" != g++-O0 ] || whole=(-DCMAKE_INTERPROCEDURAL_OPTIMIZATION=ON
            -DCMAKE_EXE_LINKER_FLAGS="-flto=auto -Wodr -Werror=odr -Werror=lto-type-mismatch")
        # Without tests, which would take most of the time, and without a type of build: a release has levels of its own.
        cmake -S . -B "$folder" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=None \
            -DCMAKE_CXX_FLAGS="-O$level -DNDEBUG" -DSIKKU_TESTS=OFF -DCMAKE_UNITY_BUILD=ON \
            -DCMAKE_UNITY_BUILD_BATCH_SIZE=8 "${whole[@]}" > "$folder.log" 2>&1 ||
            { cat "$folder.log"; exit 1; }
        cmake --build "$folder" -j "$(nproc)" --target sikku sikku_image > "$folder.log" 2>&1 ||
            { tail -n 40 "$folder.log"; exit 1; }
        programs+=("$folder/bin/sikku")
    done
done
exec tests/full/same_bytes.sh "${programs[@]}"
