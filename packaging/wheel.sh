#!/usr/bin/env bash
# Makes a wheel for Linux from a build with the Python module. Libraries are inside, except those of OpenImageIO, which
# has to be Debian 12's: without it the module makes every output but TIFF, JPEG and EXR.
# usage: packaging/wheel.sh BUILD_FOLDER OUTPUT_FOLDER
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: packaging/wheel.sh BUILD_FOLDER OUTPUT_FOLDER" >&2; exit 2; }
SIKKU_BUILD=$(realpath "$1")
export SIKKU_BUILD
mkdir -p "$2"
output=$(realpath "$2")
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 -m pip wheel -q --no-build-isolation --no-deps --no-index -w "$work" ./python > "$work/log" 2>&1 ||
    { tail -n 40 "$work/log" >&2; exit 1; }
/usr/bin/python3 -m wheel unpack -d "$work" "$work"/*.whl > /dev/null
rm "$work"/*.whl
package=$(echo "$work"/sikku-*)
modules=$package/sikku/lib
SIKKU_LEFT='libstdc\+\+|libgcc_s' packaging/bundle.sh "$modules/libraries" "$modules"/_core.*.so > "$work/libraries"
# Rename the libraries: a process loads only one library of each name, and other modules may bring other versions.
for library in "$modules"/libraries/*; do
    name=$(basename "$library")
    patchelf --set-soname "sikku-$name" "$library"
    mv "$library" "$modules/libraries/sikku-$name"
    patchelf --replace-needed "$name" "sikku-$name" "$modules"/libraries/* "$modules"/_core.*.so
done
about=$(echo "$package"/sikku-*.dist-info)
cp LICENSE "$about"
packaging/licences.py module "$about/licences" "$work/libraries"
chmod -R u=rwX,go=rX "$package"
chmod 755 "$modules"/sikku/*  # `wheel unpack` loses modes
# pip refuses the wheel where the C library is older than that of the build.
glibc=$(getconf GNU_LIBC_VERSION)
glibc=${glibc#glibc }
sed -i "s/-linux_\([a-z0-9_]*\)$/-manylinux_${glibc/./_}_\1/" "$about/WHEEL"
find "$package" -exec touch -d "@${SOURCE_DATE_EPOCH:-315532800}" {} +
/usr/bin/python3 -m wheel pack -d "$output" "$package" > /dev/null
