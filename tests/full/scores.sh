#!/usr/bin/env bash
# What LilyPond, abc2midi and MuseScore make of our scores: their MIDI files have the onsets and keys of ours.
# usage: tests/full/scores.sh PROGRAM
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/full/scores.sh PROGRAM" >&2; exit 2; }
program=$(realpath "$1")
hostile=$(realpath "$(dirname "$0")/../corpus/good/hostile-title.lsys")

# mido of Debian is known to Debian's Python alone.
python=
for candidate in python3 /usr/bin/python3; do
    if "$candidate" -c 'import mido' 2> /dev/null; then python=$candidate; break; fi
done
[ -n "$python" ] || { echo "skipped: scores through LilyPond and MuseScore (python3-mido is not installed)"; exit 0; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat > same.py << 'END'
import sys
from collections import Counter

import mido


def notes_of(name):
    """(onset, end, key) of every note, in ticks of a 480th of a quarter."""
    song = mido.MidiFile(name)
    notes = []
    for track in song.tracks:
        now, sounding = 0, {}
        for message in track:
            now += message.time
            if message.type not in ("note_on", "note_off"):
                continue
            began = sounding.setdefault((message.channel, message.note), [])
            if message.type == "note_on" and message.velocity > 0:
                began.append(now)
            elif began:
                onset = began.pop(0)
                notes.append((round(onset * 480 / song.ticks_per_beat), round(now * 480 / song.ticks_per_beat),
                              message.note))
    return notes


ours, theirs = notes_of(sys.argv[1]), notes_of(sys.argv[2])
# LilyPond counts 384 ticks a quarter, which fifths of a quarter do not divide.
known = {(onset, key) for onset, end, key in ours}
near = lambda onset, key: next((onset + d for d in (0, 1, -1, 2, -2) if (onset + d, key) in known), onset)
theirs = [(near(onset, key), end, key) for onset, end, key in theirs]
assert ours, "no notes"
starts = lambda notes: Counter((onset, key) for onset, end, key in notes)
extra = starts(theirs) - starts(ours)
assert not extra, f"{sys.argv[2]} has (onset, key) that {sys.argv[1]} has not: {sorted(extra)[:10]}"
# Where two voices meet on one key, the voices of a staff share a channel, and one note is heard.
missing = starts(ours) - starts(theirs)
for onset, key in missing:
    there = sum(1 for begin, end, other in ours if other == key and begin <= onset <= end)
    assert there > 1, f"{sys.argv[2]} lacks key {key} at {onset}"
assert len(missing) < len(ours) / 4, f"{sys.argv[2]} lacks {len(missing)} of {len(ours)} notes"
shared = f", {sum(missing.values())} of them on a key that sounds already" if missing else ""
print(f"{sys.argv[2]}: {len(ours)} notes as in {sys.argv[1]}{shared}")
END

# Durations of five units, seven flats, a descent of its own, blues, voices from branches, tuplets, groups, a melody for
# two hands, two parts, upbeats.
scores=(hilbert peano keys bilahari blues voices parts triplets quintuplets sextuplets groups hands upbeat swung)
hilbert() { "$program" play hilbert -n 3 -o "$1"; }
peano() { "$program" play peano-pentatonic -n 3 --unit 1/16 --meter 7/8 -o "$1"; }
keys() { "$program" play hilbert-in-c -n 4 --tonic Cb4 --meter 5/8 -o "$1"; }
bilahari() { "$program" play sierpinski-bilahari -n 4 --meter 3/4 -o "$1"; }
blues() { "$program" play dragon-blues --swing 50 -o "$1"; }
voices() {
    "$program" play tree-in-voices -n 2 --brackets voices --form curve --rhythm curve --phrases none --canon none \
        --counterpoint free -o "$1"
}
triplets() { "$program" play hilbert-in-c -n 4 --unit 1/12 --meter 7/8 -o "$1"; }
quintuplets() { "$program" play hilbert-in-c -n 4 --unit 1/20 --meter 3/4 -o "$1"; }
sextuplets() { "$program" play hilbert-in-c -n 4 --unit 1/24 --meter 6/8 -o "$1"; }
groups() { "$program" play hilbert-todi --meter 3+2+2/8 -o "$1"; }
hands() { "$program" play hilbert -n 5 --range "fold C1-C8" --velocity "by length" -o "$1"; }
upbeat() { "$program" play hilbert-in-c -n 4 --upbeat 3/8 --meter 3/4 --harmony triads --phrases 2 --form "A B Ac" -o "$1"; }
swung() { "$program" play dragon-drums -n 7 --upbeat 1/4 -o "$1"; }
parts() { "$program" play hilbert-in-c peano-pentatonic -n 3 -o "$1"; }
for score in "${scores[@]}"; do
    for ending in mid musicxml ly; do "$score" "$score.$ending" > log 2>&1 || { cat log; exit 1; }; done
done

if command -v lilypond > /dev/null; then
    for score in "${scores[@]}"; do
        lilypond --loglevel=WARNING -o "$score-lilypond" "$score.ly" > log 2>&1 || { cat log; exit 1; }
        [ ! -s log ] || { cat log; echo "LilyPond warns about $score.ly"; exit 1; }
        [ -s "$score-lilypond.pdf" ] || { echo "LilyPond made no print of $score.ly"; exit 1; }
        "$python" same.py "$score.mid" "$score-lilypond.midi"
    done
    # Neither does a title make it do anything else, nor end.
    "$program" --quiet play "$hostile" -o hostile.ly
    lilypond --loglevel=WARNING -o hostile-lilypond hostile.ly > log 2>&1 || { cat log; echo "LilyPond fails on a title"; exit 1; }
    [ -s hostile-lilypond.pdf ] && [ ! -e PWNED ] || { echo "LilyPond obeys a title"; exit 1; }
else
    echo "skipped: scores through LilyPond (it is not installed)"
fi

if command -v abc2midi > /dev/null; then
    for score in "${scores[@]}"; do
        "$score" "$score.abc" > log 2>&1 || { cat log; exit 1; }
        abc2midi "$score.abc" -o "$score-abc.mid" > log 2>&1 || { cat log; exit 1; }
        "$python" same.py "$score.mid" "$score-abc.mid"
    done
else
    echo "skipped: scores through abc2midi (abcmidi is not installed)"
fi

if command -v mscore3 > /dev/null; then
    for score in "${scores[@]}"; do
        QT_QPA_PLATFORM=offscreen mscore3 -o "$score-musescore.mid" "$score.musicxml" > log 2>&1 || { cat log; exit 1; }
        "$python" same.py "$score.mid" "$score-musescore.mid"
    done
else
    echo "skipped: scores through MuseScore (musescore3 is not installed)"
fi
