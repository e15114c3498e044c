"""Renders Markdown as pages: anchors, links between documents, pictures, sections for the index."""

import posixpath
import re
import subprocess
from dataclasses import dataclass, field
from html.parser import HTMLParser

from markup import escaped, plain, slug

ALLOWED = {
    "a", "blockquote", "br", "code", "dd", "del", "dl", "dt", "em", "h1", "h2", "h3", "h4", "h5", "h6", "hr", "img",
    "kbd", "li", "ol", "p", "pre", "strong", "sub", "sup", "table", "tbody", "td", "th", "thead", "tr", "ul",
}  # fmt: skip
ATTRIBUTES = {"a": ("href",), "img": ("src", "alt"), "ol": ("start",)}
VOID = {"br", "hr", "img"}
HEADINGS = ("h1", "h2", "h3", "h4", "h5", "h6")


def rendered(markdown: str) -> str:
    command = ["cmark-gfm", "--unsafe", "--validate-utf8", "-e", "table", "-e", "autolink", "-e", "strikethrough"]
    return subprocess.run(command, input=markdown, capture_output=True, text=True, check=True).stdout


@dataclass
class Section:
    anchor: str
    level: int
    title: str
    text: str = ""


@dataclass
class Document:
    html: str = ""
    title: str = ""
    sections: list[Section] = field(default_factory=list)
    links: list[str] = field(default_factory=list)
    pictures: list[str] = field(default_factory=list)


class Writer(HTMLParser):
    """Writes the allowed parts of the HTML that it reads. `link` maps an address to another one, or to None, which
    keeps only its text; `picture` maps an address to another one, with width and height."""

    def __init__(self, link, picture):
        super().__init__(convert_charrefs=True)
        self.link, self.picture = link, picture
        self.document = Document()
        self.parts: list[str] = []
        self.open: list[str] = []
        self.skipped = 0  # depth in elements whose contents are left out
        self.heading: list[str] | None = None
        self.heading_at = 0
        self.head_at = -1  # where the head of a table began, while it is empty
        self.anchors: dict[str, int] = {}

    def handle_starttag(self, tag, attrs):
        if tag in ("script", "style", "iframe", "object", "svg", "math", "template"):
            self.skipped += 1
        if self.skipped or tag not in ALLOWED:
            return
        values = {name: value or "" for name, value in attrs if name in ATTRIBUTES.get(tag, ())}
        if tag == "a":
            target = self.link(values.get("href", ""))
            if target is None:
                self.open.append("")
                return
            values["href"] = target
            self.document.links.append(target)
        elif tag == "img":
            source, width, height = self.picture(values.get("src", ""))
            values = {"src": source, "alt": values.get("alt", ""), "width": str(width), "height": str(height),
                      "loading": "lazy", "decoding": "async"}  # fmt: skip
            self.document.pictures.append(source)
        elif tag == "pre":
            values["tabindex"] = "0"
        elif tag == "table":
            label = f"Table: {self.document.sections[-1].title}" if self.document.sections else "Table"
            self.parts.append(f'<div class="scroll" tabindex="0" role="group" aria-label="{escaped(label)}">')
        elif tag == "thead":
            self.head_at = len(self.parts)
        if tag in HEADINGS:
            self.heading, self.heading_at = [], len(self.parts)
        written = "".join(f' {name}="{escaped(value)}"' for name, value in values.items())
        self.parts.append(f"<{tag}{written}>")
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag in ("script", "style", "iframe", "object", "svg", "math", "template"):
            self.skipped = max(0, self.skipped - 1)
            return
        if self.skipped or tag not in ALLOWED or tag in VOID:
            return
        if tag == "a" and self.open and self.open[-1] == "":
            self.open.pop()
            return
        if tag not in self.open:
            return
        while self.open:
            closed = self.open.pop()
            if closed:
                self.close(closed)
            if closed == tag:
                break

    def close(self, tag):
        if tag in HEADINGS and self.heading is not None:
            self.close_heading(tag)
            return
        self.parts.append(f"</{tag}>")
        if tag == "table":
            self.parts.append("</div>")
        elif tag == "thead" and self.head_at >= 0:
            # An empty head: Markdown tables always have one.
            if not re.sub(r"<[^>]*>|\s", "", "".join(self.parts[self.head_at :])):
                del self.parts[self.head_at :]
            self.head_at = -1
        elif tag == "th" and self.parts[-2] == "<th>":
            self.parts[-2:] = ["<td>", "</td>"]

    def close_heading(self, tag):
        title = plain("".join(self.heading))
        self.heading = None
        base = slug(title)
        count = self.anchors.get(base, 0)
        self.anchors[base] = count + 1
        anchor = f"{base}-{count}" if count else base
        level = int(tag[1])
        self.parts[self.heading_at] = f'<{tag} id="{escaped(anchor)}">'
        if level > 1:
            label = f"Link to {title}"
            self.parts.append(f' <a class="anchor" href="#{escaped(anchor)}" aria-label="{escaped(label)}">#</a>')
        elif not self.document.title:
            self.document.title = title
        self.parts.append(f"</{tag}>")
        self.document.sections.append(Section(anchor, level, title))

    def handle_data(self, data):
        if self.skipped:
            return
        self.parts.append(escaped(data))
        if self.heading is not None:
            self.heading.append(data)
        elif self.document.sections:
            self.document.sections[-1].text += data

    def finish(self) -> Document:
        self.close_all()
        self.document.html = "".join(self.parts)
        return self.document

    def close_all(self):
        while self.open:
            tag = self.open.pop()
            if tag:
                self.close(tag)


def read(markdown: str, link, picture) -> Document:
    writer = Writer(link, picture)
    writer.feed(rendered(markdown))
    writer.close_all()
    return writer.finish()


def contents_of(document: Document, level: int = 2) -> str:
    """A list of the sections of a page; empty if there are few."""
    sections = [each for each in document.sections if each.level == level]
    if len(sections) < 3:
        return ""
    entries = "".join(f'<li><a href="#{escaped(each.anchor)}">{escaped(each.title)}</a></li>' for each in sections)
    return f'<nav class="contents" aria-label="On this page"><p>On this page</p><ol>{entries}</ol></nav>'


def resolved(address: str, source: str) -> str:
    """An address in a document of the sources, relative to their root; anchors are kept."""
    path, mark, anchor = address.partition("#")
    path = posixpath.normpath(posixpath.join(posixpath.dirname(source), path)) if path else source
    return path + mark + anchor


def table_rows(markdown: str, heading: str) -> list[list[str]]:
    """The cells of the first table under a heading, without its head."""
    _, _, rest = markdown.partition(f"\n## {heading}\n")
    rows = []
    for line in rest.split("\n## ")[0].splitlines():
        if line.startswith("|"):
            rows.append([cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]])
        elif rows:
            break
    return rows[2:]
