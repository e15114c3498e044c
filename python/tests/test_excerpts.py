"""Excerpts are cut-outs of the whole: MIDI files are read by mido, MusicXML by Python's own parser."""

from __future__ import annotations

import io
import itertools
import random
import xml.etree.ElementTree
from collections.abc import Iterator
from typing import Any

import mido
import pytest
import sikku

PIECES = [pattern.name for pattern in sikku.patterns() if pattern.kind == "melodies"]
ARRANGEMENTS = ["blues", "canon", "fugue", "gamelan", "invention", "mohanam", "raga", "rooms", "seven"]
PIECES += ["hilbert", "peano", "quadratic-gosper", "arrowhead", "dragon"]
KEYS = [
    {},
    {"velocity": "by y"},
    {"velocity": "by turn 40-110"},
    {"velocity": "by length 50-100"},
    {"velocity": "by level 40-120", "phrases": "2"},
    {"velocity": "by x", "pan": "by x 20-100"},
    {"controller": "11 by y 30-120", "pan": "by y"},
    {"tempo": "96 by y 60-140"},
    {"tempo": "95 by x 90-100", "velocity": "by y 20-120", "swing": "60"},
    {"harmony": "triads", "velocity": "by y"},
    {"harmony": "drone"},
    {"harmony": "triads", "accompaniment": "alberti"},
    {"harmony": "progression I-vi-ii-V7", "accompaniment": "walking bass on acoustic bass"},
    {"leaps": "6", "velocity": "by y"},
    {"rhythm": "x.x. / X..x", "phrases": "2"},
    {"rhythm": "xo.x?X?30. / x.x?~~ / X... by level", "phrases": "2", "breath": "1/8 by level"},
    {"rhythm": "(x.o?)2 x?x", "seed": "7"},
    {"vertical": "glissando", "velocity": "by y"},
    {"vertical": "voice", "velocity": "by y"},
    {"mapping": "counterpoint", "velocity": "by y"},
    {"mapping": "symbols", "velocity": "by y"},
    {"canon": "2 -12", "velocity": "by y"},
    {"rhythm": "E(3,8)", "velocity": "by y 40-100"},
    {"articulation": "detached", "velocity": "by y"},
    {"retrograde": "yes", "velocity": "by y"},
    {"loop": "2", "velocity": "by y"},
    {"gamaka": "kampita 2 6", "velocity": "by y"},
    {"humanise": "1", "velocity": "by y"},
]
WINDOWS = 500
pytestmark = pytest.mark.filterwarnings("ignore::sikku.SikkuWarning")


def cases() -> Iterator[tuple[str, dict[str, str], sikku.Pattern | sikku.Arrangement, bytes, int, int]]:
    """Pieces with keys that suit them, and windows."""
    chance = random.Random(36)
    found = 0
    accepted = set()
    wanted = itertools.cycle(KEYS)
    while found < WINDOWS:
        name = chance.choice(PIECES + ARRANGEMENTS)
        keys = {} if name in ARRANGEMENTS else next(wanted)
        pattern = sikku.load_arrangement(name) if name in ARRANGEMENTS else sikku.load(name)
        try:
            whole = pattern.play("mid", **keys)
        except sikku.Error:
            continue  # these keys do not suit the piece
        bars = len(lines_of(whole)) - 1
        if bars > 400:
            continue
        accepted.add(str(keys))
        for _ in range(3):
            first = chance.randrange(1, bars + 1)
            yield name, keys, pattern, whole, first, chance.randrange(1, min(12, bars - first + 1) + 1)
            found += 1
    assert accepted == {str(keys) for keys in KEYS}


def lines_of(data: bytes) -> list[int]:
    """The ticks of the bar lines, from the beginning to the end of the last bar. The first bar includes its upbeat."""
    file = mido.MidiFile(file=io.BytesIO(data))
    last = max(sum(message.time for message in track) for track in file.tracks)
    meters, now = [], 0
    for message in file.tracks[0]:
        now += message.time
        if message.type == "time_signature":
            meters.append((now, file.ticks_per_beat * 4 * message.numerator // message.denominator))
    lines = [0]
    while lines[-1] < last:
        lines.append(lines[-1] + value_at(meters, lines[-1]))
    has_upbeat = len(meters) > 1 and meters[1][0] == meters[0][1] < meters[1][1]
    return lines[:1] + lines[2:] if has_upbeat else lines


def heard(data: bytes) -> tuple[Any, Any, Any]:
    """Notes as (onset, end, key, velocity), the values of controllers and bends on their channels, and the tempos."""
    file = mido.MidiFile(file=io.BytesIO(data))
    notes, values, tempos = [], {}, []
    for number, track in enumerate(file.tracks):
        now, sounding = 0, {}
        for message in track:
            now += message.time
            if message.type == "set_tempo":
                tempos.append((now, message.tempo))
            elif message.type == "control_change":
                values.setdefault((number, message.channel, message.control), []).append((now, message.value))
            elif message.type == "pitchwheel":
                values.setdefault((number, message.channel, "bend"), []).append((now, message.pitch))
            elif message.type == "note_on" and message.velocity > 0:
                sounding.setdefault((message.channel, message.note), []).append((now, message.velocity))
            elif message.type in ("note_on", "note_off"):
                onset, velocity = sounding[message.channel, message.note].pop(0)
                notes.append((onset, now, message.note, velocity, number, message.channel))
    return notes, values, tempos


def value_at(points: Any, tick: int) -> Any:
    """The last value up to a tick."""
    last = None
    for at, value in points:
        if at > tick:
            break
        last = value
    return last


def sound(data: bytes, first: int = 0, last: int | None = None, margin: int = 0) -> tuple[Any, Any]:
    """What sounds between two ticks, for comparison."""
    notes, values, tempos = heard(data)
    found = []
    for onset, end, key, velocity, track, channel in notes:
        begin, stop = max(onset, first), end if last is None else min(end, last)
        if begin >= stop:
            continue
        if margin and (begin - first < margin or (last is not None and last - stop < margin)):
            continue  # players deviate at edges
        effects = []
        bend_range = value_at(values.get((track, channel, 6), []), begin) or 2
        for at in (begin, (begin + stop) // 2, stop - 1):
            effects += [value_at(values.get((track, channel, kind), []), at) for kind in (7, 10, 11)]
            bend = value_at(values.get((track, channel, "bend"), []), at) or 0
            # A slide that is cut begins at another key. Bends have steps of up to 5 cents.
            effects.append(round((key + bend * bend_range / 8192) / 0.1))
        found.append((begin - first, stop - first, velocity, *effects))
    end = max((stop for _, stop, *_ in notes), default=0) if last is None else last
    tempo = [value_at(tempos, at) for at in range(first, end, 240)]
    return sorted(found, key=repr), tempo


def test_sound_of_windows() -> None:
    compared = 0
    for name, keys, pattern, whole, first, bars in cases():
        lines = lines_of(whole)
        begin, end = lines[first - 1], lines[first - 1 + bars]
        margin = 61 if "humanise" in keys else 0
        notes, tempo = sound(whole, begin, end, margin)
        case = (name, keys, first, bars)
        if not sound(whole, begin, end)[0]:
            with pytest.raises(sikku.Error, match="no notes"):
                pattern.play("mid", from_bar=first, bars=bars, **keys)
            continue
        cut = pattern.play("mid", from_bar=first, bars=bars, **keys)
        cut_notes, cut_tempo = sound(cut, 0, end - begin if margin else None, margin)
        assert cut_notes == notes, case
        assert all(abs(a - b) <= 1 for a, b in zip(cut_tempo, tempo)), case
        compared += len(notes)
    assert compared > 5000


# --- print ----------------------------------------------------------------------------------------------------------


def measures(score: str) -> Any:
    """For each part its measures, the first with its upbeat: the notes, and the dynamics in force at each note."""
    parts = []
    for part in xml.etree.ElementTree.fromstring(score).iter("part"):
        found, level, hairpin = [], None, None
        divisions = int(part.findtext("measure/attributes/divisions"))
        for measure in part.iter("measure"):
            after_upbeat = len(found) == 1 and measure.get("number") == "1"
            notes, dynamics = found.pop() if after_upbeat else ([], [])
            for item in measure:
                if item.tag == "direction":
                    for kind in item.iter("direction-type"):
                        for sign in kind:
                            if sign.tag == "dynamics":
                                level, hairpin = sign[0].tag, None
                            elif sign.tag == "wedge":
                                hairpin = None if sign.get("type") == "stop" else sign.get("type")
                elif item.tag == "note":
                    notes.append(
                        (
                            item.findtext("pitch/step") or ("rest" if item.find("rest") is not None else "drum"),
                            item.findtext("pitch/alter"),
                            item.findtext("pitch/octave"),
                            int(item.findtext("duration")) / divisions,
                            item.findtext("type"),
                            len(item.findall("dot")),
                            item.find("chord") is not None,
                            item.findtext("staff"),
                        )
                    )
                    is_onset = item.find("tie[@type='stop']") is None and item.find("rest") is None
                    dynamics.append((level, hairpin) if is_onset else None)
            found.append((notes, dynamics))
        parts.append(found)
    return parts


def test_print_of_windows() -> None:
    chance = random.Random(37)
    compared = 0
    for name in PIECES + ARRANGEMENTS:
        is_arrangement = name in ARRANGEMENTS
        pattern = sikku.load_arrangement(name) if is_arrangement else sikku.load(name)
        for keys in [{}] if is_arrangement else [{}, {"velocity": "by y 20-120"}]:
            whole = measures(pattern.play("musicxml", **keys))
            bars = len(whole[0])
            for _ in range(6):
                first = chance.randrange(bars)
                count = chance.randrange(1, min(10, bars - first) + 1)
                try:
                    cut = measures(pattern.play("musicxml", from_bar=first + 1, bars=count, **keys))
                except sikku.Error as error:
                    assert "no notes" in str(error)
                    continue
                case = (name, keys, first + 1, count)
                assert len(cut) == len(whole), case
                for part, expected in zip(cut, whole):
                    window = expected[first : first + count]
                    assert [notes for notes, _ in part] == [notes for notes, _ in window], case
                    marks = [mark for _, dynamics in part for mark in dynamics if mark]
                    wanted = [mark for _, dynamics in window for mark in dynamics if mark]
                    # The first note of the whole states the level; the last one of a window ends a hairpin.
                    assert [level for level, _ in marks[len(marks) - len(wanted) :]] == [level for level, _ in wanted], case
                    compared += len(wanted)
    assert compared > 1000
