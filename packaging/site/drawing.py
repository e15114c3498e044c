"""Makes the pictures, downloads and reports of patterns with the program.

Names of patterns do not contain '_', so files whose names contain it never replace the download of another pattern.
"""

import re
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import midi
import png
from patterns import Pattern
from program import Program, table_of

SIZE = 160  # mm; pictures are square
PICTURE_BYTES = 150_000  # of a picture on the page of a pattern
THUMBNAIL_SVG_BYTES = 7_000  # larger ones are shown as pixels in galleries
THUMBNAIL_BYTES = 14_000
THUMBNAIL_PIXELS = 320
GROWTH_BYTES = 9_000
DOWNLOAD_BYTES = 2_100_000  # larger files are not stored; the page shows the command that makes them

# The kinds whose patterns have melodies; patterns of other kinds have one if they set keys of melodies.
HEARD = ("kolams", "kolam-library", "curves", "melodies", "arrangements")


@dataclass
class Made:
    """What a page shows of a pattern. Files are names in the folder of the pattern's files."""

    picture: str = ""
    thumbnail: str = ""
    growth: list[tuple[int, str]] = field(default_factory=list)  # n, file
    variants: dict[str, str] = field(default_factory=dict)  # name, file
    downloads: list[tuple[str, str, int]] = field(default_factory=list)  # label, file, bytes
    too_large: list[tuple[str, int]] = field(default_factory=list)  # label, bytes
    roll: str = ""
    report: list[tuple[str, str]] = field(default_factory=list)
    certificate: list[tuple[str, str]] = field(default_factory=list)
    melody: list[tuple[str, str]] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)


def smaller_picture(program: Program, source: Path, folder: Path, name: str, svg: Path, most: int, pixels: int,
                    *options: str, colours: int = 256) -> str:  # fmt: skip
    """Makes a PNG and returns its name; or that of the SVG, if it is smaller."""
    large = folder / "large.png"
    dpi = f"{pixels / SIZE * 25.4:.4f}"
    if program.makes("draw", source, large, "--size", f"{SIZE}x{SIZE}mm", "--dpi", dpi, *options):
        return svg.name
    data = png.reduced(large.read_bytes(), most, colours)
    large.unlink()
    if svg.exists() and svg.stat().st_size <= len(data):
        return svg.name
    (folder / f"{name}.png").write_bytes(data)
    return f"{name}.png"


def draw(program: Program, pattern: Pattern, folder: Path, made: Made) -> None:
    source, name = pattern.path, pattern.name
    svg = folder / f"{name}.svg"
    problem = program.makes("draw", source, svg, "--size", f"{SIZE}x{SIZE}mm")
    if problem:
        made.problems.append(f"not drawn: {problem}")
        return
    size = svg.stat().st_size
    made.picture = svg.name
    if size > 25_000:
        made.picture = smaller_picture(program, source, folder, name, svg, PICTURE_BYTES, 900)
    made.thumbnail = svg.name
    if size > THUMBNAIL_SVG_BYTES:
        made.thumbnail = smaller_picture(
            program, source, folder, f"{name}_small", svg, THUMBNAIL_BYTES, THUMBNAIL_PIXELS,
            colours=64 if pattern.kind == "plants" else 16 if "kolam" in pattern.kind else 32,
        )  # fmt: skip
    for label, file, options in (("SVG", svg, ()), ("PDF", folder / f"{name}.pdf", ("--size", "A4"))):
        if file != svg and program.makes("draw", source, file, *options):
            continue
        if file.stat().st_size <= DOWNLOAD_BYTES:
            made.downloads.append((label, file.name, file.stat().st_size))
        else:
            made.too_large.append((label, file.stat().st_size))
            if file.name not in (made.picture, made.thumbnail):
                file.unlink()
    if made.too_large and made.picture.endswith(".png"):
        made.downloads.append(("PNG", made.picture, (folder / made.picture).stat().st_size))


def grow(program: Program, pattern: Pattern, folder: Path, made: Made) -> None:
    """Draws earlier generations, if they differ."""
    if pattern.kind in ("kolam-library", "melodies", "words") or not pattern.steps or not made.picture:
        return
    last = pattern.steps
    steps = range(last - 4, last) if last <= 8 else [last * k // 5 for k in range(1, 5)]
    for n in steps:
        if n < 0:
            continue
        svg = folder / f"{pattern.name}_n{n}.svg"
        options = ["-n", str(n)]
        # A stroke as wide as a step would hide the first generations of a curve.
        stroke = re.fullmatch(r"([0-9.]+) step\b(.*)", pattern.keys.get("stroke", ""))
        if pattern.kind == "curves" and stroke and float(stroke[1]) > 0.45:
            options += ["--set", f"stroke=0.3 step{stroke[2]}"]
        if program.makes("draw", pattern.path, svg, "--size", f"{SIZE}x{SIZE}mm", *options):
            continue
        file = svg.name
        if svg.stat().st_size > 4_000:
            file = smaller_picture(
                program, pattern.path, folder, f"{pattern.name}_n{n}", svg, GROWTH_BYTES, 240, *options, colours=32
            )
        if file != svg.name:
            svg.unlink()
        made.growth.append((n, file))


def vary(program: Program, pattern: Pattern, folder: Path, made: Made) -> None:
    if not made.picture:
        return
    for number, (variant, _) in enumerate(pattern.variants, 1):
        name, options = f"{pattern.name}_variant{number}", ("--variant", variant)
        svg = folder / f"{name}.svg"
        problem = program.makes("draw", pattern.path, svg, "--size", f"{SIZE}x{SIZE}mm", *options)
        if problem:
            made.problems.append(f"the variant '{variant}' cannot be drawn: {problem}")
            continue
        file = svg.name
        if svg.stat().st_size > THUMBNAIL_SVG_BYTES:
            file = smaller_picture(
                program, pattern.path, folder, name, svg, THUMBNAIL_BYTES, THUMBNAIL_PIXELS, *options, colours=64
            )
        if file != svg.name:
            svg.unlink()
        made.variants[variant] = file


def play(program: Program, pattern: Pattern, folder: Path, made: Made) -> None:
    file = folder / f"{pattern.name}.mid"
    problem = program.makes("play", pattern.path, file)
    if problem:
        if pattern.kind in ("melodies", "arrangements"):
            made.problems.append(f"not played: {problem}")
        return
    size = file.stat().st_size
    if pattern.is_arrangement:
        # The report has a table for each part; the summary of the whole is printed when a file is made.
        again = program.run("play", pattern.path, "-o", file).stderr
        match = re.search(r"(.* notes), (.* bars?), (.*), (\S+ to \S+)", again)
        if match:
            made.melody = list(zip(("notes", "bars", "time", "range"), (each.split(" notes")[0].split(" bar")[0] for each in match.groups())))
    else:
        made.melody = table_of(program.run("-q", "play", pattern.path).stdout)
    if size > DOWNLOAD_BYTES:
        made.too_large.append(("MIDI", size))
        file.unlink()
        return
    made.downloads.append(("MIDI", file.name, size))
    roll = midi.piano_roll(file.read_bytes())
    if roll:
        made.roll = f"{pattern.name}_notes.svg"
        (folder / made.roll).write_text(roll)
    if pattern.is_arrangement and roll:
        made.picture = made.thumbnail = made.roll


def make(program: Program, pattern: Pattern, folder: Path) -> Made:
    """Makes all files of a pattern in a folder, and returns what they are."""
    made = Made()
    if not pattern.is_arrangement:
        draw(program, pattern, folder, made)
        grow(program, pattern, folder, made)
        vary(program, pattern, folder, made)
        made.report = table_of(program.run("-q", "measure", pattern.path).stdout)
        if "kolam" in pattern.kind:
            made.certificate = table_of(program.run("-q", "kolam", pattern.path).stdout)
        elif pattern.kind == "tilings":
            made.certificate = table_of(program.run("-q", "tiling", pattern.path).stdout)
    if pattern.kind in HEARD:
        play(program, pattern, folder, made)
    return made


def draw_text(program: Program, text: str, file: Path, *options: str) -> str:
    """Draws a pattern that is not a file. Returns the reason if it cannot be drawn."""
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "example.lsys"
        source.write_text(text)
        return program.makes("draw", source, file, "--size", f"{SIZE}x{SIZE}mm", *options)
