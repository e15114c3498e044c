"""Examines a book: see tests/full/book.sh.

usage: book.py BOOK
"""

import re
import subprocess
import sys
from pathlib import Path

import pikepdf

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "packaging/book"), str(ROOT / "packaging/site")]

import figures  # noqa: E402

BOOK = sys.argv[1]


def fail(message: str) -> None:
    sys.exit(f"book: {message}")


def plain(text: str) -> str:
    """Letters and digits only, because line breaks and hyphens can be anywhere."""
    return re.sub(r"[^\w]|_", "", text.casefold())


text = subprocess.run(["pdftotext", "-layout", BOOK, "-"], capture_output=True, text=True, check=True).stdout
pages = text.split("\f")[:-1]
bare = [plain(page) for page in pages]
documents, patterns = figures.read()

# Figures are on pages of their documents, in order; the list at the end has those that are left out, with the reason.
page_of: dict[str, int] = {}
at = 0
for document in documents:
    at = next((n for n in range(at, len(pages)) if plain(document.name) in bare[n] and plain(document.reference) in bare[n]), None)
    if at is None:
        fail(f"{document.name} has no title page")
    for figure in document.figures:
        if figure.left_out:
            if not any(plain(figure.left_out) in page for page in bare[at:]):
                # The text mixes the columns of a table, but contains all of its words.
                words = {plain(each) for each in figure.left_out.split()}
                if not any(all(word in page for word in words) for page in bare[at:]):
                    fail(f"{document.name}: {figure.number} is not in the list of what is left out")
            continue
        found = next((n for n in range(at, len(pages)) if plain(figure.number + figure.title) in bare[n]), None)
        if found is None:
            fail(f"{document.name}: {figure.number}, {figure.title} is not in the text")
        at = found
        page_of[figure.anchor] = found + 1
        shown = bare[found] + bare[min(found + 1, len(pages) - 1)]
        for name in figure.systems:
            if plain(name) not in shown:
                fail(f"{figure.number}: the name {name} is not beside it")

with pikepdf.open(BOOK) as pdf:
    number_of = {page.objgen: number for number, page in enumerate(pdf.pages, 1)}
    names = pdf.Root.Names.Dests.Names
    destinations = {str(names[i]): number_of[names[i + 1][0].objgen] for i in range(0, len(names), 2)}
    links = 0
    for number, page in enumerate(pdf.pages, 1):
        for link in page.get("/Annots", []):
            target = str(link.get("/Dest", link.get("/A", {}).get("/D", "")))
            if target not in destinations:
                fail(f"page {number}: a link leads to '{target}', which does not exist")
            links += 1
            if target in page_of and destinations[target] != page_of[target]:
                fail(f"a link to {target} leads to page {destinations[target]}; the figure is on page {page_of[target]}")
    # Pictures that are PDF files are form XObjects of their pages.
    objects = (each for page in pdf.pages for _, each in page.resources.get("/XObject", pikepdf.Dictionary()).items())
    forms = len({each.objgen for each in objects if each.Subtype == "/Form"})
    vectors = sum(1 for document in documents for figure in document.figures for each in figure.drawings if not each.is_played
                  and (each.is_of_rules or "light" not in patterns[each.pattern].keys))  # fmt: skip
    if forms < vectors:
        fail(f"{forms} drawings are on the pages; the figures have {vectors}")

# The index prints the numbers of the pages with the figures.
expected: dict[str, set[int]] = {}
for document in documents:
    for figure in document.figures:
        if not figure.left_out:
            for term in [*figure.index, *(each.pattern for each in figure.drawings)]:
                expected.setdefault(term, set()).add(page_of[figure.anchor])
first = next(n for n, page in enumerate(pages) if page.strip().startswith("Index"))
raw = subprocess.run(["pdftotext", "-f", str(first + 1), BOOK, "-"], capture_output=True, text=True, check=True).stdout
index = re.sub(r"\s+", " ", re.sub(r"(?<=[\w-])-\n", "-", raw))
for term, numbers in expected.items():
    listed = ", ".join(map(str, sorted(numbers)))
    flat, wanted = re.sub(r"[\s-]", "", index), re.sub(r"[\s-]", "", f"{term}, {listed}")
    if wanted not in flat:
        fail(f"the index does not say '{term}, {listed}'")
print(f"book: {len(pages)} pages, {len(page_of)} figures in order, {links} links, {len(expected)} entries of the index, {forms} drawings")
