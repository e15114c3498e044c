#!/usr/bin/env python3
"""Makes the site; see packaging/site.sh, which calls this.

usage: build.py OUTPUT --program PROGRAM --studio PAGE --version VERSION [--patterns FOLDER]

FOLDER contains folders of patterns, as patterns/ of the sources (the default).
"""

import argparse
import hashlib
import json
import os
import re
import shutil
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag, urljoin

import drawing
import manual
import pages
import patterns as reading
import png
from markup import escaped, page, plain, relative, studio_link
from program import Program
from search import Index

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PAGE_BYTES = 300_000
SITE_BYTES = 60_000_000
MANUAL_PICTURE_BYTES = 90_000

# Documents of the manual outside docs/: the names of their pages, and their entries in the manual.
OTHER_DOCUMENTS = {
    "README.md": ("readme", "Overview", "What the program does; install; run; versions"),
    "CHANGELOG.md": ("changelog", "Change log", "What changed for users, and which outputs changed"),
    "CONTRIBUTING.md": ("contributing", "Contributing", "How to build and test; how to add a key, an option, a format"),
    "SECURITY.md": ("reporting-security", "Security", "How to report a vulnerability"),
}
# Pictures of the front page: pattern, caption, options.
FRONT = (
    ("kolam-radial-12x7", "A kolam of twelve petals", ("--dots",)),
    ("penrose-rhombs", "Penrose’s rhombs", ("--fill-page", "--step", "8mm")),
    ("lilac", "A lilac in the sun", ()),
)
# The melody of the front page, and the patterns that its links open in the studio.
HEARD = "hilbert-kalyani"
BEGIN = (
    ("a kolam for the door", "kolam-7x7-3aamyxrw", "bench"),
    ("a poster", "penrose-rhombs", "map"),
    ("a plant", "fern", "map"),
    ("a melody", HEARD, "play"),
)


def fail(message: str) -> None:
    sys.exit(f"site: {message}")


class Site:
    def __init__(self, folder: Path):
        self.folder = folder

    def write(self, path: str, contents: str | bytes) -> None:
        file = self.folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(contents if isinstance(contents, bytes) else contents.encode())

    def files(self) -> list[str]:
        return sorted(str(each.relative_to(self.folder)) for each in self.folder.rglob("*") if each.is_file())


def in_process(program: Program, folder: Path, pattern: reading.Pattern) -> drawing.Made:
    # Each in a separate folder, because the names of scratch files are the same.
    with tempfile.TemporaryDirectory(dir=folder) as own:
        made = drawing.make(program, pattern, Path(own))
        used = {made.picture, made.thumbnail, made.roll, *made.variants.values()}
        used |= {*(file for _, file in made.growth), *(file for _, file, _ in made.downloads)}
        for file in sorted(used - {""}):
            shutil.move(Path(own) / file, folder / file)
    return made


def pattern_pages(site: Site, all_patterns: dict[str, list[reading.Pattern]], made: dict[str, drawing.Made],
                  context: pages.Context, index: Index) -> None:  # fmt: skip
    known = {each.name: each.text for group in all_patterns.values() for each in group}
    for kind, group in all_patterns.items():
        for pattern in group:
            site.write(pages.file_of(f"{pattern.name}{pattern.path.suffix}"), pattern.text)
            site.write(pages.address_of(pattern), pages.pattern_page(pattern, made[pattern.name], group, context, known))
            text = f"{pattern.description} {pattern.source}"
            if kind == "kolam-library":  # the source is a command with many digits
                text = pattern.description
            index.add(pages.address_of(pattern), pattern.title, pages.kind_name(kind), text, pattern.name)
        site.write(f"patterns/{kind}.html", pages.kind_page(kind, group, made, context))
    site.write("patterns/index.html", pages.overview_page(all_patterns, made, context))


class ManualPictures:
    """Writes the pictures of documents in a smaller size."""

    def __init__(self, site: Site):
        self.site = site
        self.sizes: dict[str, tuple[int, int]] = {}

    def __call__(self, address: str, source: str) -> tuple[str, int, int]:
        file = (ROOT / manual.resolved(address, source)).resolve()
        if not file.is_relative_to(ROOT) or file.suffix != ".png":
            fail(f"{source}: the picture {address} is not a PNG file of the sources")
        target = f"manual/pictures/{file.name}"
        if file.name not in self.sizes:
            data = png.reduced(file.read_bytes(), MANUAL_PICTURE_BYTES)
            self.site.write(target, data)
            self.sizes[file.name] = png.size_of(data)
        return relative(target, "manual/x.html"), *self.sizes[file.name]


def sentence(text: str) -> str:
    return text[:1].upper() + text[1:]


def with_contents(document: manual.Document, classes: str, crumbs: str = "") -> str:
    """The document after its title and, if it is long, a list of its sections."""
    head, end, rest = document.html.partition("</h1>")
    if not head.startswith("<h1"):
        head, end, rest = "", "", document.html
    contents = manual.contents_of(document)
    title = f'<div class="head">{crumbs}{head}{end}</div>'
    prose = f'<article class="{classes}">{rest}</article>'
    return f'<div class="{"with-contents" if contents else "without-contents"}">{title}{contents}{prose}</div>'


def manual_pages(site: Site, index: Index) -> None:
    documents = {f"docs/{each.name}": each.stem for each in sorted((ROOT / "docs").glob("*.md"))}
    documents |= {source: name for source, (name, _, _) in OTHER_DOCUMENTS.items()}
    readme = (ROOT / "README.md").read_text()
    pictures = ManualPictures(site)
    read: dict[str, manual.Document] = {}
    for source, name in documents.items():

        def link(address: str, source: str = source) -> str | None:
            if re.match(r"(https?|mailto):", address):
                return address
            path, mark, anchor = manual.resolved(address, source).partition("#")
            if path == "LICENSE":
                return "../licence.txt"
            if path == source:
                return mark + anchor
            return f"{documents[path]}.html{mark}{anchor}" if path in documents else None

        read[name] = manual.read((ROOT / source).read_text(), link, partial(pictures, source=source))

    # The order and the descriptions are those of the README.
    described = {}
    for name, about in manual.table_rows(readme, "Documentation"):
        match = re.fullmatch(r"\[(.*)\]\((.*)\)", name)
        if match and match[2] in documents:
            described[documents[match[2]]] = (match[1], pages.summary_of(about))
    for name, title, about in OTHER_DOCUMENTS.values():
        described.setdefault(name, (title, about))
    order = [*described, *(name for name in read if name not in described)]
    for name in order:
        document = read[name]
        title = document.title or name
        path = f"manual/{name}.html"
        crumbs = '<p class="crumbs"><a href="index.html">Manual</a></p>'
        classes = "prose matrix" if name == "matrix" else "prose"
        body = with_contents(document, classes, crumbs)
        about = described.get(name, ("", title))[1]
        site.write(path, page(path, f"{title} – Manual – Sikku", body, about=about, section="manual/index.html"))
        for section in document.sections:
            address = path if section.level == 1 else f"{path}#{section.anchor}"
            index.add(address, section.title, "" if section.level == 1 else title, section.text)
    entries = "".join(
        f'<li><a href="{name}.html">{escaped(described.get(name, (read[name].title or name, ""))[0])}</a>'
        f'<p>{escaped(sentence(described.get(name, ("", ""))[1]))}</p></li>'
        for name in order
    )
    body = (
        '<div class="head"><h1>Manual</h1><p class="lede">Begin with the tutorial. Look up keys in the pattern language '
        f'and options in the commands.</p></div><div><ul class="entries">{entries}</ul></div>'
    )
    site.write("manual/index.html", page("manual/index.html", "Manual – Sikku", body, about="The manual of Sikku."))


def example(site: Site, program: Program, name: str, text: str, options: str) -> str:
    """A pattern with its pictures, one for each number of `n=0,1,2` or `seed=2,3`."""
    match = re.fullmatch(r"(n|seed)=([0-9,]+)", options.strip())
    if not match:
        fail(f"{name}: expected n=… or seed=…, not '{options}'")
    figures = ""
    for value in match[2].split(","):
        svg = site.folder / f"assets/{name}-{value}.svg"
        svg.parent.mkdir(exist_ok=True)
        problem = drawing.draw_text(program, text, svg, "-n" if match[1] == "n" else "--seed", value)
        if problem:
            fail(f"{name} cannot be drawn: {problem}")
        if svg.stat().st_size > 30_000:
            fail(f"{svg.name} has {svg.stat().st_size} bytes; choose a smaller n")
        caption = f"{match[1]} = {value}"
        figures += (
            f'<figure><img src="assets/{svg.name}" width="640" height="640" alt="The drawing of this pattern, {caption}" loading="lazy">'
            f"<figcaption>{caption}</figcaption></figure>"
        )
    link = "studio/index.html#" + studio_link(f"{name}.lsys", text)
    return (
        f'<div class="example wide"><pre tabindex="0"><code>{escaped(text)}</code></pre><div class="pictures">{figures}</div>'
        f'<p><a href="{escaped(link)}">Open it in the studio</a></p></div>'
    )


def text_pages(site: Site, program: Program, index: Index) -> None:
    """Pages of packaging/site/text. A code block that begins with ```lsys is a pattern, which is drawn."""
    for source in sorted((HERE / "text").glob("*.md")):
        markdown, examples = source.read_text(), []

        def keep(match: re.Match) -> str:
            examples.append((match[2], match[1]))
            return f"\n\nEXAMPLE-{len(examples)}-HERE\n\n"

        markdown = re.sub(r"^```lsys *(.*)\n((?:.*\n)*?)```$", keep, markdown, flags=re.MULTILINE)
        document = manual.read(markdown, lambda address: address, lambda address: fail(f"{source.name}: {address}"))
        html = document.html
        for number, (text, options) in enumerate(examples, 1):
            made = example(site, program, f"{source.stem}-{number}", text, options)
            html = html.replace(f"<p>EXAMPLE-{number}-HERE</p>", made)
        path = f"{source.stem}.html"
        document.html = html
        body = with_contents(document, "prose")
        about = plain(document.sections[0].text)[:200]
        site.write(path, page(path, f"{document.title} – Sikku", body, about=about))
        for section in document.sections:
            address = path if section.level == 1 else f"{path}#{section.anchor}"
            text = re.sub(r"EXAMPLE-\d+-HERE", "", section.text)
            index.add(address, section.title, "" if section.level == 1 else document.title, text)


def front(site: Site, program: Program, all_patterns: dict[str, list[reading.Pattern]], made: dict[str, drawing.Made],
          context: pages.Context, version: str) -> None:  # fmt: skip
    by_name = {each.name: each for group in all_patterns.values() for each in group}
    files = site.folder / "pattern/files"
    three = []
    for name, caption, options in FRONT:
        if name not in by_name:
            continue
        svg = files / f"front_{name}.svg"
        problem = program.makes("draw", by_name[name].path, svg, "--size", f"{drawing.SIZE}x{drawing.SIZE}mm", *options)
        if problem:
            fail(f"{name}: {problem}")
        file = drawing.smaller_picture(program, by_name[name].path, files, f"front_{name}", svg, 70_000, 840, *options)
        if file != svg.name:
            svg.unlink()
            context.sizes[file] = png.size_of((files / file).read_bytes())
        three.append((file, name, caption))
    example_text = "title: Hilbert curve\nderivation length: 5\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n"
    example_text += "ground: #22384f\nstroke: 0.3 step #f2e6cf\n"
    problem = drawing.draw_text(program, example_text, files / "front_example.svg")
    if problem:
        fail(problem)
    studio = png.reduced((ROOT / "docs/studio.png").read_bytes(), 120_000)
    site.write("assets/studio.png", studio)
    context.sizes["studio.png"] = png.size_of(studio)
    total = sum(len(group) for group in all_patterns.values())
    heard = (by_name[HEARD], made[HEARD]) if HEARD in by_name else None
    begin = [(text, by_name[name], panel) for text, name, panel in BEGIN if name in by_name]
    site.write("index.html", pages.front_page(three, example_text, "front_example.svg", heard, begin, total, version, context))


def assets(site: Site, program: Program, index: Index) -> None:
    for name in ("style.css", "site.js", "player.js", "search.js"):
        site.write(f"assets/{name}", (HERE / "assets" / name).read_bytes())
    site.write("assets/index.js", index.script())
    site.write("assets/icon.svg", (ROOT / "packaging/desktop/sikku.svg").read_bytes())
    # The kolam of the icon, with a margin for masks.
    icon = (HERE / "assets/icon.lsys").read_text()
    for pixels in (192, 512):
        with tempfile.TemporaryDirectory() as folder:
            source, picture = Path(folder) / "icon.lsys", Path(folder) / "icon.png"
            source.write_text(icon)
            problem = program.makes("draw", source, picture, "--size", "96x96mm", "--margin", "15mm", "--dpi", f"{pixels / 96 * 25.4:.4f}")
            if problem:
                fail(f"the icon cannot be drawn: {problem}")
            site.write(f"assets/icon-{pixels}.png", png.reduced(picture.read_bytes(), 100_000))
    manifest = {
        "name": "Sikku", "short_name": "Sikku", "description": "Kolams, tilings, plants and music from L-systems",
        "id": "./index.html", "start_url": "./index.html", "scope": "./", "display": "standalone", "lang": "en",
        "background_color": "#faf6ee", "theme_color": "#faf6ee",
        "icons": [
            {"src": f"assets/icon-{pixels}.png", "sizes": f"{pixels}x{pixels}", "type": "image/png", "purpose": purpose}
            for pixels in (192, 512) for purpose in ("any", "maskable")
        ],
        "shortcuts": [{"name": "Studio", "url": "./studio/index.html"}, {"name": "Patterns", "url": "./patterns/index.html"}],
    }  # fmt: skip
    site.write("manifest.webmanifest", json.dumps(manifest, indent=1) + "\n")
    site.write("licence.txt", (ROOT / "LICENSE").read_bytes())
    # Without this file, some servers leave out files or add a theme.
    site.write(".nojekyll", "")


def service_worker(site: Site) -> None:
    files = [file for file in site.files() if file != ".nojekyll"]
    digest = hashlib.sha256()
    for file in files:
        digest.update(file.encode() + b"\0" + hashlib.sha256((site.folder / file).read_bytes()).digest())
    first = [
        file for file in files
        if file in ("index.html", "search.html", "offline.html", "first-steps.html", "teachers.html", "patterns/index.html", "manifest.webmanifest")
        or file.startswith(("manual/", "assets/")) and not file.startswith("manual/pictures/")
    ]  # fmt: skip
    everything = [file for file in files if not file.endswith(".pdf")]
    template = (HERE / "assets/worker.js").read_text()
    for name, value in (("version", digest.hexdigest()[:16]), ("first", json.dumps(first)), ("all", json.dumps(everything))):
        template = template.replace("{{" + name + "}}", value)
    site.write("worker.js", template)


class Links(HTMLParser):
    def __init__(self):
        super().__init__()
        self.targets: list[str] = []
        self.loaded: list[tuple[str, bool]] = []  # address, True if loaded only when in view
        self.anchors: set[str] = set()

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        if values.get("id"):
            if values["id"] in self.anchors:
                raise ValueError(f"the identifier '{values['id']}' occurs twice")
            self.anchors.add(values["id"])
        for name in ("href", "src", "action", "data-midi"):
            if values.get(name):
                self.targets.append(values[name])
        if tag in ("img", "script") or (tag == "link" and values.get("rel") == "stylesheet"):
            self.loaded.append((values.get("src") or values.get("href") or "", values.get("loading") == "lazy"))


def check(site: Site) -> str:
    """Checks that every link leads to a file and an anchor of the site, and that neither a page nor the site is too
    large."""
    read: dict[str, Links] = {}
    files = set(site.files())
    problems = []
    for file in files:
        if file.endswith(".html") and not file.startswith("studio/"):
            read[file] = Links()
            try:
                read[file].feed((site.folder / file).read_text())
            except ValueError as error:
                problems.append(f"{file}: {error}")
    largest, largest_page = 0, ""
    for file, links in sorted(read.items()):
        for target in links.targets:
            if re.match(r"(https?|mailto|data):", target):
                continue
            address, anchor = urldefrag(urljoin(f"http://site/{file}", target))
            path = unquote(address.removeprefix("http://site/"))
            if path not in files:
                problems.append(f"{file}: the link {target} leads to no file")
            elif anchor and path in read and unquote(anchor) not in read[path].anchors:
                problems.append(f"{file}: the link {target} leads to no anchor")
        weights = {file: (site.folder / file).stat().st_size}
        for target, is_lazy in links.loaded:
            path = unquote(urldefrag(urljoin(f"http://site/{file}", target))[0].removeprefix("http://site/"))
            if path in files and not is_lazy:
                weights[path] = (site.folder / path).stat().st_size
        weight = sum(weights.values())
        if weight > PAGE_BYTES:
            problems.append(f"{file} loads {weight} bytes; at most {PAGE_BYTES} are allowed")
        if weight > largest:
            largest, largest_page = weight, file
    total = sum((site.folder / file).stat().st_size for file in files)
    if total > SITE_BYTES:
        problems.append(f"the site has {total} bytes; at most {SITE_BYTES} are allowed")
    if problems:
        fail("\n".join(problems[:40]))
    return (
        f"{len(read)} pages, {len(files)} files, {total / 1e6:.1f} MB; the largest page loads {largest / 1000:.0f} kB ({largest_page})"
    )


def keys_of_language() -> dict[str, tuple[str, str, str]]:
    """The values and the meaning of each key, and its place in the manual."""
    text = (ROOT / "docs/language.md").read_text()
    keys = {}
    for heading in re.findall(r"^## (Keys of .*)$", text, re.MULTILINE):
        anchor = f"manual/language.html#{heading.lower().replace(' ', '-')}"
        for cells in manual.table_rows(text, heading):
            key = pages.summary_of(cells[0])
            keys[key] = (pages.summary_of(cells[1]), pages.summary_of(cells[3]), anchor)
    return keys


def build(site: Site, options: argparse.Namespace) -> None:
    program = Program(options.program)
    all_patterns = reading.read_all(Path(options.patterns))
    files = site.folder / "pattern/files"
    files.mkdir(parents=True)
    flat = [each for group in all_patterns.values() for each in group]
    # Slow patterns first: plants, then all others.
    queue = sorted(flat, key=lambda each: (each.kind != "plants", each.name))
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        made = dict(zip((each.name for each in queue), pool.map(partial(in_process, program, files), queue)))
    for name in sorted(made):
        for problem in made[name].problems:
            print(f"site: warning: {name}: {plain(problem)}", file=sys.stderr)
    context = pages.Context(keys_of_language(), {})
    for file in sorted(files.iterdir()):
        if file.suffix == ".png":
            context.sizes[file.name] = png.size_of(file.read_bytes())
        elif file.name.endswith("_notes.svg"):
            context.sizes[file.name] = (1000, 240)
    index = Index()
    text_pages(site, program, index)
    manual_pages(site, index)
    pattern_pages(site, all_patterns, made, context, index)
    front(site, program, all_patterns, made, context, options.version)
    site.write("search.html", pages.search_page())
    site.write("offline.html", pages.offline_page())
    site.write("studio/index.html", Path(options.studio).read_bytes())
    assets(site, program, index)
    service_worker(site)


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("output")
    parser.add_argument("--program", required=True)
    parser.add_argument("--studio", required=True)
    parser.add_argument("--version", required=True)
    parser.add_argument("--patterns", default=ROOT / "patterns")
    options = parser.parse_args()
    output = Path(options.output)
    for file, how in ((options.program, "./demo builds it"), (options.studio, "studio/build.sh builds it")):
        if not Path(file).is_file():
            fail(f"{file} is missing; {how}")
    options.program = str(Path(options.program).resolve())
    if output.exists() and not (output.is_dir() and (not any(output.iterdir()) or (output / "manifest.webmanifest").is_file())):
        fail(f"{output} exists and is not a site of this script; move it or choose another folder")
    output.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=output.parent, prefix=output.name + ".") as folder:
        site = Site(Path(folder) / "site")
        site.folder.mkdir()
        try:
            build(site, options)
            facts = check(site)
        except (ValueError, OSError) as error:
            fail(str(error))
        if output.exists():
            shutil.rmtree(output)
        site.folder.rename(output)
    print(facts)


if __name__ == "__main__":
    main()
