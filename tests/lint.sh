#!/usr/bin/env bash
# Checks the format of all sources, and with clang-tidy those that were changed: usage: lint.sh BUILD_FOLDER [--all]
# BUILD_FOLDER has compile_commands.json. A source that was found clean is not looked at again until it, a header or
# the settings change. Without --all, only what differs from the commit before the last is looked at, without the
# static analyser, which takes minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
all=${2:-}
mapfile -t sources < <(git ls-files '*.h' '*.cpp')
clang-format --dry-run --Werror "${sources[@]}"
echo "clang-format: ${#sources[@]} files"

mapfile -t wanted < <(git ls-files 'engine/*.cpp' 'art/*.cpp' 'music/*.cpp' 'cli/*.cpp')
total=${#wanted[@]}
checks=()
if [ "$all" != --all ]; then
    checks=("--checks=-clang-analyzer-*,-bugprone-unchecked-optional-access")
    base=$(git rev-parse -q --verify HEAD~1 || git rev-parse HEAD)
    mapfile -t wanted < <(git diff --name-only --diff-filter=d "$base" -- engine art music cli | grep '\.cpp$' || true)
fi
mkdir -p "$build/tidy"
# The headers and settings that any source may see.
seen=$(git ls-files -s '*.h' .clang-tidy | sha256sum | cut -c1-16)$(git diff -- '*.h' .clang-tidy | sha256sum | cut -c1-8)
export build seen
tidy() {
    local source=$1 stamp
    shift
    stamp=$build/tidy/$(cat "$source" <(echo "$seen" "$@") | sha256sum | cut -c1-32)
    [ ! -e "$stamp" ] || return 0
    clang-tidy -p "$build" --quiet --warnings-as-errors='*' "$@" "$source" 2> /dev/null && touch "$stamp"
}
export -f tidy
if [ "${#wanted[@]}" -gt 0 ]; then
    printf '%s\n' "${wanted[@]}" |
        xargs -P "$(nproc)" -I{} bash -c 'source=$1; shift; tidy "$source" "$@"' _ {} "${checks[@]}"
fi
echo "clang-tidy: ${#wanted[@]} of $total sources"
