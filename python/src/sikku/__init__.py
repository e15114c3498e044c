"""L-systems: kolams, tilings, plants and music.

    import sikku

    kolam = sikku.load("snake-kolam")
    kolam.save("snake.pdf", size="A3", dots=True)
    kolam.measure()["drawn"]

See docs/python.md.
"""

from sikku.collection import Arrangement, GalleryFile, GalleryResult, gallery, load_arrangement
from sikku.data import Module, Notes, Path, Production, Tiles
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
from sikku.files import ImportedSystem, Provenance, import_systems, show
from sikku.kolams import Kolam, make_kolam, radial_kolam, read_kolam
from sikku.lib import _core
from sikku.outputs import sheet, workbook
from sikku.pattern import Pattern, PatternInfo, load, patterns

__version__: str = _core.version

__all__ = [
    "Arrangement",
    "BudgetError",
    "Diagnostic",
    "Error",
    "GalleryFile",
    "GalleryResult",
    "ImportedSystem",
    "Kolam",
    "Module",
    "NotFoundError",
    "Notes",
    "Path",
    "Pattern",
    "PatternError",
    "PatternInfo",
    "Production",
    "Provenance",
    "ScoreError",
    "SettingError",
    "SikkuWarning",
    "Tiles",
    "WordError",
    "gallery",
    "import_systems",
    "load",
    "load_arrangement",
    "make_kolam",
    "patterns",
    "radial_kolam",
    "read_kolam",
    "sheet",
    "show",
    "workbook",
]
