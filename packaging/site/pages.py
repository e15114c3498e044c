"""The pages of patterns, kinds, the front and the manual as HTML."""

import re
from dataclasses import dataclass

from drawing import SIZE, Made
from markup import code, escaped, isolated, page, plain, relative, studio_link
from patterns import Pattern
from system import facts, system

KINDS = {
    "kolams": ("Kolams", "Lines around dots, drawn in rice flour in front of houses; these are from the literature."),
    "kolam-library": ("Kolam library", "A hundred kolams on grids of dots: straight, interlaced, radial. Each is verified: "
                      "every line closes, every dot is encircled."),
    "tilings": ("Tilings", "Tiles that fill the plane without gaps or overlaps: aperiodic, self-similar, uniform, spirals."),
    "curves": ("Curves", "Lines that fill squares, hexagons and islands, and the classical fractals."),
    "plants": ("Plants", "Branches, leaves and flowers, in the plane and in space."),
    "maps": ("Maps", "Layers of cells that grow and divide."),
    "words": ("Words", "Derivations: filaments of cells, signals, growing words."),
    "melodies": ("Melodies", "Curves as music: height is pitch, length is duration."),
    "arrangements": ("Arrangements", "Several curves that are played together."),
}  # fmt: skip

@dataclass
class Context:
    """What pages of patterns need in addition to the pattern."""

    keys: dict[str, tuple[str, str, str]]  # key: values, meaning, address in the manual
    sizes: dict[str, tuple[int, int]]  # pixels of pictures


def kind_name(kind: str) -> str:
    return KINDS[kind][0] if kind in KINDS else kind


def address_of(pattern: Pattern) -> str:
    return f"pattern/{pattern.name}.html"


def file_of(name: str) -> str:
    return f"pattern/files/{name}"


def image(context: Context, path: str, file: str, alt: str, *, lazy: bool = True) -> str:
    width, height = context.sizes.get(file, (SIZE * 4, SIZE * 4))
    loading = ' loading="lazy" decoding="async"' if lazy else ""
    source = escaped(relative(file_of(file), path))
    return f'<img src="{source}" width="{width}" height="{height}" alt="{escaped(plain(alt))}"{loading}>'


def bytes_of(size: int) -> str:
    if size >= 1_000_000:
        return f"{size / 1e6:.1f} MB"
    return f"{max(1, round(size / 1000))} kB"


def is_brief(pattern: Pattern) -> bool:
    """True if the L-system fits beside the picture."""
    words = [pattern.keys.get("axiom", "")]
    for rules in pattern.rules:
        words += [f"{each.predecessor}{each.condition}{each.successor}" for each in rules.productions]
    return len(words) <= 7 and max(map(len, words)) <= 120 and sum(map(len, words)) <= 320 and len(pattern.description) <= 260


def arrangement_system(pattern: Pattern, known: dict[str, str]) -> str:
    rows = ""
    for number, track in enumerate(pattern.tracks, 1):
        name = str(track.get("pattern", ""))
        shown = f'<a href="{escaped(name)}.html">{escaped(name)}</a>' if name in known else isolated(name)
        settings = ", ".join(
            f"{key}: {value}" for key, value in track.items() if key != "pattern" and not isinstance(value, (dict, list))
        )
        rows += f'<tr><th scope="row">{number}</th><td>{shown}<br><span class="small">{escaped(settings)}</span></td></tr>'
    return f'<table class="system"><caption class="unseen">Tracks</caption><tbody>{rows}</tbody></table>'


LOOK = ("stroke", "ground", "palette", "line", "view", "light", "fill", "tile colours", "weave", "parallel", "sway")
MUSIC = ("scale", "tonic", "tempo", "rhythm", "meter", "instrument", "harmony", "phrases", "form", "mapping")


def vary(pattern: Pattern, context: Context, path: str) -> str:
    """What can be changed: name, present value, meaning."""
    rows = ""

    def row(name: str, now: str, meaning: str, anchor: str = "") -> None:
        nonlocal rows
        label = f'<a href="{escaped(relative(anchor, path))}">{escaped(name)}</a>' if anchor else isolated(name)
        meaning = f"<span>{escaped(meaning)}</span>" if meaning else ""
        now = now if len(now) <= 80 else now[:78] + " …"
        rows += f"<dt>{label}</dt><dd>{code(now)}{meaning}</dd>"

    def key_row(key: str) -> None:
        values, meaning, anchor = context.keys.get(key, ("", "", ""))
        row(key, pattern.keys[key], meaning or values, anchor)

    if pattern.steps:
        row("n", str(pattern.steps), "Number of derivation steps", context.keys.get("derivation length", ("", "", ""))[2])
    for name, value, remark in pattern.defines:
        row(name, value, remark)
    for key in ("angle factor", "angle increment"):
        if key in pattern.keys:
            key_row(key)
    if pattern.is_random:
        row("seed", pattern.keys.get("seed", "0"), "Another seed, another specimen", context.keys.get("seed", ("", "", ""))[2])
    for key in LOOK + (MUSIC if pattern.kind == "melodies" else ()):
        if key in pattern.keys:
            key_row(key)
    return f'<dl class="facts values">{rows}</dl>' if rows else ""


def variants(pattern: Pattern, made: Made, context: Context, path: str) -> str:
    if not pattern.variants:
        return ""
    entries = ""
    for name, settings in pattern.variants:
        link = relative("studio/index.html", path) + "#" + studio_link(f"{pattern.name}.lsys", pattern.text, name)
        short = settings if len(settings) <= 160 else settings[:158] + " …"
        picture = image(context, path, made.variants[name], "") if name in made.variants else ""
        entries += (
            f'<li><a href="{escaped(link)}">{picture}<span class="name">{isolated(name)}<span class="unseen">: open this variant in '
            f"the studio</span></span></a>{code(short)}</li>"
        )
    return f'<h3>Variants</h3><ul class="variants">{entries}</ul>'


def player(made: Made, path: str) -> str:
    midi = next((file for label, file, _ in made.downloads if label == "MIDI"), "")
    if not midi:
        return ""
    roll = ""
    if made.roll:
        source = escaped(relative(file_of(made.roll), path))
        roll = (
            f'<div class="roll"><img src="{source}" width="1000" height="240" alt="Piano roll: time runs to the right, '
            'pitch upwards" loading="lazy"><span class="head-line"></span></div>'
        )
    return (
        f'<div class="player" data-midi="{escaped(relative(file_of(midi), path))}" role="group" aria-label="Player" hidden>{roll}'
        '<button type="button" class="primary">Play</button><div class="place"><label class="unseen" for="place">Place</label>'
        '<input type="range" id="place" min="0" max="1000" step="1" value="0"><output for="place"></output></div></div>'
        "<noscript><p>The player needs JavaScript; the MIDI file can be played by other programs.</p></noscript>"
    )


def words(command: str) -> str:
    """A command whose lines break only between words."""
    return re.sub(r"\S*-\S*", r'<span class="word">\g<0></span>', escaped(command))


def downloads(pattern: Pattern, made: Made, path: str) -> str:
    entries = "".join(
        f'<li><a href="{escaped(relative(file_of(file), path))}" download>{label}<span class="unseen"> of {escaped(plain(pattern.title))}'
        f'</span></a> <span class="small">{bytes_of(size)}</span></li>'
        for label, file, size in made.downloads
    )
    text = relative(file_of(f"{pattern.name}{pattern.path.suffix}"), path)
    entries += (
        f'<li><a href="{escaped(text)}" download>Pattern<span class="unseen"> file</span></a> '
        f'<span class="small">{bytes_of(len(pattern.text.encode()))}</span></li>'
    )
    more = ""
    if made.too_large:
        sizes = " and ".join(f"{label} ({bytes_of(size)})" for label, size in made.too_large)
        extension = made.too_large[0][0].lower()
        more = f'<p class="small">The site does not store the {sizes}; make it with {code(f"sikku draw {pattern.name} -o {pattern.name}.{extension}")}.</p>'
    return f'<ul class="downloads" aria-label="Downloads">{entries}</ul>{more}'


def neighbours(group: list[Pattern], at: int) -> str:
    def link(pattern: Pattern, word: str, name: str) -> str:
        return f'<a class="{name}" rel="{name}" href="{pattern.name}.html"><small>{word}</small>{isolated(pattern.title)}</a>'

    before = link(group[at - 1], "Before", "prev") if at > 0 else ""
    after = link(group[at + 1], "Next", "next") if at + 1 < len(group) else ""
    return f'<nav class="neighbours" aria-label="Neighbours">{before}{after}</nav>'


def section(name: str, *contents: str) -> str:
    if not any(contents):
        return ""
    anchor = name.lower().replace(" ", "-")
    return f'<section class="part" aria-labelledby="{anchor}"><h2 id="{anchor}">{name}</h2>{"".join(contents)}</section>'


def work_link(pattern: Pattern, known: dict[str, str]) -> str:
    """The link that opens a pattern or an arrangement, beside the pattern of its first track, in the studio."""
    if not pattern.is_arrangement:
        return studio_link(f"{pattern.name}.lsys", pattern.text, panel="play" if pattern.kind == "melodies" else "")
    names = [str(track.get("pattern", "")) for track in pattern.tracks]
    first = next((name for name in [*names, "snake-kolam"] if name in known), "line")  # the studio begins with the kolam
    text = known.get(first, "axiom: F\n")
    return studio_link(f"{first}.lsys", text, arrangement=(f"{pattern.name}.toml", pattern.text))


def pattern_page(pattern: Pattern, made: Made, group: list[Pattern], context: Context, known: dict[str, str]) -> str:
    path = address_of(pattern)
    title, kind = plain(pattern.title), kind_name(pattern.kind)
    description = pattern.description
    source = pattern.source
    studio = relative("studio/index.html", path) + "#" + work_link(pattern, known)
    buttons = f'<p class="buttons"><a class="button primary" href="{escaped(studio)}">Open in the studio</a></p>'
    plate = ""
    if made.picture and not pattern.is_arrangement:
        plate = f'<figure class="plate">{image(context, path, made.picture, title, lazy=False)}</figure>'
    # Short productions are printed beside the picture.
    is_short = bool(plate) and is_brief(pattern)
    head = (
        f'<div class="head"><p class="crumbs"><a href="../patterns/{pattern.kind}.html">{escaped(kind)}</a></p>'
        f"<h1>{isolated(pattern.title)}</h1>"
        + (f"<p>{isolated(description)}</p>" if description else "")
        + (f'<p class="small">{isolated(source)}</p>' if source else "")
        + f"{buttons}{downloads(pattern, made, path)}{system(pattern) if is_short else ''}</div>"
    )
    parts = [f'<div class="specimen">{plate}{head}</div>' if plate else f"<div>{head}</div>"]

    def part(name: str, *contents: str) -> None:
        parts.append(section(name, *contents))

    melody = player(made, path)
    is_musical = pattern.kind in ("melodies", "arrangements")
    heard = "" if is_musical else '<p class="small measure">The line read as a melody: each horizontal run is a note, and its height is the pitch.</p>'
    if melody and is_musical:
        part("Listen", melody, facts(made.melody))
    if pattern.is_arrangement:
        part("Tracks", arrangement_system(pattern, known))
    elif not is_short:
        part("The L-system", system(pattern))
    if made.growth:
        figures = "".join(
            f"<figure>{image(context, path, file, f'{title}, n = {n}')}<figcaption>n = {n}</figcaption></figure>"
            for n, file in made.growth
        )
        last = image(context, path, made.thumbnail or made.picture, f"{title}, n = {pattern.steps}")
        part("Growth", f'<div class="growth">{figures}<figure>{last}<figcaption>n = {pattern.steps}</figcaption></figure></div>')
    examined = ""
    if made.certificate:
        claims = relative("manual/claims.html", path)
        examined = section(
            "Certificate", facts(made.certificate, "facts verdict"),
            f'<p class="small measure">The program has verified these statements. <a href="{claims}">What they claim, and what they do not</a>.</p>',
        )  # fmt: skip
    measured = section("Measures", facts(made.report))
    if examined and measured:
        parts.append(f'<div class="columns">{examined}{measured}</div>')
    else:
        parts.append(examined + measured)
    if melody and not is_musical:
        part("Listen", heard, melody, facts(made.melody))
    if pattern.is_arrangement:
        command = f"sikku play {pattern.name} -o {pattern.name}.html"
    else:
        part("What to vary", vary(pattern, context, path), variants(pattern, made, context, path))
        command = f"sikku draw {pattern.name} -o {pattern.name}.pdf"
        if pattern.steps:
            command += f"\nsikku draw {pattern.name} -n {pattern.steps + 1} --size A3 -o large.pdf"
        if pattern.defines:
            command += f"\nsikku draw {pattern.name} --set {pattern.defines[0][0]}={pattern.defines[0][1]} -o another.svg"
        elif pattern.is_random:
            command += f"\nsikku draw {pattern.name} --seed 7 -o another.svg"
        if pattern.kind == "melodies":
            command += f"\nsikku play {pattern.name} -o {pattern.name}.html"
    part(
        "On the command line",
        f'<div class="command"><pre tabindex="0"><code id="command">{words(command)}</code></pre>'
        '<button type="button" data-copy="command" hidden>Copy</button></div>',
        f'<details><summary>The whole file, {escaped(pattern.path.name)}</summary><div class="command"><pre tabindex="0" dir="ltr">'
        f'<code id="file">{escaped(pattern.text)}</code></pre>'
        '<button type="button" data-copy="file" hidden>Copy</button></div></details>',
    )  # fmt: skip
    parts = [each for each in parts if each]
    parts.append(neighbours(group, group.index(pattern)))
    about = f"{title}: {kind}. {description}"
    scripts = ("player.js",) if melody else ()
    return page(path, f"{title} – {kind} – Sikku", "\n".join(parts), about=about[:300], section="patterns/index.html", scripts=scripts)


def card(pattern: Pattern, made: Made, context: Context, path: str, *, with_source: bool = True, lazy: bool = True) -> str:
    picture = '<span class="empty"></span>'
    if made.thumbnail:
        picture = image(context, path, made.thumbnail, "", lazy=lazy)
    source = pattern.source
    if len(source) > 90:
        source = source[:88] + " …"
    source = f'<span class="from">{isolated(source)}</span>' if with_source and source and pattern.kind != "kolam-library" else ""
    address = escaped(relative(address_of(pattern), path))
    # Text that the filter searches in addition to what is shown.
    words = plain(f"{pattern.description} {dict(made.certificate).get('kolam', '')} {dict(made.certificate).get('symmetry', '')}")[:300]
    return f'<li data-words="{escaped(words)}"><a href="{address}">{picture}<span class="name">{isolated(pattern.title)}</span>{source}</a></li>'


def kind_page(kind: str, group: list[Pattern], made: dict[str, Made], context: Context) -> str:
    path = f"patterns/{kind}.html"
    name, about = KINDS.get(kind, (kind, ""))
    cards = "".join(card(each, made[each.name], context, path, lazy=at > 5) for at, each in enumerate(group))
    classes = "grid dense" if kind == "kolam-library" else "grid rolls" if kind == "arrangements" else "grid"
    body = (
        f'<div class="head"><p class="crumbs"><a href="index.html">Patterns</a></p><h1>{escaped(name)}</h1><p class="lede">{escaped(about)}</p></div>'
        '<div class="filter" hidden><label for="filter">Filter</label><input type="search" id="filter" autocomplete="off">'
        '<span id="count" class="small" role="status"></span></div>'
        f'<ul class="{classes}" id="patterns">{cards}</ul>'
    )
    return page(path, f"{name} – Sikku", body, about=about, section="patterns/index.html")


# The patterns of each kind that the overview shows.
PICKED = {
    "kolams": ("anklets-of-krishna", "kooja-kolam", "padi-star", "bag-of-candies"),
    "kolam-library": ("kolam-radial-12x7", "kolam-9x9-zz3jrmhm", "kolam-triangle-6-t7eqgsmx", "kolam-9-5-idukku-1je896k5"),
    "tilings": ("penrose-rhombs", "hat", "ammann-beenker", "spiral-tiling"),
    "curves": ("hilbert", "hexagonal-gosper", "dekking-spline", "dragon"),
    "plants": ("lilac", "fern", "abop-plant-f", "flower-field"),
    "maps": ("moss-leaf", "cell-layer", "gourd", "seedling"),
    "melodies": ("hilbert-kalyani", "dragon-blues", "gosper-waltz", "snowflake-bossa"),
}


def overview_page(patterns: dict[str, list[Pattern]], made: dict[str, Made], context: Context) -> str:
    path = "patterns/index.html"
    total = sum(len(group) for group in patterns.values())
    sections = ""
    for kind, group in patterns.items():
        by_name = {each.name: each for each in group}
        picked = [by_name[name] for name in PICKED.get(kind, ()) if name in by_name]
        shown = (picked + [each for each in group if each not in picked])[:4]
        cards = "".join(card(each, made[each.name], context, path, with_source=False) for each in shown)
        name, about = KINDS.get(kind, (kind, ""))
        classes = "grid rolls" if kind == "arrangements" else "grid"
        sections += (
            f'<section aria-labelledby="{kind}"><h2 id="{kind}"><a href="{kind}.html">{escaped(name)}</a> <small>{len(group)}</small></h2>'
            f'<p>{escaped(about)}</p><ul class="{classes}">{cards}</ul></section>'
        )
    body = (
        f'<div class="head"><h1>Patterns</h1><p class="lede">{total} patterns come with the program, each with its source. Open a pattern '
        f'in the studio, change it, print it, or listen to it.</p></div><div class="kinds">{sections}</div>'
    )
    return page(path, "Patterns – Sikku", body, about=f"{total} L-systems from the literature, with pictures, productions and sources.")


def front_page(three: list[tuple[str, str, str]], example: str, example_picture: str, heard: tuple[Pattern, Made] | None,
               begin: list[tuple[str, Pattern, str]], total: int, version: str, context: Context) -> str:  # fmt: skip
    """`three` lists a file, the name of a pattern and a caption; `begin` lists patterns that open in the studio,
    and the view that is open there."""
    path = "index.html"
    figures = "".join(
        f'<figure><a href="pattern/{name}.html">{image(context, path, file, caption, lazy=False)}</a>'
        f'<figcaption><a href="pattern/{name}.html">{escaped(caption)}</a></figcaption></figure>'
        for file, name, caption in three
    )
    install = f"sudo apt install ./sikku_{version}_amd64.deb"

    def command(name: str, text: str) -> str:
        return (
            f'<div class="command"><pre tabindex="0"><code id="{name}">{words(text)}</code></pre>'
            f'<button type="button" data-copy="{name}" hidden>Copy</button></div>'
        )

    melody = ""
    if heard and (controls := player(heard[1], path)):
        melody = (
            '<section class="part" aria-labelledby="hear"><h2 id="hear">The same two rules, heard</h2><p class="measure">Height is pitch, '
            f'length is duration: <a href="{address_of(heard[0])}">{isolated(heard[0].title)}</a>, a prelude in a raga of South India.</p>'
            f"{controls}</section>"
        )
    links = [
        f'<a href="studio/index.html#{studio_link(f"{pattern.name}.lsys", pattern.text, panel=panel)}" data-studio>{escaped(text)}</a>'
        for text, pattern, panel in begin
    ]
    choices = f"<p>Or begin with {', '.join(links[:-1])} or {links[-1]}.</p>" if len(links) > 1 else ""
    width, height = context.sizes["studio.png"]
    about = "Kolams, tilings, plants and music from L-systems, with exact geometry from the text to the print and the score."
    body = f"""<section class="front">
<h1>Kolams, tilings, plants and music from a few lines of text</h1>
<p class="lede">Sikku grows drawings and melodies from the rules of L-systems, with exact geometry from the text to the print
and the score. <em>Sikku</em> is Tamil for the knot of a kolam line.</p>
<p class="buttons"><a class="button primary" href="studio/index.html" data-studio>Try it now</a>
<a class="button" href="first-steps.html">First steps</a></p>
</section>
<div class="triptych">{figures}</div>
<section class="split">
<div><h2>Two rules, one line</h2>
<p>X and Y are replaced again and again, five times. Then a turtle reads the word: F is a step, + and − are turns.
It draws Hilbert’s curve. Change a letter and see what happens.</p>
<pre tabindex="0"><code>{escaped(example)}</code></pre>
<p><a href="{escaped("studio/index.html#" + studio_link("hilbert.lsys", example))}">Open it in the studio</a></p></div>
<figure>{image(context, path, example_picture, "Hilbert’s curve: one line that fills a square")}</figure>
</section>
{melody}
<section class="try" aria-labelledby="try"><h2 id="try">Try it now</h2>
<p class="measure">The studio is a page on which you write, see, vary, play and export patterns. It runs in the
browser and sends no data; opening it loads about 2 MB.</p>
<div id="studio-place"><a class="poster" href="studio/index.html" data-studio>
<img src="assets/studio.png" width="{width}" height="{height}" loading="lazy"
alt="Open the studio here: the text of a pattern on the left, its picture in the middle"></a></div>
{choices}
<p><a href="studio/index.html">Open the studio in a separate page</a></p></section>
<section class="split top-aligned" aria-labelledby="install"><div><h2 id="install">Two commands to a first print</h2>
<p>Install the program, and draw a kolam as a PDF of size A3. Packages for Debian 12, other Linux systems, Python and
Node.js are listed in <a href="manual/readme.html#install">Install</a>.</p></div>
<div>{command("install-command", install)}{command("print-command", "sikku draw anklets-of-krishna --size A3 -o kolam.pdf")}</div></section>
<section aria-labelledby="more"><h2 id="more">Where to go</h2>
<ul class="entries">
<li><a href="first-steps.html">First steps</a><p>What an L-system is, in ten minutes and six examples.</p></li>
<li><a href="patterns/index.html">Patterns</a><p>{total}, most of them from the literature: kolams, tilings, curves, plants, maps,
words, melodies, arrangements.</p></li>
<li><a href="manual/index.html">Manual</a><p>The tutorial, the pattern language, prints, scores, galleries, and libraries for C++, Python and JavaScript.</p></li>
<li><a href="teachers.html">Teachers</a><p>Workbooks, colouring pages and lessons for classes.</p></li>
</ul></section>"""
    title = "Sikku – kolams, tilings, plants and music from L-systems"
    return page(path, title, body, about=about, scripts=("player.js",) if melody else ())


def search_page() -> str:
    body = """<div class="head"><h1>Search</h1></div>
<div><form class="searching" role="search" aria-label="Whole site"><label class="unseen" for="query">Words in the manual and in patterns</label>
<input id="query" name="q" type="search" autocomplete="off" placeholder="Words in the manual and in patterns">
<button type="submit" class="primary">Search</button></form>
<p id="search-state" class="small" role="status"></p><ul class="results" id="results"></ul>
<noscript><p>The search needs JavaScript and runs in the browser. The <a href="manual/index.html">manual</a> and the
<a href="patterns/index.html">patterns</a> are also listed.</p></noscript></div>"""
    return page("search.html", "Search – Sikku", body, about="Search the manual and the patterns.", scripts=("index.js", "search.js"))


def offline_page() -> str:
    body = """<div class="head"><h1>Not available offline</h1><p class="lede">The network is down, and the browser has not stored this page.
Pages that you have opened before are available, and so are the <a href="index.html">front page</a>, the
<a href="first-steps.html">first steps</a> and the <a href="manual/index.html">manual</a>.</p></div>"""
    return page("offline.html", "Offline – Sikku", body, about="This page is not stored for offline use.")


def summary_of(text: str) -> str:
    """The text of a line of Markdown."""
    return plain(re.sub(r"[`*_]|\[([^\]]*)\]\([^)]*\)", r"\1", text))
