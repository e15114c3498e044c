#!/usr/bin/env python3
"""Compares the list of the book's figures with the patterns and with the numbering of the documents. Quick: draws nothing.

usage: tests/book.py
"""

import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "packaging/book"), str(ROOT / "packaging/site")]

import figures  # noqa: E402


def chapters(*lengths: tuple[int, int]) -> list[str]:
    return [f"Figure {chapter}.{number}" for chapter, most in lengths for number in range(1, most + 1)]


# The numbered figures of the documents.
NUMBERED = {
    "Prusinkiewicz & Hanan 1989": chapters((1, 4), (2, 13), (3, 18), (4, 6), (5, 3), (6, 9)),
    "Prusinkiewicz, Hammel, Hanan & Mech 1996": [f"Figure {number}" for number in range(1, 18)],
    "Thesis, chapter 3": chapters((3, 12)),
    "Andújar 2014": [f"Example {number}" for number in range(1, 7)],
    "Saupe 1988": [f"Figure C.{number}" for number in range(1, 9)] + ["Page 272"],
}
# Patterns with these sources belong in the book. The thesis has the figures of the last one.
SOURCES = (*(each for each in NUMBERED if each != "Thesis, chapter 3"), "Prusinkiewicz & Lindenmayer 1990, figure 1.")
NOT_DRAWN = ("melodies", "arrangements")  # their curves are other patterns

problems: list[str] = []


def expect(is_true: bool, problem: str) -> None:
    if not is_true:
        problems.append(problem)


def order_of(number: str) -> list[int | str]:
    return [int(part) if part.isdigit() else part for part in number.replace("Figure ", "").split(".")]


documents, patterns = figures.read()
expect([each.name for each in documents] == list(NUMBERED), "the documents are not those of NUMBERED, in this order")
for document in documents:
    numbers = [each.number for each in document.figures]
    expect(len(set(numbers)) == len(numbers), f"{document.name}: a figure is listed twice")
    missing = [each for each in NUMBERED[document.name] if each not in numbers]
    expect(not missing, f"{document.name}: {', '.join(missing)} neither drawn nor left out")
    plates = [order_of(each) for each in numbers if each.startswith("Figure ")]
    expect(plates == sorted(plates, key=lambda each: [str(part).zfill(3) for part in each]), f"{document.name}: figures are not in order")
    for figure in document.figures:
        expect(not (figure.left_out and figure.drawings), f"{document.name}: {figure.number} is drawn and left out")
        if not figure.left_out:
            expect(bool(figure.index), f"{document.name}: {figure.number} has no entry in the index")
            expect(not (figure.turn and figure.is_half), f"{document.name}: {figure.number} has half a page and a second page")

drawn = {each.pattern for document in documents for figure in document.figures for each in figure.drawings}
drawn |= {name for document in documents for figure in document.figures for name in figure.systems}
for name, pattern in sorted(patterns.items()):
    source = pattern.keys.get("source", "").removeprefix("after ")
    if pattern.kind not in NOT_DRAWN and source.startswith(SOURCES):
        expect(name in drawn, f"{name} ({source}) is in no figure")

# Wrong entries are refused, with the figure and the reason.
HEAD = '[[document]]\nname = "x"\nshort = "x"\nreference = "x"\nabout = "x"\ncover = "hilbert"\n[[document.figure]]\nnumber = "Figure 1"\n'
for entry, reason in (
    ('draw = ["no-such-pattern"]\ncaption = "x"', "Figure 1: unknown pattern 'no-such-pattern'"),
    ('draw = ["hilbert -n 0:3"]\nlabels = ["a"]', "Figure 1: 1 labels for 4 drawings"),
    ('draw = ["hilbert -n 0:3"]\ncolumns = [2, 1]', "Figure 1: 3 places for 4 drawings"),
    ('draw = ["hilbert --fit"]', "'hilbert --fit': unknown option --fit"),
    ('draw = ["hilbert", "peano"]', "Figure 1: no caption"),
    ('caption = "x"', "Figure 1: neither drawn nor left out"),
    ('draw = ["hilbert"]\ncolour = "red"', "Figure 1: unknown key 'colour'"),
):
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(HEAD + entry + "\n")
        file.flush()
        try:
            figures.read(Path(file.name))
            problems.append(f"not refused: {entry}")
        except ValueError as error:
            expect(str(error) == reason, f"expected '{reason}', not '{error}'")

if problems:
    sys.exit("\n".join(f"book: {each}" for each in problems))
total = sum(len(each.figures) for each in documents)
left = sum(1 for document in documents for each in document.figures if each.left_out)
print(f"book: {total} figures of {len(documents)} documents, {left} of them left out, {len(drawn)} patterns")
