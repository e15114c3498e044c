"""Kolams made on grids of dots, and read from photographs and other files."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from typing import Any, NamedTuple, Optional

from sikku import errors
from sikku.data import PathName, warn
from sikku.lib import _core
from sikku.pattern import Pattern, load
from sikku.settings import whole

__all__ = ["Kolam", "make_kolam", "radial_kolam", "read_kolam"]


class Kolam(NamedTuple):
    """A kolam on a grid of dots."""

    pattern: Pattern
    """The pattern that draws it."""
    facts: dict[str, Any]
    """grid, dots, gaps, crossed, joined, lines, symmetry and crossings (the states of the gaps). Of a made kolam also
    code, changed and attempt; of one that was read doubtful, repaired and notes."""


def make_kolam(
    grid: str,
    *,
    seed: int = 0,
    symmetry: Optional[str] = None,
    density: Optional[float] = None,
    joined: float = 0.0,
    crossings: Optional[str] = None,
    period: int = 0,
    single_line: bool = False,
    attempts: int = 1000,
    colours: bool = False,
    dots: bool = False,
    centred: bool = False,
    rim: str = "round",
) -> Kolam:
    """Makes a kolam on a grid of dots, as `sikku kolam --grid`; the same on every machine.

    grid: `7x7`, the dots of each row (`1-3-5-3-1`), `15-8 idukku pulli`, blocks or a shape (docs/commands.md).
    seed: random seed, 0 or more.
    symmetry: none, C2, C3, C4, C6, mirror-x, mirror-y, diagonal, mirrors, diagonals, D3, D3-y, D4 or D6; by default the
        seed chooses one that the grid permits.
    density: share of the gaps in which lines cross, 0 to 1; by default chosen by the seed, and all dots are
        connected; interlaced dots get petals and stars instead.
    joined: share of the other gaps in which lines run past both dots.
    crossings: the states of the gaps instead of chance: all, none, or a digit for each gap.
    period: columns after which crossings repeat, as in a frieze; 0: they do not.
    single_line: make a single line.
    attempts: attempts to find a single line with a symmetry or a period.
    colours: colour the lines; lines that are images of each other share a colour.
    dots: draw the dots.
    centred: also set a dot in each field between four dots whose four gaps are crossed.
    rim: shape of the loops at the rim: round, pointed, petal, horn or crescent.

    Raises SettingError, and Error if no single line was found.
    """
    if not isinstance(grid, str):
        raise errors.SettingError("grid", str(grid), "expected a string such as '5x5' or '1-3-5-3-1'")
    text, facts = _core.make_kolam(
        grid,
        _count("seed", seed, 0, 2**64 - 1),
        symmetry,
        density,
        joined,
        crossings,
        _count("period", period, 0, 1_000_000),
        single_line,
        _count("attempts", attempts, 1, 2**31 - 1),
        colours,
        dots,
        centred,
        rim,
    )
    return Kolam(load(f"kolam on {grid}", text=text), json.loads(facts))


def radial_kolam(arms: int, dots: int, *, order: Sequence[int] = (), colours: bool = False, show_dots: bool = False) -> Pattern:
    """Makes a radial kolam (Hridaya kamalam): lines go through the dots, from arm to arm.

    arms, dots: number of arms, and of dots on each.
    order: order in which a line visits the dots of an arm, 1 next to the centre; by default odd numbers, then even ones.
    Raises SettingError.
    """
    size = f"{whole('arms', arms)}x{whole('dots', dots)}"
    text = _core.make_radial_kolam(size, "-".join(map(str, order)), colours, show_dots)
    return load(f"radial kolam {size}", text=text)


def read_kolam(
    path: PathName,
    *,
    number: int = 1,
    lattice: str = "",
    grid: str = "",
    corners: Sequence[tuple[float, float]] = (),
    crop: Sequence[int] = (),
    repair: bool = True,
    fix: Sequence[str] = (),
    budget: float = 2e8,
) -> Kolam:
    """Reads a kolam from a photograph, a .kolam.json, a CSV of one-stroke kolams, an SVG, gestures or a pattern.

    number: which of several kolams, from 1.
    lattice: square or interlaced; by default whichever fits better.
    grid: the dots that the kolam of a photograph has, in the notations of make_kolam(): dots that were not seen are
        completed, and another kolam is an error.
    corners: four corners (x, y) of the part of a photograph that is read and straightened, in pixels, around it from the
        top left one.
    crop: x, y, width and height of the part of a photograph that is read, in pixels.
    repair: whether doubtful gaps of a photograph are replaced by their images under its symmetry.
    fix: gaps and dots changed by hand, such as `"3,4: cross"`, `"dot 0,3"` and `"no dot 2,1"`.
    budget: maximum number of derivation nodes visited, for a pattern.

    Doubtful gaps are issued as SikkuWarning. Raises NotFoundError, SettingError, PatternError, and Error if the file
    contains no kolam that can be read.
    """
    number = _count("number", number, 1, 1_000_000)
    around = " ".join(f"{float(x)!r},{float(y)!r}" for x, y in corners)
    part = ",".join(str(int(whole("crop", one))) for one in crop)
    text, facts = _core.read_kolam(
        os.fsencode(path), number, lattice, grid, around, part, repair, list(fix), budget
    )
    found = json.loads(facts)
    if found["doubtful"]:
        places = ", ".join(f"row {one['row']} gap {one['gap']}" for one in found["doubtful"][:20])
        warn(f"{os.fsdecode(path)}: {len(found['doubtful'])} of {found['gaps']} gaps are doubtful: {places}")
    return Kolam(load(os.path.basename(os.fsdecode(path)), text=text), found)


def _count(name: str, value: int, least: int, most: int) -> int:
    number = int(whole(name, value))
    if not least <= number <= most:
        raise errors.SettingError(name, str(value), f"expected a whole number from {least} to {most}")
    return number
