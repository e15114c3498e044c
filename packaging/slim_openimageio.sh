#!/usr/bin/env bash
# Builds OpenImageIO as Debian 13 distributes it, with PNG, TIFF, JPEG, EXR, WebP and BMP only, and installs it in FOLDER.
# That of Debian 12 has all formats, and pulls in 259 libraries.
# usage: packaging/slim_openimageio.sh FOLDER
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: packaging/slim_openimageio.sh FOLDER" >&2; exit 2; }
version=2.5.18.0+dfsg
archive=http://deb.debian.org/debian/pool/main/o/openimageio/openimageio_$version.orig.tar.xz
# As Debian signed it: Checksums-Sha256 in the index of sources.
sha256=0dc2185aac5e01a2e5a1a804f558c1190ea048650a7fedef1033a1616abcac80
mkdir -p "$1"
folder=$(realpath "$1")
# This script and the packages from which it is made.
key=$({ cat "$0"; dpkg-query -W '*-dev' g++-12 2> /dev/null; echo "${CXXFLAGS:-} ${LDFLAGS:-}"; } | sha256sum)
[ "$(cat "$folder/key" 2> /dev/null)" != "$key" ] || exit 0
rm -rf "$folder"
mkdir -p "$folder"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
/usr/lib/apt/apt-helper download-file "$archive" source.tar.xz "SHA256:$sha256" > log 2>&1 || { cat log >&2; exit 1; }
mkdir source
tar -xf source.tar.xz -C source --strip-components=1

formats=() packages=()
for format in cineon dds dicom dpx ffmpeg fits gif heif hdr ico iff jpeg2000 null openvdb pnm psd ptex raw rla sgi \
    softimage targa term zfile; do
    formats+=("-DENABLE_$format=OFF")
done
for package in Python OpenCV FFmpeg GIF Libheif LibRaw OpenJPEG OpenVDB Ptex OpenColorIO Freetype Nuke QT DCMTK TBB BZip2 \
    R3DSDK; do
    packages+=("-DUSE_${package^^}=OFF" "-DUSE_$package=OFF")
done
# Without a build ID, a hash that also covers symbols, some of which are named after the folder.
cmake -S source -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$folder" \
    -DCMAKE_CXX_FLAGS="${CXXFLAGS:-} -ffile-prefix-map=$work=." \
    -DCMAKE_SHARED_LINKER_FLAGS="${LDFLAGS:-} -Wl,--build-id=none" -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_CXX_FLAGS_RELEASE="-O2 -DNDEBUG" -DEMBEDPLUGINS=ON \
    -DOIIO_BUILD_TOOLS=OFF -DOIIO_BUILD_TESTS=OFF -DBUILD_DOCS=OFF -DINSTALL_DOCS=OFF -DINSTALL_FONTS=OFF \
    -DCMAKE_SKIP_RPATH=ON -DSTOP_ON_WARNING=OFF -DCMAKE_CXX_STANDARD=17 -DBUILD_MISSING_ROBINMAP=OFF -DBUILD_MISSING_FMT=OFF \
    "${formats[@]}" "${packages[@]}" > log 2>&1 || { tail -n 40 log >&2; exit 1; }
cmake --build build -j "$(nproc)" > log 2>&1 || { tail -n 40 log >&2; exit 1; }
cmake --install build > /dev/null
cp source/LICENSE.md source/THIRD-PARTY.md "$folder"
echo "$version" > "$folder/version"
echo "$key" > "$folder/key"
