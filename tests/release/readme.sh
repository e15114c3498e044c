#!/usr/bin/env bash
# Prints the examples of README that use the program as a script: files that it shows are written, live music is left out.
# usage: tests/release/readme.sh README.md
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/release/readme.sh README.md" >&2; exit 2; }
awk '
    /^Write this into|Write this into/ { match($0, /`[^`]*`/); file = substr($0, RSTART + 1, RLENGTH - 2) }
    /^    / {
        line = substr($0, 5)
        if (line ~ /^sikku / && line !~ /--port/) { if (open) { print "END"; open = 0 }; print line }
        else if (file && !open && line ~ /^[a-z ]*:/) { print "cat > " file " <<\"END\""; open = 1; file = "" ; print line }
        else if (open) print line
        next
    }
    open && !/^$/ { print "END"; open = 0 }' "$1"
