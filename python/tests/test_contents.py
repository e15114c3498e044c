"""What is inside of patterns and files; copies, pickles, equality; pixels; progress."""

from __future__ import annotations

import copy
import multiprocessing
import pickle
import runpy
import subprocess
import warnings
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy
import pytest
import sikku
from conftest import SOURCE, Run

TEXT = """title: All of it
axiom: A(1)
derivation length: 3
stroke: 0.4mm navy
define grow = 2
A(x) : x < 9 --> F(x)A(x * grow) : 3
A(x) : x >= 9 --> F(x) : 1
B < F > C --> G
table night:
F --> FF
interpret:
A(x) --> B
variant small: grow = 1, derivation length = 2
"""


def test_the_contents_of_a_pattern() -> None:
    pattern = sikku.load("all", text=TEXT)
    assert pattern.keys["axiom"] == "A(1)"
    assert pattern.keys["stroke"] == "0.4mm navy"
    assert pattern.defines == {"grow": "2"}
    assert pattern.variants == {"small": {"grow": "1", "derivation length": "2"}}
    shown = [(str(one), one.table, one.interprets) for one in pattern.productions]
    assert shown == [
        ("A(x) : x < 9 --> F(x)A(x * grow) : 3", None, False),
        ("A(x) : x >= 9 --> F(x) : 1", None, False),
        ("B < F > C --> G", None, False),
        ("F --> FF", "night", False),
        ("A(x) --> B", None, True),
    ]
    assert pattern.productions[0].condition == "x < 9"
    assert pattern.productions[0].weight == "3"
    small = sikku.load("all", text=TEXT, variant="small", stroke="1mm red")
    assert (small.variant, small.settings) == ("small", {"stroke": "1mm red"})
    assert small.defines == {"grow": "1"} and small.n == 2
    assert small.keys["stroke"] == "1mm red"


def drawn(pattern: sikku.Pattern) -> Any:
    return pattern.draw("svg")


def test_patterns_are_values() -> None:
    pattern = sikku.load("honda-trees", variant="b", n=5)
    same = sikku.load("honda-trees", variant="b", n=5)
    assert pattern == same and hash(pattern) == hash(same)
    assert pattern == sikku.load("honda-trees", variant="b").with_settings(n=4).with_settings(n=5)
    assert pattern != sikku.load("honda-trees", variant="b") and pattern != sikku.load("honda-trees", n=5)
    assert pattern != "honda-trees"
    assert copy.copy(pattern) == copy.deepcopy(pattern) == pattern
    again = pickle.loads(pickle.dumps(pattern))
    assert again == pattern and again.draw("svg") == pattern.draw("svg")
    strange = sikku.load("<text>", text='title: "é"\naxiom: F\n')
    assert pickle.loads(pickle.dumps(strange)).title == strange.title


@pytest.mark.parametrize("name", ["snake-kolam", "lilac", "checkers"])
def test_patterns_go_to_other_processes(name: str) -> None:
    pattern = sikku.load(name)
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(drawn, pattern).result() == pattern.draw("svg")


def test_pixels_are_those_of_a_png(tmp_path: Path) -> None:
    options: dict[str, Any] = {"size": "50x40mm", "dpi": 127, "ground": "#402010"}
    pattern = sikku.load("snake-kolam")
    pixels = pattern.pixels(**options)
    assert pixels.shape == (200, 250, 4) and pixels.dtype == numpy.uint8
    pattern.save(tmp_path / "x.png", **options)
    subprocess.run(["oiiotool", tmp_path / "x.png", "-o", tmp_path / "x.ppm"], check=True)
    data = (tmp_path / "x.ppm").read_bytes()
    assert data.startswith(b"P6\n250 200\n255\n")
    expected = numpy.frombuffer(data[-250 * 200 * 3 :], numpy.uint8).reshape(200, 250, 3)
    assert (pixels[:, :, :3] == expected).all() and (pixels[:, :, 3] == 255).all()
    assert (pattern.pixels(size="50x40mm", dpi=127, ground="none", stroke="0.2 step navy")[:, :, 3] < 255).any()


def test_progress() -> None:
    calls: list[tuple[int, float]] = []
    pattern = sikku.load("hilbert")
    svg = pattern.draw("svg", n=11, progress=lambda done, expected: calls.append((done, expected)))
    assert svg == pattern.draw("svg", n=11)
    assert all(isinstance(done, int) and expected >= 0 for done, expected in calls)
    assert any(done > 0 for done, _ in calls)


def test_an_exception_in_progress_stops_the_work(tmp_path: Path) -> None:
    def stop(done: int, expected: float) -> None:
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        sikku.load("hilbert").save(tmp_path / "x.svg", n=12, progress=stop)
    assert list(tmp_path.iterdir()) == []


def test_prints_and_scores_are_loaded(tmp_path: Path) -> None:
    pattern = sikku.load("hilbert-in-c", n=3)
    for name in ("x.svg", "x.pdf", "x.png", "x.mid", "x.musicxml", "x.notes.svg"):
        pattern.save(tmp_path / name)
        stored = sikku.show(tmp_path / name)
        assert stored.text == pattern.text
        assert stored.made.startswith(f"sikku {sikku.__version__}, -n 3")
        assert sikku.load(tmp_path / name).text == pattern.text
    (tmp_path / "plain.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"/>')
    with pytest.raises(sikku.Error, match="no pattern"):
        sikku.show(tmp_path / "plain.svg")
    with pytest.raises(sikku.Error, match="not made by Sikku"):
        sikku.show(SOURCE / "README.md")
    with pytest.raises(sikku.Error):
        sikku.show(tmp_path / "missing.svg")


FRACTINT = """Dragon { ; Heighway
  Angle 8
  Axiom FX
  F=
  y=+FX--FY+
  x=-FX++FY-
}
Koch {
  Angle 6
  Axiom F--F--F
  F=F+F--F+F
}
Wrong { Angle 6 }
"""


def test_systems_of_fractint(tmp_path: Path) -> None:
    file = tmp_path / "two.l"
    file.write_text(FRACTINT)
    with pytest.warns(sikku.SikkuWarning):
        systems = sikku.import_systems(file)
    assert [one.name for one in systems[:2]] == ["Dragon", "Koch"]
    assert systems[0].line == 1 and systems[1].line == 8
    koch = systems[1].pattern
    assert koch is not None and koch.with_settings(n=4).measure()["drawn"] == 3 * 4**4
    assert all(one.pattern is None for one in systems[2:])
    with pytest.raises(sikku.Error, match=r"Fractint.*import_systems"):
        sikku.load(file)


def test_systems_of_cpfg_with_a_view_file(tmp_path: Path, run: Run) -> None:
    (tmp_path / "plant.l").write_text("Lsystem: 1\nderivation length: 3\nAxiom: F\nF --> F[+F]F\nendlsystem\n")
    (tmp_path / "plant.v").write_text("angle factor: 9\n")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", sikku.SikkuWarning)
        beside = sikku.import_systems(tmp_path / "plant.l")[0].pattern
        named = sikku.import_systems(tmp_path / "plant.l", view=tmp_path / "plant.v")[0].pattern
    assert beside is not None and beside == named
    said = run("import", str(tmp_path / "plant.l")).stdout.decode()
    assert beside.text == said
    assert beside.keys["angle factor"] == "9"


def test_what_cannot_be_imported(tmp_path: Path) -> None:
    with pytest.raises(sikku.NotFoundError):
        sikku.import_systems(tmp_path / "missing.l")
    with pytest.raises(sikku.Error, match="only files of cpfg and Fractint"):
        sikku.import_systems(SOURCE / "LICENSE")


def test_the_stub_of_options_is_current() -> None:
    stub = runpy.run_path(str(SOURCE / "python/stub.py"))["stub"]()
    assert stub == (SOURCE / "python/src/sikku/outputs.pyi").read_text(), "run python/stub.py"


def test_a_stream_is_not_a_path() -> None:
    import io

    with pytest.raises(TypeError, match="draw.*return"):
        sikku.load("hilbert").save(io.BytesIO())  # type: ignore[arg-type]


def test_lines_of_a_path() -> None:
    path = sikku.load("islands-and-lakes", n=1).path()
    assert [len(line) for line in path.lines] == numpy.diff(path.strokes).tolist()
    assert sikku.load(text="axiom: +\n").path().lines == []


def test_columns_of_notes() -> None:
    notes = sikku.load("hilbert-in-c").notes(bars=4)
    columns = notes.columns()
    assert list(columns) == ["onset", "duration", "key", "velocity", "voice"]
    assert all(len(column) == len(notes) for column in columns.values())
