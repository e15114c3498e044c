"""Patterns, and the prints, scores, measures and data made from them."""

from __future__ import annotations

import html
import itertools
import json
import os
from collections.abc import Iterator
from typing import Any, NamedTuple, Optional, Union

from sikku import errors
from sikku.data import Module, Path, PathName, Production, Tiles, exact, warn
from sikku.lib import _core
from sikku.outputs import Outputs
from sikku.settings import Texts, Value, to_settings, whole

__all__ = ["Pattern", "PatternInfo", "load", "patterns"]

_most_shown = 2_000_000  # derivation nodes of the drawings and pages that notebooks show
_longest_shown = 1_000_000  # characters of a drawing that a notebook shows as SVG


class PatternInfo(NamedTuple):
    """A bundled pattern."""

    name: str
    kind: str
    """Name of its folder: kolams, kolam-library, tilings, curves, maps, plants, words or melodies."""
    title: str
    source: str
    """Source of the pattern in the literature."""


class Pattern(Outputs):
    """A pattern that was read, checked and compiled. Immutable; several threads may use it at once.

    Patterns are equal if their names, texts, variants and settings are. They can be copied, hashed and pickled.

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

    @property
    def variant(self) -> str:
        """Name of the variant that was chosen, or an empty string."""
        return self._document.variant

    @property
    def settings(self) -> dict[str, str]:
        """Keys and defines that were set besides the text of the pattern, with their values."""
        return dict(self._document.settings)

    @property
    def keys(self) -> dict[str, str]:
        """Keys of the pattern and their values, settings applied: `axiom`, `angle factor`, `stroke`, …"""
        return self._document.keys

    @property
    def defines(self) -> dict[str, str]:
        """Names of the pattern's `define` lines and their values, settings applied."""
        return self._document.defines

    @property
    def variants(self) -> dict[str, dict[str, str]]:
        """For the name of each variant, the keys and defines that it sets."""
        return self._document.variants

    @property
    def productions(self) -> list[Production]:
        """Productions in the order of the text: of all tables, of each table, and those that interpret."""
        return self._document.productions

    def _state(self) -> tuple[str, str, str, list[tuple[str, str]]]:
        return self.name, self.text, self.variant, self._document.settings

    def __reduce__(self) -> tuple[Any, ...]:
        return _restore, self._state()

    def __copy__(self) -> Pattern:
        return self

    def __deepcopy__(self, memo: object) -> Pattern:
        return self

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Pattern):
            return NotImplemented
        return self._state()[:3] == other._state()[:3] and self.settings == other.settings

    def __hash__(self) -> int:
        return hash((*self._state()[:3], frozenset(self.settings.items())))

    def __repr__(self) -> str:
        return f"<sikku.Pattern {self.title or self.name!r}, n = {self.n}>"

    def with_settings(
        self, *, n: Optional[int] = None, seed: Optional[int] = None, **settings: Value
    ) -> Pattern:
        """Returns a copy of the pattern with another derivation length, seed, keys or defines.

        Raises SettingError, and PatternError if the settings make a production invalid.
        """
        texts = _shared_settings(n, seed) + to_settings(settings)
        return Pattern(self._document.with_settings(texts))

    def measure(self, *, budget: float = 2e8) -> dict[str, Any]:
        """Measures the word, without deriving it if productions have no contexts: n = 60 costs as little as n = 6.

        Returns the output of `sikku measure --json`: title, n, symbols, counts, drawn, moves, length, box, ink, end,
        heading, closed, depth, derived. Integers are exact and of any size; those above 10,000 digits are given as
        text, "about 10^k". Lengths are in turtle steps, headings in degrees.

        budget: maximum number of derivation nodes visited, if the word has to be derived.
        Raises BudgetError, WordError.
        """
        facts: dict[str, Any] = json.loads(_core.measure(self._document, budget))
        return {name: value if name == "title" else exact(value) for name, value in facts.items()}

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
        Raises SettingError; the iterator raises BudgetError, WordError.
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

    def tiles(self, n: Optional[int] = None, *, budget: float = 2e8) -> Tiles:
        """Examines the polygons as tiles, as `sikku tiling` does, and returns them as NumPy arrays with the certificate.

        Cost: about 3 s and 1 GB for a million tiles; at most 10 million.

        n: derivation length, instead of the pattern's.
        budget: maximum number of derivation nodes visited.
        Raises PatternError (also for maps), WordError, BudgetError, and Error for drawings in space.
        """
        text, corners, *columns = _core.tiles(self._derived(n), budget)
        certificate = _growth_of(json.loads(text))
        (points, begins), (number, shape, orientation, colour, is_reflected, letter, neighbours, differing) = (
            corners,
            columns,
        )
        return Tiles(
            certificate,
            points,
            begins,
            number,
            shape,
            orientation,
            colour,
            is_reflected,
            letter,
            neighbours,
            differing,
        )

    def tile_counts(self, n: Optional[int] = None) -> dict[str, Any]:
        """Counts the tiles and finds their growth from the productions alone: n = 60 costs as little as n = 6.

        Returns the output of `sikku tiling --counts --json`. Integers are exact and of any size.
        Raises SettingError, and PatternError for maps.
        """
        return _growth_of(json.loads(_core.tile_counts(self._derived(n))))

    def _derived(self, n: Optional[int]) -> _core.Document:
        return self._document if n is None else self.with_settings(n=n)._document

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, Union[str, bytes]]:
        """For notebooks: a page that plays a melody, in a frame; otherwise the drawing as SVG, or as PNG if that has
        more than a million characters. Nothing for drawings of more than 2 million nodes."""
        bundle: dict[str, Union[str, bytes]] = {"text/plain": repr(self)}
        if self.is_melody:
            page = self._shown("scores", "html")
            if page is not None:
                bundle["text/html"] = (
                    f'<iframe srcdoc="{html.escape(str(page))}" sandbox="allow-scripts" '
                    f'title="{html.escape(self.title)}" style="width: 100%; height: 640px; border: 0"></iframe>'
                )
            return bundle
        drawing = self._shown("prints", "svg")
        if drawing is not None and len(drawing) <= _longest_shown:
            bundle["image/svg+xml"] = drawing
        elif drawing is not None:
            picture = self._shown("prints", "png")
            if picture is not None:
                bundle["image/png"] = picture
        return bundle

    def _shown(self, interpreter: str, format: str) -> Union[str, bytes, None]:
        try:
            options = [("budget", str(_most_shown))]
            if format == "png":
                options.append(("dpi", "96"))  # of screens
            outputs, _ = _core.make(self._document, interpreter, format, options, None)
        except errors.Error:  # over the budget, or nothing is drawn
            return None
        content: Union[str, bytes] = next(iter(outputs.values()))
        return content


def _restore(name: str, text: str, variant: str, settings: Texts) -> Pattern:
    """Reads a pickled pattern."""
    document, _ = _core.load(os.fsencode(name), text.encode("utf-8", "surrogateescape"), variant, settings)
    return Pattern(document)


def _growth_of(facts: dict[str, Any]) -> dict[str, Any]:
    """Converts large integers, which JSON contains as text."""
    facts["n"] = exact(facts["n"])
    growth = facts["growth"]
    growth["tiles"] = exact(growth["tiles"])
    for one in growth["counts"]:
        one["count"] = exact(one["count"])
    return facts


def _shared_settings(n: Optional[int], seed: Optional[int]) -> Texts:
    texts: Texts = []
    if n is not None:
        texts.append(("derivation length", whole("n", n)))
    if seed is not None:
        texts.append(("seed", whole("seed", seed)))
    return texts


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

    pattern: name of a bundled pattern, or path of a pattern file, or of a print or score that Sikku made, which contains
        its pattern; with `text`, the name of the text in messages.
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
        warn(str(warning))
    return Pattern(document)


def patterns() -> list[PatternInfo]:
    """Lists the bundled patterns, sorted by kind and name, without arrangements. Takes about 10 ms."""
    return [PatternInfo(*one) for one in _core.patterns()]
