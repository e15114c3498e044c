"""Prints, models and scores of a pattern. `outputs.pyi` states their options; python/stub.py writes it."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Optional, Union

from sikku import errors
from sikku.data import Bytes, Notes, PathName, notes_from, only, warn_of
from sikku.lib import _core
from sikku.settings import Value, to_options

if TYPE_CHECKING:
    from sikku.pattern import Pattern

__all__ = ["Outputs", "Progress", "sheet", "workbook"]

Progress = Callable[[int, float], object]
"""Called some twenty times a second with the units of work (symbols, lines, rows) that are done and those expected, 0 if
their number is unknown. The numbers begin again with each stage. An exception stops the work, which writes nothing."""


class Outputs:
    """The outputs of a pattern."""

    __slots__ = ()
    _document: _core.Document

    def draw(
        self, format: str = "svg", *, progress: Optional[Progress] = None, **options: Value
    ) -> Union[str, bytes]:
        """Draws a print or a model and returns it: text for SVG, HP-GL and G-code, otherwise bytes.

        format: svg, pdf, eps, png, tif, jpg, exr, gif, hpgl, gcode, dxf, obj, glb or stl.
        options: `n=3`, `size="A3"`, `stroke="0.3mm navy"`, `dots=True`, … (docs/commands.md).
        progress: called with the units of work that are done and those expected.

        Warnings are issued as SikkuWarning. Raises SettingError, PatternError, BudgetError, WordError, and Error if
        nothing is drawn or the output has several files, which save() writes.
        """
        return _made(self._document, "prints", format, options, progress)

    def play(
        self, format: str = "mid", *, progress: Optional[Progress] = None, **options: Value
    ) -> Union[str, bytes]:
        """Plays the pattern and returns the score: text for MusicXML, LilyPond, SVG and HTML, otherwise bytes.

        format: mid, musicxml, mxl, ly, pdf (printed by LilyPond), abc, wav, flac, csd, sco, strudel, svg (curve and piano
        roll) or html (a page that plays).
        options: `n=5`, `scale="dorian"`, `bars=16`, `tempo=96`, … (docs/commands.md).
        progress: called with the units of work that are done and those expected.

        Warnings are issued as SikkuWarning. Raises SettingError, PatternError, BudgetError, WordError, ScoreError.
        """
        return _made(self._document, "scores", format, options, progress)

    def save(self, path: PathName, *, progress: Optional[Progress] = None, **options: Value) -> list[str]:
        """Writes a print, a model or a score; the extension of `path` selects the format.

        Each file appears whole or not at all, because it is written to a temporary name and renamed. Some outputs have
        several files, such as models (.obj and .mtl) and tiled prints (`tile="A4"`). The extension `.notes.svg` selects
        the curve and the piano roll of a melody, `.score.pdf` its printed score.

        Returns facts about the output, such as the length that a plotter draws. Options, warnings and errors are those
        of draw() and play(). Raises Error if a file cannot be written.
        """
        interpreter, format = format_of(path)
        values = to_options(interpreter, options)
        return warn_of(_core.write(self._document, interpreter, format, values, os.fsencode(path), progress))

    def pixels(self, *, progress: Optional[Progress] = None, **options: Value) -> Bytes:
        """Draws the pixels that a PNG would have: uint8 of shape (height, width, 4), rows from the top; red, green, blue
        and straight alpha.

        options: those of draw(): `size="A5"`, `dpi=150`, `ground="white"`, …
        Warnings and errors are those of draw().
        """
        pixels, remarks = _core.pixels(self._document, to_options("prints", options), progress)
        warn_of(remarks)
        return pixels

    def notes(self, **options: Value) -> Notes:
        """Returns the notes of the score that play() writes with the same options, as NumPy arrays.

        Cost: about 200 bytes per note. Raises SettingError, PatternError, BudgetError, WordError, ScoreError.
        """
        return notes_from(_core.notes(self._document, to_options("scores", options)))


def sheet(
    path: PathName,
    *drawings: Union[Pattern, tuple[Pattern, dict[str, Value]]],
    progress: Optional[Progress] = None,
    **options: Value,
) -> list[str]:
    """Draws several patterns on one page; the extension of `path` selects the format.

    drawings: patterns, or pairs of a pattern and options of its own: `(kolam, {"border": "rope", "x": "20mm"})`.
    options: those of `sikku sheet`: `columns=2`, `gutter="20mm"`, `dots=True`, `size="A2"`, …
    progress: called with the units of work that are done and those expected.

    Returns facts about the output. Warnings are issued as SikkuWarning. Raises SettingError, PatternError,
    BudgetError, WordError, and Error if a drawing has no room or the file cannot be written.
    """
    items = [one if isinstance(one, tuple) else (one, {}) for one in drawings]
    _, format = format_of(path)
    return warn_of(
        _core.write_sheet(
            [(pattern._document, to_options("prints", own)) for pattern, own in items],
            format,
            to_options("sheet", options),
            os.fsencode(path),
            progress,
        )
    )


def workbook(
    path: PathName,
    *kolams: Union[Pattern, tuple[Pattern, dict[str, Value]]],
    progress: Optional[Progress] = None,
    **options: Value,
) -> list[str]:
    """Writes a workbook of kolams for a class, from easy to hard, as PDF.

    kolams: patterns, or pairs of a pattern and its look: `(kolam, {"border": "rope"})`.
    options: those of `sikku workbook`: `heading="Class 3"`, `booklet=True`, …
    progress: called with the units of work that are done and those expected.

    Returns facts about the output. Warnings are issued as SikkuWarning. Raises SettingError, PatternError,
    BudgetError, WordError, and Error if a kolam has no lines or the file cannot be written.
    """
    items = [one if isinstance(one, tuple) else (one, {}) for one in kolams]
    return warn_of(
        _core.write_workbook(
            [(pattern._document, to_options("prints", own)) for pattern, own in items],
            to_options("workbook", options),
            os.fsencode(path),
            progress,
        )
    )


def _made(
    document: _core.Document,
    interpreter: str,
    format: str,
    options: dict[str, Value],
    progress: Optional[Progress],
) -> Union[str, bytes]:
    outputs, remarks = _core.make(document, interpreter, format, to_options(interpreter, options), progress)
    warn_of(remarks)
    return only(outputs)


def format_of(path: PathName) -> tuple[str, str]:
    """The interpreter and the format of a file by its extension. Raises SettingError."""
    if not isinstance(path, (str, bytes, os.PathLike)):
        raise TypeError(f"save() writes a file: expected its path, not {type(path).__name__}; draw() and play() return it")
    name = os.path.basename(os.fsdecode(path)).lower()
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
