"""measure(), kolam(), word() and path()."""

from __future__ import annotations

import cmath
import itertools
import json
import math
import os
import resource
import subprocess
import sys
from typing import Any

import numpy
import pytest
import sikku
from conftest import Run

NAMES = [pattern.name for pattern in sikku.patterns()]
WORDS = [pattern.name for pattern in sikku.patterns() if pattern.kind != "maps"]
KOLAMS = [pattern.name for pattern in sikku.patterns() if pattern.kind == "kolams"]


def exact(value: Any) -> Any:
    """Converts strings of digits to integers."""
    if isinstance(value, str) and value.lstrip("-").isdigit():
        return int(value)
    if isinstance(value, list):
        return [exact(one) for one in value]
    return {name: exact(one) for name, one in value.items()} if isinstance(value, dict) else value


@pytest.mark.parametrize("name", NAMES)
def test_measurements_are_those_of_the_program(name: str, run: Run) -> None:
    result = run("measure", name, "--json")
    assert sikku.load(name).measure() == exact(json.loads(result.stdout))


@pytest.mark.parametrize("n", [60, 200])
def test_whole_numbers_are_exact(n: int, run: Run) -> None:
    facts = sikku.load("hilbert", n=n).measure()
    assert facts["n"] == n
    assert facts["drawn"] == 4**n - 1
    assert isinstance(facts["drawn"], int)
    assert facts["length"] == 4**n - 1
    assert facts["box"][0] == 1 - 2**n
    assert facts == exact(json.loads(run("measure", "hilbert", "-n", str(n), "--json").stdout))


def test_numbers_of_many_digits() -> None:
    assert sikku.load("hilbert", n=16_000).measure()["drawn"] == 4**16_000 - 1
    assert sikku.load("hilbert", n=100_000).measure()["drawn"].startswith("about 10^")


@pytest.mark.parametrize("name", KOLAMS)
def test_kolams_are_those_of_the_program(name: str, run: Run) -> None:
    assert sikku.load(name).kolam() == json.loads(run("kolam", name, "--json").stdout)


@pytest.mark.parametrize("name", WORDS)
def test_words_are_those_of_the_program(name: str, run: Run) -> None:
    word = run("derive", name).stdout.decode().rstrip("\n")
    assert "".join(map(str, sikku.load(name).word())) == word.replace(" ", "")


def test_maps_have_no_words() -> None:
    with pytest.raises(sikku.Error, match="this pattern is a map"):
        list(sikku.load("checkers").word())


def test_modules() -> None:
    pattern = sikku.load(text="axiom: A(1)F(2)B\nderivation length: 3\nA(x) --> F(x)A(x / 2)\n")
    assert list(pattern.word()) == [
        ("F", (1.0,)), ("F", (0.5,)), ("F", (0.25,)), ("A", (0.125,)), ("F", (2.0,)), ("B", ()),
    ]  # fmt: skip
    assert "".join(map(str, pattern.word(1))) == "F(1)A(0.5)F(2)B"
    assert next(pattern.word(0)).name == "A"
    homomorphism = sikku.load(text="axiom: XY\ninterpret:\nX --> FF\n")
    assert "".join(map(str, homomorphism.word())) == "XY"
    assert "".join(map(str, homomorphism.word(interpreted=True))) == "FFY"


def test_long_words_need_little_memory() -> None:
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    names = [module.name for module in itertools.islice(sikku.load("hilbert").word(60), 300_000)]
    assert names.count("F") > 50_000
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 40_000


def threads() -> int:
    return len(os.listdir("/proc/self/task"))


def test_words_may_be_dropped() -> None:
    pattern = sikku.load("hilbert", n=60)
    before = threads()
    for _ in range(50):
        next(pattern.word())
        pattern.word()
    assert threads() == before
    half = [pattern.word() for _ in range(20)]
    for word in half:
        next(word)
    assert threads() == before + 20
    del word, half
    assert threads() == before
    word = pattern.word(2)
    assert len(list(word)) > 0
    assert list(word) == []
    assert threads() == before


def test_words_may_be_open_when_python_ends() -> None:
    code = "import sikku; kept = [sikku.load('hilbert').word(60) for _ in range(5)]; print(next(kept[0]))"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, timeout=60)
    assert (result.returncode, result.stdout, result.stderr) == (0, b"-\n", b"")


def test_words_after_a_fork() -> None:
    word = sikku.load("hilbert").word(60)
    next(word)
    child = os.fork()
    if child == 0:
        try:
            for _ in word:
                pass
        except sikku.Error:
            os._exit(0)
        os._exit(1)
    assert os.waitpid(child, 0)[1] == 0
    assert next(word)


def test_errors_of_words() -> None:
    negative = "axiom: F(1)\nderivation length: 2\nF(x) --> F(x) : 0 - x\nF(x) --> F(x)F(x) : x\n"
    word = sikku.load(text=negative).word()
    with pytest.raises(sikku.WordError, match="negative"):
        next(word)
    assert list(word) == []
    with pytest.raises(sikku.SettingError):
        sikku.load("hilbert").word(-1)


def turtle_strokes(pattern: sikku.Pattern, angle: float, heading: float) -> list[list[complex]]:
    """The strokes of a word of `F f + - [ ]`, walked in Python; degrees. `+` turns to the right."""
    place, strokes = 0j, [[0j]]
    kept: list[tuple[complex, float]] = []
    for name, parameters in pattern.word():
        if name in "Ff" and name:
            length = parameters[0] if parameters else 1.0
            place += length * cmath.exp(1j * math.radians(heading))
            strokes = [*strokes[:-1], [*strokes[-1], place]] if name == "F" else [*strokes, [place]]
        elif name in "+-":
            heading += -angle if name == "+" else angle
        elif name == "[":
            kept.append((place, heading))
        elif name == "]":
            place, heading = kept.pop()
            strokes = [*strokes, [place]]
    return [stroke for stroke in strokes if len(stroke) > 1]


@pytest.mark.parametrize(
    ("name", "n", "angle", "heading"),
    [("hilbert", 4, 90, 90), ("islands-and-lakes", 1, 90, 90), ("plant-a", 2, 25.7, 90), ("arrowhead", 4, 60, 180)],
)
def test_paths_are_those_of_a_turtle_in_python(name: str, n: int, angle: float, heading: float) -> None:
    pattern = sikku.load(name, n=n)
    points, strokes = pattern.path()
    expected = turtle_strokes(pattern, angle, heading)
    assert points.dtype == numpy.float64 and strokes.dtype == numpy.int64
    assert strokes.tolist() == list(itertools.accumulate(map(len, expected), initial=0))
    flat = numpy.array([place for stroke in expected for place in stroke])
    assert numpy.allclose(points, numpy.stack([flat.real, flat.imag], axis=1), atol=1e-9)


def test_a_path_of_a_million_points() -> None:
    points, strokes = sikku.load("hilbert").path(10)
    assert points.shape == (4**10, 2)
    assert strokes.tolist() == [0, 4**10]
    steps = numpy.abs(numpy.diff(points, axis=0)).sum(axis=1)
    assert (steps == 1).all()
    assert len(numpy.unique(points, axis=0)) == len(points)


def test_paths_in_space_and_of_splines() -> None:
    points, strokes = sikku.load("bush-3d", n=3).path()
    assert points.shape[1] == 3
    assert strokes[-1] == len(points)
    snake = sikku.load("snake-kolam")
    points, strokes = snake.path()
    assert len(points) - (len(strokes) - 1) == snake.kolam()["segments"]
    empty = sikku.load(text="axiom: +\n").path()
    assert empty.points.shape == (0, 2)
    assert empty.strokes.tolist() == [0]


def test_limits_of_paths() -> None:
    with pytest.raises(sikku.BudgetError):
        sikku.load("hilbert").path(20)
    with pytest.raises(sikku.BudgetError):
        sikku.load("hilbert").path(8, budget=1000)
    with pytest.raises(sikku.BudgetError, match="memory"):
        sikku.load("hilbert").path(30, budget=1e30)
