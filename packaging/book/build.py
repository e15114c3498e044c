#!/usr/bin/env python3
"""Makes the book; see packaging/book.sh, which calls this.

usage: build.py OUTPUT --program PROGRAM --version VERSION [--only NUMBER,...]

--only makes a book of a few figures, to look at them.
"""

import argparse
import logging
import os
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "site"))  # the readers of patterns and reports

import pikepdf  # noqa: E402
import weasyprint  # noqa: E402

import figures  # noqa: E402
import text  # noqa: E402
from plates import Picture, Studio, pages_of  # noqa: E402
from program import Program  # noqa: E402

MM = 25.4 / 96  # of a CSS pixel
POINT = 72 / 25.4  # of a millimetre
LEAST_PLATE = 92.0  # mm; figures whose text leaves less have their systems on a second page


def rendered(html: str, folder: Path) -> weasyprint.Document:
    """Sets the pages. Images have addresses `picture:NAME`, because the PDF depends on addresses and the folder is temporary."""

    def fetch(address: str) -> dict:
        name = address.removeprefix("picture:")
        kind = "image/svg+xml" if name.endswith(".svg") else "image/png"
        return {"string": (folder / name).read_bytes(), "mime_type": kind}

    return weasyprint.HTML(string=html, url_fetcher=fetch).render()


def places_of(document: weasyprint.Document) -> dict[str, tuple[int, float, float]]:
    """The page, from 1, and the position in millimetres of each element with an identifier."""
    return {
        name: (number, x * MM, y * MM)
        for number, page in enumerate(document.pages, 1)
        for name, (x, y) in page.anchors.items()
    }


def room_for(figure: figures.Figure, places: dict[str, tuple[int, float, float]], plate: str, end: str) -> float:
    """The height that pictures can have on a page, in millimetres: what the text from their place to an element leaves.
    `places` are those of a book without pictures."""
    first, _, _ = places[f"{figure.anchor}-{plate}"]
    last, _, bottom = places[f"{figure.anchor}-{end}"]
    return text.PAGE_BOTTOM - bottom - 2 if first == last else 0.0


def insert_pictures(pdf: pikepdf.Pdf, pictures: list[Picture], places: dict[str, tuple[int, float, float]]) -> None:
    """Places the drawings that are PDF files under the text of their pages."""
    for picture in pictures:
        if picture.file.suffix != ".pdf":
            continue
        number, x, y = places[picture.anchor]
        page = pdf.pages[number - 1]
        with pikepdf.open(picture.file) as drawing:
            form = pdf.copy_foreign(drawing.pages[0].as_form_xobject())
        # add_underlay() would choose a different name in each run.
        name = pikepdf.Name(f"/{picture.anchor}")
        if "/XObject" not in page.resources:
            page.resources.XObject = pikepdf.Dictionary()
        page.resources.XObject[name] = form
        bottom = float(page.mediabox[3]) - (y + picture.height) * POINT
        wide, tall = (size * POINT / float(side) for size, side in zip((picture.width, picture.height), list(form.BBox)[2:]))
        place = f"q {wide:.6f} 0 0 {tall:.6f} {x * POINT:.4f} {bottom:.4f} cm {name} Do Q"
        page.contents_add(place.encode(), prepend=True)


def build(output: Path, program: Program, version: str, only: list[str], scratch: Path) -> str:
    documents, patterns = figures.read()
    if only:
        known = {figure.number for document in documents for figure in document.figures}
        if unknown := [each for each in only if each not in known]:
            raise ValueError(f"unknown figure '{unknown[0]}'")
        for document in documents:
            document.figures = [each for each in document.figures if each.number in only]
        documents = [each for each in documents if each.figures]
    studio = Studio(program, patterns, scratch)
    book = text.Book(documents, patterns, studio, version)
    shown = book.figures

    whole = [each for each in shown if not each.is_half]
    places = places_of(rendered(book.html({}, {}), scratch))
    book.spreads = {each.anchor for each in whole if each.turn or room_for(each, places, "plate", "end") < LEAST_PLATE}
    places = places_of(rendered(book.html({}, {}), scratch)) if book.spreads else places
    for number, picture in book.openers.items():
        _, _, top = places[f"document-{number}"]
        _, _, bottom = places[f"document-{number}-end"]
        picture.height = text.PAGE_HEIGHT - text.OPENER_MARGIN - (bottom - top) - text.OPENER_GAP
    plates: text.Plates = {}
    for figure in shown:
        if figure.is_half:
            plates[figure.anchor] = pages_of(figure, text.HALF_WIDTH, text.HALF_HEIGHT)
        elif figure.anchor in book.spreads:
            if not figure.turn and len(figure.drawings) > 1:
                print(f"book: warning: {figure.number} needs two pages, but has no turn", file=sys.stderr)
            rooms = room_for(figure, places, "plate", "words"), room_for(figure, places, "second", "end")
            plates[figure.anchor] = pages_of(figure, text.WIDTH, *rooms)
        else:
            plates[figure.anchor] = pages_of(figure, text.WIDTH, room_for(figure, places, "plate", "end"))
    for figure in shown:
        if figure.has_one_scale:
            studio.set_one_scale(figure, [each for rows in plates[figure.anchor] for row in rows for each in row])
    pictures = [each for pages in plates.values() for rows in pages for row in rows for each in row] + book.extra_pictures()
    studio.make_all(pictures, os.cpu_count() or 1)

    # Repeated if a picture has moved a text to another page, so that the printed numbers of pages are right.
    for _ in range(5):
        pages = {name: page for name, (page, _, _) in places.items()}
        document = rendered(book.html(plates, pages), scratch)
        places = places_of(document)
        if all(places[name][0] == page for name, page in pages.items()):
            break
    else:
        raise ValueError("the numbers of pages do not settle")
    plain = scratch / "text.pdf"
    document.write_pdf(plain)
    with pikepdf.open(plain) as pdf:
        insert_pictures(pdf, pictures, places)
        pdf.save(output, static_id=True, object_stream_mode=pikepdf.ObjectStreamMode.generate)
    return f"{len(document.pages)} pages, {len(shown)} figures, {output.stat().st_size / 1e6:.1f} MB"


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("output")
    parser.add_argument("--program", required=True)
    parser.add_argument("--version", required=True)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    if not Path(options.program).is_file():
        sys.exit(f"book: {options.program} is missing; ./demo builds it")
    logging.getLogger("fontTools").setLevel(logging.ERROR)  # it warns of widths of glyphs in Linux Libertine
    output = Path(options.output)
    output.parent.mkdir(parents=True, exist_ok=True)
    only = [each for each in options.only.split(",") if each]
    with tempfile.TemporaryDirectory(dir=output.parent, prefix=output.name + ".") as folder:
        made = Path(folder) / "book.pdf"
        try:
            facts = build(made, Program(str(Path(options.program).resolve())), options.version, only, Path(folder))
        except (ValueError, OSError) as error:
            sys.exit(f"book: {error}")
        made.replace(output)
    print(facts)


if __name__ == "__main__":
    main()
