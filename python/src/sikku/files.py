"""Patterns in the files of Sikku and of other programs."""

from __future__ import annotations

import os
from typing import NamedTuple, Optional

from sikku import errors
from sikku.data import PathName, warn
from sikku.lib import _core
from sikku.pattern import Pattern, load

__all__ = ["ImportedSystem", "Provenance", "import_systems", "show"]


class Provenance(NamedTuple):
    """What a print or a score was made from."""

    text: str
    """Text of the pattern."""
    made: str
    """Version and options of the program that made it: `sikku 0.2.0, -n 4 --size A3`. Untrusted, like the text."""


class ImportedSystem(NamedTuple):
    """An L-system of another program."""

    name: str
    line: int
    """Line of its first symbol in the file."""
    pattern: Optional[Pattern]
    """The same system as a pattern; None if it has errors, which were warned of."""
    losses: list[str]
    """Features that the pattern lacks."""
    draws: bool
    """False if the pattern draws nothing at its derivation length."""


def show(path: PathName) -> Provenance:
    """Reads the pattern back from a print, a plot, a model or a score that Sikku made. load() reads it and compiles it.

    Raises Error if the file contains no pattern or is damaged.
    """
    found = _core.provenance(os.fsencode(path))
    if found is None:
        raise errors.Error(f"{os.fsdecode(path)}: this file was not made by Sikku")
    return Provenance(*found)


def import_systems(path: PathName, *, view: Optional[PathName] = None) -> list[ImportedSystem]:
    """Imports the L-systems of a cpfg file or a Fractint collection as patterns.

    view: view file of a cpfg file, for its angle and line widths; by default NAME.v beside the file, if there is one.

    Errors and losses are issued as SikkuWarning. Raises NotFoundError, PatternError if nothing can be imported, and
    Error for files of other programs.
    """
    systems, diagnostics = _core.import_systems(os.fsencode(path), None if view is None else os.fsencode(view))
    for one in diagnostics:
        warn(str(one))
    return [
        ImportedSystem(system, line, load(system, text=text) if text else None, losses, draws)
        for system, line, text, losses, draws in systems
    ]
