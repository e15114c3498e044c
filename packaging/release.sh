#!/usr/bin/env bash
# Builds everything that a release consists of: Debian packages, an archive to unpack anywhere, the source distribution
# and the wheel for Python, the npm package, the page of the studio, the extension for VS Code; the list of what they
# contain (SPDX) and SHA256SUMS.
# The same commit, Debian packages and npm give the same bytes in any folder at any time.
# Everything is built from scratch, except the slim OpenImageIO if it is up to date.
# usage: packaging/release.sh [OUTPUT_FOLDER]
set -euo pipefail
[ $# -le 1 ] || { echo "usage: packaging/release.sh [OUTPUT_FOLDER]" >&2; exit 2; }
output=$(realpath -m "${1:-$(dirname "$0")/../dist}")
cd "$(dirname "$0")/.."
. tests/packages.sh
install_packages "${build_packages[@]}" "${studio_packages[@]}" "${release_packages[@]}"
umask 022
export LC_ALL=C.UTF-8 TZ=UTC
if [ -n "$(git status --porcelain)" ]; then
    echo "warning: there are changes that are not committed" >&2
fi
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
for file in "$output"/* "$output"/.[!.]*; do
    if [ -e "$file" ] && [ "$(basename "$file")" != SHA256SUMS ] &&
        ! grep -q -s "  $(basename "$file")\$" "$output/SHA256SUMS"; then
        echo "$output contains $(basename "$file"), which this script did not make; move it or choose another folder" >&2
        exit 1
    fi
done
mkdir -p "$(dirname "$output")" build
made=$(mktemp -d "$output.XXXXXX")
trap 'rm -rf "$made" "$made.sums"' EXIT
rm -rf build/dist build/portable build/studio build/npm

studio/build.sh
page=build/studio/sikku-studio.html
(cd studio && node npm/build.mjs --output "$made")
# Harden the programs, which read untrusted files, and keep the path of this folder out of them.
export CXXFLAGS="-ffile-prefix-map=$PWD=. -fstack-protector-strong -D_FORTIFY_SOURCE=2" LDFLAGS="-Wl,-z,relro -Wl,-z,now"
build=build/dist
cmake --preset release -B "$build" -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_INSTALL_LIBDIR=lib -DSIKKU_PYTHON=ON \
    -DPython_EXECUTABLE=/usr/bin/python3 -DSIKKU_TESTS=OFF > build/dist.log 2>&1 || { cat build/dist.log >&2; exit 1; }
cmake --build "$build" -j "$(nproc)"
packaging/deb.sh "$build" "$page" "$made"
packaging/portable.sh "$build" "$page" "$made"
packaging/wheel.sh "$build" "$made"
packaging/sdist.sh "$made"
packaging/editors/vscode.sh "$made"
version=$(packaging/version.sh)
cp "$page" "$made/sikku-studio-$version.html"
packaging/sbom.py "$made" "$build"
(cd "$made" && sha256sum -- *) > "$made.sums"
mv "$made.sums" "$made/SHA256SUMS"
chmod 755 "$made"
rm -rf "$output"
mv "$made" "$output"
cat "$output/SHA256SUMS"
