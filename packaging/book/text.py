"""The pages of the book as one HTML document."""

import re
from pathlib import Path

from figures import Document, Drawing, Figure, drawings_of
from markup import escaped, plain
from patterns import Pattern
from plates import Picture, Studio, pages_of
from system import readable, system

HERE = Path(__file__).resolve().parent
# Millimetres; style.css has the same margins.
WIDTH = 164.0
PAGE_BOTTOM = 274.0
HALF_WIDTH, HALF_HEIGHT = 78.0, 103.0
PAGE_WIDTH, PAGE_HEIGHT = 210.0, 297.0
OPENER_GAP, OPENER_MARGIN = 13.0, 24.0  # between picture and title; below the text
COVER = (210.0, 212.0)
COVER_DRAWING = "anklets-of-krishna"
LONGEST_WORD, LONGEST_INTERPRETATION = 210, 70  # characters of a word; of a production for drawing
NUMBERS = dict(enumerate("no one two three four five six seven eight nine ten eleven twelve".split()))
TITLE = "Figures of L-Systems"
SUBTITLE = "Five documents, drawn again from their productions"


def prose(line: str) -> str:
    """A line of text with typographic quotes, arrows and minus signs."""
    line = re.sub(r"(?<![\w’])'([^']+)'", r"‘\1’", line).replace("-->", "→")
    line = re.sub(r"(?<=\d) x (?=\d)", " × ", line)
    return escaped(line)


def operators(text: str) -> str:
    for plain_form, printed in (("<=", "≤"), (">=", "≥"), ("-", "−")):
        text = text.replace(plain_form, printed)
    return text


def word(text: str, most: int = LONGEST_WORD) -> str:
    """The HTML of a word or a condition, which may break anywhere; a long one is cut."""
    if not text:
        return "ε"
    if len(text) > most:
        text = text[: most - 20].rstrip() + " …"
    return f"<code>{escaped(operators(text))}</code>"


def steps_of(figure: Figure, pattern: Pattern) -> str:
    """The derivation lengths of a pattern in a figure, if the figure sets them."""
    own = [each for each in figure.drawings if each.pattern == pattern.name and "--set" not in each.options and not each.is_of_rules]
    numbers = sorted({int(each.n) for each in own if each.n})
    if not numbers:
        return ""
    if len(numbers) > 2 and numbers == list(range(numbers[0], numbers[-1] + 1)):
        return f"{numbers[0]} to {numbers[-1]}"
    return ", ".join(map(str, numbers))


Plates = dict[str, list[list[list[Picture]]]]  # by figure: pages, rows, pictures


def without_article(term: str) -> str:
    return re.sub(r"^(A|An|The) (?=\w)", "", term)


def kind_of_note(note: str) -> tuple[str, str]:
    """The kind of a note, and its text without the words that state the kind."""
    mended = re.match(r"Mended:? ", note)
    remade = re.match(r"(A reconstruction|Reconstructions|Reconstructed)(, for|,|:)? ", note)
    kind = "Mended" if mended else "Reconstructed" if remade or "econstruct" in note or "guess" in note else "Note"
    rest = note[(mended or remade).end() :] if mended or remade else note
    return kind, rest[:1].upper() + rest[1:]


class Facts:
    """Reports of the program on what figures show, as lines of text. Each is made once."""

    def __init__(self, studio: Studio, patterns: dict[str, Pattern]):
        self.studio, self.patterns = studio, patterns
        self.known: dict[tuple[str, Drawing], list[tuple[str, str]]] = {}

    def rows(self, command: str, drawing: Drawing) -> dict[str, str]:
        if (command, drawing) not in self.known:
            self.known[command, drawing] = self.studio.report(command, drawing)
        return dict(self.known[command, drawing])

    def measured(self, drawing: Drawing) -> str:
        rows = self.rows("measure", drawing)
        if "cells" in rows:
            return " · ".join(f"{rows[name]} {'outer edges' if name == 'outer' else name}" for name in ("cells", "edges", "vertices", "outer") if name in rows)
        found = [f"{readable('symbols', rows.get('symbols', ''))} symbols"]
        if self.patterns[drawing.pattern].kind == "words":  # drawn as letters or schematically
            return found[0]
        if rows.get("drawn", "0") != "0":
            found.append(f"{readable('drawn', rows['drawn'])} segments")
        elif rows.get("moves", "0") != "0":
            found.append(f"{readable('moves', rows['moves'])} steps")
        box = rows.get("ink", rows.get("box", "none"))
        numbers = [] if box == "none" else [float(each) for each in box.split()]
        if len(numbers) in (4, 6) and any(numbers):
            half = len(numbers) // 2
            found.append(" × ".join(f"{round(high - low, 9):,.4g}" for low, high in zip(numbers[:half], numbers[half:])) + " steps in size")
        if rows.get("closed") == "yes" and rows.get("drawn") != "0":
            found.append("closed")
        return " · ".join(found)

    def certificate(self, drawing: Drawing) -> str:
        kind = self.patterns[drawing.pattern].kind
        if kind not in ("kolams", "tilings") or "--set" in drawing.options:
            return ""
        rows = self.rows("kolam" if kind == "kolams" else "tiling", drawing)
        parts = [rows["kolam" if kind == "kolams" else "tiling"].removeprefix("yes: ")]
        if rows.get("crossings", "0") != "0":
            parts.append(f"crossings {rows['crossings']}")
        if "symmetry" in rows:
            parts.append(f"symmetry {rows['symmetry'].partition(' about')[0]}")
        if rows.get("exact") == "yes":
            parts.append("decided by whole numbers")
        return "; ".join(parts)


class Book:
    def __init__(self, documents: list[Document], patterns: dict[str, Pattern], studio: Studio, version: str):
        self.documents, self.patterns, self.version = documents, patterns, version
        self.facts = Facts(studio, patterns)
        self.figures = [each for document in documents for each in document.figures if not each.left_out]
        self.second_halves: set[str] = set()
        self.spreads: set[str] = set()  # figures whose systems are on a second page
        for document in documents:
            drawn = [each for each in document.figures if not each.left_out]
            for before, after in zip(drawn, drawn[1:]):
                if before.is_half and after.is_half and before.anchor not in self.second_halves:
                    self.second_halves.add(after.anchor)
        cover = Picture(drawings_of(COVER_DRAWING)[0], "", "cover-picture", *COVER)
        self.cover = cover
        # Their heights are set when the height of the text is known.
        self.openers = {
            number: Picture(document.cover, "", f"document-{number}-picture", PAGE_WIDTH, 100.0)
            for number, document in enumerate(documents, 1)
        }

    def extra_pictures(self) -> list[Picture]:
        return [self.cover, *self.openers.values()]

    # A picture is an empty box, under which its drawing is placed later; pixels and piano rolls are images.
    def box(self, picture: Picture) -> str:
        size = f"width:{picture.width:.3f}mm;height:{picture.height:.3f}mm"
        image = ""
        if picture.file and picture.file.suffix != ".pdf":
            image = f'<img src="picture:{picture.file.name}" style="{size}" alt="">'
        return f'<div class="picture" id="{picture.anchor}" style="{size}">{image}</div>'

    def plate(self, figure: Figure, rows: list[list[Picture]], name: str = "plate") -> str:
        html = ""
        for row in rows:
            cells = "".join(
                f'<td style="width:{each.width:.3f}mm">{self.box(each)}'
                + (f'<p class="label">{prose(each.label)}</p>' if figure.labels else "")
                + "</td>"
                for each in row
            )
            html += f'<table class="row"><tr>{cells}</tr></table>'
        return f'<div class="plate" id="{figure.anchor}-{name}">{html}</div>'

    def measures(self, figure: Figure, name: str) -> str:
        own = [each for each in figure.drawings if each.pattern == name and not each.is_played and not each.is_of_rules]
        drawing = [Drawing(name), *(each for each in own if "--set" not in each.options)][-1]
        lines = [f'<code class="name">{escaped(name)}</code> {escaped(self.facts.measured(drawing))}']
        if certificate := self.facts.certificate(drawing):
            lines.append(f"<b>Certified</b> {prose(certificate)}")
        return "".join(f'<p class="facts">{line}</p>' for line in lines)

    def system(self, figure: Figure, name: str) -> str:
        pattern = self.patterns[name]
        most = 1200 if figure.anchor in self.spreads else LONGEST_WORD
        html = system(pattern, steps_of(figure, pattern), lambda text: word(text, most))
        rows = re.findall(r"<tr.*?</tr>", html)
        # n and δ share a row.
        if len(rows) > 1 and ">δ</th>" in rows[1]:
            cells = [re.sub(r"<[^>]*>", "", each.partition("<td>")[2]) for each in rows[:2]]
            rows[:2] = [f'<tr><th scope="row">n, δ</th><td>{cells[0]}, {cells[1]}</td></tr>']
        classes = "system"
        if pattern.defines:
            classes += " named"
        constants = self.constants(figure, pattern)
        if constants:
            defined = {f">{escaped(each)}</th>" for each, _, _ in pattern.defines}
            rows = [row for row in rows if not any(each in row for each in defined)]
        # Productions that draw organs and cells are additions of the pattern, and often long.
        for at, row in enumerate(rows):
            if ">For drawing<" in row:
                drawn = rows[at + 1 :]
                if figure.is_half or any(len(re.sub(r"<[^>]*>", "", each)) > LONGEST_INTERPRETATION for each in drawn):
                    number = NUMBERS.get(len(drawn), str(len(drawn)))
                    plural = "s" if len(drawn) > 1 else ""
                    rows[at:] = [f'<tr><th></th><td class="more">and {number} production{plural} for drawing, in the pattern file</td></tr>']
                break

        def table(part: list[str]) -> str:
            return f'<table class="{classes}"><tbody>{"".join(part)}</tbody></table>'

        longest = max(len(re.sub(r"<[^>]*>", "", row)) for row in rows)
        if len(rows) > 14 and longest < 36 and len(figure.systems) == 1:
            half = (len(rows) + 1) // 2
            return f'<table class="twice"><tr><td>{table(rows[:half])}</td><td>{table(rows[half:])}</td></tr></table>' + constants
        return table(rows) + constants

    def constants(self, figure: Figure, pattern: Pattern) -> str:
        """A table of the constants that the variants in a figure set, if there are several."""
        shown = [each.options[each.options.index("--variant") + 1] for each in figure.drawings if each.pattern == pattern.name and "--variant" in each.options]
        variants = [(name, dict(re.findall(r"(\S+) = ([^,]+)", values))) for name, values in pattern.variants if name in shown]
        names = [name for name, _, _ in pattern.defines if any(name in values for _, values in variants)]
        if len(variants) < 2 or not names:
            return ""
        start = {name: value for name, value, _ in pattern.defines}
        head = "".join(f"<th>{escaped(name)}</th>" for name in names)
        body = "".join(
            f"<tr><th>{escaped(variant)}</th>" + "".join(f"<td>{escaped(operators(values.get(name, start[name])))}</td>" for name in names) + "</tr>"
            for variant, values in variants
        )
        return f'<table class="constants"><tr><th></th>{head}</tr>{body}</table>'

    def figure(self, figure: Figure, plates: Plates) -> str:
        pages = plates.get(figure.anchor, [[]])
        if figure.is_half and figure.anchor not in plates:
            pages = pages_of(figure, HALF_WIDTH, HALF_HEIGHT)
        caption = f"<p>{prose(figure.caption)}</p>"
        remarks = ""
        if figure.note:
            kind, note = kind_of_note(figure.note)
            remarks += f'<p class="note"><b>{kind}</b> {prose(note)}</p>'
        if figure.without:
            remarks += f'<p class="note"><b>Left out</b> {prose(figure.without)}.</p>'
        names = figure.systems or [figure.drawings[0].pattern]
        spread = figure.anchor in self.spreads
        words_end = f'<div id="{figure.anchor}-words"></div>'
        if len(figure.systems) > 1 or spread:
            blocks = "".join(
                f'<div class="block"><h3>{escaped(self.patterns[name].title)}</h3>{self.system(figure, name)}{self.measures(figure, name)}</div>'
                for name in figure.systems
            )
            body = f'<div class="words across">{caption}{remarks}</div>{words_end}'
            if spread:
                body += f'<div class="spread"><p class="continued"><span class="number">{escaped(figure.number)}</span> continued</p>'
                body += f'{self.plate(figure, pages[1] if len(pages) > 1 else [], "second")}</div>'
            body += f'<div class="blocks of-{min(len(names), 3)}">{blocks}</div>'
        else:
            left = f'<div class="words">{caption}{remarks}</div>'
            right = self.system(figure, names[0]) if figure.systems else ""
            measures = self.measures(figure, names[0])
            if figure.is_half:
                body = f"{left}{right}{measures}"
            elif right:
                body = f'<table class="pair"><tr><td class="left">{left}{measures}</td><td class="right">{right}</td></tr></table>'
            else:
                body = f'<table class="pair"><tr><td class="left">{left}</td><td class="right">{measures}</td></tr></table>'
        head = (
            f'<h2 id="{figure.anchor}"><span class="number">{escaped(figure.number)}</span> '
            f'<span class="title">{prose(figure.title)}</span></h2><span class="chapter">{escaped(figure.chapter)}</span>'
        )
        end = f'<div id="{figure.anchor}-end"></div>'
        classes = "figure"
        if figure.is_half:
            classes += " half second" if figure.anchor in self.second_halves else " half"
            pair = f'<table class="pair"><tr><td class="side">{self.plate(figure, pages[0])}</td><td class="right">{body}</td></tr></table>'
            return f'<article class="{classes}">{head}{pair}{end}</article>'
        return f'<article class="{classes}">{head}{self.plate(figure, pages[0])}{body}{end}</article>'

    def page_of(self, pages: dict[str, int], anchor: str) -> str:
        return str(pages.get(anchor, 100))

    def contents(self, pages: dict[str, int]) -> str:
        def line(anchor: str, number: str, title: str) -> str:
            return (
                f'<tr><td class="number">{escaped(number)}</td><td><a href="#{anchor}">{prose(title)}</a></td>'
                f'<td class="page"><a href="#{anchor}">{self.page_of(pages, anchor)}</a></td></tr>'
            )

        parts = []
        second = len(self.documents) // 2 + 1  # begins the second column of the other documents
        for at, document in enumerate(self.documents, 1):
            rows, chapter = "", document.name
            for figure in document.figures:
                if figure.left_out:
                    continue
                if figure.chapter != chapter:
                    chapter = figure.chapter
                    rows += f'<tr class="part"><td></td><td colspan="2">{escaped(chapter)}</td></tr>'
                number = figure.number.removeprefix("Figure ").removeprefix("Appendix ").replace("Section ", "§ ")
                rows += line(figure.anchor, number, figure.title)
            parts.append(
                f'<h3{" class=beside" if at == second + 1 else ""}><span class="page">{self.page_of(pages, f"document-{at}")}</span><a href="#document-{at}">{prose(document.name)}</a></h3>'
                f"<table>{rows}</table>"
            )
        back = (("left-out", "What is left out, and why"), ("remade", "What was mended or reconstructed"), ("index", "Index"))
        parts.append("<h3>At the end</h3><table>" + "".join(line(anchor, "", title) for anchor, title in back) + "</table>")
        # The first document has more figures than the others together, and a page to itself.
        return (
            f'<section class="contents"><h1 id="contents">Contents</h1><div class="columns">{parts[0]}</div>'
            f'<div class="columns rest">{"".join(parts[1:])}</div></section>'
        )

    def opener(self, number: int, document: Document) -> str:
        about = "".join(f"<p>{prose(' '.join(each.split()))}</p>" for each in document.about.split("\n\n"))
        shown = sum(1 for each in document.figures if not each.left_out)
        missing = len(document.figures) - shown
        count = f"{shown} figures" + (f"; {missing} left out" if missing else "")
        return (
            f'<section class="opener"><span class="document">{prose(document.short)}</span><div class="bleed">{self.box(self.openers[number])}</div>'
            f'<div class="below"><h1 id="document-{number}">{prose(document.name)}</h1>'
            f'<p class="reference">{prose(document.reference)}</p><div class="about">{about}</div><p class="count">{count}</p><div id="document-{number}-end"></div></div></section>'
        )

    def left_out(self) -> str:
        rows = ""
        for document in self.documents:
            entries = [(each.number, each.title, each.left_out) for each in document.figures if each.left_out]
            entries += [(each.number, each.title, f"In part: {each.without}.") for each in document.figures if each.without]
            if entries:
                rows += f'<tr class="document"><th colspan="3">{prose(document.name)}</th></tr>'
            for number, title, reason in entries:
                rows += f"<tr><td>{escaped(number)}</td><td>{prose(title)}</td><td>{prose(reason)}</td></tr>"
        return (
            '<section class="left-out"><h1 id="left-out">What is left out, and why</h1>'
            "<p>These figures, or parts of them, show no system that can be drawn. Tables are not listed; the constants of the nine "
            f"trees (table 1 of the paper of 1996) are printed with the trees.</p><table>{rows}</table></section>"
        )

    def remade(self, pages: dict[str, int]) -> str:
        rows = ""
        for document in self.documents:
            entries = [each for each in document.figures if each.note]
            if entries:
                rows += f"<h3>{prose(document.name)}</h3>"
            for figure in entries:
                kind = kind_of_note(figure.note)[0].lower().replace("note", "see the note")
                rows += (
                    f'<p><a href="#{figure.anchor}">{escaped(figure.number)}, {prose(figure.title)}</a>: {kind},\u00a0'
                    f"{self.page_of(pages, figure.anchor)}</p>"
                )
        return (
            '<section class="remade"><h1 id="remade">What was mended or reconstructed</h1><p>The note at each of these figures says what the '
            "document lacks, and what replaces it.</p>"
            f'<div class="columns">{rows}</div></section>'
        )

    def index(self, pages: dict[str, int]) -> str:
        entries: dict[str, set[str]] = {}
        for figure in self.figures:
            for term in figure.index:
                entries.setdefault(plain(term), set()).add(figure.anchor)
            for each in figure.drawings:
                entries.setdefault(f"{plain(self.patterns[each.pattern].title)}`{each.pattern}", set()).add(figure.anchor)
        html, letter = "", ""
        for term in sorted(entries, key=lambda each: (without_article(each).casefold(), each)):
            first = without_article(term)[0].upper()
            if first != letter:
                letter = first
                html += f'<h3>{escaped(letter)}</h3>'
            # Figures that share a page are listed once.
            numbers = {pages.get(anchor, 100): anchor for anchor in sorted(entries[term], reverse=True)}
            links = ", ".join(f'<a href="#{anchor}">{number}</a>' for number, anchor in sorted(numbers.items()))
            title, _, name = term.partition("`")
            html += f"<p>{prose(title)}{f' <code>{escaped(name)}</code>' if name else ''},\u00a0{links}</p>"
        return (
            '<section class="index"><h1 id="index">Index</h1><p class="hint">Names in <code>this type</code> are names of pattern files.</p>'
            f'<div class="columns">{html}</div></section>'
        )

    def html(self, plates: Plates, pages: dict[str, int]) -> str:
        """The whole book. Without `plates` the pictures of figures have no height; without `pages` numbers of pages are
        placeholders of the same width."""
        ground = self.patterns[COVER_DRAWING].keys["ground"]
        references = "".join(f"<li>{prose(each.reference)}</li>" for each in self.documents)
        parts = (HERE / "front.html").read_text()
        for name, value in {
            "cover": self.box(self.cover), "ground": ground, "title": TITLE, "subtitle": SUBTITLE,
            "count": str(len(self.figures)), "references": references, "version": self.version,
        }.items():  # fmt: skip
            parts = parts.replace("{{" + name + "}}", value)
        body = parts.replace("{{contents}}", self.contents(pages))
        for number, document in enumerate(self.documents, 1):
            body += self.opener(number, document)
            body += "".join(self.figure(each, plates) for each in document.figures if not each.left_out)
        body += self.left_out() + self.remade(pages) + self.index(pages)
        style = (HERE / "style.css").read_text()
        return (
            f'<!doctype html><html lang="en"><head><meta charset="utf-8"><meta name="author" content="Sikku"><title>{TITLE}</title><style>{style}</style></head>'
            f"<body>{body}</body></html>"
        )
