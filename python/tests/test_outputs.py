"""draw(), play(), save() and notebooks."""

from __future__ import annotations

import html
import io
import xml.etree.ElementTree
from pathlib import Path

import mido
import numpy
import pytest
import sikku
from conftest import Run

NAMES = [pattern.name for pattern in sikku.patterns()]


def test_a_sheet_is_that_of_the_program(tmp_path: Path, run: Run) -> None:
    snake = sikku.load("snake-kolam")
    koch = sikku.load("koch-curve")
    ours, theirs = tmp_path / "ours.svg", tmp_path / "theirs.svg"
    sikku.sheet(ours, (snake, {"dots": True, "border": "rope"}), koch, columns=2, gutter="20mm", same_scale=True)
    command = ["sheet", "snake-kolam@dots,border=rope", "koch-curve", "--columns", "2", "--gutter", "20mm"]
    assert run(*command, "--same-scale", "-o", str(theirs)).returncode == 0
    assert ours.read_bytes() == theirs.read_bytes()
    with pytest.raises(sikku.SettingError):
        sikku.sheet(ours, snake, nonsense=1)


def test_a_workbook_is_that_of_the_program(tmp_path: Path, run: Run) -> None:
    snake = sikku.load("snake-kolam")
    ours, theirs = tmp_path / "ours.pdf", tmp_path / "theirs.pdf"
    sikku.workbook(ours, (snake, {"n": 1}), (snake, {"n": 2, "border": "rope"}), booklet=True, heading="Class 3")
    command = ["workbook", "snake-kolam@n=1", "snake-kolam@n=2,border=rope", "--booklet", "--heading", "Class 3"]
    assert run(*command, "-o", str(theirs)).returncode == 0
    assert ours.read_bytes() == theirs.read_bytes()
    with pytest.raises(sikku.SettingError):
        sikku.workbook(ours, snake, nonsense=1)


def test_the_derivation_length_is_an_option_named_n(tmp_path: Path) -> None:
    hilbert = sikku.load("hilbert")
    three = hilbert.with_settings(n=3)
    assert hilbert.draw("svg", n=3) == three.draw("svg")
    assert hilbert.play("mid", n=3) == three.play("mid")
    assert numpy.array_equal(hilbert.notes(n=3).onset, three.notes().onset)
    ours, theirs = tmp_path / "ours.pdf", tmp_path / "theirs.pdf"
    hilbert.save(ours, n=3)
    three.save(theirs)
    assert ours.read_bytes() == theirs.read_bytes()
    sikku.sheet(ours, (hilbert, {"n": 3}), hilbert)
    sikku.sheet(theirs, three, hilbert)
    assert ours.read_bytes() == theirs.read_bytes()
    with pytest.raises(sikku.SettingError, match="n='many'"):
        hilbert.draw("svg", n="many")


def test_patterns_are_those_of_the_program(run: Run) -> None:
    arrangements = run("patterns", "arrangements", "--names").stdout.decode().split()
    names = run("patterns", "--names").stdout.decode().split()
    assert [name for name in names if name not in arrangements] == NAMES
    hilbert = next(pattern for pattern in sikku.patterns() if pattern.name == "hilbert")
    assert hilbert.kind == "curves"
    assert hilbert.title == "Hilbert curve"
    assert hilbert.source.startswith("Prusinkiewicz & Hanan 1989")


@pytest.mark.filterwarnings("ignore::sikku.SikkuWarning")
@pytest.mark.parametrize("name", NAMES)
def test_drawings_have_the_bytes_of_the_program(name: str, run: Run, tmp_path: Path) -> None:
    file = tmp_path / "x.svg"
    result = run("-q", "draw", name, "-o", str(file))
    pattern = sikku.load(name)
    if result.returncode != 0:
        with pytest.raises(sikku.Error) as caught:
            pattern.draw("svg")
        assert str(caught.value) in result.stderr.decode()
        return
    drawn = pattern.draw("svg")
    assert isinstance(drawn, str)
    assert drawn.encode() == file.read_bytes()


@pytest.mark.filterwarnings("ignore::sikku.SikkuWarning")
@pytest.mark.parametrize("name", NAMES)
def test_scores_have_the_bytes_of_the_program(name: str, run: Run, tmp_path: Path) -> None:
    file = tmp_path / "x.mid"
    result = run("-q", "play", name, "-o", str(file))
    pattern = sikku.load(name)
    if result.returncode != 0:
        with pytest.raises(sikku.Error) as caught:
            pattern.play("mid")
        assert str(caught.value) in result.stderr.decode()
        return
    assert pattern.play("mid") == file.read_bytes()


def test_options_are_those_of_the_program(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "x.svg"
    arguments = ["--size", "A3", "--landscape", "--dot-spacing", "7.5mm", "--set", "stroke=0.4mm navy"]
    assert run("draw", "snake-kolam", "-n", "3", "-o", str(file), *arguments).returncode == 0
    pattern = sikku.load("snake-kolam", n=3, stroke="0.4mm navy")
    drawn = pattern.draw(size="A3", landscape=True, dot_spacing="7.5mm", border=None, animate=False)
    assert drawn == file.read_text()
    assert run("draw", "snake-kolam", "--dots", "--animate", "-o", str(file)).returncode == 0
    assert sikku.load("snake-kolam").draw(dots=True, animate=True) == file.read_text()
    # Options may include keys of the pattern.
    assert sikku.load("snake-kolam").draw(derivation_length=3, stroke="0.4mm navy") == sikku.load(
        "snake-kolam", n=3, stroke="0.4mm navy"
    ).draw()
    window = sikku.load("hilbert", n=60).draw(window=(-40, 0, numpy.float64(0), numpy.int64(58)))
    assert run("draw", "hilbert", "-n", "60", "--window", "-40,0,0,58", "-o", str(file)).returncode == 0
    assert window == file.read_text()


@pytest.mark.parametrize("format", ["svg", "hpgl", "gcode"])
def test_texts(format: str) -> None:
    assert isinstance(sikku.load("hilbert", n=3).draw(format), str)


@pytest.mark.parametrize(
    ("format", "start"),
    [("pdf", b"%PDF"), ("png", b"\x89PNG"), ("jpg", b"\xff\xd8"), ("glb", b"glTF"), ("stl", b"Binary STL"), ("exr", b"v/1\x01")],
)
def test_bytes(format: str, start: bytes) -> None:
    drawn = sikku.load("hilbert", n=3).draw(format, **({} if format == "glb" else {"size": "50x50mm"}))
    assert isinstance(drawn, bytes)
    assert drawn.startswith(start)


def test_score_texts() -> None:
    pattern = sikku.load("hilbert-in-c", n=3)
    starts = {
        "musicxml": "<?xml",
        "ly": "\\version",
        "abc": "%abc-2.1",
        "csd": "<CsoundSynthesizer>",
        "sco": "; score",
        "strudel": "// https://strudel.cc/#",
        "svg": "<?xml",
        "html": "<!DOCTYPE html",
    }
    for format, start in starts.items():
        score = pattern.play(format)
        assert isinstance(score, str)
        assert start.lower() in score[:300].lower()


def test_save(tmp_path: Path) -> None:
    pattern = sikku.load("snake-kolam", n=2)
    assert pattern.save(tmp_path / "x.svg") == []
    assert (tmp_path / "x.svg").read_text() == pattern.draw()
    pattern.save(str(tmp_path / "x.pdf"), size="A5")
    assert (tmp_path / "x.pdf").read_bytes().startswith(b"%PDF")
    facts = pattern.save(tmp_path / "x.gcode")
    assert any("pen-up travel" in fact for fact in facts)
    melody = sikku.load("hilbert-in-c")
    melody.save(tmp_path / "x.mid", bars=4)
    assert (tmp_path / "x.mid").read_bytes() == melody.play(bars=4)
    melody.save(tmp_path / "x.notes.svg")
    assert (tmp_path / "x.notes.svg").read_text() == melody.play("svg")
    sikku.load("bush-3d", n=2).save(tmp_path / "bush.obj")
    assert (tmp_path / "bush.mtl").exists()


def test_files_appear_whole_or_not_at_all(tmp_path: Path) -> None:
    pattern = sikku.load("snake-kolam")
    with pytest.raises(sikku.Error, match="absent"):
        pattern.save(tmp_path / "absent" / "x.svg")
    with pytest.raises(sikku.BudgetError):
        sikku.load("hilbert", n=30).save(tmp_path / "x.svg")
    with pytest.raises(sikku.SettingError) as caught:
        pattern.save(tmp_path / "x.xyz")
    assert caught.value.option == "format"
    assert list(tmp_path.iterdir()) == []


def test_outputs_of_several_files_are_saved() -> None:
    with pytest.raises(sikku.Error, match="save"):
        sikku.load("bush-3d", n=2).draw("obj")


def test_warnings() -> None:
    with pytest.warns(sikku.SikkuWarning, match="cut off"):
        sikku.load("hilbert").draw(step="20mm", size="A6")


def test_notebooks_show_drawings() -> None:
    bundle = sikku.load("snake-kolam")._repr_mimebundle_()
    assert xml.etree.ElementTree.fromstring(bundle["image/svg+xml"]).tag.endswith("svg")
    assert set(bundle) == {"text/plain", "image/svg+xml"}
    assert set(sikku.load("hilbert", n=40)._repr_mimebundle_()) == {"text/plain"}
    large = sikku.load("bush-3d")._repr_mimebundle_()
    assert set(large) == {"text/plain", "image/png"} and len(large["image/png"]) < 1_000_000


def test_notebooks_play_melodies() -> None:
    pattern = sikku.load("hilbert-in-c")
    bundle = pattern._repr_mimebundle_()
    assert set(bundle) == {"text/plain", "text/html"}
    page = str(bundle["text/html"])
    frame = xml.etree.ElementTree.fromstring(page)
    assert frame.tag == "iframe"
    assert html.unescape(page.split('"')[1]) == pattern.play("html")


def test_a_hostile_title_stays_inside_the_frame() -> None:
    text = 'title: "></iframe><script>alert(1)</script>\naxiom: F+F-F\ntempo: 90\n'
    page = str(sikku.load(text=text)._repr_mimebundle_()["text/html"])
    assert "<script" not in page
    xml.etree.ElementTree.fromstring(page)


def midi_notes(data: bytes) -> list[tuple[int, int, int, int]]:
    """Onset, duration, key and velocity of each note, as mido reads them."""
    found = []
    for track in mido.MidiFile(file=io.BytesIO(data)).tracks:
        time = 0
        open_notes: dict[tuple[int, int], tuple[int, int]] = {}
        for message in track:
            time += message.time
            if message.type not in ("note_on", "note_off"):
                continue
            place = (message.channel, message.note)
            if message.type == "note_on" and message.velocity > 0:
                open_notes[place] = (time, message.velocity)
            else:
                onset, velocity = open_notes.pop(place)
                found.append((onset, time - onset, message.note, velocity))
        assert not open_notes
    return sorted(found)


@pytest.mark.parametrize("name", ["hilbert-in-c", "gosper-waltz", "tree-in-voices"])
def test_notes_are_those_of_the_score(name: str) -> None:
    pattern = sikku.load(name)
    notes = pattern.notes(bars=16)
    score = pattern.play("mid", bars=16)
    assert isinstance(score, bytes)
    assert mido.MidiFile(file=io.BytesIO(score)).ticks_per_beat == 480
    listed = zip(notes.onset.tolist(), notes.duration.tolist(), notes.key.tolist(), notes.velocity.tolist())
    assert sorted(listed) == midi_notes(score)
    assert notes.end >= int((notes.onset + notes.duration).max())
    assert (notes.onset[1:] >= notes.onset[:-1]).all()
    assert notes.curve.shape == (len(notes), 2, 2)
    assert notes.onset.dtype == notes.duration.dtype == numpy.int64
    assert notes.velocity.dtype == numpy.uint8
    assert notes.voice.dtype == numpy.int16


def test_times_of_notes() -> None:
    notes = sikku.load("hilbert-in-c").notes(tempo=60, meter="3/4")
    assert notes.tempo == 60
    assert notes.meter == (3, 4)
    assert notes.seconds(480) == 1.0
    assert notes.seconds(notes.onset)[0] == notes.onset[0] / 480
