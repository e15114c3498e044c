"""Reads the parts of pattern and arrangement files that their pages show."""

import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

NAME = re.compile(r"[a-z0-9][a-z0-9.-]*")


@dataclass
class Production:
    predecessor: str  # with its contexts
    condition: str
    successor: str
    weight: str


@dataclass
class Rules:
    """The productions of a table, of the homomorphism, or of no table."""

    name: str
    productions: list[Production] = field(default_factory=list)


@dataclass
class Pattern:
    kind: str
    name: str
    path: Path
    text: str
    keys: dict[str, str] = field(default_factory=dict)
    defines: list[tuple[str, str, str]] = field(default_factory=list)  # name, value, remark
    variants: list[tuple[str, str]] = field(default_factory=list)  # name, the values that it sets
    rules: list[Rules] = field(default_factory=list)
    tracks: list[dict] = field(default_factory=list)  # of an arrangement

    @property
    def is_arrangement(self) -> bool:
        return self.path.suffix == ".toml"

    @property
    def title(self) -> str:
        return typographic(self.keys.get("title") or self.name)

    @property
    def description(self) -> str:
        return typographic(self.keys.get("description", ""))

    @property
    def source(self) -> str:
        return typographic(self.keys.get("source", ""))

    @property
    def is_random(self) -> bool:
        return "random(" in self.text or any(each.weight for rules in self.rules for each in rules.productions)

    @property
    def steps(self) -> int | None:
        value = self.keys.get("derivation length", "0")
        return int(value) if value.isdigit() else None


def typographic(text: str) -> str:
    """Replaces straight quotation marks and apostrophes by typographic ones."""
    return re.sub(r'"([^"<>=]*)"', r"“\1”", re.sub(r"(?<=\w)'(?=\w)", "’", text))


COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
DEFINE = re.compile(r"#?define\s+(\w+)\s*=?\s*(.*)")
TEXT = re.compile(r"(title|source|description): (.*)")
KEY = re.compile(r"([a-z][a-z ]*?)(?: (\S+))?:(?:\s+(.*)|)$")


def production(line: str) -> Production:
    left, _, right = line.partition("-->")
    predecessor, _, condition = left.partition(" : ")
    successor, colon, weight = right.rpartition(" : ")
    if not colon:
        successor, weight = right, ""
    successor = successor.strip()
    return Production(predecessor.strip(), condition.strip(), "" if successor == "*" else successor, weight.strip())


def lines_of(text: str) -> list[str]:
    """The lines that are not comments; a blank and `\\` at the end of a line continue it."""
    lines: list[str] = []
    continues = False
    for line in text.splitlines():
        line = line.rstrip()
        if continues:
            lines[-1] += line.lstrip()
        elif not line.lstrip().startswith("//"):
            lines.append(line)
        else:
            continue
        continues = lines[-1].endswith(" \\")
        if continues:
            lines[-1] = lines[-1][:-2]
    return lines


def read_pattern(kind: str, path: Path) -> Pattern:
    text = path.read_text(encoding="utf-8-sig")
    pattern = Pattern(kind, path.stem, path, text)
    rules = None
    for line in lines_of(text):
        bare = COMMENT.sub("", line).strip()
        if match := TEXT.fullmatch(bare):  # may mention productions
            pattern.keys.setdefault(match[1], match[2])
        elif "-->" in bare:
            if rules is None:
                rules = Rules("")
                pattern.rules.append(rules)
            rules.productions.append(production(bare))
        elif match := DEFINE.fullmatch(bare):
            remark = " ".join(each[2:-2].strip() for each in COMMENT.findall(line))
            pattern.defines.append((match[1], match[2].strip(), remark))
        elif match := re.fullmatch(r"(?:table (.*)|interpret):", bare):
            rules = Rules(f"Table {match[1]}" if match[1] else "For drawing")
            pattern.rules.append(rules)
        elif match := re.fullmatch(r"variant ([^:]*): *(.*)", bare):
            pattern.variants.append((match[1].strip(), match[2]))
        elif (match := KEY.fullmatch(bare)) and not bare.startswith("patch "):
            name = f"{match[1]} {match[2]}" if match[2] else match[1]
            pattern.keys.setdefault(name, match[3] or "")
    pattern.rules = [each for each in pattern.rules if each.productions]
    return pattern


def read_arrangement(kind: str, path: Path) -> Pattern:
    text = path.read_text(encoding="utf-8-sig")
    contents = tomllib.loads(text)
    comment = [line[1:].strip() for line in text.splitlines() if line.startswith("#")]
    keys = {name: str(value) for name, value in contents.items() if not isinstance(value, (list, dict))}
    keys.setdefault("description", " ".join(comment))
    tracks = [track for track in contents.get("track", []) if isinstance(track, dict)]
    return Pattern(kind, path.stem, path, text, keys, tracks=tracks)


ORDER = ("kolams", "kolam-library", "tilings", "curves", "plants", "maps", "words", "melodies", "arrangements")


def read_all(folder: Path) -> dict[str, list[Pattern]]:
    """All patterns by kind. Raises ValueError for names that cannot be addresses or occur twice."""
    kinds = sorted(
        (each for each in folder.iterdir() if each.is_dir() and each.name != "posters"),
        key=lambda each: (ORDER.index(each.name) if each.name in ORDER else len(ORDER), each.name),
    )
    patterns: dict[str, list[Pattern]] = {}
    seen: dict[str, Path] = {}
    for kind in kinds:
        files = sorted(each for each in kind.iterdir() if each.suffix in (".lsys", ".toml"))
        for file in files:
            for name in (kind.name, file.stem):
                if not NAME.fullmatch(name):
                    raise ValueError(f"{file}: a name consists of a to z, 0 to 9, '.' and '-'")
            if file.stem in seen:
                raise ValueError(f"{file} has the same name as {seen[file.stem]}")
            seen[file.stem] = file
            read = read_arrangement if file.suffix == ".toml" else read_pattern
            patterns.setdefault(kind.name, []).append(read(kind.name, file))
    return patterns
