"""L-systems: kolams, tilings, plants and music.

    import sikku

    kolam = sikku.load("snake-kolam")
    kolam.save("snake.pdf", size="A3", dots=True)
    kolam.measure()["drawn"]

See docs/python.md.
"""

from sikku.errors import (
    BudgetError,
    Diagnostic,
    Error,
    NotFoundError,
    PatternError,
    ScoreError,
    SettingError,
    SikkuWarning,
    WordError,
)
from sikku.lib import _core
from sikku.pattern import Module, Notes, Path, Pattern, PatternInfo, load, patterns, sheet

__version__: str = _core.version

__all__ = [
    "BudgetError",
    "Diagnostic",
    "Error",
    "Module",
    "NotFoundError",
    "Notes",
    "Path",
    "Pattern",
    "PatternError",
    "PatternInfo",
    "ScoreError",
    "SettingError",
    "SikkuWarning",
    "WordError",
    "load",
    "patterns",
    "sheet",
]
