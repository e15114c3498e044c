"""Parts of players, names of chords, degrees and slurs in print, read from MusicXML by Python's own parser."""

from __future__ import annotations

import pathlib
import re
import unicodedata
import xml.etree.ElementTree
from collections.abc import Iterator
from typing import Any

import pytest
import sikku

STEPS = {"C": 0, "D": 2, "E": 4, "F": 5, "G": 7, "A": 9, "B": 11}
pytestmark = pytest.mark.filterwarnings("ignore::sikku.SikkuWarning")


def saved(name: str, extension: str, folder: pathlib.Path) -> dict[str, str]:
    """The score of an arrangement and the parts beside it."""
    sikku.load_arrangement(name).save(folder / f"{name}.{extension}", parts=True)
    return {file.name: file.read_text() for file in folder.glob(f"{name}*.{extension}")}


def parts_of(score: str) -> list[Any]:
    return list(xml.etree.ElementTree.fromstring(score).iter("part"))


def key_of(note: Any) -> float | None:
    """The written MIDI key."""
    if note.find("pitch") is None:
        return None
    step, octave = note.findtext("pitch/step"), int(note.findtext("pitch/octave"))
    return 12 * (octave + 1) + STEPS[step] + float(note.findtext("pitch/alter") or 0)


def raised(part: Any) -> int:
    """Semitones by which a part is written higher than it sounds."""
    octaves = int(part.findtext("measure/attributes/transpose/octave-change") or 0)
    return -int(part.findtext("measure/attributes/transpose/chromatic") or 0) - 12 * octaves


def placed(part: Any) -> Iterator[tuple[int, float, Any]]:
    """The notes and rests of a part, each with its bar from 0 and its quarters within it."""
    divisions = int(part.findtext("measure/attributes/divisions"))
    for bar, measure in enumerate(part.iter("measure")):
        here = last = 0
        for item in measure:
            length = int(item.findtext("duration") or 0)
            if item.tag == "backup":
                here -= length
            elif item.tag == "forward":
                here += length
            elif item.tag == "note":
                if item.find("chord") is None:
                    last = here
                    here += length
                yield bar, last / divisions, item


def told(part: Any, has_cues: bool = False) -> list[Any]:
    """The notes and rests of a part, regardless of gathered rests."""
    return [
        (
            bar,
            at,
            key_of(note),
            note.findtext("unpitched/display-step"),
            note.findtext("duration"),
            note.findtext("type"),
            len(note.findall("dot")),
            note.findtext("accidental"),
            note.findtext("voice"),
            sorted((child.tag, child.get("type")) for child in note.iterfind("notations/*")),
        )
        for bar, at, note in placed(part)
        if (note.find("cue") is not None) == has_cues
    ]


@pytest.mark.parametrize("name", ["blues", "canon", "gamelan", "raga", "mohanam", "rooms", "seven"])
def test_parts_have_the_notes_of_the_score(name: str, tmp_path: pathlib.Path) -> None:
    files = saved(name, "musicxml", tmp_path)
    score = parts_of(files.pop(f"{name}.musicxml"))
    assert len(files) == len(score) > 1
    names = sorted(files, key=lambda file: int(re.search(r"-(\d+)-", file)[1]))
    for expected, file in zip(score, names):
        (part,) = parts_of(files[file])
        scale = int(expected.findtext("measure/attributes/divisions")) / int(
            part.findtext("measure/attributes/divisions")
        )

        def scaled(notes: list[Any], by: float) -> list[Any]:
            return [(*note[:4], int(note[4]) * by, *note[5:]) for note in notes]

        assert scaled(told(part), scale) == scaled(told(expected), 1)
        check_rests(part)


def check_rests(part: Any) -> None:
    """Gathered bars are silent, and no two silent bars that are alike remain apart."""
    measures = list(part.iter("measure"))
    silent = [all(note.find("rest") is not None for note in measure.iter("note")) for measure in measures]
    gathered = {}
    for bar, measure in enumerate(measures):
        count = measure.findtext("attributes/measure-style/multiple-rest")
        if count:
            gathered[bar] = int(count)
            assert all(silent[bar : bar + int(count)])
    inside = {bar for first, count in gathered.items() for bar in range(first, first + count)}
    for bar in range(len(measures) - 1):
        if silent[bar] and silent[bar + 1] and bar not in inside:
            begins = measures[bar + 1].find("direction") is not None or measures[bar + 1].find("attributes") is not None
            ends = measures[bar].find("barline") is not None
            assert begins or ends or bar + 2 == len(measures), bar + 1


def test_cues_are_notes_of_other_parts(tmp_path: pathlib.Path) -> None:
    found = 0
    for name in ["gamelan", "raga", "canon", "blues"]:
        files = saved(name, "musicxml", tmp_path)
        score = parts_of(files.pop(f"{name}.musicxml"))
        heard = [
            {(bar, at, (key_of(note) - raised(part)) % 12) for bar, at, note in placed(part) if key_of(note)}
            for part in score
        ]
        for text in files.values():
            (part,) = parts_of(text)
            cues: dict[int, set[tuple[int, float, float]]] = {}
            for bar, at, note in placed(part):
                if note.find("cue") is None or not key_of(note):
                    continue
                cues.setdefault(bar, set()).add((bar, at, (key_of(note) - raised(part)) % 12))
            for bar, notes in cues.items():
                assert any(notes == {note for note in other if note[0] == bar} for other in heard), (name, bar)
                found += len(notes)
            entries = [bar for bar in cues if bar + 1 not in cues]
            own = {bar for bar, _, note in placed(part) if note.find("cue") is None and note.find("rest") is None}
            assert all(bar + 1 in own and not own & set(range(bar - 7, bar + 1)) for bar in entries)
    assert found > 10


def test_parts_of_one_player_and_of_other_formats(tmp_path: pathlib.Path) -> None:
    with pytest.warns(sikku.SikkuWarning, match="single player"):
        assert isinstance(sikku.load("hilbert").play("musicxml", parts=True), str)
    with pytest.warns(sikku.SikkuWarning, match="applies only to print"):
        assert isinstance(sikku.load_arrangement("canon").play("mid", parts=True), bytes)
    with pytest.raises(sikku.Error, match="3 files"):
        sikku.load_arrangement("canon").play("musicxml", parts=True)
    lilypond = saved("gamelan", "ly", tmp_path)
    assert "R1*4/4*12" in lilypond["gamelan-4-celesta.ly"]
    assert "page-turn-breaking" in lilypond["gamelan-4-celesta.ly"]
    assert "page-turn-breaking" not in lilypond["gamelan.ly"]
    assert "Z14 |" in saved("gamelan", "abc", tmp_path)["gamelan-4-celesta.abc"]


# --- chords, degrees, slurs -----------------------------------------------------------------------------------------

KINDS = {
    "major": {0, 4, 7},
    "minor": {0, 3, 7},
    "dominant": {0, 4, 10, 7},
    "diminished": {0, 3, 6},
    "minor-seventh": {0, 3, 10, 7},
    "major-seventh": {0, 4, 11, 7},
}


def chords_in(part: Any) -> list[tuple[tuple[int, float], set[float] | None]]:
    """The places at which names of chords stand, and the pitch classes that they mean."""
    divisions = int(part.findtext("measure/attributes/divisions"))
    found = []
    for bar, measure in enumerate(part.iter("measure")):
        here = 0
        for item in measure:
            length = int(item.findtext("duration") or 0)
            if item.tag == "harmony":
                kind = KINDS.get(item.findtext("kind"))
                root = STEPS[item.findtext("root/root-step")] + float(item.findtext("root/root-alter") or 0)
                sounding = {(root + tone - raised(part)) % 12 for tone in kind} if kind else None
                found.append(((bar, here / divisions), sounding))
            elif item.find("chord") is None:
                here += -length if item.tag == "backup" else length
    return found


@pytest.mark.parametrize(
    ("load", "staff"),
    [
        (lambda: sikku.load("hilbert-chorale"), 1),
        (lambda: sikku.load_arrangement("blues"), 2),
        (lambda: sikku.load("hilbert", harmony="progression I-V7-vi-IV", accompaniment="bluo"), 1),
        (lambda: sikku.load("hilbert", harmony="triads"), 1),
        (lambda: sikku.load("hilbert", harmony="triads", tonic="Eb4"), 1),
        (lambda: sikku.load("hilbert", harmony="triads", accompaniment="~c~c", instrument="clarinet"), 1),
        (lambda: sikku.load("hilbert", harmony="progression Dm7-G7-Cmaj7-F/A"), 1),
        (lambda: sikku.load("hilbert", harmony="progression C-F-G7-Am", accompaniment="bc5c", retrograde="yes"), 1),
        (lambda: sikku.load("hilbert", harmony="progression C-F-G7-Am", accompaniment="bc5c", phrases="2", form="ABA"), 1),
        (lambda: sikku.load("hilbert", harmony="progression C-F-G7-Am", loop="2", canon="1 -12"), 1),
    ],
)
def test_names_of_chords(load: Any, staff: int) -> None:
    parts = parts_of(load().play("musicxml", chord_symbols=True))
    named = chords_in(parts[0])
    assert all(part.find("measure/harmony") is None for part in parts[1:])
    checked = 0
    for bar, at, note in placed(parts[staff]):
        if key_of(note) is None:
            continue
        meant = [chord for place, chord in named if place <= (bar, at)][-1]
        assert (key_of(note) - raised(parts[staff])) % 12 in meant, (bar + 1, at)
        checked += 1
    assert checked > 20


def test_tones_of_chords_are_spelled_from_their_roots() -> None:
    for chord, key, step in [("A7", 1, "C"), ("E7", 8, "G"), ("Fm", 8, "A"), ("D7", 6, "F"), ("Ab", 3, "E")]:
        (_, strings) = parts_of(sikku.load("hilbert-in-c").play("musicxml", harmony=f"progression C-{chord}"))
        steps = {note.findtext("pitch/step") for _, _, note in placed(strings) if (key_of(note) or 0) % 12 == key}
        assert steps == {step}, chord


def test_chords_without_a_name_end_the_one_before() -> None:
    pattern = sikku.load("hilbert", scale="todi-that", harmony="triads")
    with pytest.warns(sikku.SikkuWarning, match="no name"):
        part = parts_of(pattern.play("musicxml", chord_symbols=True))[0]
    kinds = [kind.text for kind in part.iter("kind")]
    assert "none" in kinds and set(kinds) - {"none"}
    with pytest.warns(sikku.SikkuWarning, match="'chord_symbols' has no effect|'chord-symbols' has no effect"):
        sikku.load("hilbert").play("musicxml", chord_symbols=True)


@pytest.mark.parametrize(
    ("name", "keys", "kind", "names"),
    [
        ("hilbert-kalyani", {}, "sargam", "S R G M P D N"),
        ("hilbert-in-c", {}, "solfa", "do re mi fa sol la ti"),
        ("hilbert-in-c", {"scale": "minor", "tonic": "F#4"}, "sargam", "S R g m P d n"),
        ("hilbert-in-c", {"instrument": "clarinet"}, "degrees", "1 2 3 4 5 6 7"),
        ("hilbert-in-c", {"scale": "minor", "tonic": "F#4"}, "degrees", "1 2 ♭3 4 5 ♭6 ♭7"),
    ],
)
def test_degrees_under_notes(name: str, keys: dict[str, str], kind: str, names: str) -> None:
    pattern = sikku.load(name)
    part = parts_of(pattern.play("musicxml", syllables=kind, **keys))[0]
    notes = pattern.notes(**keys)
    tonic = {"hilbert-kalyani": 2, "hilbert-in-c": 0}[name] if "tonic" not in keys else 6
    steps = {"hilbert-kalyani": [0, 2, 4, 6, 7, 9, 11], "hilbert-in-c": [0, 2, 4, 5, 7, 9, 11]}[name]
    if keys.get("scale") == "minor":
        steps = [0, 2, 3, 5, 7, 8, 10]
    words = names.split()
    sung = 0
    for _, _, note in placed(part):
        text = note.findtext("lyric/text")
        is_onset = note.find("rest") is None and note.find("tie[@type='stop']") is None
        assert (text is not None) == is_onset
        if not is_onset:
            continue
        plain = unicodedata.normalize("NFD", text).replace("\u0307", "").replace("\u0323", "")
        above = (key_of(note) - raised(part) - tonic) % 12
        assert plain == words[steps.index(above)]
        sung += 1
    assert sung == sum(1 for note in notes.voice if note == 0)


def test_slurs_join_notes_between_rests() -> None:
    found = 0
    for name in ["hilbert-chorale", "hilbert-kalyani", "hilbert-todi", "snowflake-shruti"]:
        for keys in [{}, {"from_bar": 4, "bars": 3}]:
            for part in parts_of(sikku.load(name).play("musicxml", **keys)):
                open_at: dict[str, int] = {}
                for bar, _, note in placed(part):
                    if note.find("chord") is not None:
                        continue
                    voice = note.findtext("voice")
                    for slur in note.iterfind("notations/slur"):
                        if slur.get("type") == "start":
                            assert voice not in open_at
                            open_at[voice] = bar
                        else:
                            assert bar - open_at.pop(voice) <= 4
                            found += 1
                    assert voice not in open_at or note.find("rest") is None
                assert not open_at
    assert found > 20
    detached = parts_of(sikku.load("hilbert-in-c").play("musicxml", articulation="detached"))[0]
    for _, _, note in placed(detached):
        is_short = note.findtext("type") in ("eighth", "quarter") and note.find("tie") is None
        is_dotted_quarter = note.findtext("type") == "quarter" and note.find("dot") is not None
        expected = is_short and not is_dotted_quarter and note.find("rest") is None
        assert (note.find("notations/articulations/staccato") is not None) == expected
