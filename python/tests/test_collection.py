"""Arrangements and galleries."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy
import pytest
import sikku
from conftest import SOURCE, Run

NAMES = sorted(file.stem for file in (SOURCE / "patterns/arrangements").glob("*.toml"))


@pytest.mark.filterwarnings("ignore::sikku.SikkuWarning")
@pytest.mark.parametrize("name", NAMES)
def test_arrangements_are_those_of_the_program(name: str, run: Run, tmp_path: Path) -> None:
    piece = sikku.load_arrangement(name)
    result = run("-q", "play", name, "--bars", "4", "-o", str(tmp_path / "x.mid"))
    assert result.returncode == 0, result.stderr
    assert piece.play("mid", bars=4) == (tmp_path / "x.mid").read_bytes()
    piece.save(tmp_path / "y.mid", bars=4)
    assert (tmp_path / "y.mid").read_bytes() == (tmp_path / "x.mid").read_bytes()
    assert len(piece.tracks) > 1 and all(isinstance(track, sikku.Pattern) for track in piece.tracks)
    assert pickle.loads(pickle.dumps(piece)) == piece


def test_an_arrangement_of_files(tmp_path: Path) -> None:
    (tmp_path / "one.lsys").write_text("axiom: F+F-F+F\ntempo: 100\n")
    (tmp_path / "piece.toml").write_text('title = "One"\n[[track]]\npattern = "one.lsys"\n')
    piece = sikku.load_arrangement(tmp_path / "piece.toml")
    assert piece.title == "One"
    assert 'title = "One"' in piece.text
    notes = piece.notes()
    alone = sikku.load(tmp_path / "one.lsys").notes()
    assert notes.key.tolist() == alone.key.tolist() and notes.onset.dtype == numpy.int64
    assert sikku.load_arrangement(text=piece.text).notes().key.tolist() == notes.key.tolist()


def test_upbeats_are_stated() -> None:
    pattern = sikku.load(text="axiom: FF\nheading: 0\n")
    assert pattern.notes().upbeat == 0
    assert pattern.notes(upbeat="1/8").upbeat == 240
    assert pattern.notes(upbeat="1/8", from_bar=2, bars=1, loop=9).upbeat == 0


def test_sections_have_tempos_and_meters() -> None:
    frame = '[[section]]\nname = "B"\ntempo = 60\nmeter = "3/4"\n'
    tracks = "".join(f'[[track]]\npattern = "a"\nsection = "{letter}"\n' for letter in "AB")
    pattern = '[[pattern]]\nname = "a"\ntext = "axiom: FF\\nheading: 0\\n"\n'
    notes = sikku.load_arrangement(text='form = "A B A"\n' + frame + tracks + pattern).notes()
    assert notes.changes == [(1920, 60.0, (3, 4)), (3360, 120.0, (4, 4))]
    # A lasts 2 s, B 3 s; half a second of the second A follows.
    assert notes.seconds(3360 + 480) == 5.5
    assert notes.seconds(numpy.array([0, 1920, 2400, 3360])).tolist() == [0, 2, 3, 5]


def test_errors_of_arrangements(tmp_path: Path) -> None:
    with pytest.raises(sikku.NotFoundError):
        sikku.load_arrangement("no-such-piece")
    with pytest.raises(sikku.Error):
        sikku.load_arrangement(text="title = [")
    with pytest.raises(sikku.PatternError):
        sikku.load_arrangement(text='[[pattern]]\nname = "x"\ntext = "axim: F\\n"\n[[track]]\npattern = "x"\n')
    with pytest.raises(sikku.SettingError):
        sikku.load_arrangement("canon").save(tmp_path / "x.png")
    with pytest.raises(TypeError):
        sikku.load_arrangement()


def test_a_gallery_is_that_of_the_program(run: Run, tmp_path: Path) -> None:
    calls: list[tuple[int, float]] = []
    result = sikku.gallery(
        tmp_path / "one",
        ["snake-kolam", "hilbert-in-c"],
        format=["svg", "mid"],
        size="60x60mm",
        bars=4,
        progress=lambda done, expected: calls.append((done, expected)),
    )
    assert not result.failures
    assert sorted(one.name for one in result.files) == [
        "hilbert-in-c.mid", "hilbert-in-c.svg", "snake-kolam.mid", "snake-kolam.svg",
    ]  # fmt: skip
    assert all(one.is_new and one.bytes == (tmp_path / "one" / one.name).stat().st_size for one in result.files)
    again = sikku.gallery(
        tmp_path / "one", ["snake-kolam", "hilbert-in-c"], format="svg,mid", size="60x60mm", bars=4
    )
    assert not any(one.is_new for one in again.files)
    run(
        "-q", "gallery", "snake-kolam", "hilbert-in-c", "-f", "svg,mid", "--size", "60x60mm", "--bars", "4",
        "-o", str(tmp_path / "two"),
    )  # fmt: skip
    for one in result.files:
        assert (tmp_path / "one" / one.name).read_bytes() == (tmp_path / "two" / one.name).read_bytes()


def test_errors_of_galleries(tmp_path: Path) -> None:
    with pytest.raises(sikku.Error):
        sikku.gallery(tmp_path / "x", "no-such-pattern")
    with pytest.raises(sikku.Error):
        sikku.gallery(tmp_path / "x", "snake-kolam", format="xyz")
    bad = tmp_path / "bad.lsys"
    bad.write_text("axiom: F[\n")
    result = sikku.gallery(tmp_path / "y", [str(bad), "snake-kolam"], format="svg", keep_going=True)
    assert list(result.failures) == ["bad.svg"] and len(result.files) == 1


def test_an_exception_in_progress_stops_a_gallery(tmp_path: Path) -> None:
    def stop(done: int, expected: float) -> None:
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        sikku.gallery(tmp_path / "x", "curves", format="png", size="A3", progress=stop)
