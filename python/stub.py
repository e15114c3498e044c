"""Writes python/src/sikku/outputs.pyi, the types of the options of prints, scores and sheets, from the tables of the
libraries. A test compares.

    PYTHONPATH=build/dev/python python3 python/stub.py > python/src/sikku/outputs.pyi
"""

from __future__ import annotations

from sikku.lib import _core

TYPES = {"flag": "bool", "number": "Union[float, str]", "whole": "Union[int, str]", "text": "Value"}
HEAD = '''"""Written by python/stub.py. Options are those of the program; further keywords are keys and defines of the pattern."""
from collections.abc import Callable
from typing import Literal, Optional, Union, overload

from sikku.data import Bytes, Notes, PathName
from sikku.lib import _core
from sikku.pattern import Pattern
from sikku.settings import Value

Progress = Callable[[int, float], object]

class Outputs:
    _document: _core.Document
'''


def keywords(rows: list[tuple[str, bool, str, str, str]], indent: str) -> str:
    """One keyword a line, sorted by name."""
    lines = []
    for name, is_list, kind, value, _ in sorted(rows):
        # The value of some options may be omitted: `dots=True`.
        type = "Value" if is_list or value.startswith("[") else TYPES[kind]
        lines.append(f"{indent}{name.replace('-', '_')}: Optional[{type}] = ...,\n")
    return "".join(lines) + f"{indent}**settings: Value,\n"


def literals(interpreter: str, is_text: bool) -> str:
    names = [name for name, _, text in _core.formats(interpreter) if text == is_text]
    names += [alias for _, alias, text in _core.formats(interpreter) if text == is_text and alias]
    return f"Literal[{', '.join(repr(name) for name in sorted(set(names)))}]".replace("'", '"')


def method(name: str, interpreter: str, default: str, progress: bool = True) -> str:
    """The overloads of draw() or play(): text formats and others."""
    text = ""
    options = keywords(_core.options(interpreter), " " * 8)
    shown = "        progress: Optional[Progress] = ...,\n" if progress else ""
    for is_text, answer in ((True, "str"), (False, "bytes")):
        has_default = any(row[0] == default and row[2] == is_text for row in _core.formats(interpreter))
        format = f"format: {literals(interpreter, is_text)}{' = ...' if has_default else ''}"
        text += f"    @overload\n    def {name}(\n        self,\n        {format},\n        *,\n{shown}{options}    ) -> {answer}: ...\n"
    # Formats that are known only when the program runs.
    text += f"    @overload\n    def {name}(\n        self,\n        format: str,\n        *,\n{shown}        **options: Value,\n"
    return text + "    ) -> Union[str, bytes]: ...\n"


def stub() -> str:
    both = {row[0]: row for row in _core.options("scores")} | {row[0]: row for row in _core.options("prints")}
    text = HEAD + method("draw", "prints", "svg") + method("play", "scores", "mid")
    shown = "        progress: Optional[Progress] = ...,\n"
    indent = " " * 8
    text += f"    def save(\n        self,\n        path: PathName,\n        *,\n{shown}{keywords(list(both.values()), indent)}"
    text += "    ) -> list[str]: ...\n"
    text += f"    def pixels(\n        self,\n        *,\n{shown}{keywords(_core.options('prints'), indent)}    ) -> Bytes: ...\n"
    text += f"    def notes(\n        self,\n        *,\n{keywords(_core.options('scores'), indent)}    ) -> Notes: ...\n"
    sheets = {row[0]: row for row in _core.options("prints") + _core.sheet_options()}
    text += "\ndef sheet(\n    path: PathName,\n    *drawings: Union[Pattern, tuple[Pattern, dict[str, Value]]],\n"
    text += f"    progress: Optional[Progress] = ...,\n{keywords(list(sheets.values()), '    ')}) -> list[str]: ...\n"
    text += "\ndef workbook(\n    path: PathName,\n    *kolams: Union[Pattern, tuple[Pattern, dict[str, Value]]],\n"
    rows = keywords(_core.workbook_options(), "    ").replace("    **settings: Value,\n", "")
    text += f"    progress: Optional[Progress] = ...,\n{rows}) -> list[str]: ...\n"
    return text + "\ndef format_of(path: PathName) -> tuple[str, str]: ...\n"


if __name__ == "__main__":
    print(stub(), end="")
