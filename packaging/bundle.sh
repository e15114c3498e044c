#!/usr/bin/env bash
# Copies the shared libraries that programs and modules need into FOLDER, and makes FILES find them there, relative to
# themselves. The C library is left to the machine, and so are libraries whose names match SIKKU_LEFT. Prints the path of
# each library that was copied. Libraries in SIKKU_INSTEAD take the place of those of the machine.
# usage: packaging/bundle.sh FOLDER FILE…
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: packaging/bundle.sh FOLDER FILE…" >&2; exit 2; }
mkdir -p "$1"
folder=$(realpath "$1")
shift
left="^(linux-vdso|ld-linux[^.]*|libc|libm|libdl|libpthread|librt${SIKKU_LEFT:+|$SIKKU_LEFT})\.so"
# RPATH instead of RUNPATH, so that LD_LIBRARY_PATH, as set on clusters, does not override it.
find_by() { patchelf --force-rpath --set-rpath "\$ORIGIN/$(realpath --relative-to "$(dirname "$1")" "$folder")" "$1"; }
for file in "$@"; do
    LD_LIBRARY_PATH=${SIKKU_INSTEAD:-} ldd "$file" | awk '$2 == "=>" { print $1, $3 }'
done | sort -u | while read -r name path; do
    [[ $name =~ $left ]] && continue
    [ "$path" != not ] || { echo "$name is not installed" >&2; exit 1; }
    install -m 644 "$path" "$folder/$name"
    strip --strip-unneeded "$folder/$name"
    find_by "$folder/$name"
    realpath "$path"
done
for file in "$@"; do find_by "$(realpath "$file")"; done
