"""The L-system of a pattern and the program's reports about it as HTML."""

import re
from collections.abc import Callable

from markup import code, escaped
from patterns import Pattern, Rules

# Names of the lines in the reports of the program.
NAMES = {
    "symbols": "Symbols of the word", "counts": "Of each symbol", "drawn": "Segments drawn", "moves": "Steps moved", "length": "Length of the line",
    "box": "Extent", "ink": "Extent of what is drawn", "end": "The turtle ends at", "closed": "Closed", "kolam": "Kolam", "lines": "Lines",
    "crossings": "Crossings", "touching": "Touching", "meetings": "Meetings", "diagram": "As a knot or link", "faces": "Fields",
    "dots": "Dots", "symmetry": "Symmetry", "exact": "Exact", "tiling": "Tiling", "shapes": "Shapes", "edges": "Edges",
    "vertices": "Vertices", "neighbours": "Neighbours", "growth": "Growth", "area": "Area", "cells": "Cells", "outline": "Outer edges",
    "scale": "Scale", "notes": "Notes", "bars": "Bars", "time": "Duration", "range": "Range", "height": "Height", "strokes": "Strokes",
    "reused": "Edges drawn twice", "depth": "Depth of branches",
}  # fmt: skip
LEFT_OUT = {"derived", "heading", "ink", "end"}


def readable(name: str, text: str) -> str:
    """A line of a report in a form for readers: with units and without data for programs."""
    numbers = text.split()
    if name == "box" and len(numbers) in (4, 6):
        half = len(numbers) // 2
        sides = [float(high) - float(low) for low, high in zip(numbers[:half], numbers[half:])]
        return " × ".join(f"{side:.6g}" for side in sides) + " steps"
    if name == "counts":
        return ", ".join(f"{symbol} {count}" for symbol, count in zip(numbers[0::2], numbers[1::2]))
    if name == "length":
        return f"{float(text):,.6g} steps" if re.fullmatch(r"[0-9.]+", text) else f"{text} steps"
    if text.isdigit():
        return f"{int(text):,}"
    return text[:1].upper() + text[1:]


def facts(rows: list[tuple[str, str]], classes: str = "facts") -> str:
    known = dict(rows)
    entries = "".join(
        f"<dt>{escaped(NAMES.get(name, name.capitalize()))}</dt><dd>{escaped(readable(name, text))}</dd>"
        for name, text in rows
        if name not in LEFT_OUT
        and not (name == "moves" and text == known.get("drawn"))
        and not (name in ("drawn", "length", "depth") and text == "0")
    )
    return f'<dl class="{classes}">{entries}</dl>' if entries else ""


def angle_of(pattern: Pattern) -> str:
    if factor := pattern.keys.get("angle factor"):
        if factor.isdigit() and int(factor) > 0:
            degrees = 360 / int(factor)
            return f"{degrees:g}°" if degrees == round(degrees, 2) else f"360°/{factor}"
        return f"360°/{factor}"
    return pattern.keys.get("angle increment", "90") + "°"


def module(text: str) -> str:
    """The HTML of a word; the empty word is ε."""
    if not text:
        return "<code>ε</code>"
    if len(text) > 1200:
        return f'<code class="long" dir="ltr" tabindex="0" role="group" aria-label="Word">{escaped(text)}</code>'
    return code(text)


def rows_of(rules: Rules, number: int, word: Callable[[str], str]) -> tuple[str, int]:
    rows = ""
    if rules.name:
        rows += f'<tr class="section"><th colspan="2" scope="rowgroup">{escaped(rules.name)}</th></tr>'
    for each in rules.productions:
        number += 1
        condition = f' <span class="condition">: {word(each.condition)}</span>' if each.condition else ""
        weight = f"<small>{escaped(each.weight)}</small>" if each.weight else ""
        rows += (
            f'<tr><th scope="row">p<sub>{number}</sub></th><td>{word(each.predecessor)}{condition}'
            f'<span class="arrow">{weight}→</span>{word(each.successor)}</td></tr>'
        )
    return rows, number


def system(pattern: Pattern, steps: str = "", word: Callable[[str], str] = module) -> str:
    """The L-system as the literature prints it: n, δ, axiom ω, productions p. `steps` is shown instead of the pattern's n;
    `word` makes HTML of words and conditions."""
    rows = ""
    if pattern.steps is not None:
        rows += f'<tr><th scope="row">n</th><td>{escaped(steps) or pattern.steps}</td></tr>'
    if "map" not in pattern.keys:
        rows += f'<tr><th scope="row">δ</th><td>{escaped(angle_of(pattern))}</td></tr>'
    for name, value, _ in pattern.defines:
        rows += f'<tr><th scope="row">{escaped(name)}</th><td>{word(value)}</td></tr>'
    rows += f'<tr><th scope="row">ω</th><td>{word(pattern.keys.get("axiom", ""))}</td></tr>'
    number = 0
    for rules in pattern.rules:
        more, number = rows_of(rules, number, word)
        rows += more
    return f'<table class="system"><caption class="unseen">Axiom and productions</caption><tbody>{rows}</tbody></table>'
