"""Patterns, and the prints, scores, measures and data made from them."""

from __future__ import annotations

import html
import itertools
import json
import os
import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple, Optional, Union

import numpy
import numpy.typing

from sikku import errors
from sikku.lib import _core
from sikku.settings import Texts, Value, number_text, to_options, to_settings, whole

__all__ = ["Module", "Notes", "Path", "Pattern", "PatternInfo", "load", "patterns"]

PathName = Union[str, "os.PathLike[str]"]
Numbers = numpy.typing.NDArray[numpy.float64]
Wholes = numpy.typing.NDArray[numpy.int64]

_most_shown = 2_000_000  # derivation nodes of the drawings and pages that notebooks show


class Module(NamedTuple):
    """A symbol of a word with its parameters."""

    name: str
    """The symbol without parameters: `F`, `+`, `@o`."""
    parameters: tuple[float, ...]
    """Parameters; empty for most symbols."""

    def __str__(self) -> str:
        """The module as written in patterns: `F(2.5)`."""
        return f"{self.name}({','.join(map(number_text, self.parameters))})" if self.parameters else self.name


class Path(NamedTuple):
    """The lines of a drawing, in turtle steps; the turtle starts at the origin."""

    points: Numbers
    """float64 of shape (points, 2), or (points, 3) for drawings in space."""
    strokes: Wholes
    """int64 of shape (strokes + 1,): stroke i consists of `points[strokes[i]:strokes[i + 1]]`, at least two points."""


@dataclass(frozen=True)
class Notes:
    """The notes of a score, sorted by onset, then by voice. Each array has one entry per note."""

    onset: Wholes
    """Onsets in ticks, int64. A quarter note has 480 ticks."""
    duration: Wholes
    """Durations in ticks, int64, greater than 0."""
    key: Numbers
    """MIDI keys, float64; 60 is C4, fractions are microtones."""
    velocity: numpy.typing.NDArray[numpy.uint8]
    """Loudness, 1 to 127."""
    voice: numpy.typing.NDArray[numpy.int16]
    """Voices, counted from 0."""
    curve: Numbers
    """Pieces of the curve that produce the notes, float64 of shape (notes, 2, 2), in turtle steps."""
    end: int
    """End of the score in ticks, rests included."""
    tempo: float
    """Quarter notes per minute."""
    meter: tuple[int, int]
    """Beats per bar and their unit: (6, 8)."""

    def __len__(self) -> int:
        return len(self.onset)

    def seconds(self, ticks: Any) -> Any:
        """Converts ticks, a number or an array such as `onset`, to seconds."""
        return ticks * (60.0 / (self.tempo * _core.ticks_per_quarter))


class PatternInfo(NamedTuple):
    """A bundled pattern."""

    name: str
    kind: str
    """Name of its folder: kolams, kolam-library, tilings, curves, plants, words or melodies."""
    title: str
    source: str
    """Source of the pattern in the literature."""


def _warn(remarks: list[tuple[bool, str]]) -> list[str]:
    """Issues the warnings among the remarks and returns the facts."""
    for is_warning, text in remarks:
        if is_warning:
            warnings.warn(text, errors.SikkuWarning, stacklevel=4)
    return [text for is_warning, text in remarks if not is_warning]


def _exact(value: object) -> object:
    """Converts strings of digits, which JSON contains for large integers, to int, also in lists and dicts."""
    if isinstance(value, str):
        # Python refuses to convert more than 4300 digits at once (CVE-2020-10735).
        return _whole_of_digits(value) if re.fullmatch(r"-?[0-9]+", value) else value
    if isinstance(value, list):
        return [_exact(one) for one in value]
    if isinstance(value, dict):
        return {name: _exact(one) for name, one in value.items()}
    return value


def _whole_of_digits(digits: str) -> int:
    if digits.startswith("-"):
        return -_whole_of_digits(digits[1:])
    if len(digits) <= 4000:
        return int(digits)
    half = len(digits) // 2
    power: int = 10 ** (len(digits) - half)
    return _whole_of_digits(digits[:half]) * power + _whole_of_digits(digits[half:])


def _format_of(path: str) -> tuple[str, str]:
    """The interpreter and the format of a file by its extension. Raises SettingError."""
    name = os.path.basename(path).lower()
    extension = os.path.splitext(name)[1][1:]
    for score in ("notes.svg", "score.pdf"):
        if name.endswith("." + score):
            return "scores", score
    known = []
    for interpreter in ("prints", "scores"):
        for format, alias, _ in _core.formats(interpreter):
            if extension and extension in (format, alias):
                return interpreter, format
            known.append(format)
    raise errors.SettingError("format", extension, f"unknown extension; expected {', '.join(known)}")


class Pattern:
    """A pattern that was read, checked and compiled. Immutable; several threads may use it at once.

    Options of methods are those of `sikku draw` and `sikku play`, with underscores instead of hyphens
    (`dot_spacing="7mm"`), and keys and defines of the pattern (`angle_factor=6`). Flags are True or False; numbers may
    be numbers or text. Long calls let other threads run, and stop on Ctrl-C with KeyboardInterrupt and write nothing.
    """

    __slots__ = ("_document", "__weakref__")

    def __init__(self, document: _core.Document) -> None:
        """Not public; use sikku.load()."""
        self._document = document

    @property
    def name(self) -> str:
        """Name of the pattern in messages: the path of its file, or `NAME.lsys`."""
        return self._document.name

    @property
    def title(self) -> str:
        """Value of the key `title`, or an empty string."""
        return self._document.key("title")

    @property
    def source(self) -> str:
        """Value of the key `source`, which cites the literature, or an empty string."""
        return self._document.key("source")

    @property
    def text(self) -> str:
        """Text of the pattern as read."""
        return self._document.source_text

    @property
    def n(self) -> int:
        """Derivation length."""
        return self._document.steps

    @property
    def is_melody(self) -> bool:
        """True if the pattern sets a key of melodies, such as `scale`."""
        return self._document.is_melody

    def __repr__(self) -> str:
        return f"<sikku.Pattern {self.title or self.name!r}, n = {self.n}>"

    def with_settings(
        self, *, n: Optional[int] = None, seed: Optional[int] = None, **settings: Value
    ) -> Pattern:
        """Returns a copy of the pattern with another derivation length, seed, keys or defines.

        Raises PatternError.
        """
        texts = _shared_settings(n, seed) + to_settings(settings)
        return Pattern(self._document.with_settings(texts))

    def draw(self, format: str = "svg", **options: Value) -> Union[str, bytes]:
        """Draws a print or a model and returns it: text for SVG, HP-GL and G-code, otherwise bytes.

        format: svg, pdf, png, tif, jpg, exr, gif, hpgl, gcode, dxf, obj, glb or stl.
        options: `n=3`, `size="A3"`, `stroke="0.3mm navy"`, `dots=True`, … (docs/commands.md).

        Warnings are issued as SikkuWarning. Raises SettingError, PatternError, BudgetError, WordError, and Error if
        nothing is drawn or the output has several files, which save() writes.
        """
        return self._made("prints", format, options)

    def play(self, format: str = "mid", **options: Value) -> Union[str, bytes]:
        """Plays the pattern and returns the score: text for MusicXML, LilyPond, SVG and HTML, otherwise bytes.

        format: mid, musicxml, mxl, ly, pdf (printed by LilyPond), abc, wav, flac, csd, sco, strudel, svg (curve and piano
        roll) or html (a page that plays).
        options: `n=5`, `scale="dorian"`, `bars=16`, `tempo=96`, … (docs/commands.md).

        Warnings are issued as SikkuWarning. Raises SettingError, PatternError, BudgetError, WordError, ScoreError.
        """
        return self._made("scores", format, options)

    def save(self, path: PathName, **options: Value) -> list[str]:
        """Writes a print, a model or a score; the extension of `path` selects the format.

        Each file appears whole or not at all, because it is written to a temporary name and renamed. Some outputs have
        several files, such as models (.obj and .mtl) and tiled prints (`tile="A4"`). The extension `.notes.svg` selects
        the curve and the piano roll of a melody, `.score.pdf` its printed score.

        Returns facts about the output, such as the length that a plotter draws. Options, warnings and errors are those
        of draw() and play(). Raises Error if a file cannot be written.
        """
        interpreter, format = _format_of(os.fsdecode(path))
        remarks = _core.write(
            self._document, interpreter, format, to_options(interpreter, options), os.fsencode(path)
        )
        return _warn(remarks)

    def measure(self, *, budget: float = 2e8) -> dict[str, Any]:
        """Measures the word, without deriving it if productions have no contexts: n = 60 costs as little as n = 6.

        Returns the output of `sikku measure --json`: title, n, symbols, counts, drawn, moves, length, box, ink, end,
        heading, closed, depth, derived. Integers are exact and of any size; those above 10,000 digits are given as
        text, "about 10^k". Lengths are in turtle steps, headings in degrees.

        budget: maximum number of derivation nodes visited, if the word has to be derived.
        Raises BudgetError, WordError.
        """
        facts: dict[str, Any] = json.loads(_core.measure(self._document, budget))
        return {name: value if name == "title" else _exact(value) for name, value in facts.items()}

    def kolam(self, *, budget: float = 2e8) -> dict[str, Any]:
        """Examines the drawing as a kolam: lines, crossings, faces, symmetry, dots.

        Returns the output of `sikku kolam --json` (docs/commands.md). A million segments take 3 s and 250 MB.

        Raises BudgetError, WordError, and Error if nothing is drawn.
        """
        facts: dict[str, Any] = json.loads(_core.kolam(self._document, budget))
        return facts

    def word(self, n: Optional[int] = None, *, interpreted: bool = False) -> Iterator[Module]:
        """Returns an iterator over the modules of the word, which is derived as it is read.

        Words of any length need little memory, unless productions have contexts. Discarding the iterator ends the
        derivation. The iterator cannot be used after os.fork(). Cost: about 10 ns per module.

        n: derivation length, instead of the pattern's.
        interpreted: whether to apply the productions under `interpret:`.
        Raises PatternError; the iterator raises BudgetError, WordError.
        """
        return itertools.chain.from_iterable(_core.WordIterator(self._derived(n), interpreted))

    def path(self, n: Optional[int] = None, *, budget: float = 2e8) -> Path:
        """Returns the lines that the turtle draws, as NumPy arrays.

        Splines (`line: spline`) are given as control polygons; polygons, discs and surfaces are left out. Cost:
        about 20 ns and 16 bytes per point.

        n: derivation length, instead of the pattern's.
        budget: maximum number of derivation nodes visited.
        Raises PatternError, WordError, BudgetError (also if the points would take more than half of the memory).
        """
        return Path(*_core.path(self._derived(n), budget))

    def notes(self, **options: Value) -> Notes:
        """Returns the notes of the score that play() writes with the same options, as NumPy arrays.

        Cost: about 200 bytes per note. Raises SettingError, PatternError, BudgetError, WordError, ScoreError.
        """
        arrays, end, tempo, beats, unit = _core.notes(self._document, to_options("scores", options))
        onset, duration, key, velocity, voice, curve = arrays
        return Notes(onset, duration, key, velocity, voice, curve, end, tempo, (beats, unit))

    def _derived(self, n: Optional[int]) -> _core.Document:
        return self._document if n is None else self.with_settings(n=n)._document

    def _made(self, interpreter: str, format: str, options: dict[str, Value]) -> Union[str, bytes]:
        outputs, remarks = _core.make(self._document, interpreter, format, to_options(interpreter, options))
        _warn(remarks)
        if len(outputs) != 1:
            raise errors.Error(f"this output has {len(outputs)} files; save() writes them")
        content: Union[str, bytes] = next(iter(outputs.values()))
        return content

    def _repr_svg_(self) -> Optional[str]:
        """The drawing, for notebooks; None for melodies and drawings of more than 2 million nodes."""
        if self.is_melody:
            return None
        return self._shown("prints", "svg")

    def _repr_html_(self) -> Optional[str]:
        """A page that plays the melody, in a frame, for notebooks; None for other patterns."""
        if not self.is_melody:
            return None
        page = self._shown("scores", "html")
        if page is None:
            return None
        return (
            f'<iframe srcdoc="{html.escape(page)}" sandbox="allow-scripts" title="{html.escape(self.title)}" '
            'style="width: 100%; height: 640px; border: 0"></iframe>'
        )

    def _shown(self, interpreter: str, format: str) -> Optional[str]:
        try:
            outputs, _ = _core.make(self._document, interpreter, format, [("budget", str(_most_shown))])
        except errors.Error:  # over the budget, or nothing is drawn
            return None
        return str(next(iter(outputs.values())))


def _shared_settings(n: Optional[int], seed: Optional[int]) -> Texts:
    texts: Texts = []
    if n is not None:
        texts.append(("derivation length", whole("n", n)))
    if seed is not None:
        texts.append(("seed", whole("seed", seed)))
    return texts


def sheet(path: PathName, *drawings: Union[Pattern, tuple[Pattern, dict[str, Value]]], **options: Value) -> list[str]:
    """Draws several patterns on one page; the extension of `path` selects the format.

    drawings: patterns, or pairs of a pattern and options of its own: `(kolam, {"border": "rope", "x": "20mm"})`.
    options: those of `sikku sheet`: `columns=2`, `gutter="20mm"`, `dots=True`, `size="A2"`, …

    Returns facts about the output. Warnings are issued as SikkuWarning. Raises SettingError, PatternError,
    BudgetError, WordError, and Error if a drawing has no room or the file cannot be written.
    """
    items = [one if isinstance(one, tuple) else (one, {}) for one in drawings]
    _, format = _format_of(os.fsdecode(path))
    remarks = _core.write_sheet(
        [(pattern._document, to_options("prints", own)) for pattern, own in items],
        format,
        to_options("sheet", options),
        os.fsencode(path),
    )
    return _warn(remarks)


def load(
    pattern: Optional[PathName] = None,
    *,
    text: Union[str, bytes, None] = None,
    n: Optional[int] = None,
    seed: Optional[int] = None,
    variant: str = "",
    **settings: Value,
) -> Pattern:
    """Reads, checks and compiles a pattern.

    pattern: name of a bundled pattern, or path of a pattern file; with `text`, the name of the text in messages.
    text: text of the pattern, instead of a file.
    n: derivation length, instead of the pattern's.
    seed: random seed, 0 or more.
    variant: name of one of the pattern's variants.
    settings: keys and defines of the pattern: `angle_factor=6`, `stroke="0.5mm navy"`.

    Warnings are issued as SikkuWarning. Raises PatternError with every error and its place, NotFoundError,
    SettingError, and Error if the file cannot be read.
    """
    if pattern is None and text is None:
        raise TypeError("load() needs a pattern or a text")
    name = os.fsencode("<text>" if pattern is None else pattern)
    content = text.encode("utf-8", "surrogatepass") if isinstance(text, str) else text
    texts = _shared_settings(n, seed) + to_settings(settings)
    document, found = _core.load(name, content, variant, texts)
    for warning in found:
        warnings.warn(str(warning), errors.SikkuWarning, stacklevel=2)
    return Pattern(document)


def patterns() -> list[PatternInfo]:
    """Lists the bundled patterns, sorted by kind and name, without arrangements. Takes about 10 ms."""
    return [PatternInfo(*one) for one in _core.patterns()]
