#!/usr/bin/env bash
# Scores with repeat signs, of bundled pieces and 40 random forms: MuseScore, abc2midi and LilyPond play the notes that
# they play without the signs.
# usage: tests/full/repeats.sh PROGRAM
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/full/repeats.sh PROGRAM" >&2; exit 2; }
program=$(realpath "$1")
here=$(realpath "$(dirname "$0")")
skip() { echo "skipped: repeat signs in other programs ($1)"; exit 0; }
musescore=$(command -v musescore3 || command -v mscore) || skip "MuseScore is not installed"
for tool in abc2midi lilypond; do command -v "$tool" > /dev/null || skip "$tool is not installed"; done
# Only the Python of Debian finds the mido package of Debian.
python=
for candidate in python3 /usr/bin/python3; do
    if "$candidate" -c 'import mido' 2> /dev/null; then python=$candidate; break; fi
done
[ -n "$python" ] || skip "python3-mido is not installed"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$python" "$here/repeats.py" make "$program" "$folder" 40
QT_QPA_PLATFORM=offscreen timeout 1200 "$musescore" -j jobs.json > log 2>&1 || { tail log; exit 1; }
# abc2midi lengthens bars with fermatas, also in scores without signs.
for score in *.signs.abc; do
    for one in "$score" "${score%.signs.abc}.plain.abc"; do
        abc2midi "$one" -o "${one%.abc}.abc.mid" > "$one.log" 2>&1 || { cat "$one.log"; exit 1; }
        grep -iE '^(error|warning)' "$one.log" | grep -vE ' ignored$|without lyrics' > "$one.warnings" || true
    done
    [ "$(wc -l < "$score.warnings")" -le "$(wc -l < "${score%.signs.abc}.plain.abc.warnings")" ] ||
        { cat "$score.warnings"; echo "abc2midi warns about sikku $(cat "${score%.signs.abc}.txt")"; exit 1; }
done
for score in *.ly; do
    lilypond --loglevel=WARNING -o "${score%.ly}.lilypond" "$score" > log 2>&1 || { cat log; exit 1; }
    # Messages about full pages do not concern repeat signs.
    ! grep -vE 'compress' log || { echo "LilyPond warns about $score"; exit 1; }
done
"$python" "$here/repeats.py" compare "$folder"
