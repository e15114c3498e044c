#!/usr/bin/env bash
# Makes the Debian packages, the wheel and the source distribution of a build, and compares what they contain with
# tests/release/lists.txt. SIKKU_WRITE_LISTS=1 writes the file instead.
# usage: tests/release/lists.sh BUILD_FOLDER
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/release/lists.sh BUILD_FOLDER" >&2; exit 2; }
build=$(realpath "$1")
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
version=$(packaging/version.sh)
# The studio's page takes minutes to build, and has tests of its own.
echo '<!DOCTYPE html><title>Sikku</title>' > "$work/sikku-studio.html"
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2> /dev/null || echo 315532800)
export SOURCE_DATE_EPOCH
# Uncompressed, to save time; only the lists of files matter here.
DPKG_DEB_COMPRESSOR_TYPE=none packaging/deb.sh "$build" "$work/sikku-studio.html" "$work"
packaging/wheel.sh "$build" "$work"
packaging/sdist.sh "$work"

contents() {
    case $1 in
        *.deb) dpkg-deb --fsys-tarfile "$1" | tar -tvf - ;;
        *.whl) zipinfo "$1" | grep '^[-?]' ;;
        *) tar -tvzf "$1" ;;
    esac
}
# Patterns take one line per kind, sources and headers one per folder; libraries are listed without their versions, which
# depend on the system.
lists() {
    local artefact
    for artefact in "$work"/*.deb "$work"/*.whl "$work"/*.tar.gz; do
        basename "$artefact"
        contents "$artefact" | grep -v '/$' | sed -E '/->/s/ -> .*/ (link)/; /^...x/s/$/ (executable)/
            s:^.* [0-9][0-9]\:[0-9][0-9](\:[0-9][0-9])? ::; s:(patterns/[^/]*)/.*:\1/*:
            s:/(include|source|tests)/.*:/\1/*:; s:^\./::; s:(libraries/[^.]*)\.so[.0-9]*:\1.so:' | LC_ALL=C sort -u | sed 's/^/    /'
    done | sed "s/$version/VERSION/g"
}
lists > "$work/lists"
if [ -n "${SIKKU_WRITE_LISTS:-}" ]; then
    cp "$work/lists" tests/release/lists.txt
else
    diff tests/release/lists.txt "$work/lists" || { echo "the contents of the packages differ from tests/release/lists.txt; SIKKU_WRITE_LISTS=1 updates it" >&2; exit 1; }
    echo "Debian packages, wheel and source distribution contain the files that they should"
fi
