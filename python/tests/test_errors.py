"""Errors, damaged input, ctrl-C, threads."""

from __future__ import annotations

import pickle
import random
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest
import sikku
from conftest import SOURCE


def test_pattern_errors_have_places() -> None:
    with pytest.raises(sikku.PatternError) as caught:
        sikku.load("mine", text="axiom: F\nangel factor: 6\nF --> F+(F\n")
    error = caught.value
    assert (error.file, error.line, error.column) == ("mine", 2, 1)
    assert error.message == "unknown key 'angel factor'; did you mean 'angle factor'?"
    assert [(one.line, one.is_warning) for one in error.diagnostics] == [(2, False), (3, False)]
    assert "mine:2:1: " in str(error)
    assert isinstance(error, ValueError)
    assert pickle.loads(pickle.dumps(error)).diagnostics == error.diagnostics


def test_keys_of_prints_and_scores_are_checked() -> None:
    with pytest.raises(sikku.PatternError) as caught:
        sikku.load(text="axiom: F\nstroke: 3x\ntempo: never\n")
    assert [one.line for one in caught.value.diagnostics] == [2, 3]
    assert caught.value.file == "<text>"


@pytest.mark.parametrize(
    ("settings", "option", "value"),
    [
        ({"angle_factor": "x"}, "angle factor", "x"),
        ({"nothing": 1}, "nothing", "1"),
        ({"variant": "nothing"}, "variant", "nothing"),
        ({"n": -1}, "n", "-1"),
        ({"a=b": 1}, "a=b", "1"),
        ({"variant": "a=b"}, "variant", "a=b"),
        ({"title": "a\nb"}, "title", "a\nb"),
    ],
)
def test_errors_of_settings(settings: dict[str, Any], option: str, value: str) -> None:
    with pytest.raises(sikku.SettingError) as caught:
        sikku.load("hilbert", **settings)
    assert (caught.value.option, caught.value.value) == (option, value)


@pytest.mark.parametrize(
    ("option", "value"), [("n", "x"), ("seed", "q"), ("dots", "maybe"), ("stroke", "zz"), ("step", "zz")]
)
def test_options_and_settings_raise_the_same(option: str, value: str) -> None:
    with pytest.raises(sikku.SettingError) as caught:
        sikku.load("hilbert").draw("svg", **{option: value})
    assert (caught.value.option, caught.value.value) == (option, value)


@pytest.mark.parametrize("name", ["aaa.lsys", "zebra.lsys"])
def test_errors_of_a_pattern_and_a_setting_are_those_of_the_pattern(name: str) -> None:
    with pytest.raises(sikku.PatternError) as caught:
        sikku.load(name, text="axiom: F\nF --> F(\n", angle_factor="x")
    assert sorted({one.line > 0 for one in caught.value.diagnostics}) == [False, True]
    with pytest.raises(sikku.PatternError):
        sikku.load(name, text="axiom = F(a)\nF --> FF\n")


def test_unknown_gallery_file(tmp_path: Path) -> None:
    with pytest.raises(sikku.NotFoundError, match="kolam-library"):
        sikku.gallery(tmp_path / "out", file="nothing")
    with pytest.raises(sikku.NotFoundError, match="did you mean 'hilbert'"):
        sikku.gallery(tmp_path / "out", ["hilbrt"])


def test_option_errors() -> None:
    pattern = sikku.load("hilbert")
    with pytest.raises(sikku.SettingError) as caught:
        pattern.draw(dot_spacing="3x")
    assert (caught.value.option, caught.value.value) == ("dot-spacing", "3x")
    assert str(caught.value).startswith("dot_spacing='3x': ")
    assert pickle.loads(pickle.dumps(caught.value)).option == "dot-spacing"
    with pytest.raises(sikku.SettingError, match="did you mean"):
        pattern.draw(dot_spacin="7mm")
    with pytest.raises(sikku.SettingError) as caught:
        pattern.draw("xyz")
    assert (caught.value.option, caught.value.value) == ("format", "xyz")
    with pytest.raises(sikku.SettingError):
        pattern.draw(dpi=float("nan"))
    with pytest.raises(sikku.SettingError):
        sikku.load("hilbert", n=2.5)  # type: ignore[arg-type]
    with pytest.raises(TypeError):
        pattern.draw(size=object())  # type: ignore[arg-type]
    with pytest.raises(TypeError):
        sikku.load()


def test_names_that_do_not_exist() -> None:
    with pytest.raises(sikku.NotFoundError, match="did you mean 'snake-kolam'"):
        sikku.load("snake-kolm")
    with pytest.raises(sikku.Error, match="absent.lsys"):
        sikku.load("absent.lsys")


def test_other_errors() -> None:
    with pytest.raises(sikku.BudgetError):
        sikku.load("hilbert", n=30).draw()
    with pytest.raises(sikku.WordError, match="]"):
        sikku.load(text="axiom: F]\n").draw()
    with pytest.raises(sikku.ScoreError):
        sikku.load(text="axiom: +\n").play()
    with pytest.raises(sikku.Error, match="nothing to draw"):
        sikku.load(text="axiom: +\n").draw()
    with pytest.raises(sikku.Error):
        sikku.load(text="axiom: +\n").kolam()


def test_warnings_of_patterns() -> None:
    with pytest.warns(sikku.SikkuWarning, match=r"<text>:2:1: warning: words contain 'A' with [0-9]+ parameters, never with 2"):
        sikku.load(text="axiom: A(1)F\nA(x, y) --> F\n")


def damaged() -> list[bytes]:
    chance = random.Random(1)
    texts = [b"", b"\0", b"\xff\xfe", b"axiom: F" * 100_000, b"/*", b"axiom: " + b"[" * 100_000]
    for file in sorted((SOURCE / "patterns").rglob("*.lsys"))[::4]:
        text = bytearray(file.read_bytes())
        for _ in range(6):
            text[chance.randrange(len(text))] = chance.randrange(256)
        texts.append(bytes(text))
        texts.append(bytes(text[: chance.randrange(len(text))]))
    return texts


@pytest.mark.filterwarnings("ignore::sikku.SikkuWarning")
@pytest.mark.parametrize("text", damaged(), ids=lambda text: str(len(text)))
def test_damaged_texts(text: bytes) -> None:
    """Each text is a valid pattern or raises an error of sikku; nothing else is raised."""
    try:
        pattern = sikku.load(text=text)
        pattern.measure(budget=1e5)
        pattern.draw(budget=1e5)
        pattern.path(budget=1e5)
        pattern.notes(budget=1e5)
        pattern.kolam(budget=1e5)
    except sikku.Error as error:
        assert str(error)


def test_surrogates_are_invalid_utf8() -> None:
    with pytest.raises(sikku.PatternError, match="UTF-8"):
        sikku.load(text="axiom: F\ud800\n")


# Long words that are not stored.
TURNS = "sikku.load(text='axiom: f\\nf --> f+f\\nforward: F\\n')"
CHANCE = "sikku.load(text='axiom: F\\nF --> FF : 1\\nF --> F+F : 1\\nderivation length: 60\\n')"

LONG_CALLS = [
    "sikku.load('hilbert', n=13).draw(budget=1e12)",
    "sikku.load('hilbert', n=13).save('x.svg', budget=1e12)",
    f"{TURNS}.path(38, budget=1e14)",
    f"{CHANCE}.measure(budget=1e12)",
    "sikku.load('hilbert', n=10).kolam(budget=1e12)",
    "sikku.load('hilbert-in-c', n=14).play(budget=1e12)",
    "sum(1 for _ in sikku.load('hilbert').word(60))",
    "list(sikku.load(text='axiom: A\\nderivation length: 40\\nA < A --> AA\\nA --> AA\\n').word())",
]


@pytest.mark.parametrize("call", LONG_CALLS)
def test_long_calls_stop_on_an_interrupt(call: str, tmp_path: Path) -> None:
    # A shell lets what it starts in the background ignore the signal.
    heeds = "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
    attempt = f"try:\n    {call}\nexcept KeyboardInterrupt:\n    print('stopped')\n"
    code = f"{heeds}import sikku\nprint('ready', flush=True)\n{attempt}"
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, cwd=tmp_path)
    try:
        assert child.stdout is not None
        assert child.stdout.readline() == b"ready\n"
        time.sleep(0.4)
        began = time.monotonic()
        child.send_signal(signal.SIGINT)
        output, _ = child.communicate(timeout=60)
    finally:
        child.kill()
    assert (output, child.returncode) == (b"stopped\n", 0)
    assert time.monotonic() - began < 5
    assert list(tmp_path.iterdir()) == []


def test_exceptions_of_other_signals_arrive() -> None:
    class Alarm(Exception):
        pass

    def ring(*_: object) -> None:
        raise Alarm

    before = signal.signal(signal.SIGALRM, ring)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with pytest.raises(Alarm):
            sikku.load(text="axiom: f\nf --> f+f\nforward: F\n").path(38, budget=1e14)
    finally:
        signal.signal(signal.SIGALRM, before)


def test_other_threads_run_during_long_calls() -> None:
    ticks = 0
    is_over = threading.Event()

    def count() -> None:
        nonlocal ticks
        while not is_over.is_set():
            ticks += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count, daemon=True)
    pattern = sikku.load(text="axiom: f\nf --> f+f\nforward: F\n")
    thread.start()
    before = ticks
    pattern.path(26, budget=1e9)
    during = ticks - before
    is_over.set()
    thread.join()
    assert during >= 5


def test_a_pattern_serves_several_threads() -> None:
    pattern = sikku.load("snake-kolam")
    expected = pattern.draw()
    drawn: list[object] = []
    threads = [threading.Thread(target=lambda: drawn.append(pattern.draw())) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert drawn == [expected] * 8
