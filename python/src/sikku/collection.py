"""Arrangements of several patterns as one piece, and galleries of many files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import NamedTuple, Optional, Union

from sikku import errors
from sikku.data import Notes, PathName, notes_from, only, warn, warn_of
from sikku.lib import _core
from sikku.outputs import Progress, format_of
from sikku.pattern import Pattern
from sikku.settings import Value, to_gallery_keys, to_options

__all__ = ["Arrangement", "GalleryFile", "GalleryResult", "gallery", "load_arrangement"]


class Arrangement:
    """Several patterns, each with keys of its own, as one piece. Immutable; several threads may use it at once."""

    __slots__ = ("_arrangement", "__weakref__")

    def __init__(self, arrangement: _core.Arrangement) -> None:
        """Not public; use sikku.load_arrangement()."""
        self._arrangement = arrangement

    @property
    def title(self) -> str:
        """Title of the piece, or an empty string."""
        return self._arrangement.title

    @property
    def text(self) -> str:
        """The arrangement as TOML, with every pattern in it."""
        return self._arrangement.text

    @property
    def tracks(self) -> list[Pattern]:
        """The pattern of each track, with the keys of the track."""
        return [Pattern(document) for document in self._arrangement.documents]

    def __repr__(self) -> str:
        return f"<sikku.Arrangement {self.title!r}, {len(self.tracks)} tracks>"

    def __reduce__(self) -> tuple[object, ...]:
        return _restore, (self.text, self._arrangement.folder)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Arrangement):
            return NotImplemented
        return self.text == other.text and self._arrangement.folder == other._arrangement.folder

    def __hash__(self) -> int:
        return hash(self.text)

    def play(
        self, format: str = "mid", *, progress: Optional[Progress] = None, **options: Value
    ) -> Union[str, bytes]:
        """Plays the piece and returns the score; formats, options and errors are those of Pattern.play()."""
        outputs, remarks = _core.make_piece(self._arrangement, format, to_options("scores", options), progress)
        warn_of(remarks)
        return only(outputs)

    def save(self, path: PathName, *, progress: Optional[Progress] = None, **options: Value) -> list[str]:
        """Writes the score; the extension of `path` selects the format. Returns facts about it."""
        interpreter, format = format_of(path)
        if interpreter != "scores":
            raise errors.SettingError("format", format, "an arrangement is played, not drawn")
        values = to_options("scores", options)
        return warn_of(_core.write_piece(self._arrangement, format, values, os.fsencode(path), progress))

    def notes(self, **options: Value) -> Notes:
        """Returns the notes of the score that play() writes with the same options, as NumPy arrays."""
        return notes_from(_core.notes_of_piece(self._arrangement, to_options("scores", options)))


class GalleryFile(NamedTuple):
    """A finished file of a gallery."""

    name: str
    """Path below the folder of the gallery."""
    bytes: int
    is_new: bool
    """True if this call made it; False if it was up to date."""
    warnings: list[str]


class GalleryResult(NamedTuple):
    """What gallery() made."""

    files: list[GalleryFile]
    failures: dict[str, str]
    """For the name of each file that could not be made, the reason."""


def load_arrangement(name: Optional[PathName] = None, *, text: Optional[str] = None) -> Arrangement:
    """Reads an arrangement and compiles its patterns.

    name: path of a TOML file, or name of a bundled arrangement; with `text`, the name of the text in messages.
    text: TOML, instead of a file.

    Raises NotFoundError, PatternError for errors in its patterns, and Error for errors of the arrangement.
    """
    if name is None and text is None:
        raise TypeError("load_arrangement() needs a name or a text")
    return Arrangement(_core.load_arrangement(os.fsencode("<text>" if name is None else name), _encoded(text), None))


def _restore(text: str, folder: bytes) -> Arrangement:
    """Reads a pickled arrangement."""
    return Arrangement(_core.load_arrangement(b"<text>", _encoded(text), folder))


def _encoded(text: Optional[str]) -> Optional[bytes]:
    return None if text is None else text.encode("utf-8", "surrogateescape")


def gallery(
    folder: PathName,
    patterns: Union[str, Iterable[str]] = (),
    *,
    file: PathName = "",
    format: Union[str, Sequence[str]] = (),
    poster: str = "",
    contact: str = "",
    force: bool = False,
    keep_going: bool = False,
    memory: float = 0,
    threads: int = 0,
    progress: Optional[Progress] = None,
    **keys: Value,
) -> GalleryResult:
    """Makes many prints and scores in one folder, in parallel, as `sikku gallery` does. Files that are up to date stay;
    an interrupted run is resumed by the same call.

    folder: the folder of the gallery.
    patterns: names, kinds, globs, folders or files; by default all bundled patterns that draw.
    file: gallery file (TOML), or the name of a bundled one.
    format: formats such as `["svg", "mid"]`.
    poster, contact: sizes of a poster with captions, and of a contact sheet with names.
    force: make everything again, and replace files that the gallery did not make.
    keep_going: continue with other files after one failed.
    memory: maximum memory in bytes; 0: half of what is available.
    threads: files at a time; 0: one for each core.
    progress: called with the number of finished files and that of all.
    keys: options of prints and scores, and keys of patterns: `size="A4"`, `n="3:6"`.

    Warnings about the gallery are issued as SikkuWarning. Raises SettingError; NotFoundError for an unknown pattern
    or gallery file; Error for other errors that can be detected before anything is made.
    """
    names = [patterns] if isinstance(patterns, str) else list(patterns)
    texts = to_gallery_keys(keys)
    if format:
        texts["format"] = format if isinstance(format, str) else ",".join(format)
    finished, failures, warnings, troubles = _core.make_gallery(
        names,
        os.fspath(file),
        os.fsencode(folder),
        poster,
        contact,
        texts,
        force,
        keep_going,
        memory,
        threads,
        progress,
    )
    for text in warnings:
        warn(text)
    if troubles:
        raise errors.Error("\n".join(troubles))
    return GalleryResult([GalleryFile(*one) for one in finished], dict(failures))
