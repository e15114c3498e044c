#!/usr/bin/env bash
# Makes sikku-VERSION-linux-x86_64.tar.gz of a build: the program with everything but the C library inside, to be unpacked
# anywhere. Its OpenImageIO is a slim one, without HEIF.
# usage: packaging/portable.sh BUILD_FOLDER STUDIO_PAGE OUTPUT_FOLDER
set -euo pipefail
[ $# -eq 3 ] || { echo "usage: packaging/portable.sh BUILD_FOLDER STUDIO_PAGE OUTPUT_FOLDER" >&2; exit 2; }
build=$(realpath "$1") page=$(realpath "$2")
mkdir -p "$3"
output=$(realpath "$3")
cd "$(dirname "$0")/.."
slim=$PWD/build/slim-openimageio
packaging/slim_openimageio.sh "$slim"
# The same sources as in the build, against the slim library.
pictures=$PWD/build/portable
cmake --preset release -B "$pictures" -DSIKKU_TESTS=OFF -DSIKKU_PROGRAM=OFF -DSIKKU_FONTS=OFF -DCMAKE_PREFIX_PATH="$slim" -DCMAKE_SKIP_RPATH=ON \
    > build/portable.log 2>&1 || { cat build/portable.log >&2; exit 1; }
cmake --build "$pictures" -j "$(nproc)" --target sikku_image sikku_decoder > build/portable.log 2>&1 ||
    { tail -n 40 build/portable.log >&2; exit 1; }

version=$(packaging/version.sh)
name=sikku-$version-linux-$(uname -m)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
staged=$work/$name
cmake --install "$build" --strip --prefix "$staged" > /dev/null
rm -rf "$staged/include" "$staged"/lib*/*.a "$staged"/lib*/cmake "$staged"/lib*/pkgconfig
modules=$(dirname "$(find "$staged" -name sikku_image.so)")
rm "$modules/sikku_heif_decoder"
for file in sikku_image.so sikku_decoder; do
    install -s -m 755 "$(find "$pictures" -path "*/sikku/$file")" "$modules/$file"
done
SIKKU_INSTEAD=$slim/lib packaging/bundle.sh "$modules/libraries" "$staged/bin/sikku" "$modules/sikku_image.so" \
    "$modules/sikku_font.so" "$modules/sikku_decoder" > "$work/libraries"
cp "$page" "$staged/share/sikku"
licences=$staged/share/doc/sikku/licences
mkdir -p "$licences"
packaging/licences.py program "$licences" "$work/libraries" "$slim"
{
    echo "Sikku $version, for x86-64 with glibc 2.36 or newer (Debian 12, Ubuntu 24.04). Unpack it anywhere and run bin/sikku."
    echo "This copy reads photographs in JPEG, PNG, TIFF and WebP, but not in HEIF."
    echo
    echo "The licences and versions of the bundled libraries are in share/doc/sikku/licences. libjbig is under the GPL, version 2"
    echo "or later: if you redistribute this archive, do so under the terms of the GPL, version 3. The sources are the Debian"
    echo "packages with these names and versions, at https://snapshot.debian.org. OpenImageIO was built from the source package"
    echo "of Debian 13, with few formats, by packaging/slim_openimageio.sh of Sikku."
} > "$staged/INSTALL"
packaging/archive.sh "$work" "$name" "$output/$name.tar.gz"
