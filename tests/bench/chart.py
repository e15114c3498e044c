"""A chart as a pattern file, which the program draws: lines over two logarithmic axes, each named at its end."""
import math
from dataclasses import dataclass

STEPS = 2.0  # of a decade, on both axes
LETTER = 0.34  # height of capitals, in steps
COLOURS = ["#b3452c", "#1f6f6b", "#c98a12", "#39538f", "#7a3b69", "#4f7a28", "#8a5a33", "#2b2b2b"]
AXIS = len(COLOURS) + 1  # colour 0 is that of the stroke
GRID = AXIS + 1


@dataclass
class Line:
    name: str
    points: list[tuple[float, float]]


class Word:
    """A word that draws: straight steps and texts at absolute places."""

    def __init__(self) -> None:
        self.symbols: list[str] = []
        self.labels: list[str] = []
        self.at = (0.0, 0.0)

    def step(self, symbol: str, to: tuple[float, float]) -> None:
        dx, dy = to[0] - self.at[0], to[1] - self.at[1]
        length, angle = math.hypot(dx, dy), math.degrees(math.atan2(dy, dx))
        if length > 1e-6:
            self.symbols.append(f"+({angle:.5f}){symbol}({length:.5f})-({angle:.5f})")
        self.at = to

    def line(self, points: list[tuple[float, float]], colour: int, width: float) -> None:
        self.symbols.append(f";({colour})!({width})")
        self.step("f", points[0])
        for point in points[1:]:
            self.step("F", point)

    def disc(self, at: tuple[float, float], radius: float, colour: int) -> None:
        self.symbols.append(f";({colour})")
        self.step("f", at)
        self.symbols.append(f"@O({radius})")

    def text(self, text: str, at: tuple[float, float], colour: int, left: bool = False) -> None:
        """`at` is the middle of the text, or of its left edge."""
        shift = width(text) / 2 if left else 0
        self.symbols.append(f";({colour})!(0.045)")
        self.step("f", (at[0] + shift, at[1]))
        self.labels.append(text)
        self.symbols.append(f" T{len(self.labels)} ")


def width(text: str) -> float:
    """About the width of a text, in steps."""
    return sum(0.42 if c in "iljtf.,: " else 1.12 if c in "mwMW" else 0.82 for c in text) * LETTER


def power(exponent: int, unit: str) -> str:
    """A power of ten as it is read, with its unit."""
    names = {"s": {-3: "1 ms", -2: "10 ms", -1: "100 ms", 0: "1 s", 1: "10 s", 2: "100 s"},
             "MB": {0: "1 MB", 1: "10 MB", 2: "100 MB", 3: "1 GB", 4: "10 GB"},
             "": {1: "10", 2: "100", 3: "1000"}}
    if exponent in names[unit]:
        return names[unit][exponent]
    return f"10^{exponent} {unit}".rstrip()


def apart(places: list[float], least: float) -> list[float]:
    """Places moved as little as needed to lie `least` apart, in their order."""
    order = sorted(range(len(places)), key=lambda i: places[i])
    moved = list(places)
    for _ in range(400):
        for a, b in zip(order, order[1:]):
            lack = least - (moved[b] - moved[a])
            if lack > 0:
                moved[a] -= lack / 2
                moved[b] += lack / 2
    return moved


def chart(title: str, lines: list[Line], unit: str) -> str:
    """The pattern file of a chart. Sizes and values are positive; lines end at their largest size."""
    sizes = [math.log10(x) for line in lines for x, _ in line.points]
    values = [math.log10(y) for line in lines for _, y in line.points]
    x0, x1 = math.floor(min(sizes)), math.ceil(max(sizes))
    y0, y1 = math.floor(min(values)), math.ceil(max(values))

    def place(x: float, y: float) -> tuple[float, float]:
        return (x - x0) * STEPS, (y - y0) * STEPS

    word = Word()
    for x in range(x0, x1 + 1):
        word.line([place(x, y0), place(x, y1)], GRID, 0.03)
        word.text(power(x, ""), (place(x, y0)[0], -0.6), AXIS)
    for y in range(y0, y1 + 1):
        word.line([place(x0, y), place(x1, y)], GRID, 0.03)
        name = power(y, unit)
        word.text(name, (-0.35 - width(name), place(x0, y)[1]), AXIS, left=True)
    word.text(title, (0, place(x0, y1)[1] + 0.9), AXIS, left=True)
    ends = [place(math.log10(line.points[-1][0]), math.log10(line.points[-1][1])) for line in lines]
    right = place(x1, y0)[0] + 0.9
    for i, (line, end, y) in enumerate(zip(lines, ends, apart([e[1] for e in ends], LETTER * 1.75))):
        colour = 1 + i % len(COLOURS)
        word.line([end, (right - 0.3, y)], GRID, 0.03)
        word.line([place(math.log10(a), math.log10(b)) for a, b in line.points], colour, 0.09)
        for a, b in line.points:
            word.disc(place(math.log10(a), math.log10(b)), 0.1, colour)
        word.text(line.name, (right, y), colour, left=True)
    names = [f"T{i + 1}" for i in range(len(word.labels))]
    return "\n".join([
        f"title: {title}", f"axiom: {''.join(word.symbols)}", f"symbols: {' '.join(names)}",
        *(f"label {name}: {text}" for name, text in zip(names, word.labels)),
        "turn: left", "heading: 0", f"lettering: {LETTER}", "stroke: 1 step #000",
        f"palette: #000 {' '.join(COLOURS)} #55504a #e2dccf", "ground: #fbf8f1", "",
    ])
