#!/usr/bin/env python3
"""Measures how time and memory grow with the size of the work, beside other programs, and writes the results.

Usage: scaling.py PROGRAM [--repeats N] [--only WORK …] [--note TEXT] [--write]

Every point runs a whole program, several times, and counts processor time (user and system, of all cores) and peak
memory; the median stands. The works of a series and those of its peers take turns, so that they see the same machine.
The exponent is the slope of log time over log size, by least squares, of the points that take twice as long as
`PROGRAM --version` or more, after that time is subtracted. --write replaces the generated part of docs/performance.md
and draws its charts by PROGRAM itself; --note says under which conditions. Peers that are not installed are left out,
which the page says: node and npm (lindenmayer is fetched into a folder that is removed afterwards), inkscape with
python3-lxml, python3-cssselect and python3-numpy, imagemagick, librsvg2-bin, midicsv, potrace.
"""
import argparse
import json
import math
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from chart import Line, chart

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/performance.md"
BEGIN, END = "<!-- measured by tests/bench/scaling.py -->", "<!-- end of what was measured -->"
INKSCAPE = Path("/usr/share/inkscape/extensions/lindenmayer.py")
LINDENMAYER = "lindenmayer@1.5.4"
MOST_SECONDS_OF_PEERS = 30
HATS: list[object] = ["-n", 7, "--set", "edge b=f", "--set", "edge d=f"]

CHANCE = "axiom: F\nF --> F[+F]F[-F]F : 0.33\nF --> F[+F]F : 0.33\nF --> F[-F]F : 0.34\n"
CONTEXTS = "hogeweg-hesper-a"  # figure 3.11a
PARAMETERS = (
    "axiom: A(100,30)\nA(s,w) : s >= 0 --> !(w)F(s)[+(35)/(0)A(s*0.75,w*0.5^0.4)][+(-35)/(0)A(s*0.77,w*0.5^0.4)]\n"
)
DICE = 'title: Dice\naxiom: F\nderivation length: 4\nF --> F[+F]F : 0.5\nF --> F[-F]F : 0.5\nangle increment: 25\n'
LINDENMAYER_SYSTEMS = {  # pattern, and derivation lengths that take it up to some seconds
    "derive": ("koch-island", [3, 4, 5, 6]),
    "by chance": (CHANCE, [5, 7, 9]),
    "parameters": (PARAMETERS, [8, 11, 14]),
    "contexts": (CONTEXTS, [15, 25, 35]),
}


@dataclass
class Point:
    size: int
    command: list[str]
    needs: Path | None = None
    seconds: float = 0
    megabytes: float = 0


@dataclass
class Work:
    name: str
    counted: str
    what: str
    limit: str
    points: list[Point]
    peers: dict[str, list[Point]] = field(default_factory=dict)


class Bench:
    """The program, a folder for its files, and the ways to run it."""

    def __init__(self, program: str, folder: Path):
        self.program, self.folder = program, folder
        self.lindenmayer = self.fetch_lindenmayer()

    def fetch_lindenmayer(self) -> Path | None:
        if not shutil.which("npm"):
            return None
        command = ["npm", "install", "--no-audit", "--no-fund", "--silent", LINDENMAYER]
        fetched = subprocess.run(command, cwd=self.folder, capture_output=True, check=False)
        return self.folder if fetched.returncode == 0 else None

    def path(self, name: str, text: str | None = None) -> str:
        if text is not None:
            (self.folder / name).write_text(text)
        return str(self.folder / name)

    def sikku(self, *words: object) -> list[str]:
        return [self.program, "--quiet", *map(str, words)]

    def measured(self, pattern: str, n: int, key: str) -> int:
        answer = subprocess.run(self.sikku("measure", pattern, "-n", n, "--json"), capture_output=True, check=True)
        return int(json.loads(answer.stdout)[key])

    def make(self, *words: object) -> None:
        subprocess.run(self.sikku(*words), check=True, stdout=subprocess.DEVNULL)


def run(command: list[str], folder: Path, most_seconds: float | None = None) -> tuple[float, float] | None:
    """Processor seconds and peak megabytes; none if it takes too long. A child's peak counts that of the process that
    forked it, up to the moment it begins: `time` is small."""
    peak = folder / "peak"
    limit = ["timeout", str(most_seconds)] if most_seconds else []
    with open(folder / "errors", "wb") as errors:
        process = subprocess.Popen(
            ["time", "-q", "-f", "%M", "-o", str(peak), *limit, *command], stdout=subprocess.DEVNULL, stderr=errors, cwd=folder
        )
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if most_seconds and process.returncode == 124:
        return None
    if process.returncode != 0:
        sys.exit(f"{' '.join(command)}: {(folder / 'errors').read_text(errors='replace').strip()}")
    return usage.ru_utime + usage.ru_stime, int(peak.read_text().split()[-1]) / 1024


def series(sizes: list[int], commands: list[list[str]]) -> list[Point]:
    return [Point(size, command) for size, command in zip(sizes, commands, strict=True)]


def works(bench: Bench) -> list[Work]:
    """All works with the peers that this machine has."""
    b, out = bench, bench.path
    chance, parameters = out("chance.lsys", CHANCE), out("parameters.lsys", PARAMETERS)

    def derive(name: str, what: str, limit: str, pattern: str, lengths: list[int]) -> Work:
        sizes = [b.measured(pattern, n, "symbols") for n in lengths]
        return Work(name, "symbols", what, limit, series(sizes, [b.sikku("derive", pattern, "-n", n) for n in lengths]))

    hilbert = {n: 4**n - 1 for n in range(4, 13)}
    widths = [256, 512, 1024, 2048, 4096, 8192]

    def picture(name: str, pattern: str, n: int, pixels: list[int], *options: str) -> list[Point]:
        return series(
            [w * w for w in pixels],
            [
                b.sikku("draw", pattern, "-n", n, "--size", f"{w}x{w}mm", "--dpi", "25.4", *options, "-o", out(f"{name}.png"))
                for w in pixels
            ],
        )

    dots = [5, 10, 20, 40, 80, 160]
    photographs = [300, 600, 1200, 2400, 4800]
    b.make("kolam", "--grid", "9x9", "--single-line", "--symmetry", "C4", "--dots", "-o", out("grid.lsys"))
    for width in photographs:
        b.make("draw", out("grid.lsys"), "--size", f"{width}x{width}mm", "--dpi", "25.4", "-o", out(f"photograph-{width}.png"))
    jobs = [10, 100, 1000, 10000]
    dice = out("dice.lsys", DICE)
    rhombs = [4, 6, 8, 10, 12]
    generations = [4, 7, 10, 13, 16, 19]
    squares = out("squares.lsys", "map: clockwise\naxiom: A~B~AB\nA --> B[-A][+~A]B\nB --> ~A\n")
    notes = {n: round(4**n * 0.4) for n in range(6, 13)}
    light = [128, 256, 512, 1024, 2048, 4096]

    all_works = [
        derive("derive", "the quadratic Koch island", "memory: symbols are copied into the pipe", "koch-island", [3, 4, 5, 6, 7, 8, 9]),
        derive("by chance", "three weighted successors (figure 3.16)", "arithmetic: a random number for each symbol", chance, [7, 9, 11, 13, 14]),
        derive("parameters", "modules of equation 11, with their numbers printed", "arithmetic: numbers are printed", parameters, [8, 11, 14, 17, 20]),
        derive("contexts", "signals of figure 3.11a", "memory: whole words are kept", CONTEXTS, [15, 25, 35, 45, 55]),
        Work("draw", "segments", "Hilbert curve as SVG", "the encoder of numbers",
             series(list(hilbert.values()), [b.sikku("draw", "hilbert", "-n", n, "-o", out("draw.svg")) for n in hilbert])),
        Work("picture", "pixels", "Hilbert curve of 1,048,575 segments as PNG", "compression", picture("picture", "hilbert", 10, widths)),
        Work("deep view", "pixels", "Hilbert curve n = 60 as PNG", "parts of the size of a pixel", picture("deep", "hilbert", 60, widths)),
        Work("light", "pixels", "a bush in light, as PNG", "arithmetic: rays from each pixel to the sky", picture("light", "bush-3d", 7, light, "--light", "sky")),
        Work("kolam", "dots", "a single line on a square grid, woven into a pattern", "the search for a single line",
             series([d * d for d in dots], [b.sikku("kolam", "--grid", f"{d}x{d}", "--single-line", "-o", out("kolam.lsys")) for d in dots])),
        Work("tiling", "tiles", "Penrose rhombs certified", "memory: random access to a table of points",
             series([b.measured("penrose-rhombs", n, "polygons") for n in rhombs],
                    [b.sikku("tiling", "penrose-rhombs", "-n", n) for n in rhombs])),
        Work("map", "cells", "a map that divides into squares, measured", "memory: random access to the edges of cells",
             series([2**n for n in generations], [b.sikku("measure", squares, "-n", n) for n in generations])),
        Work("play", "notes", "Hilbert curve as MIDI", "the encoder of events",
             series(list(notes.values()), [b.sikku("play", "hilbert", "-n", n, "-o", out("play.mid")) for n in notes])),
        Work("gallery", "jobs", "plants by chance as SVG", "the file system: a file for each job",
             series(jobs, [b.sikku("gallery", dice, "--force", "--seed", f"1:{count}", "-f", "svg", "-o", out(f"gallery-{count}")) for count in jobs])),
        Work("read", "pixels", "a kolam read from a picture", "arithmetic: filters over the picture",
             series([w * w for w in photographs],
                    [b.sikku("kolam", "--read", out(f"photograph-{w}.png"), "-o", out("read.lsys")) for w in photographs])),
    ]
    for work in all_works:
        work.peers = {name: points for name, points in peers(bench, work.name).items() if points}
    return all_works


def figures(bench: Bench) -> list[tuple[str, Point]]:
    """Works of a single size, as users meet them."""
    b, out = bench, bench.path
    strokes = out("strokes.lsys", "axiom: X\nderivation length: 20\nX --> XY\nY --> YX\ninterpret:\nX --> +(37)F(0.4)f(0.3)\nY --> -(53)F(0.2)f(0.9)\n")

    def draw(what: str, *words: object) -> tuple[str, Point]:
        return what, Point(1, b.sikku("draw", *words))

    return [
        ("the length, counts and extent of the Hilbert curve, n = 60", Point(1, b.sikku("measure", "hilbert", "-n", 60))),
        ("the number of Penrose rhombs, n = 60", Point(1, b.sikku("tiling", "penrose-rhombs", "-n", 60, "--counts"))),
        ("bar 10^9 of the Hilbert curve n = 40 as MIDI", Point(1, b.sikku(
            "play", "hilbert", "-n", 40, "--from-bar", 10**9, "--bars", 1, "-o", out("bar.mid")))),
        draw("a kolam as a thumbnail of 200 pixels", "snake-kolam", "--size", "200x200mm", "--dpi", "25.4", "-o", out("thumbnail.png")),
        *(draw(f"a kolam on A0 at 300 dpi, compression {level}", "snake-kolam", "--size", "A0", "--compression", level,
               "-o", out("a0.png")) for level in (1, 6)),
        *(draw(f"{plant} in light on A4 at 150 dpi", plant, "--size", "A4", "--dpi", 150, "--light", "sky", "-o", out("plant.png"))
          for plant in ("lilac", "fern", "lily-of-the-valley", "date-palm", "bush-3d")),
        draw("a million strokes that never meet, as a plot", strokes, "-o", out("strokes.gcode")),
        ("832,040 hats with equal edges, certified", Point(1, b.sikku("tiling", "hat", *HATS))),
        ("1,048,576 chairs, certified", Point(1, b.sikku("tiling", "chair", "-n", 10))),
        draw("982,090 Penrose rhombs on A0 at 300 dpi", "penrose-rhombs", "-n", 13, "--size", "A0", "-o", out("rhombs.png")),
        ("a gallery of 400 thumbnails of 200 pixels", Point(1, b.sikku(
            "gallery", out("dice.lsys"), "--force", "--seed", "1:400", "-f", "png", "--size", "200x200mm", "--dpi", "25.4",
            "-o", out("thumbnails")))),
    ]


def peers(bench: Bench, work: str) -> dict[str, list[Point]]:
    """The same work by other programs, at sizes that they reach in seconds, or at the sizes of the work."""
    out = bench.path
    if work in LINDENMAYER_SYSTEMS and bench.lindenmayer:
        pattern, lengths = LINDENMAYER_SYSTEMS[work]
        script = str(Path(__file__).with_name("lindenmayer_peer.mjs"))
        source = out(f"{work.replace(' ', '-')}-peer.lsys", pattern) if "\n" in pattern else pattern
        return {"lindenmayer (npm)": series(
            [bench.measured(source, n, "symbols") for n in lengths],
            [["node", script, str(bench.lindenmayer), work, str(n)] for n in lengths])}
    if work == "draw" and has_inkscape():
        page = out("page.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200"/>')
        orders = [4, 5, 6, 7, 8]
        return {"Inkscape's extension": series([4**n - 1 for n in orders], [[
            "/usr/bin/python3", str(INKSCAPE), f"--order={n}", "--langle=90", "--rangle=90", "--step=1", "--axiom=A",
            "--rules=A=-BF+AFA+FB-;B=+AF-BFB-FA+", page] for n in orders])}
    if work == "picture":
        drawing, found = out("peer.svg"), {}
        bench.make("draw", "hilbert", "-n", 10, "--size", "256x256mm", "-o", drawing)
        widths = [256, 512, 1024, 2048, 4096]
        if shutil.which("rsvg-convert"):
            found["rsvg-convert (Cairo)"] = series([w * w for w in widths], [
                ["rsvg-convert", "--unlimited", "-w", str(w), drawing, "-o", out("peer.png")] for w in widths])
        if shutil.which("convert"):
            found["ImageMagick"] = series([w * w for w in widths[:3]], [
                ["convert", "-size", f"{w}x{w}", f"msvg:{drawing}", out("magick.png")] for w in widths[:3]])
        return found
    if work == "deep view":
        # The matching order: steps as long as the smallest part that a picture of order 60 shows.
        widths = [256, 512, 1024, 2048, 4096, 8192]
        return {"the same program, all segments": series([w * w for w in widths], [
            bench.sikku("draw", "hilbert", "-n", round(math.log2(w)) + 1, "--size", f"{w}x{w}mm", "--dpi", "25.4", "-o", out("full.png"))
            for w in widths])}
    if work == "play" and shutil.which("csvmidi"):
        orders = [6, 7, 8, 9]
        for n in orders:
            bench.make("play", "hilbert", "-n", n, "-o", out(f"peer-{n}.mid"))
            with open(out(f"peer-{n}.csv"), "wb") as text:
                subprocess.run(["midicsv", out(f"peer-{n}.mid")], stdout=text, check=True)
        return {"csvmidi": series([round(4**n * 0.4) for n in orders], [
            ["csvmidi", out(f"peer-{n}.csv"), out("peer.mid")] for n in orders])}
    if work == "read" and shutil.which("potrace") and shutil.which("convert"):
        widths = [300, 600, 1200, 2400, 4800]
        for w in widths:
            subprocess.run(["convert", out(f"photograph-{w}.png"), out(f"photograph-{w}.pbm")], check=True)
        return {"potrace (outlines only)": series([w * w for w in widths], [
            ["potrace", "-s", out(f"photograph-{w}.pbm"), "-o", out("traced.svg")] for w in widths])}
    return {}


def has_inkscape() -> bool:
    """Whether Inkscape's extension runs, which needs several of Debian's Python modules."""
    return subprocess.run(["/usr/bin/python3", str(INKSCAPE), "--help"], capture_output=True, check=False).returncode == 0


def measure(work: Work, bench: Bench, repeats: int) -> None:
    """Fills in the points of a work and of its peers, in turns; points at which a peer takes too long are left out."""
    runs: dict[int, list[tuple[float, float]]] = {}
    for _ in range(repeats):
        for points in [work.points, *work.peers.values()]:
            for at, point in enumerate(list(points)):
                found = run(point.command, bench.folder, MOST_SECONDS_OF_PEERS if points is not work.points else None)
                if found is None:
                    del points[at:]
                    break
                runs.setdefault(id(point), []).append(found)
    for point in [point for points in [work.points, *work.peers.values()] for point in points]:
        point.seconds = statistics.median(seconds for seconds, _ in runs[id(point)])
        point.megabytes = statistics.median(megabytes for _, megabytes in runs[id(point)])
    work.peers = {name: points for name, points in work.peers.items() if points}


def slope(pairs: list[tuple[float, float]]) -> float | None:
    """Least squares of log y over log x; none for fewer than two points."""
    logs = [(math.log(x), math.log(y)) for x, y in pairs if x > 0 and y > 0]
    if len(logs) < 2:
        return None
    mx, my = statistics.mean(x for x, _ in logs), statistics.mean(y for _, y in logs)
    return sum((x - mx) * (y - my) for x, y in logs) / sum((x - mx) ** 2 for x, _ in logs)


def exponents(points: list[Point], seconds: float, megabytes: float) -> tuple[float | None, float | None]:
    """Of time and memory, beyond those of a program that does nothing."""
    return (slope([(p.size, p.seconds - seconds) for p in points if p.seconds > 2 * seconds]),
            slope([(p.size, p.megabytes - megabytes) for p in points if p.megabytes > 2 * megabytes]))


def time_text(seconds: float) -> str:
    return f"{seconds * 1000:.1f} ms" if seconds < 0.1 else f"{seconds:.2f} s" if seconds < 10 else f"{seconds:.1f} s"


def size_text(size: int) -> str:
    return f"{size:,}"


def exponent_text(value: float | None) -> str:
    return "constant" if value is None else f"{value:.2f}"


def machine() -> str:
    names = [line.split(":", 1)[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
    memory = int(Path("/proc/meminfo").read_text().split()[1]) / 1024 / 1024
    return f"{len(names)} cores of {names[0] if names else 'an unnamed processor'}, {memory:.0f} GB"


def page(measured: list[Work], single: list[tuple[str, Point]], nothing: tuple[float, float], repeats: int,
         missing: list[str], note: str) -> str:
    seconds, megabytes = nothing
    lines = [
        f"{machine()}; {f'medians of {repeats} runs' if repeats > 1 else 'one run'} of the whole program: processor time of all cores together, and peak memory. "
        f"A program that does nothing (`sikku --version`) takes {time_text(seconds)} and {megabytes:.0f} MB. Exponents are "
        "those of what is beyond it: 1 is time in proportion to the size; *constant*: too little grows to be fitted. "
        f"{note}".rstrip(), "",
        "![Processor time over size](performance-time.png)", "", "![Peak memory over size](performance-memory.png)", "",
        "| work | largest | time | a second | memory | exponent of time | of memory | limit |", "|---|---|---|---|---|---|---|---|",
    ]
    for work in measured:
        last = work.points[-1]
        time_exponent, memory_exponent = exponents(work.points, seconds, megabytes)
        lines.append(
            f"| {work.name}: {work.what} | {size_text(last.size)} {work.counted} | {time_text(last.seconds)} | "
            f"{rate_text(last.size / max(last.seconds - seconds, 1e-4))} | {last.megabytes:.0f} MB | "
            f"{exponent_text(time_exponent)} | {exponent_text(memory_exponent)} | {work.limit} |")
    lines += ["", "Other programs, at the largest size that they were given, in the same run:", "",
              "| work | size | other program | its time, memory | exponent | Sikku |", "|---|---|---|---|---|---|"]
    for work in measured:
        for name, points in work.peers.items():
            last = points[-1]
            mine = at_size(work.points, last.size)
            lines.append(
                f"| {work.name} | {size_text(last.size)} {work.counted} | {name} | {time_text(last.seconds)}, {last.megabytes:.0f} MB | "
                f"{exponent_text(slope([(p.size, p.seconds) for p in points]))} | {time_text(mine[0])}, {mine[1]:.0f} MB |")
    if missing:
        lines += ["", f"Not installed, so not in this run: {', '.join(missing)}."]
    if single:
        lines += ["", "Single works:", "", "| work | time | memory |", "|---|---|---|"]
        lines += [f"| {what} | {time_text(point.seconds)} | {point.megabytes:.0f} MB |" for what, point in single]
    lines += ["", "All points, processor time and peak memory:", "", "| work | points |", "|---|---|"]
    for work in measured:
        cells = "; ".join(f"{size_text(p.size)}: {time_text(p.seconds)}, {p.megabytes:.0f} MB" for p in work.points)
        lines.append(f"| {work.name}, {work.counted} | {cells} |")
    return "\n".join(lines) + "\n"


def rate_text(rate: float) -> str:
    for unit, name in ((1e9, " thousand million"), (1e6, " million"), (1e3, " thousand")):
        if rate >= unit:
            return f"{rate / unit:.3g}{name}"
    return f"{rate:.3g}"


def at_size(points: list[Point], size: int) -> tuple[float, float]:
    """Time and memory at a size between two measured ones: logarithms are interpolated."""
    for a, b in zip(points, points[1:]):
        if a.size <= size <= b.size:
            t = (math.log(size) - math.log(a.size)) / (math.log(b.size) - math.log(a.size))
            return (a.seconds ** (1 - t) * b.seconds**t, a.megabytes ** (1 - t) * b.megabytes**t)
    nearest = min(points, key=lambda p: abs(math.log(p.size / size)))
    return nearest.seconds, nearest.megabytes


def draw_charts(bench: Bench, measured: list[Work]) -> None:
    for name, unit, title, value in (("time", "s", "Processor time over size", lambda p: p.seconds),
                                     ("memory", "MB", "Peak memory over size", lambda p: p.megabytes)):
        lines = [Line(f"{work.name}, {work.counted}", [(p.size, value(p)) for p in work.points]) for work in measured]
        pattern = bench.path(f"{name}.lsys", chart(title, lines, unit))
        bench.make("draw", pattern, "--size", "240x150mm", "--margin", "6mm", "--dpi", "120", "-o", ROOT / f"docs/performance-{name}.png")


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("program")
    options.add_argument("--repeats", type=int, default=3)
    options.add_argument("--only", nargs="*")
    options.add_argument("--note", default="", help="a sentence about the build and the machine")
    options.add_argument("--write", action="store_true", help="replace the generated part of docs/performance.md")
    arguments = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(str(Path(arguments.program).resolve()), Path(folder))
        missing = [name for name, there in (
            ("lindenmayer (npm)", bench.lindenmayer), ("Inkscape's extension", has_inkscape()),
            ("rsvg-convert", shutil.which("rsvg-convert")), ("ImageMagick", shutil.which("convert")),
            ("csvmidi", shutil.which("csvmidi")), ("potrace", shutil.which("potrace"))) if not there]
        idle = Work("nothing", "", "", "", [Point(1, [bench.program, "--version"])])
        measure(idle, bench, 9)
        nothing = (idle.points[0].seconds, idle.points[0].megabytes)
        measured = []
        for work in works(bench):
            if arguments.only and work.name not in arguments.only:
                continue
            measure(work, bench, arguments.repeats)
            measured.append(work)
            print(f"{work.name}: {time_text(work.points[-1].seconds)} for {size_text(work.points[-1].size)}", file=sys.stderr)
        single = [] if arguments.only else figures(bench)
        for what, point in single:
            measure(Work(what, "", "", "", [point]), bench, arguments.repeats)
            print(f"{what}: {time_text(point.seconds)}", file=sys.stderr)
        text = page(measured, single, nothing, arguments.repeats, missing, arguments.note)
        if not arguments.write:
            print(text)
            return
        draw_charts(bench, measured)
        before, rest = PAGE.read_text().split(BEGIN)
        PAGE.write_text(before + BEGIN + "\n\n" + text + "\n" + END + rest.split(END)[1])


if __name__ == "__main__":
    main()
