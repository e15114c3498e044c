"""Exceptions and warnings of sikku."""

from __future__ import annotations

from typing import NamedTuple

__all__ = [
    "BudgetError",
    "Diagnostic",
    "Error",
    "NotFoundError",
    "PatternError",
    "ScoreError",
    "SettingError",
    "SikkuWarning",
    "WordError",
]


class Diagnostic(NamedTuple):
    """An error or a warning at a place in a pattern."""

    file: str
    """Name of the text: a path, a bundled pattern, or the name of a setting."""
    line: int
    """Line, counted from 1; 0 for a setting."""
    column: int
    """Column in code points, counted from 1; 0 for a setting."""
    message: str
    """What is wrong, and what is expected."""
    excerpt: str
    """The line of the pattern, with a caret below the place."""
    is_warning: bool
    """True for warnings, which do not prevent the use of the pattern."""

    def __str__(self) -> str:
        kind = "warning: " if self.is_warning else ""
        excerpt = f"\n{self.excerpt}" if self.excerpt else ""
        return f"{self.file}:{self.line}:{self.column}: {kind}{self.message}{excerpt}"


class Error(Exception):
    """A file cannot be read or written, or nothing is drawn. Base class of the errors of sikku."""


class PatternError(Error, ValueError):
    """A pattern has errors. `file`, `line`, `column` and `message` are those of the first one."""

    def __init__(self, text: str, diagnostics: list[Diagnostic]) -> None:
        super().__init__(text, diagnostics)
        self.diagnostics: list[Diagnostic] = diagnostics
        """All errors and warnings, sorted by place."""
        first = next((one for one in diagnostics if not one.is_warning), None)
        self.file: str = first.file if first else ""
        self.line: int = first.line if first else 1
        self.column: int = first.column if first else 1
        self.message: str = first.message if first else text

    def __str__(self) -> str:
        return str(self.args[0])


class SettingError(Error, ValueError):
    """An option, key, define or variant is unknown, has an invalid value, or cannot be combined with another."""

    def __init__(self, option: str, value: str, message: str) -> None:
        super().__init__(option, value, message)
        self.option: str = option
        """Name of the option (`dot-spacing`), key (`angle factor`) or define, as in the manual."""
        self.value: str = value
        """Text of the value; empty if a combination is invalid."""
        self.message: str = message
        """What is wrong, and what is expected."""

    def __str__(self) -> str:
        value = f"={self.value!r}" if self.value else ""
        return f"{self.option.replace('-', '_')}{value}: {self.message}"


class NotFoundError(Error, LookupError):
    """No file, bundled pattern or bundled gallery file has the name."""


class BudgetError(Error):
    """The work exceeds its budget; `budget=1e9` sets a larger one."""


class WordError(Error, ValueError):
    """The word cannot be drawn or played, because of unmatched brackets or positions that are not finite."""


class ScoreError(Error, ValueError):
    """The score cannot be written, because it has no notes or too many for the format."""


class SikkuWarning(UserWarning):
    """A warning about a pattern, or about an output that was made."""
