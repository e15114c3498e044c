"""Reads figures.toml, which lists the figures of the book, with the pattern files and gallery files that it names."""

import itertools
import re
import shlex
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from patterns import Pattern, read_all, typographic

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
FILE = HERE / "figures.toml"

# Sentences of a pattern's description that say what was mended or reconstructed.
REMADE = re.compile(r"\b(Mended|mended|[Rr]econstruct\w*|guess\w*|does not (say|tell)|text leaves? (it )?open|leaves open)\b")
FIGURE_KEYS = {
    "number", "chapter", "title", "draw", "gallery", "labels", "systems", "columns", "turn", "one_scale", "set", "half", "caption",
    "note", "without", "left_out", "index",
}  # fmt: skip


@dataclass(frozen=True)
class Drawing:
    """A picture of a figure as a call of the program."""

    pattern: str
    options: tuple[str, ...] = ()
    is_played: bool = False  # a piano roll

    @property
    def n(self) -> str:
        return self.options[self.options.index("-n") + 1] if "-n" in self.options else ""

    @property
    def is_of_rules(self) -> bool:
        return "--rule" in self.options


@dataclass
class Figure:
    number: str
    title: str = ""
    chapter: str = ""
    drawings: list[Drawing] = field(default_factory=list)
    labels: list[str] = field(default_factory=list)
    systems: list[str] = field(default_factory=list)  # names of patterns
    columns: list[int] = field(default_factory=list)  # of each row; one number: of all; empty: the number that makes pictures largest
    turn: int = 0  # pictures on the first page; others are on a second one, above the systems; 0: all
    has_one_scale: bool = False
    step: tuple[float, float, float] | None = None  # of a gallery, and width and height of its pictures, in mm
    keys: list[str] = field(default_factory=list)  # KEY=VALUE, for all pictures
    is_half: bool = False
    caption: str = ""
    note: str = ""
    without: str = ""
    left_out: str = ""
    index: list[str] = field(default_factory=list)
    anchor: str = ""


@dataclass
class Document:
    name: str
    short: str
    reference: str
    about: str
    cover: Drawing
    figures: list[Figure]


def range_of(text: str) -> list[str]:
    """`2:9`, `0:12:3` or `1,4,5` as numbers."""
    numbers: list[str] = []
    for part in text.split(","):
        ends = [int(each) for each in part.split(":")]
        first, last, step = (ends + [ends[0]])[0], ends[min(1, len(ends) - 1)], ends[2] if len(ends) > 2 else 1
        numbers += map(str, range(first, last + 1, step))
    return numbers


def drawings_of(text: str) -> list[Drawing]:
    """The drawings that a line of `draw` stands for: several if -n or --variant have several values."""
    words = shlex.split(text)
    is_played = words[0] == "play"
    name, *options = words[1:] if is_played else words
    choices: list[list[tuple[str, ...]]] = []
    at = 0
    while at < len(options):
        option = options[at]
        if option in ("-n", "--variant"):
            values = range_of(options[at + 1]) if option == "-n" else options[at + 1].split(",")
            choices.append([(option, value) for value in values])
        elif option in ("--set", "--seed", "--highlight", "--view"):
            choices.append([(option, options[at + 1])])
        elif option == "--rule":
            choices.append([(option,)])
            at -= 1
        else:
            raise ValueError(f"'{text}': unknown option {option}")
        at += 2
    return [Drawing(name, tuple(itertools.chain(*each)), is_played) for each in itertools.product(*choices)]


def gallery_of(name: str) -> tuple[list[Drawing], tuple[float, float, float] | None]:
    """The drawings of a gallery file, and the step that it sets."""
    contents = tomllib.loads((ROOT / f"patterns/posters/{name}.toml").read_text())
    drawings: list[Drawing] = []

    def listed(value: object) -> list[str]:
        return [str(each) for each in value] if isinstance(value, list) else [str(value)]

    for item in contents["item"]:
        variants = listed(item["variant"]) if "variant" in item else [""]
        steps = [number for each in listed(item["n"]) for number in range_of(each)] if "n" in item else [""]
        for pattern, variant, n in itertools.product(listed(item["pattern"]), variants, steps):
            options = (("--variant", variant) if variant else ()) + (("-n", n) if n else ())
            drawings.append(Drawing(pattern, options))
    if "step" not in contents:
        return drawings, None
    width, height = contents["size"].removesuffix("mm").split("x")
    return drawings, (float(contents["step"].removesuffix("mm")), float(width), float(height))


def split_description(text: str) -> tuple[str, str]:
    """Splits a description: the sentences about the pattern, and those about what was mended or reconstructed."""
    sentences = re.split(r"(?<=[.!?])\s+(?=[A-Z(])", text)
    mending, kept, remade = False, [], []
    for sentence in sentences:
        # All sentences after ‘Mended:’ describe what was mended.
        mending = mending or sentence.startswith("Mended")
        (remade if mending or REMADE.search(sentence) else kept).append(sentence)
    return " ".join(kept), " ".join(remade)


def label_of(drawing: Drawing, same_pattern: bool, pattern: Pattern) -> str:
    if "--variant" in drawing.options:
        variant = drawing.options[drawing.options.index("--variant") + 1]
        return f"{variant}, n = {drawing.n}" if drawing.n else variant
    if drawing.n:
        return f"n = {drawing.n}"
    return f"n = {pattern.steps}" if same_pattern else pattern.title


def read_figure(entry: dict, chapter: str, patterns: dict[str, Pattern]) -> Figure:
    if unknown := set(entry) - FIGURE_KEYS:
        raise ValueError(f"{entry.get('number')}: unknown key '{sorted(unknown)[0]}'")
    columns = entry.get("columns", [])
    figure = Figure(
        entry["number"], entry.get("title", ""), entry.get("chapter", chapter), turn=entry.get("turn", 0),
        columns=columns if isinstance(columns, list) else [columns],
        keys=entry.get("set", []), is_half=entry.get("half", False), caption=typographic(entry.get("caption", "")),
        note=typographic(entry.get("note", "")), without=entry.get("without", ""), left_out=entry.get("left_out", ""),
        index=entry.get("index", []),
    )  # fmt: skip
    if figure.left_out:
        return figure
    if "gallery" in entry:
        figure.drawings, figure.step = gallery_of(entry["gallery"])
        figure.has_one_scale = figure.step is not None
    figure.drawings += [each for line in entry.get("draw", []) for each in drawings_of(line)]
    figure.has_one_scale |= entry.get("one_scale", False)
    if not figure.drawings:
        raise ValueError(f"{figure.number}: neither drawn nor left out")
    names = list(dict.fromkeys(each.pattern for each in figure.drawings))
    systems = entry.get("systems", [each for each in names if not all(d.is_played for d in figure.drawings if d.pattern == each)])
    for name in names + systems:
        if name not in patterns:
            raise ValueError(f"{figure.number}: unknown pattern '{name}'")
    figure.systems = systems
    first = patterns[names[0]]
    figure.title = figure.title or first.title
    if len(names) == 1:
        caption, note = split_description(first.description)
        if "caption" not in entry:
            figure.caption = caption
            figure.note = figure.note or note
    if not figure.caption:
        raise ValueError(f"{figure.number}: no caption")
    if "labels" in entry:
        figure.labels = [typographic(each) for each in entry["labels"]]
        if len(figure.labels) != len(figure.drawings):
            raise ValueError(f"{figure.number}: {len(figure.labels)} labels for {len(figure.drawings)} drawings")
    if sum(figure.columns[1:]) and sum(figure.columns) != len(figure.drawings):
        raise ValueError(f"{figure.number}: {sum(figure.columns)} places for {len(figure.drawings)} drawings")
    if not figure.labels and len(figure.drawings) > 1:
        figure.labels = [label_of(each, len(names) == 1, patterns[each.pattern]) for each in figure.drawings]
    return figure


def read(file: Path = FILE) -> tuple[list[Document], dict[str, Pattern]]:
    """The documents, and all bundled patterns by name. Raises ValueError for entries that cannot be drawn."""
    patterns = {each.name: each for group in read_all(ROOT / "patterns").values() for each in group}
    documents = []
    for at, entry in enumerate(tomllib.loads(file.read_text())["document"]):
        figures = []
        chapter = entry["name"]
        for number, each in enumerate(entry["figure"], 1):
            figures.append(read_figure(each, chapter, patterns))
            figures[-1].anchor = f"figure-{at + 1}-{number}"
            chapter = figures[-1].chapter
        cover = drawings_of(entry["cover"])[0]
        documents.append(Document(entry["name"], entry["short"], entry["reference"], entry["about"].strip(), cover, figures))
    return documents, patterns
