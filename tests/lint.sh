#!/usr/bin/env bash
# Checks the format of all sources, and runs clang-tidy on changed ones. Usage: lint.sh BUILD_FOLDER [--all]
# BUILD_FOLDER is build/PRESET. A clean source is checked again only after it, a header or the settings
# change. Without --all, only files that differ from the commit before the last are checked (none outside of a git
# repository).
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
all=${2:-}
mapfile -t sources < <(find engine art music cli python studio tests -name node_modules -prune -o \
    \( -name '*.h' -o -name '*.cpp' \) -print | sort)
clang-format --dry-run --Werror "${sources[@]}"
echo "clang-format: ${#sources[@]} files"

# Single sources instead of the batches of the build, or with --all the batches, which take less than half the time;
# without precompiled headers of g++, which clang-tidy cannot read, without options that it does not have, and without
# warnings of names that sources of a batch share, as g++ gives those that matter.
batches=OFF options=() unknown='no-restrict|no-stringop-[a-z]*|no-subobject-linkage'
if [ "$all" = --all ]; then
    batches=ON unknown="shadow|$unknown"
    options=(--checks=-bugprone-suspicious-include '--header-filter=(engine|art|music|cli|python|studio)/.*\.(h|cpp)$')
fi
cmake --preset "$(basename "$build")" -B "$build/tidy" -DCMAKE_UNITY_BUILD=$batches \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON > "$build/tidy.log" 2>&1 || { cat "$build/tidy.log"; exit 1; }
sed -i -E "s/ --param ggc[^ ]*//g; s/ -W($unknown)//g" "$build/tidy/compile_commands.json"
if [ "$all" = --all ]; then
    mapfile -t wanted < <(sed -n 's/^ *"file": "\(.*\)",\?$/\1/p' "$build/tidy/compile_commands.json" |
        grep -v -e /tests/ -e sikku_headers | sort -u)
else
    # Only the web build compiles studio/wasm.
    mapfile -t wanted < <(git diff --name-only --diff-filter=d HEAD~1 -- engine art music cli python 'studio/*.cpp' ':!studio/wasm' 2> /dev/null |
        grep '\.cpp$' || true)
fi
# All headers and settings.
seen=$(cat .clang-tidy $(find engine art music cli python studio/*.h studio/editor -name '*.h' | sort) | sha256sum | cut -c1-24)
export build seen
# The sources of a batch, or the source itself.
sources_of() {
    case $1 in
        */Unity/*) sed -n 's/^#include "\(.*\)"$/\1/p' "$1" ;;
        *) echo "$1" ;;
    esac
}
tidy() {
    local source=$1 stamp
    shift
    stamp=$build/tidy/$({ sources_of "$source" | xargs cat; echo "$seen"; } | sha256sum | cut -c1-32)
    [ ! -e "$stamp" ] || return 0
    clang-tidy -p "$build/tidy" --quiet --warnings-as-errors='*' "$@" "$source" 2> /dev/null && touch "$stamp"
}
export -f sources_of tidy
if [ "${#wanted[@]}" -gt 0 ]; then
    printf '%s\n' "${wanted[@]}" |
        xargs -P "$(nproc)" -I{} bash -c 'tidy "$@"' bash {} "${options[@]}"
fi
echo "clang-tidy: ${#wanted[@]} sources$([ "$batches" = OFF ] || echo ' and batches of sources')"
