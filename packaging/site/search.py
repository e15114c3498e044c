"""The index of the site: the words of each section and of each page of a pattern."""

import json
import re
import unicodedata

from markup import plain

EXCERPT = 150  # characters

# Words that occur on nearly every page.
COMMON = set(
    "a an and are as at be by for from if in into is it its of on one or that the their them then there they this to "
    "which with where what when without has have not no can each all also only so than".split()
)


def folded(text: str) -> list[str]:
    decomposed = unicodedata.normalize("NFD", text)
    bare = "".join(letter for letter in decomposed if not unicodedata.combining(letter)).lower()
    return re.findall(r"[^\W_]+", bare)


def base36(number: int) -> str:
    digits = "0123456789abcdefghijklmnopqrstuvwxyz"
    text = ""
    while True:
        number, digit = divmod(number, 36)
        text = digits[digit] + text
        if number == 0:
            return text


class Index:
    def __init__(self):
        self.pages: list[tuple[str, str, str, str]] = []
        self.places: dict[str, dict[int, bool]] = {}

    def add(self, address: str, title: str, of: str, text: str, names: str = "") -> None:
        """Adds a section. `of` is what it belongs to; the beginning of the text is shown, names are only found."""
        number = len(self.pages)
        line = plain(text)
        if len(line) > EXCERPT:
            line = line[:EXCERPT].rsplit(" ", 1)[0] + " …"
        self.pages.append((address, plain(title), plain(of), line))
        for words, is_title in ((folded(title), True), (folded(f"{of} {names} {text}"), False)):
            for word in words:
                if (word in COMMON or len(word) < 2) and not is_title:
                    continue
                if len(word) > 24 or (word.isdigit() and len(word) > 4):
                    continue
                found = self.places.setdefault(word, {})
                found[number] = found.get(number, False) or is_title

    def script(self) -> str:
        words = sorted(self.places)
        packed = []
        for word in words:
            before, text = 0, ""
            for page in sorted(self.places[word]):
                text += base36(page - before) + ("W" if self.places[word][page] else " ")
                before = page
            packed.append(text.rstrip())
        contents = {"pages": self.pages, "words": " ".join(words), "places": "|".join(packed)}
        written = json.dumps(contents, ensure_ascii=False, separators=(",", ":"))
        return f"window.sikkuIndex={written};\n".replace("<", "\\u003c")
