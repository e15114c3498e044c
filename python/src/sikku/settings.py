"""Keyword arguments as settings of patterns and options of outputs."""

from __future__ import annotations

import functools
import numbers
from collections.abc import Iterable
from typing import Union

from sikku.errors import SettingError
from sikku.lib import _core

__all__ = ["Value", "to_options", "to_settings"]

Value = Union[str, bool, float, None, Iterable[object]]
"""Text as on the command line, a flag, a number, or a sequence: the numbers of one value (`window=(0, 0, 8, 8)`) or the
values of an option that may be repeated. None omits the setting."""

Texts = list[tuple[str, str]]


def number_text(number: float) -> str:
    """The shortest decimal text that reads back as the same number."""
    if isinstance(number, numbers.Integral):
        return str(int(number))
    text = repr(float(number))
    return text[:-2] if text.endswith(".0") else text


def to_text(name: str, value: object) -> str:
    """The text of one value. Raises TypeError for values of other types than str, bool, numbers and sequences."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, numbers.Real):
        return number_text(float(value) if not isinstance(value, numbers.Integral) else int(value))
    if isinstance(value, Iterable) and not isinstance(value, (bytes, bytearray)):
        return ",".join(to_text(name, one) for one in value)
    raise TypeError(f"{name}: expected text, a number, True or False, not {type(value).__name__}")


@functools.lru_cache(maxsize=None)
def _keys() -> frozenset[str]:
    return frozenset(_core.keys())


@functools.lru_cache(maxsize=None)
def _options(interpreter: str) -> dict[str, tuple[bool, bool]]:
    """For the name of each option: whether it may be repeated, and whether its value may be omitted."""
    if interpreter == "sheet":
        rows = _core.options("prints") + _core.sheet_options()
    else:
        rows = _core.workbook_options() if interpreter == "workbook" else _core.options(interpreter)
    return {name: (is_list, value.startswith("[")) for name, is_list, _, value, _ in rows}


def _key_name(name: str) -> str:
    """The key of that name (`derivation_length`), or the name itself, which may be a define."""
    key = name.replace("_", " ").strip()
    return key if key in _keys() else name


def to_settings(values: dict[str, Value]) -> Texts:
    """Keys and defines of a pattern with the texts of their values."""
    return [(_key_name(name), to_text(name, value)) for name, value in values.items() if value is not None]


def to_options(interpreter: str, values: dict[str, Value]) -> Texts:
    """Options of an interpreter (or of a `sheet` or `workbook`), keys and defines with the texts of their values."""
    known = _options(interpreter)
    texts: Texts = []
    for name, value in values.items():
        if value is None:
            continue
        option = name.replace("_", "-")
        if option not in known:
            texts.append((_key_name(name), to_text(name, value)))
            continue
        is_list, is_optional = known[option]
        if is_list and isinstance(value, Iterable) and not isinstance(value, str):
            texts.extend((option, to_text(name, one)) for one in value)
        elif is_optional and isinstance(value, bool):
            texts += [(option, "")] if value else []
        else:
            texts.append((option, to_text(name, value)))
    return texts


def to_gallery_keys(values: dict[str, Value]) -> dict[str, str]:
    """Keys of a gallery, with hyphens, and the texts of their values."""
    return {name.replace("_", "-"): to_text(name, value) for name, value in values.items() if value is not None}


def whole(option: str, value: object) -> str:
    """The text of an integer of any type, including NumPy's. Raises SettingError for other values."""
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise SettingError(option, str(value), "expected a whole number")
    return str(int(value))
