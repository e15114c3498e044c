#!/usr/bin/env bash
# Tests the language server in Neovim, the grammars for syntax highlighting in Neovim and in the libraries of VS Code,
# on all patterns, and the packed extension for VS Code.
# usage: tests/full/editors.sh PROGRAM
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/full/editors.sh PROGRAM" >&2; exit 2; }
program=$(realpath "$1")
root=$(realpath "$(dirname "$0")/../..")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
find "$root/patterns" -name '*.lsys' | LC_ALL=C sort > "$folder/patterns"

if command -v nvim > /dev/null; then
    mkdir "$folder/home"
    HOME=$folder/home FOLDER=$folder PATTERNS=$folder/patterns SIKKU=$program timeout 600 \
        nvim --headless --clean --cmd "set runtimepath^=$root/packaging/editors/vim" \
        -c "luafile $root/tests/full/editors.lua"
else
    echo "skipped: the language server in Neovim (it is not installed)"
fi

if ! command -v npm > /dev/null; then
    echo "skipped: the extension for VS Code and its grammar (npm is not installed)"
    exit
fi
mkdir "$folder/vscode"
cp "$root"/packaging/editors/vscode/package*.json "$folder/vscode"
if ! (cd "$folder/vscode" && npm ci --silent --no-audit --no-fund) > "$folder/log" 2>&1; then
    echo "skipped: the extension for VS Code and its grammar (npm cannot install packages: $(tail -n 1 "$folder/log"))"
    exit
fi
mapfile -t patterns < "$folder/patterns"
node "$root/tests/full/grammar.mjs" "$folder/vscode" "$program" \
    "$root/packaging/editors/vscode/syntaxes/sikku.tmLanguage.json" "${patterns[@]}" "$root"/tests/corpus/good/*.lsys
# The packed extension starts the server; a stub replaces VS Code.
"$root/packaging/editors/vscode.sh" "$folder/out"
(cd "$folder" && unzip -q out/*.vsix -d extension)
node "$root/tests/full/extension.mjs" "$folder/extension/extension" "$program" "${patterns[0]}"
