#!/usr/bin/env bash
# Packs the extension for VS Code: OUTPUT_FOLDER/sikku-VERSION.vsix. Needs npm, which downloads the packages
# of packaging/editors/vscode/package-lock.json. With SOURCE_DATE_EPOCH the same commit gives the same bytes.
# usage: packaging/editors/vscode.sh OUTPUT_FOLDER
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: packaging/editors/vscode.sh OUTPUT_FOLDER" >&2; exit 2; }
mkdir -p "$1"
output=$(realpath "$1")
cd "$(dirname "$0")"
version=$(../version.sh)
umask 022
export TZ=UTC
grep -q "^  \"version\": \"$version\",$" vscode/package.json ||
    { echo "packaging/editors/vscode/package.json: expected version $version" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/vscode"
cp -r vscode/. "$work/vscode"
rm -rf "$work/vscode/node_modules" "$work/vscode/dist"
cp ../../LICENSE "$work/vscode/LICENSE"
chmod -R u=rwX,go=rX "$work/vscode" # whatever the umask of the checkout
cd "$work/vscode"
npm ci --silent --no-audit --no-fund > ../log 2>&1 || { tail -n 20 ../log >&2; exit 1; }
npm run --silent package -- --out "$output" > ../log 2>&1 || { tail -n 20 ../log >&2; exit 1; }
echo "$output/sikku-$version.vsix"
