"""Text as HTML: escaping, the frame that all pages share, addresses relative to a page."""

import base64
import html
import json
import posixpath
import re
import unicodedata
import zlib

# Characters that change the direction of a text or are invisible; they must not affect the text that follows.
CONTROLS = re.compile("[\u0000-\u0008\u000b-\u001f\u007f-\u009f\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb]")


def plain(text: str) -> str:
    """A line of text without control characters and directional marks, for titles of pages, labels and the index."""
    return re.sub(r"\s+", " ", CONTROLS.sub("", unicodedata.normalize("NFC", text))).strip()


def escaped(text: str) -> str:
    return html.escape(CONTROLS.sub("", text), quote=True)


def isolated(text: str) -> str:
    """A text by other authors, isolated in its own direction."""
    return f"<bdi>{escaped(text)}</bdi>"


def code(text: str) -> str:
    return f'<code dir="ltr">{escaped(text)}</code>'


def slug(heading: str) -> str:
    """The anchor that GitHub gives a heading."""
    kept = "".join(letter for letter in heading.strip().lower() if letter.isalnum() or letter in " -_")
    return kept.replace(" ", "-")


def relative(target: str, page: str) -> str:
    """The address of a file of the site, relative to a page."""
    path, mark, anchor = target.partition("#")
    if not path:
        return target
    return posixpath.relpath(path, posixpath.dirname(page) or ".") + mark + anchor


def compact_json(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))


def studio_link(name: str, text: str, variant: str = "", arrangement: tuple[str, str] | None = None, panel: str = "") -> str:
    """The fragment of a link that the studio opens: see art/link/link.h. An arrangement has a name and a text, and is
    played instead of the pattern. `panel` is the view that is open, such as `play`."""
    pattern = {"name": name, "text": text}
    if variant:
        pattern["variant"] = variant
    work: dict[str, object] = {"pattern": pattern}
    shown = {"panel": "play" if arrangement else panel}
    if arrangement:
        shown["arrangement"] = compact_json({"name": arrangement[0], "text": arrangement[1]})
    if shown["panel"]:
        work["page"] = shown
    contents = compact_json(work).encode()
    press = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = press.compress(contents) + press.flush()
    return "sikku1." + base64.urlsafe_b64encode(packed).decode().rstrip("=")


# Every page loads nothing but files of the site.
POLICY = (
    "default-src 'none'; img-src 'self' data:; style-src 'self'; script-src 'self'; connect-src 'self'; "
    "manifest-src 'self'; worker-src 'self'; frame-src 'self'; base-uri 'none'; form-action 'self'"
)

MARK = (
    '<svg class="mark" viewBox="0 0 32 32" aria-hidden="true" focusable="false"><rect width="32" height="32" rx="7"/>'
    '<path d="M16 5c8 0 8 11 0 11S8 27 16 27s8-11 0-11S8 5 16 5zM5 16c0-8 11-8 11 0s11 8 11 0-11-8-11 0-11 8-11 0z"/>'
    "</svg>"
)

SECTIONS = (
    ("first-steps.html", "First steps"),
    ("patterns/index.html", "Patterns"),
    ("manual/index.html", "Manual"),
    ("teachers.html", "Teachers"),
    ("studio/index.html", "Studio"),
)


def page(path: str, title: str, body: str, *, about: str, section: str = "", scripts: tuple[str, ...] = ()) -> str:
    """A whole page. `body` is HTML, `title` and `about` are text, `section` is the entry of SECTIONS it belongs to."""

    def to(target: str) -> str:
        return escaped(relative(target, path))

    def entry(target: str, name: str) -> str:
        current = ' aria-current="page"' if target == path else ' aria-current="true"' if target == section else ""
        return f'<li><a href="{to(target)}"{current}>{name}</a></li>'

    entries = "".join(entry(*each) for each in SECTIONS)
    loaded = "".join(f'<script src="{to(f"assets/{name}")}" defer></script>\n' for name in ("site.js", *scripts))
    home = ' aria-current="page"' if path == "index.html" else ""
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{escaped(POLICY)}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="theme-color" content="#faf6ee" media="(prefers-color-scheme: light)">
<meta name="theme-color" content="#1d1815" media="(prefers-color-scheme: dark)">
<meta name="referrer" content="no-referrer">
<meta name="description" content="{escaped(plain(about))}">
<title>{escaped(plain(title))}</title>
<link rel="icon" href="{to("assets/icon.svg")}" type="image/svg+xml">
<link rel="apple-touch-icon" href="{to("assets/icon-192.png")}">
<link rel="manifest" href="{to("manifest.webmanifest")}">
<link rel="stylesheet" href="{to("assets/style.css")}">
{loaded}</head>
<body>
<a class="skip" href="#content">Skip to the content</a>
<header class="top">
<a class="brand" href="{to("index.html")}"{home}>{MARK}<span>Sikku</span></a>
<nav aria-label="Site"><ul>{entries}</ul></nav>
<form class="find" action="{to("search.html")}" role="search">
<label class="unseen" for="find">Search</label><input id="find" name="q" type="search" placeholder="Search" autocomplete="off">
</form>
</header>
<main id="content" tabindex="-1">
{body}
</main>
<footer class="bottom">
<p>Sikku is free software under the <a href="{to("licence.txt")}">MIT licence</a>. This site sets no cookies, does not
count visitors and sends no requests to other servers.</p>
<p class="offline" id="offline" hidden><button type="button" id="keep">Keep this site for offline use</button>
<span id="keep-state" role="status"></span></p>
</footer>
</body>
</html>
"""
