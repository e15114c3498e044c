#!/usr/bin/env bash
# Makes Debian packages of a build with the Python module, and of the studio's page.
# usage: packaging/deb.sh BUILD_FOLDER STUDIO_PAGE OUTPUT_FOLDER
set -euo pipefail
[ $# -eq 3 ] || { echo "usage: packaging/deb.sh BUILD_FOLDER STUDIO_PAGE OUTPUT_FOLDER" >&2; exit 2; }
SIKKU_BUILD=$(realpath "$1") SIKKU_STUDIO=$(realpath "$2")
SIKKU_PACKAGING=$(realpath "$(dirname "$0")")
export SIKKU_BUILD SIKKU_STUDIO SIKKU_PACKAGING
mkdir -p "$3"
output=$(realpath "$3")
cd "$(dirname "$0")/.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/sikku"
cp -r packaging/debian python "$folder/sikku"
cd "$folder/sikku"
SOURCE_DATE_EPOCH=$(dpkg-parsechangelog -S Timestamp)
export SOURCE_DATE_EPOCH DEB_BUILD_OPTIONS=noautodbgsym
dpkg-buildpackage -b -us -uc -d > "$folder/log" 2>&1 || { tail -n 40 "$folder/log"; exit 1; }
cp ../*.deb "$output"
