"""Tables of mutations, and the copy of the sources in which all of them are compiled behind one switch."""
import re
import zlib
from dataclasses import dataclass, field
from pathlib import Path

# What is done to the code; a row names one of these.
KINDS = (
    "sign", "comparison", "dropped term", "constant", "swapped", "lost output", "wrong unit", "dropped check", "order",
    "default", "off by one", "name", "format", "status",
)
# Said once in each source before anything else; a macro, because what kernels of several processors share must not be code.
SWITCH = "#define MUTATED(n) (!__builtin_is_constant_evaluated() && ::viewprojMutant == (n))\nextern int viewprojMutant;\n"
# Read before any static object is made.
READING = """#include <cstdlib>
int viewprojMutant = 0;
__attribute__((constructor(101))) static void readMutant() {
  if (const char* number = std::getenv("VIEWPROJ_MUTANT")) viewprojMutant = std::atoi(number);
}
"""


class BrokenRow(Exception):
    pass


@dataclass
class Mutation:
    """A row: see README.md."""

    name: str
    kind: str
    file: str
    where: str  # of the row itself
    seen: str = ""
    old: list = field(default_factory=list)
    new: list = field(default_factory=list)
    tests: list = field(default_factory=list)  # (ctest's name, filter or case or "")
    equivalent: str = ""

    @property
    def module(self):
        """lib/projection/ray.cpp: projection; cmd/records/points.cpp: input."""
        parts = self.file.split("/")
        return parts[1] if len(parts) > 2 else "main"

    @property
    def number(self):
        """Not the row's place, so that a new row compiles no other file anew."""
        return zlib.crc32(self.name.encode()) & 0x7FFFFFFF


def read_table(path):
    rows = []
    row = None
    for number, line in enumerate(path.read_text().split("\n"), 1):
        where = f"{path.name}:{number}"
        if not line or line.startswith("#"):
            continue
        mark, _, rest = line.partition(" ")
        if mark == "*":
            parts = [part.strip() for part in rest.split("|")]
            if len(parts) != 3:
                raise BrokenRow(f"{where}: not '* NAME | KIND | FILE'")
            row = Mutation(*parts, where)
            rows.append(row)
        elif row is None:
            raise BrokenRow(f"{where}: no row has begun")
        elif mark == "-":
            row.old.append(rest)
        elif mark == "+":
            row.new.append(rest)
        elif mark == "!":
            test, _, part = rest.strip().partition(" ")
            row.tests.append((test, part.strip()))
        elif mark == "=":
            row.equivalent = rest.strip()
        elif row.seen or row.old:
            raise BrokenRow(f"{where}: begins with none of * - + ! = #")
        else:
            row.seen = line
    return rows


def read_tables(paths):
    """Every row, checked for itself."""
    rows = [row for path in paths for row in read_table(path)]
    names, numbers = {}, {}
    for row in rows:
        if row.name in names:
            raise BrokenRow(f"{row.where}: {row.name} is also at {names[row.name].where}")
        if row.number in numbers:
            raise BrokenRow(f"{row.where}: {row.name} needs another name: its number is that of {numbers[row.number].name}")
        if row.kind not in KINDS:
            raise BrokenRow(f"{row.where}: {row.kind} is no kind; these are: {', '.join(KINDS)}")
        if not row.seen or not row.old or not (row.tests or row.equivalent):
            raise BrokenRow(f"{row.where}: needs a line of what a user sees, the text, and a test or a reason (=)")
        names[row.name] = numbers[row.number] = row
    return rows


@dataclass
class _Place:
    """Where a row's text stands in its file, and what becomes of it."""

    start: int
    end: int
    row: Mutation
    inner: list = field(default_factory=list)


def _place(row, text):
    old = "\n".join(row.old)
    before, opened, rest = old.partition("«")
    middle, closed, after = rest.partition("»") if opened else (before, "", "")
    if not opened:
        before = ""
    elif not closed or "«" in middle or "»" in after:
        raise BrokenRow(f"{row.where}: « and » do not pair")
    whole = before + middle + after
    count = text.count(whole)
    if count != 1:
        raise BrokenRow(f"{row.where}: {row.name}: its text stands {count} times in {row.file}")
    start = text.index(whole) + len(before)
    return _Place(start, start + len(middle), row)


def _nested(places):
    """The places, those inside another one in its inner; of two with the same text, one is inside the other."""
    top = []
    for place in sorted(places, key=lambda p: (p.start, -p.end)):
        level = top
        while level and place.start < level[-1].end:
            if place.end > level[-1].end:
                raise BrokenRow(f"{place.row.where}: {place.row.name} overlaps with {level[-1].row.name}")
            level = level[-1].inner
        level.append(place)
    return top


def _text(text, start, end, places):
    out, at = "", start
    for place in places:
        out += text[at : place.start] + _switched(text, place)
        at = place.end
    return out + text[at:end]


def _switched(text, place):
    row = place.row
    new = "\n".join(row.new)
    condition = f"MUTATED({row.number})"
    if "MUTATED" in new:
        if place.inner:
            raise BrokenRow(f"{place.inner[0].row.where}: stands inside {row.name}, which writes its own switch")
        return new.replace("MUTATED", condition)
    old = _text(text, place.start, place.end, place.inner)
    taken = text[place.start : place.end].rstrip()
    value = re.search(r"[\w>]\s*\{[^{};]*\}$", taken)  # Vec3{0, 0, 1} is no statement
    if taken.endswith(";") or (taken.endswith("}") and not value):
        return f"if ({condition}) {{ {new} }} else {{ {old} }}"
    if not new:
        raise BrokenRow(f"{row.where}: an expression needs another in its place")
    return f"({condition} ? ({new}) : ({old}))"


def mutated(path, text, rows):
    """The text of a source with these rows of it, or as it is."""
    if not rows:
        return text
    return f'#line 1 "{path}"\n' + _text(text, 0, len(text), _nested([_place(row, text) for row in rows]))


def write_if_changed(path, content):
    if path.is_file() and path.read_bytes() == content:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def write_sources(root, target, rows):
    """A copy of the project, its lib and cmd mutated. What has not changed stays as it is, and is not compiled again."""
    unknown = [row for row in rows if not (root / row.file).is_file()]
    if unknown:
        raise BrokenRow(f"{unknown[0].where}: there is no {unknown[0].file}")
    wanted = set()
    for part in ("CMakeLists.txt", "README.md", "lib", "cmd", "tests", "samples"):
        for path in [root / part, *(root / part).rglob("*")]:
            if not path.is_file():
                continue
            name = path.relative_to(root)
            content = path.read_bytes()
            of_file = [row for row in rows if row.file == str(name)]
            if of_file:
                content = mutated(name, content.decode(), of_file).encode()
            if str(name) == "lib/CMakeLists.txt":
                content += f"target_sources(libviewproj PRIVATE {target}/mutant.cpp)\n".encode()
            write_if_changed(target / name, content)
            wanted.add(target / name)
    write_if_changed(target / "mutant.hpp", SWITCH.encode())
    write_if_changed(target / "mutant.cpp", READING.encode())
    wanted.update((target / "mutant.hpp", target / "mutant.cpp"))
    for path in sorted(target.rglob("*"), reverse=True):  # what is in a folder before the folder
        if path.is_file() and path not in wanted:
            path.unlink()
        elif path.is_dir() and not any(path.iterdir()):
            path.rmdir()
