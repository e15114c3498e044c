#!/usr/bin/env bash
# Examines the extension for VS Code of a release, and starts the program with it.
# usage: tests/release/vscode.sh DIST PROGRAM
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: tests/release/vscode.sh DIST PROGRAM" >&2; exit 2; }
here=$(dirname "$(readlink -f "$0")")
dist=$(realpath "$1") program=$(realpath "$2")
archive=$(find "$dist" -name 'sikku-*.vsix')
size=$(stat -c %s "$archive")
[ "$size" -le 150000 ] || { echo "the extension has $size bytes; at most 150,000 are wanted" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
diff - <(zipinfo -1 "$archive" | LC_ALL=C sort) <<'END' || { echo "the extension contains other files" >&2; exit 1; }
[Content_Types].xml
extension.vsixmanifest
extension/LICENSE.txt
extension/dist/NOTICES.txt
extension/dist/extension.js
extension/language-configuration.json
extension/package.json
extension/readme.md
extension/syntaxes/sikku.tmLanguage.json
END
unzip -q "$archive" -d "$work"
cmp "$work/extension/syntaxes/sikku.tmLanguage.json" <("$program" lsp --grammar textmate)
node "$here/../full/extension.mjs" "$work/extension" "$program" "$here/../../patterns/curves/hilbert.lsys"
echo "extension for VS Code: $size bytes"
