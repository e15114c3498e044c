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
start=$SECONDS
tests/bytes.sh 4 env LC_ALL=C TZ=UTC "$program" > "$build/expected"
total=$(wc -l < "$build/expected")
echo "$total outputs, by the program given, 4 threads, locale C, UTC ($((SECONDS - start)) s)"

# same NAME COMMAND…: compares a list that a command prints.
same() {
    local name=$1 expected=${expected:-$build/expected}
    shift
    local start=$SECONDS
    "$@" > "$build/found" || fail "$name: no list"
    if ! cmp -s "$expected" "$build/found"; then
        { diff "$expected" "$build/found" || true; } | grep '^[<>]' | awk '{ print $3 }' | sort -u > "$build/differ"
        head -n 20 "$build/differ"
        fail "$name: $(wc -l < "$build/differ") outputs differ"
    fi
    echo "$name: $(wc -l < "$expected") outputs with the same bytes ($((SECONDS - start)) s)"
}

for locale in tr_TR.UTF-8 de_DE.UTF-8 ar_SA.UTF-8; do
    [ -d "$build/$locale" ] || localedef -i "${locale%.*}" -f UTF-8 "$build/$locale" || fail "no locale $locale"
done
same "1 thread, tr_TR, Kolkata" tests/bytes.sh 1 env LOCPATH="$build" LC_ALL=tr_TR.UTF-8 TZ=Asia/Kolkata "$program"
same "4 threads, de_DE, Los Angeles" tests/bytes.sh 4 env LOCPATH="$build" LC_ALL=de_DE.UTF-8 TZ=America/Los_Angeles "$program"
same "2 threads, ar_SA" tests/bytes.sh 2 env LOCPATH="$build" LC_ALL=ar_SA.UTF-8 "$program"

list_of_bridge() { "$program" gallery --file tests/bytes/bytes.toml --list --json | node tests/bytes/bytes.mjs "$bridge"; }
if [ -n "$bridge" ]; then
    # The web build excludes arrangements; studio/tests/parity.mjs compares its reports.
    grep -v ' \./\(pieces\|reports\)/' "$build/expected" > "$build/expected-web"
    expected=$build/expected-web same "WebAssembly (compiled by clang, with libc++)" list_of_bridge
else
    echo "skipped: WebAssembly (no bridge was given)"
fi

# compiled NAME CMAKE_ARGUMENT…: builds a program without OpenImageIO, by another compiler or for another machine.
compiled() {
    local folder=$build/$1
    shift
    cmake -S . -B "$folder" -G Ninja -DSIKKU_TESTS=OFF -DSIKKU_PICTURES=OFF -DSIKKU_FONTS=OFF -DCMAKE_UNITY_BUILD=ON \
        -DCMAKE_UNITY_BUILD_BATCH_SIZE=8 "$@" > "$folder.log" 2>&1 || { tail -n 30 "$folder.log"; fail "$folder: not configured"; }
    cmake --build "$folder" -j "$(nproc)" --target sikku > "$folder.log" 2>&1 ||
        { tail -n 30 "$folder.log"; fail "$folder: not built"; }
}
for compiler in g++-O0 g++-O3 clang++-O2; do
    # Link-time optimisation also detects violations of the one-definition rule.
    whole=()
    [ "$compiler" != g++-O0 ] || whole=(-DCMAKE_INTERPROCEDURAL_OPTIMIZATION=ON
        -DCMAKE_EXE_LINKER_FLAGS="-flto=auto -Wodr -Werror=odr -Werror=lto-type-mismatch")
    compiled "$compiler" -DCMAKE_CXX_COMPILER="${compiler%-*}" -DCMAKE_BUILD_TYPE=None \
        -DCMAKE_CXX_FLAGS="-${compiler##*-} -DNDEBUG" "${whole[@]}"
    same "$compiler" tests/bytes.sh "$(nproc)" "$build/$compiler/bin/sikku"
done

# With the libraries of Debian 12 for these machines.
libraries=(libc6-dev libstdc++-12-dev libtbb-dev libfmt-dev zlib1g-dev libpugixml-dev libboost-dev libglm-dev
    libcli11-dev libtomlplusplus-dev nlohmann-json3-dev)
cross() {
    local machine=$1 architecture=$2
    local root=$build/root-$architecture
    architecture=$architecture kept_root bookworm "$root" extract "${libraries[@]}"
    compiled "$architecture" -DCMAKE_TOOLCHAIN_FILE="$here/cross.cmake" -DMACHINE="$machine" -DROOT="$root" \
        -DCMAKE_BUILD_TYPE=Release
}
cross i686-linux-gnu i386
loader=("$build/root-i386/lib/ld-linux.so.2")
# Some kernels run no 32-bit programs.
"${loader[@]}" --version > /dev/null 2>&1 || loader=(qemu-i386-static "${loader[@]}")
same "i386" tests/bytes.sh "$(nproc)" env SIKKU_DATA="$build/i386/share/sikku" "${loader[@]}" \
    --library-path "$build/root-i386/usr/lib/i386-linux-gnu:$build/root-i386/lib/i386-linux-gnu" "$build/i386/bin/sikku"
cross aarch64-linux-gnu arm64
same "arm64 (qemu-user)" tests/bytes.sh "$(nproc)" qemu-aarch64-static -L "$build/root-arm64" "$build/arm64/bin/sikku"

# Debian 13, with its own compiler and libraries.
root=$PWD/build/debian13
if [ -x "$root/sikku/build/dev/bin/sikku" ]; then
    same "Debian 13 (g++ 14)" in_root "$root" /sikku/tests/bytes.sh "$(nproc)" /sikku/build/dev/bin/sikku
else
    echo "skipped: Debian 13 (tests/release/debian13.sh builds it)"
fi
