#!/usr/bin/env bash
# Checks the format of all sources, and runs clang-tidy on changed ones. Usage: lint.sh BUILD_FOLDER [--all]
# BUILD_FOLDER is build/PRESET. A clean source is checked again only after it, a header or the settings
# change. Without --all, only files that differ from the commit before the last are checked (none outside of a git
# repository), without the static analyser, which takes minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
all=${2:-}
mapfile -t sources < <(find engine art music cli python studio tests -name node_modules -prune -o \
    \( -name '*.h' -o -name '*.cpp' \) -print | sort)
clang-format --dry-run --Werror "${sources[@]}"
echo "clang-format: ${#sources[@]} files"

# Only the web build compiles studio/wasm.
mapfile -t wanted < <(find engine art music cli python studio/*.cpp -name '*.cpp' | sort)
total=${#wanted[@]}
if [ "$all" != --all ]; then
    mapfile -t wanted < <(git diff --name-only --diff-filter=d HEAD~1 -- engine art music cli python 'studio/*.cpp' ':!studio/wasm' 2> /dev/null |
        grep '\.cpp$' || true)
fi
# A table of single sources instead of batches, without precompiled headers of g++, which clang-tidy cannot read, and
# without options that it does not have.
cmake --preset "$(basename "$build")" -B "$build/tidy" -DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
    > "$build/tidy.log" 2>&1 || { cat "$build/tidy.log"; exit 1; }
sed -i -E 's/ --param ggc[^ ]*//g; s/ -Wno-(restrict|stringop-[a-z]*)//g' "$build/tidy/compile_commands.json"
# All headers and settings.
seen=$(cat .clang-tidy $(find engine art music cli python studio/*.h -name '*.h' | sort) | sha256sum | cut -c1-24)
export build seen
tidy() {
    local source=$1 stamp
    stamp=$build/tidy/$(cat "$source" <(echo "$seen") | sha256sum | cut -c1-32)
    [ ! -e "$stamp" ] || return 0
    clang-tidy -p "$build/tidy" --quiet --warnings-as-errors='*' "$source" 2> /dev/null && touch "$stamp"
}
export -f tidy
if [ "${#wanted[@]}" -gt 0 ]; then
    printf '%s\n' "${wanted[@]}" |
        xargs -P "$(nproc)" -I{} bash -c 'tidy {}'
fi
echo "clang-tidy: ${#wanted[@]} of $total sources"
