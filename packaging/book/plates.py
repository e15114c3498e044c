"""The pictures of figures: their places in a grid, and the files that the program makes for them."""

import math
import re
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import midi
from figures import Drawing, Figure
from patterns import Pattern
from program import Program, reason_of, table_of

GAP = 2.5  # mm between pictures
LABEL = 5.0  # mm, a line below a picture
DPI = 300  # of pictures in light
THICKEST = 0.014  # share of the shorter side of a picture; limits the lines of curves with few steps


@dataclass
class Picture:
    """A picture in the book. Sizes are in millimetres."""

    drawing: Drawing
    label: str
    anchor: str
    width: float
    height: float
    step: float = 0.0  # mm; 0: the drawing fills the picture
    keys: tuple[str, ...] = ()  # KEY=VALUE
    file: Path | None = None


def rows_of(count: int, columns: int) -> list[int]:
    """The number of pictures in each row; rows differ by at most one."""
    rows = math.ceil(count / columns)
    if count % columns == 0 or columns == 1:
        return [min(columns, count)] * rows
    return [count // rows + (1 if row < count % rows else 0) for row in range(rows)]


def best_columns(count: int, width: float, height: float) -> int:
    """The number of columns for which the largest squares fit into the pictures."""

    def side(columns: int) -> float:
        rows = math.ceil(count / columns)
        return min((width - GAP * (columns - 1)) / columns, (height - GAP * (rows - 1)) / rows - LABEL)

    return max(range(1, count + 1), key=lambda columns: (side(columns), -columns))


def laid_out(figure: Figure, width: float, height: float, numbers: range, columns: list[int]) -> list[list[Picture]]:
    """Lays out some pictures of a figure in rows, with their labels, in an area of this size."""
    count = len(numbers)
    label = LABEL if figure.labels else 0.0
    rows = columns if len(columns) > 1 else rows_of(count, (columns or [best_columns(count, width, height)])[0])
    # A picture alone in its row is larger than those in rows of several.
    shares = [1.6 if of_row == 1 and max(rows) > 1 else 1.0 for of_row in rows]
    room = height - GAP * (len(rows) - 1) - label * len(rows)
    if room <= 0:
        raise ValueError(f"figure {figure.number}: its text leaves no room for pictures")
    laid, at = [], 0
    for of_row, share in zip(rows, shares):
        wide, tall = (width - GAP * (of_row - 1)) / of_row, room * share / sum(shares)
        row = []
        for number in numbers[at : at + of_row]:
            text = figure.labels[number] if figure.labels else ""
            row.append(
                Picture(figure.drawings[number], text, f"{figure.anchor}-picture-{number + 1}", wide, tall, keys=tuple(figure.keys))
            )
        at += of_row
        laid.append(row)
    return laid


def pages_of(figure: Figure, width: float, height: float, second: float = 0.0) -> list[list[list[Picture]]]:
    """The rows of the first page and, if some of the pictures are on a second page, of that page."""
    count, turn = len(figure.drawings), figure.turn or len(figure.drawings)
    if not second or turn == count:
        return [laid_out(figure, width, height, range(count), figure.columns)]
    rows, at = figure.columns, 0
    while len(rows) > 1 and sum(rows[:at]) < turn:
        at += 1
    return [
        laid_out(figure, width, height, range(turn), rows[:at] or rows),
        laid_out(figure, width, second, range(turn, count), rows[at:] or rows),
    ]


def margin_of(picture: Picture) -> float:
    return 0.09 * min(picture.width, picture.height)


def is_lit(pattern: Pattern, drawing: Drawing) -> bool:
    return "light" in pattern.keys and not drawing.is_of_rules


class Studio:
    """Makes the files of pictures in a folder."""

    def __init__(self, program: Program, patterns: dict[str, Pattern], folder: Path):
        self.program, self.patterns, self.folder = program, patterns, folder

    def make(self, picture: Picture) -> None:
        """Makes the file of a picture: a PNG if it is in light, an SVG if it is a piano roll, otherwise a PDF. Raises ValueError."""
        pattern = self.patterns[picture.drawing.pattern]
        if picture.drawing.is_played:
            tune = self.folder / f"{picture.anchor}.mid"
            problem = self.program.makes("play", pattern.path, tune)
            roll = None if problem else midi.piano_roll(tune.read_bytes())
            if roll is None:
                raise ValueError(f"{pattern.name} cannot be played: {problem or 'too many notes'}")
            picture.file = self.folder / f"{picture.anchor}.svg"
            picture.file.write_text(re.sub(r"@media.*?\}\}", "", roll))
            return
        lit = is_lit(pattern, picture.drawing)
        picture.file = self.folder / f"{picture.anchor}.{'png' if lit else 'pdf'}"
        margin = margin_of(picture)
        options = [*picture.drawing.options, "--size", f"{picture.width:.3f}x{picture.height:.3f}mm", "--margin", f"{margin:.3f}mm"]
        if lit:
            options += ["--dpi", str(DPI)]
        if picture.step:
            options += ["--step", f"{picture.step:.4f}mm"]
        if stroke := self.stroke(picture, pattern):
            options += ["--set", f"stroke={stroke}"]
        for each in () if picture.drawing.is_of_rules else picture.keys:
            options += ["--set", each]
        problem = self.program.makes("draw", pattern.path, picture.file, *options)
        if problem:
            raise ValueError(f"{pattern.name} {' '.join(picture.drawing.options)} cannot be drawn: {problem}")

    def fitting_step(self, picture: Picture) -> float:
        """The length of a step with which a drawing in the plane fills its picture, in millimetres; 0 in space."""
        box = dict(self.report("measure", picture.drawing)).get("ink", "none").split()
        if len(box) != 4:
            return 0.0
        wide, tall = float(box[2]) - float(box[0]), float(box[3]) - float(box[1])
        room = -2 * margin_of(picture)
        return min((side + room) / max(size, 1e-9) for side, size in ((picture.width, wide), (picture.height, tall)))

    def set_one_scale(self, figure: Figure, pictures: list[Picture]) -> None:
        step = min(map(self.fitting_step, pictures))
        if step == 0 and figure.step:
            of_step, width, height = figure.step
            step = of_step * min(min(each.width / width, each.height / height) for each in pictures)
        for each in pictures:
            each.step = step

    def stroke(self, picture: Picture, pattern: Pattern) -> str:
        """A thinner stroke, if that of the pattern is relative to the step and too thick in this picture; otherwise ""."""
        match = re.fullmatch(r"([0-9.]+) step\b *(.*)", pattern.keys.get("stroke", ""))
        if not match or any(each.startswith("stroke=") for each in picture.keys) or "view" in pattern.keys or "!" in pattern.text or picture.drawing.is_of_rules:
            return ""
        most = THICKEST * min(picture.width, picture.height)
        step = picture.step or self.fitting_step(picture)
        return f"{most:.3f}mm {match[2]}".strip() if float(match[1]) * step > most else ""

    def make_all(self, pictures: list[Picture], threads: int) -> None:
        # The program uses threads of its own only for pictures in light, which come first as they take longest.
        queue = sorted(pictures, key=lambda each: not is_lit(self.patterns[each.drawing.pattern], each.drawing))
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(self.make, queue))

    def report(self, command: str, drawing: Drawing) -> list[tuple[str, str]]:
        options = [each for each in drawing.options if not drawing.is_of_rules]
        if "--highlight" in options:
            at = options.index("--highlight")
            del options[at : at + 2]
        done = self.program.run("-q", command, self.patterns[drawing.pattern].path, *options)
        if done.returncode != 0:
            raise ValueError(f"{drawing.pattern} cannot be drawn: sikku {command}: {reason_of(done)}")
        return table_of(done.stdout)
