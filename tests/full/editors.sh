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
    # The lines of the manual, exactly: those for Neovim 0.8 or newer, then those for 0.7.
    block=1
    [[ $(nvim --version) != "NVIM v0.7."* ]] || block=2
    mkdir -p "$folder/config/nvim" "$folder/bin"
    awk -v wanted=$block '/^In Neovim/ { ++count } /^#/ { count = 0 } count == wanted && sub(/^    /, "")' \
        "$root/docs/editors.md" > "$folder/config/nvim/init.lua"
    ln -s "$program" "$folder/bin/sikku"
    printf 'axiom: F\nangel factor: 4\n' > "$folder/wrong.lsys"
    HOME=$folder/home XDG_CONFIG_HOME=$folder/config PATH=$folder/bin:$PATH timeout 60 nvim --headless "$folder/wrong.lsys" -c "lua
        local seen = vim.wait(10000, function() return #vim.diagnostic.get(0) == 1 end, 10)
        io.stdout:write(seen and vim.diagnostic.get(0)[1].message or vim.inspect(vim.diagnostic.get(0)), '\n')
        vim.cmd(seen and 'qall!' or 'cquit 1')" > "$folder/log" 2>&1 ||
        { cat "$folder/log"; echo "the lines of docs/editors.md do not start the server in Neovim" >&2; exit 1; }
    grep -q "did you mean 'angle factor'" "$folder/log" || { cat "$folder/log"; exit 1; }
    echo "$(nvim --version | head -n 1): the lines of docs/editors.md report errors"
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
