"""The pictures of figures: their places in a grid, and the files that the program makes for them."""

import math
import re
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import midi
from figures import Drawing, Figure
from patterns import Pattern
from program import Program, table_of

GAP = 2.5  # mm between pictures
LABEL = 5.0  # mm, a line below a picture
DPI = 300  # of pictures in light


@dataclass
class Picture:
    """A picture in the book. Sizes are in millimetres."""

    drawing: Drawing
    label: str
    anchor: str
    width: float
    height: float
    step: float = 0.0  # mm; 0: the drawing fills the picture
    ground: str = ""
    file: Path | None = None


def rows_of(count: int, columns: int) -> list[int]:
    """How many pictures each row has; a last row is not much shorter than the others."""
    rows = math.ceil(count / columns)
    if count % columns == 0 or columns == 1:
        return [min(columns, count)] * rows
    return [count // rows + (1 if row < count % rows else 0) for row in range(rows)]


def best_columns(count: int, width: float, height: float) -> int:
    """The number of columns that makes the largest square fit into each picture."""

    def side(columns: int) -> float:
        rows = math.ceil(count / columns)
        return min((width - GAP * (columns - 1)) / columns, (height - GAP * (rows - 1)) / rows - LABEL)

    return max(range(1, count + 1), key=lambda columns: (side(columns), -columns))


def laid_out(figure: Figure, width: float, height: float) -> list[list[Picture]]:
    """The pictures of a figure in rows, in an area of this size with labels."""
    count = len(figure.drawings)
    label = LABEL if figure.labels else 0.0
    rows = rows_of(count, figure.columns or best_columns(count, width, height))
    tall = (height - GAP * (len(rows) - 1)) / len(rows) - label
    laid, at = [], 0
    for columns in rows:
        wide = (width - GAP * (columns - 1)) / columns
        row = []
        for drawing in figure.drawings[at : at + columns]:
            label_text = figure.labels[at] if figure.labels else ""
            row.append(Picture(drawing, label_text, f"{figure.anchor}-picture-{at + 1}", wide, tall, ground=figure.ground))
            at += 1
        laid.append(row)
    if figure.step:
        step, of_width, of_height = figure.step
        scale = min(min(each.width / of_width, each.height / of_height) for row in laid for each in row)
        for row in laid:
            for each in row:
                each.step = step * scale
    return laid


def is_lit(pattern: Pattern, drawing: Drawing) -> bool:
    return "light" in pattern.keys and not drawing.is_of_rules


class Studio:
    """Makes the files of pictures in a folder."""

    def __init__(self, program: Program, patterns: dict[str, Pattern], folder: Path):
        self.program, self.patterns, self.folder = program, patterns, folder

    def make(self, picture: Picture) -> None:
        """Makes a PDF of the picture; a PNG if it is in light, an SVG if it is a piano roll. Raises ValueError."""
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
        margin = 0.09 * min(picture.width, picture.height)
        options = [*picture.drawing.options, "--size", f"{picture.width:.3f}x{picture.height:.3f}mm", "--margin", f"{margin:.3f}mm"]
        if lit:
            options += ["--dpi", str(DPI)]
        if picture.step:
            options += ["--step", f"{picture.step:.4f}mm"]
        if picture.ground:
            options += ["--set", f"ground={picture.ground}"]
        problem = self.program.makes("draw", pattern.path, picture.file, *options)
        if problem:
            raise ValueError(f"{pattern.name} {' '.join(picture.drawing.options)} cannot be drawn: {problem}")

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
        return table_of(done.stdout) if done.returncode == 0 else []
