#!/usr/bin/env bash
# Measures the processor time of a build from nothing, by target and by unit, and lists the headers that are read most
# often outside of precompiled ones. Usage: build.sh PRESET [OPTION OF CMAKE…], such as `build.sh release -DSIKKU_TESTS=OFF`
set -euo pipefail
here=$(realpath "$0")

# Called for each compiler or linker: runs it, and appends its user and system seconds and its output to a table.
if [ "${1:-}" = --launch ]; then
    shift
    arguments=("$@")
    for ((i = 0; i < $#; ++i)); do
        [ "${arguments[i]}" != -o ] || output=${arguments[i + 1]}
    done
    TIMEFORMAT='%U %S'
    { time "$@" 2>&3; } 3>&2 2> "$SIKKU_BUILD_TIMES.$$" && status=0 || status=$?
    echo "$(tail -n 1 "$SIKKU_BUILD_TIMES.$$") ${output:-other}" >> "$SIKKU_BUILD_TIMES"
    rm "$SIKKU_BUILD_TIMES.$$"
    exit "$status"
fi

[ $# -ge 1 ] || { echo "usage: build.sh PRESET [OPTION OF CMAKE…]" >&2; exit 2; }
preset=$1
shift
cd "$(dirname "$here")/../.."
build=build/measured-$preset
rm -rf "$build"
mkdir -p "$build"
export CCACHE_DISABLE=1 SIKKU_BUILD_TIMES=$PWD/$build/times
cmake --preset "$preset" -B "$build" -DCMAKE_CXX_COMPILER_LAUNCHER="$here;--launch" \
    -DCMAKE_CXX_LINKER_LAUNCHER="$here;--launch" "$@" > "$build/configure.log"
rm -f "$SIKKU_BUILD_TIMES"  # CMake tried the compiler
cmake --build "$build" -j "$(nproc)" -- -k 0 > "$build/build.log" || { tail -n 40 "$build/build.log"; exit 1; }

echo "Processor seconds by target:"
awk '{
    target = $3
    if (!sub(/\.dir\/.*/, "", target)) target = "link"
    sub(/.*CMakeFiles\//, "", target)
    if ($3 ~ /\.gch$/) target = "precompiled headers"
    seconds[target] += $1 + $2; units[target]++; all += $1 + $2
} END {
    for (target in seconds) printf "%8.1f  %4d  %s\n", seconds[target], units[target], target
    printf "%8.1f  %4d  all\n", all, NR
}' "$SIKKU_BUILD_TIMES" | sort -rn
echo "Slowest units:"
awk '{ printf "%8.1f  %s\n", $1 + $2, $3 }' "$SIKKU_BUILD_TIMES" | sort -rn | head -n 20
echo "Megabytes of headers read by all units, and units:"
ninja -C "$build" -t deps | awk '
    /#deps/ { is_precompiled = $1 ~ /\.gch:$/; next }
    NF && is_precompiled { precompiled[$1] = 1; next }
    NF && !/\.(cpp|cxx|gch)$/ { units[$1]++ }
    END { for (header in units) if (!(header in precompiled)) print units[header], header }' |
    while read -r units header; do
        echo "$((units * $(stat -c %s "$build/$header" 2> /dev/null || stat -c %s "$header"))) $units $header"
    done | sort -rn | head -n 30 | awk '{ printf "%8.2f  %4d  %s\n", $1 / 1e6, $2, $3 }'
