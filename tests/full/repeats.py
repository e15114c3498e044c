"""Makes random forms with repeat signs, and compares the notes that other programs play with the signs, those that they
play without the signs, and those of the MIDI files of Sikku.

usage: repeats.py make PROGRAM FOLDER COUNT; repeats.py compare FOLDER
"""

from __future__ import annotations

import json
import pathlib
import random
import subprocess
import sys
from collections import Counter

PIECES = ["hilbert -n 5", "hilbert-in-c -n 4", "hilbert-in-c -n 5", "peano -n 3", "dragon -n 8"] * 2
PIECES += ["dragon-blues -n 7", "hilbert-chorale", "dragon-twelve-bars", "gosper-whole-tone", "peano-pentatonic -n 3", "hilbert-kalyani"]
FORMS = ["A A", "A A B A", "A1 A2 B A2", "A A B B", "A A A B", "A1 A1 A2", "A A A1 A2", "A A A A A", "A B A B C"]
FORMS += ["A1 B A2 B", "A B2 A B1", "A A+1 A A+1 B", "B A A Ak", "A A B B C C D D", "A1 A2 A1 A2 B B", "A B A B A C"]
CHOICES = {
    "scale": ["minor", "dorian", "blues", "mohanam", "chromatic"],
    "tonic": ["Eb4", "F#3", "A4", "G5"],
    "unit": ["1/8", "1/16", "1/4", "1/12"],
    "meter": ["3/4", "6/8", "7/8", "2+2+3/8"],
    "instrument": ["flute", "clarinet", "violin", "church organ", "harpsichord", "tenor sax", "piano"],
    "rhythm": ["x..x..x.", "E(5,8)", "adi", "X.x.x.~~", "xo.x"],
    "harmony": ["drone", "triads", "progression I-vi-ii-V7", "progression C-Am7-F/A-Gsus4"],
    "accompaniment": ["oom-pah on piano", "alberti on piano", "strum on nylon guitar", "walking bass"],
    "velocity": ["by y 20-120", "by turn", "by x", "by length"],
    "phrases": ["2", "3"],
    "breath": ["bar", "1/8", "none"],
    "articulation": ["detached"],
    "loop": ["2", "3"],
    "canon": ["1 -12", "2 fifth below"],
    "ending": ["ritardando", "fermata"],
    "vertical": ["glissando", "voice", "extend"],
    "gamaka": ["jaru 1", "kampita 2 6"],
    "cadence": ["tonic", "alternate"],
    "upbeat": ["1/8", "1/4", "3/16"],
    "from-bar": ["2", "5"],
}
FLAGS = ["chord-symbols", "grace-notes", "syllables=degrees"]
# Pieces and keys whose print has all notes of the MIDI file, and at their times.
EXACT = {"hilbert", "hilbert-in-c", "peano", "dragon", "peano-pentatonic", "canon", "fugue", "invention"}
INEXACT = {"vertical", "gamaka", "ending"}
BUNDLED = ["blues", "canon", "fugue", "gamelan", "invention", "mohanam", "raga", "rooms", "seven", "gosper-whole-tone"]
BUNDLED += ["hilbert-kalyani", "hilbert-todi", "peano-pentatonic", "snowflake-shruti", "tree-in-voices", "dragon-drums"]


def made(program: str, arguments: list[str], file: pathlib.Path) -> str | None:
    """The messages of the program when it makes a score; None if it refuses."""
    run = subprocess.run([program, *arguments, "-o", file], capture_output=True, text=True, check=False)
    # Some keys exclude each other.
    assert run.returncode in (0, 1, 2), (arguments, run)
    return run.stderr if run.returncode == 0 else None


def make(program: str, folder: pathlib.Path, count: int) -> None:
    chance = random.Random(400)
    scores: list[list[str]] = [["play", name] for name in BUNDLED] + [["play", name, "--loop=2"] for name in BUNDLED]
    jobs, names = [], []
    number = with_signs = tries = 0
    while scores or with_signs < count:
        tries += 1
        assert tries < 20 * count, "hardly any score has repeat signs"
        if scores:
            arguments = scores.pop()
        else:
            arguments = ["play", *chance.choice(PIECES).split(), f"--form={chance.choice(FORMS)}"]
            for name, values in CHOICES.items():
                if chance.random() < 0.15:
                    arguments.append(f"--{name}={chance.choice(values)}")
            arguments += [f"--{flag}" for flag in FLAGS if chance.random() < 0.3]
        said = made(program, [*arguments, "--repeats"], folder / f"{number}.signs.musicxml")
        if said is None or "printed as" not in said:
            continue
        is_random = len(arguments) > 3
        with_signs += is_random
        for kind in ("signs", "plain"):
            options = arguments + ["--repeats"] * (kind == "signs")
            for ending in ("musicxml", "abc"):
                assert made(program, options, folder / f"{number}.{kind}.{ending}") is not None
            file = folder / f"{number}.{kind}"
            jobs.append({"in": f"{file}.musicxml", "out": f"{file}.musescore.mid"})
        keys = {argument[2:].partition("=")[0] for argument in arguments[2:]}
        if arguments[1] in EXACT and not keys & INEXACT:
            assert made(program, arguments, folder / f"{number}.mid") is not None
        # LilyPond is slow.
        if number % 8 == 0:
            assert made(program, [*arguments, "--repeats"], folder / f"{number}.signs.ly") is not None
            assert made(program, arguments, folder / f"{number}.plain.ly") is not None
        (folder / f"{number}.txt").write_text(" ".join(arguments))
        names.append(number)
        number += 1
    (folder / "jobs.json").write_text(json.dumps(jobs))
    (folder / "names.json").write_text(json.dumps(names))


def notes_of(file: pathlib.Path) -> list[tuple[int, int, int]]:
    """(onset, key, end) of every note, in ticks of a 480th of a quarter."""
    import mido  # of Debian's Python alone

    song = mido.MidiFile(file)
    notes = []
    for track in song.tracks:
        now = 0
        sounding: dict[tuple[int, int], list[int]] = {}
        for message in track:
            now += message.time
            if message.type not in ("note_on", "note_off"):
                continue
            tick = round(now * 480 / song.ticks_per_beat)
            begun = sounding.setdefault((message.channel, message.note), [])
            if message.type == "note_on" and message.velocity > 0:
                begun.append(tick)
            elif begun:
                notes.append((begun.pop(0), message.note, tick))
    return notes


def starts(notes: list[tuple[int, int, int]]) -> Counter[tuple[int, int]]:
    return Counter((onset, key) for onset, key, _ in notes)


def expect_same(ours: list[tuple[int, int, int]], theirs: Counter[tuple[int, int]], what: str) -> None:
    # LilyPond counts 384 ticks a quarter, which fifths of a quarter do not divide.
    near = {(onset + d, key): (onset, key) for d in (2, -2, 1, -1, 0) for onset, key, _ in ours}
    extra = [note for note in theirs if note not in near]
    assert not extra, f"{what}: {sorted(extra)[:5]} are not in our MIDI file"
    # If two voices sound the same key, other programs play it once.
    for onset, key in starts(ours).keys() - {near[note] for note in theirs}:
        sounding = sum(begin <= onset <= end for begin, other, end in ours if other == key)
        assert sounding > 1, f"{what}: key {key} at {onset} is only in our MIDI file"


def compare(folder: pathlib.Path) -> None:
    total: Counter[str] = Counter()
    for number in json.loads((folder / "names.json").read_text()):
        what = (folder / f"{number}.txt").read_text()
        for reader in ("musescore.mid", "abc.mid", "lilypond.midi"):
            files = [folder / f"{number}.{kind}.{reader}" for kind in ("plain", "signs")]
            if reader == "lilypond.midi" and number % 8 != 0:
                continue
            plain, signs = (starts(notes_of(file)) for file in files)
            assert plain, f"{reader}, sikku {what}: no notes"
            assert plain == signs, f"{reader}, sikku {what}: {sorted(plain - signs)[:5]} became {sorted(signs - plain)[:5]}"
            own = folder / f"{number}.mid"
            if own.exists():
                expect_same(notes_of(own), signs, f"{reader}, sikku {what}")
                total["exact"] += 1
            total[reader] += sum(plain.values())
            total[f"{reader} scores"] += 1
    assert total["exact"] >= 30, "hardly any score is compared with our MIDI file"
    for reader in ("musescore.mid", "abc.mid", "lilypond.midi"):
        print(f"repeats: {reader.split('.')[0]} plays {total[reader]} notes of {total[f'{reader} scores']} scores alike with and without signs")
    print(f"repeats: {total['exact']} of them as in our MIDI files")


if __name__ == "__main__":
    if sys.argv[1] == "make":
        make(sys.argv[2], pathlib.Path(sys.argv[3]), int(sys.argv[4]))
    else:
        compare(pathlib.Path(sys.argv[2]))
