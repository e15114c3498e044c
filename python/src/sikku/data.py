"""Words, lines, tiles and notes as data."""

from __future__ import annotations

import os
import re
import sys
import warnings
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Optional, Union

import numpy
import numpy.typing

from sikku import errors
from sikku.lib import _core
from sikku.settings import number_text

__all__ = ["Module", "Notes", "Path", "Production", "Tiles"]

PathName = Union[str, "os.PathLike[str]"]
Numbers = numpy.typing.NDArray[numpy.float64]
Wholes = numpy.typing.NDArray[numpy.int64]
Indices = numpy.typing.NDArray[numpy.int32]
Bytes = numpy.typing.NDArray[numpy.uint8]


class Module(NamedTuple):
    """A symbol of a word with its parameters."""

    name: str
    """The symbol without parameters: `F`, `+`, `@o`."""
    parameters: tuple[float, ...]
    """Parameters; empty for most symbols."""

    def __str__(self) -> str:
        """The module as written in patterns: `F(2.5)`."""
        return f"{self.name}({','.join(map(number_text, self.parameters))})" if self.parameters else self.name


class Production(NamedTuple):
    """A production, as its pattern states it."""

    predecessor: str
    successor: str
    left: Optional[str]
    """Left context."""
    right: Optional[str]
    """Right context."""
    condition: Optional[str]
    weight: Optional[str]
    """Weight among the productions of the same predecessor, for random choices."""
    table: Optional[str]
    """Name of the table that contains it; None for productions of all tables."""
    interprets: bool
    """True for productions below `interpret:`."""

    def __str__(self) -> str:
        """The production in one line: `A(x) : x > 1 --> B`."""
        left = f"{self.left} < " if self.left else ""
        right = f" > {self.right}" if self.right else ""
        condition = f" : {self.condition}" if self.condition else ""
        weight = f" : {self.weight}" if self.weight else ""
        return f"{left}{self.predecessor}{right}{condition} --> {self.successor}{weight}"


class Path(NamedTuple):
    """The lines of a drawing, in turtle steps; the turtle starts at the origin."""

    points: Numbers
    """float64 of shape (points, 2), or (points, 3) for drawings in space."""
    strokes: Wholes
    """int64 of shape (strokes + 1,): stroke i consists of `points[strokes[i]:strokes[i + 1]]`, at least two points."""

    @property
    def lines(self) -> list[Numbers]:
        """The points of each stroke, as views of `points`: for example for matplotlib's LineCollection."""
        return numpy.split(self.points, self.strokes[1:-1]) if len(self.strokes) > 1 else []


@dataclass(frozen=True, eq=False)
class Tiles:
    """The tiles of a drawing, in drawing order, without duplicates and polygons that are open or cross themselves.

    Each array has one entry per tile, unless noted.
    """

    certificate: dict[str, Any]
    """Facts of `sikku tiling --json`: tiling (True or False), exact, violations, gaps, shapes, figures, symmetry, …"""
    corners: Numbers
    """float64 of shape (corners, 2), in turtle steps, anticlockwise; those on straight stretches are left out."""
    begins: Wholes
    """int64 of shape (tiles + 1,): tile i has the corners `corners[begins[i]:begins[i + 1]]`."""
    number: Wholes
    """Number of the polygon in the drawing, from 1."""
    shape: Indices
    """Congruent tiles, mirror images included, have the same number: an index into `certificate["shapes"]`."""
    orientation: Indices
    """Tiles that are equal up to translation have the same number."""
    colour: Indices
    """Colour index of the pattern."""
    is_reflected: numpy.typing.NDArray[numpy.bool_]
    """True for tiles of the other hand than the first one of their shape."""
    letter: list[str]
    """The symbol whose production drew the tile; "" where productions have contexts, parameters or chance."""
    neighbours: Indices
    """int32 of shape (pairs, 2): indices of tiles that share a piece of an edge, each pair once."""
    neighbour_colour: Indices
    """Numbers that differ between neighbours; empty if tiles overlap."""

    def __len__(self) -> int:
        return len(self.shape)

    @property
    def polygons(self) -> list[Numbers]:
        """The corners of each tile, as views of `corners`: for example for matplotlib's PolyCollection."""
        return numpy.split(self.corners, self.begins[1:-1]) if len(self) > 0 else []


@dataclass(frozen=True, eq=False)
class Notes:
    """The notes of a score, sorted by onset, then by voice. Each array has one entry per note."""

    onset: Wholes
    """Onsets in ticks, int64. A quarter note has 480 ticks."""
    duration: Wholes
    """Durations in ticks, int64, greater than 0."""
    key: Numbers
    """MIDI keys, float64; 60 is C4, fractions are microtones."""
    velocity: Bytes
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
    changes: list[tuple[int, float, tuple[int, int]]] = field(default_factory=list)
    """Where sections begin with another tempo or meter: tick, quarter notes per minute, meter."""
    upbeat: int = 0
    """Ticks before the first bar line; 0: the score begins at one."""

    def __len__(self) -> int:
        return len(self.onset)

    def seconds(self, ticks: Any) -> Any:
        """Converts ticks, a number or an array such as `onset`, to seconds."""
        tick = 60.0 / (self.tempo * _core.ticks_per_quarter)
        seconds = ticks * tick
        for onset, tempo, _ in self.changes:
            after = 60.0 / (tempo * _core.ticks_per_quarter)
            seconds = seconds + numpy.maximum(ticks - onset, 0) * (after - tick)
            tick = after
        return seconds

    def columns(self) -> dict[str, Any]:
        """The arrays of one dimension by name, as pandas.DataFrame and polars.DataFrame take them."""
        return {name: getattr(self, name) for name in ("onset", "duration", "key", "velocity", "voice")}


def notes_from(listed: tuple[Any, ...]) -> Notes:
    """Notes of the arrays that the compiled part returns."""
    (onset, duration, key, velocity, voice, curve), end, tempo, beats, unit, changes, upbeat = listed
    return Notes(onset, duration, key, velocity, voice, curve, end, tempo, (beats, unit), changes, upbeat)


def only(outputs: dict[str, Union[str, bytes]]) -> Union[str, bytes]:
    """The content of a single output. Raises Error if there are several."""
    if len(outputs) != 1:
        raise errors.Error(f"this output has {len(outputs)} files; save() writes them")
    return next(iter(outputs.values()))


def warn(text: str) -> None:
    """Issues a SikkuWarning at the line outside of this package that called it."""
    frame = sys._getframe(1)
    level = 2
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith("sikku."):
        frame = frame.f_back
        level += 1
    warnings.warn(text, errors.SikkuWarning, stacklevel=level)


def warn_of(remarks: list[tuple[bool, str]]) -> list[str]:
    """Issues the warnings among the remarks and returns the facts."""
    for is_warning, text in remarks:
        if is_warning:
            warn(text)
    return [text for is_warning, text in remarks if not is_warning]


def exact(value: object) -> object:
    """Converts strings of digits, which JSON contains for large integers, to int, also in lists and dicts."""
    if isinstance(value, str):
        # Python refuses to convert more than 4300 digits at once (CVE-2020-10735).
        return _whole_of_digits(value) if re.fullmatch(r"-?[0-9]+", value) else value
    if isinstance(value, list):
        return [exact(one) for one in value]
    if isinstance(value, dict):
        return {name: exact(one) for name, one in value.items()}
    return value


def _whole_of_digits(digits: str) -> int:
    if digits.startswith("-"):
        return -_whole_of_digits(digits[1:])
    if len(digits) <= 4000:
        return int(digits)
    half = len(digits) // 2
    power: int = 10 ** (len(digits) - half)
    return _whole_of_digits(digits[:half]) * power + _whole_of_digits(digits[half:])
