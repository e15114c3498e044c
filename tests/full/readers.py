"""Random scores as MusicXML, and whether MuseScore and Verovio read in them what is written.

usage: readers.py make PROGRAM FOLDER COUNT; readers.py compare FOLDER COUNT
"""

from __future__ import annotations

import json
import pathlib
import random
import subprocess
import sys
import xml.etree.ElementTree
from collections import Counter
from fractions import Fraction
from typing import Any

PIECES = ["hilbert", "peano", "dragon", "quadratic-gosper", "arrowhead", "snowflake", "hilbert-in-c"]
PIECES += ["hilbert-chorale", "hilbert-kalyani", "dragon-twelve-bars", "gosper-whole-tone", "hilbert-todi"]
CHOICES = {
    "scale": ["major", "minor", "dorian", "harmonic minor", "blues", "mohanam", "mela 65", "whole tone", "chromatic"],
    "tonic": ["C4", "Eb4", "F#3", "A4", "Db4", "B3", "G5"],
    "unit": ["1/8", "1/16", "1/4", "1/12", "3/16", "1/20"],
    "meter": ["4/4", "3/4", "6/8", "7/8", "5/4", "2+2+3/8", "9/8"],
    "instrument": ["flute", "clarinet", "violin", "church organ", "harpsichord", "cello", "tenor sax", "piano"],
    "rhythm": ["x..x..x.", "E(5,8)", "x.x.~x.x", "adi", "x.x.x.~~ / X..x", "(x.o.)3 x?x?60Xx", "xo.x / X..o by level"],
    "harmony": ["drone", "triads", "progression I-vi-ii-V7", "progression C-Am7-F/A-Gsus4"],
    "accompaniment": ["oom-pah on piano", "arpeggio on harp", "alberti on piano", "strum on nylon guitar"],
    "canon": ["1 -12", "2 fifth below, 1 octave below"],
    "vertical": ["rest", "extend", "voice"],
    "velocity": ["by y 20-120", "by turn"],
    "phrases": ["2"],
    "articulation": ["detached"],
    "range": ["reflect C3-C6", "fold C2-C7"],
    "leaps": ["7"],
    "form": ["A B A", "A A+2 Ai", "B2 Ar A*2"],
    "breath": ["1/8 by level", "bar"],
    "climax": ["0.6"],
    "tempo": ["84 Andante con moto", "Allegro"],
    "upbeat": ["1/8", "1/4", "3/16", "5/8"],
}
FLAGS = {"syllables": ["degrees", "sargam"], "score": ["concert"]}


def make(program: str, folder: pathlib.Path, count: int) -> None:
    chance = random.Random(300)
    jobs = []
    number = tries = 0
    while number < count:
        tries += 1
        assert tries < 20 * count, "hardly any score can be made"
        arguments = ["play", chance.choice(PIECES), "--bars", str(chance.randrange(2, 9))]
        for name, values in CHOICES.items():
            if chance.random() < 0.3:
                arguments.append(f"--{name}={chance.choice(values)}")
        for name, values in FLAGS.items():
            if chance.random() < 0.3:
                arguments.append(f"--{name}={chance.choice(values)}")
        if chance.random() < 0.5:
            arguments.append("--chord-symbols")
        file = folder / f"{number}.musicxml"
        made = subprocess.run([program, "--quiet", *arguments, "-o", file], capture_output=True, check=False)
        # Some keys exclude each other.
        assert made.returncode in (0, 1, 2), (arguments, made)
        if made.returncode != 0:
            continue
        (folder / f"{number}.txt").write_text(" ".join(arguments))
        jobs.append({"in": str(file), "out": str(folder / f"{number}.read.musicxml")})
        number += 1
    (folder / "jobs.json").write_text(json.dumps(jobs))


def notes_of(file: pathlib.Path) -> Counter[Any]:
    """(onset in quarters, letter, alteration, octave) of every note that is struck."""
    found: Counter[Any] = Counter()
    for part in xml.etree.ElementTree.parse(file).iter("part"):
        divisions, begin = 1, Fraction(0)
        for measure in part.iter("measure"):
            here = last = longest = Fraction(0)
            for item in measure:
                divisions = int(item.findtext("divisions") or divisions)
                length = Fraction(int(item.findtext("duration") or 0), divisions)
                if item.tag == "backup":
                    here -= length
                elif item.tag == "forward":
                    here += length
                elif item.tag == "note" and item.find("grace") is None:
                    if item.find("chord") is None:
                        last = here
                        here += length
                    if item.find("pitch") is not None and item.find("tie[@type='stop']") is None:
                        alter = float(item.findtext("pitch/alter") or 0)
                        found[(begin + last, item.findtext("pitch/step"), alter, item.findtext("pitch/octave"))] += 1
                longest = max(longest, here)
            begin += longest
    return found


def has_silent_bar(file: pathlib.Path) -> bool:
    """True if no part sounds in some bar."""
    parts = [list(part.iter("measure")) for part in xml.etree.ElementTree.parse(file).iter("part")]
    return any(all(measure.find("note/pitch") is None for measure in bar) for bar in zip(*parts))


def has_crossing_beam(file: pathlib.Path) -> bool:
    """True if a beam leads over the border of a tuplet."""
    for note in xml.etree.ElementTree.parse(file).iter("note"):
        beam = note.findtext("beam[@number='1']")
        ends = note.find("notations/tuplet[@type='stop']") is not None and beam in ("begin", "continue")
        begins = note.find("notations/tuplet[@type='start']") is not None and beam in ("continue", "end")
        if ends or begins:
            return True
    return False


def compare(folder: pathlib.Path, count: int) -> None:
    notes = left_out = 0
    for number in range(count):
        ours = notes_of(folder / f"{number}.musicxml")
        what = (folder / f"{number}.txt").read_text()
        notes += sum(ours.values())
        theirs = notes_of(folder / f"{number}.read.musicxml")
        assert ours == theirs, f"MuseScore, sikku {what}: {list((ours - theirs).items())[:4]} became {list((theirs - ours).items())[:4]}"
        # In additive meters, Verovio gives no time to rests of a whole bar; it misreads beams that cross tuplets.
        own = folder / f"{number}.musicxml"
        is_additive = "+" in what.partition("--meter=")[2].partition(" ")[0]
        if (is_additive and has_silent_bar(own)) or has_crossing_beam(own):
            left_out += 1
            continue
        verovio: Counter[Any] = Counter()
        for onset, step, alter, octave in json.loads((folder / f"{number}.verovio.json").read_text()):
            # Verovio counts in binary fractions.
            verovio[(Fraction(onset).limit_denominator(240), step, alter, octave)] += 1
        assert ours == verovio, f"Verovio, sikku {what}: {list((ours - verovio).items())[:4]} became {list((verovio - ours).items())[:4]}"
    assert 4 * left_out < count, f"{left_out} scores are left out for Verovio"
    print(f"readers: MuseScore and Verovio read the onset, letter, sign and octave of {notes} notes in {count} random scores ({left_out} of them without Verovio)")


if __name__ == "__main__":
    if sys.argv[1] == "make":
        make(sys.argv[2], pathlib.Path(sys.argv[3]), int(sys.argv[4]))
    else:
        compare(pathlib.Path(sys.argv[2]), int(sys.argv[3]))
