#!/usr/bin/env bash
# Compares the bytes of ten thousand outputs (tests/bytes.sh) between compilers, machines, systems, locales, numbers of
# threads and time zones.
# usage: tests/release/bytes.sh PROGRAM [BRIDGE_FOLDER]
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: tests/release/bytes.sh PROGRAM [BRIDGE_FOLDER]" >&2; exit 2; }
here=$(dirname "$(readlink -f "$0")")
. "$here/root.sh"
program=$(realpath "$1")
bridge=${2:-}
[ -z "$bridge" ] || bridge=$(realpath "$bridge")
cd "$here/../.."
. tests/packages.sh
build=$PWD/build/bytes
mkdir -p "$build"
list() { tests/bytes.sh "$@"; }
list "$(nproc)" "$program" > "$build/expected"
total=$(wc -l < "$build/expected")
[ "$total" -ge 10000 ] || fail "only $total outputs"
echo "$total outputs; on x86-64, by the program given"

# same NAME COMMAND…: compares a list that a command prints.
same() {
    local name=$1
    shift
    local start=$SECONDS
    "$@" > "$build/found" || fail "$name: no list"
    if ! cmp -s "$build/expected" "$build/found"; then
        { diff "$build/expected" "$build/found" || true; } | grep '^[<>]' | awk '{ print $3 }' | sort -u > "$build/differ"
        head -n 20 "$build/differ"
        fail "$name: $(wc -l < "$build/differ") outputs differ"
    fi
    echo "$name: the same bytes ($((SECONDS - start)) s)"
}
list_of_bridge() { "$program" gallery --file tests/bytes/bytes.toml --list --json | node tests/bytes/bytes.mjs "$bridge"; }

same "1 thread" list 1 env "$program"
for locale in C tr_TR.UTF-8 de_DE.UTF-8 ar_SA.UTF-8; do
    [ "$locale" = C ] || [ -d "$build/$locale" ] || localedef -i "${locale%.*}" -f UTF-8 "$build/$locale" ||
        fail "no locale $locale"
    same "locale $locale" list "$(nproc)" env LOCPATH="$build" LC_ALL="$locale" "$program"
done
for zone in Asia/Kolkata America/Los_Angeles; do same "time zone $zone" list "$(nproc)" env TZ="$zone" "$program"; done
for compiler in g++-O0 g++-O3 clang++-O2; do
    other=build/compilers/$compiler/bin/sikku
    if [ -x "$other" ]; then same "$compiler" list "$(nproc)" "$PWD/$other"; else echo "skipped: $compiler (tests/full/compilers.sh builds it)"; fi
done
if [ -n "$bridge" ]; then
    cp "$build/expected" "$build/all"
    grep -v ' \./pieces/' "$build/all" > "$build/expected"  # the web build has no arrangements
    same "WebAssembly" list_of_bridge
    mv "$build/all" "$build/expected"
else
    echo "skipped: WebAssembly (no bridge was given)"
fi

# Programs without pictures for other machines, with the libraries of Debian 12 for them.
libraries=(libc6-dev libstdc++-12-dev libtbb-dev libfmt-dev zlib1g-dev libpugixml-dev libboost-dev libglm-dev
    libcli11-dev libtomlplusplus-dev nlohmann-json3-dev)
cross() {
    local machine=$1 architecture=$2
    local root=$build/root-$architecture
    if [ ! -d "$root" ]; then
        rm -rf "$root.new"
        architecture=$architecture make_root bookworm "$root.new" extract "${libraries[@]}"
        mv "$root.new" "$root"
    fi
    cmake -S . -B "$build/$architecture" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$here/cross.cmake" -DMACHINE="$machine" \
        -DROOT="$root" -DCMAKE_BUILD_TYPE=Release -DSIKKU_TESTS=OFF -DSIKKU_PICTURES=OFF \
        -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=8 > "$build/$architecture.log" 2>&1 ||
        { tail -n 30 "$build/$architecture.log"; fail "$architecture: not configured"; }
    cmake --build "$build/$architecture" -j "$(nproc)" --target sikku > "$build/$architecture.log" 2>&1 ||
        { tail -n 30 "$build/$architecture.log"; fail "$architecture: not built"; }
}
cross aarch64-linux-gnu arm64
same "arm64 (qemu-user)" list "$(nproc)" qemu-aarch64-static -L "$build/root-arm64" "$build/arm64/bin/sikku"
cross i686-linux-gnu i386
same "i386" list "$(nproc)" env SIKKU_DATA="$build/i386/share/sikku" \
    "$build/root-i386/lib/ld-linux.so.2" --library-path "$build/root-i386/usr/lib/i386-linux-gnu:$build/root-i386/lib/i386-linux-gnu" \
    "$build/i386/bin/sikku"

# Debian 13, with its own compiler and libraries.
root=$PWD/build/debian13
if [ -x "$root/sikku/build/dev/bin/sikku" ]; then
    same "Debian 13" in_root "$root" /sikku/tests/bytes.sh "$(nproc)" /sikku/build/dev/bin/sikku
else
    echo "skipped: Debian 13 (tests/release/debian13.sh builds it)"
fi
