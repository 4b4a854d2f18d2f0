"""Reads the includes of lib and cmd: each goes to a file of the same module or of one further down, and no file reaches itself
through others (a .cpp and its .hpp are one file). A public header includes public headers and the standard library alone,
and neither names the arithmetic behind it nor declares anything outside of viewproj.  python3 tests/checks/layers.py [--table]"""
import re
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# From the bottom up; those of one line do not include one another.
LAYERS = (
    ("lib/numbers",),
    ("lib/camera",),
    ("lib/projection", "lib/matrices"),
    ("lib/scene", "lib/geodesy"),
    ("lib/viewproj",),
    ("cmd/text",),
    ("cmd/input",),
    ("cmd/output",),
    ("cmd/schema", "cmd/stream"),
    ("cmd/commands",),
    ("cmd/completion", "cmd/man", "cmd"),
)
# A public header counts as one of the module that implements it, or above all.
PUBLIC = {
    "vectors": "lib/numbers", "version": "lib/numbers", "convention": "lib/camera", "camera": "lib/camera",
    "screen": "lib/projection", "floats": "lib/projection", "clip": "lib/projection", "matrices": "lib/matrices", "scene": "lib/scene",
    "geodesy": "lib/geodesy", "viewproj": "lib/viewproj",
}
# What users never see; as words, comments left out.
ARITHMETIC = re.compile(r"\b(DoubleDouble|DDVec3|Expansion|Exact(Rows|Vec3|Plane|Source)|FineVec3|Dyadic|Wide\w*|Certified|"
                        r"ProjectionConstants|\w*Lanes|Interval|near|far)\b")
RANK = {module: rank for rank, layer in enumerate(LAYERS) for module in layer}


def module_of(path):
    """The longest folder that is a module."""
    if path.parent == ROOT / "lib" / "viewproj" and path.stem in PUBLIC:
        return PUBLIC[path.stem]
    for folder in path.relative_to(ROOT).parents:
        if str(folder) in RANK:
            return str(folder)
    raise SystemExit(f"layers: {path.relative_to(ROOT)} belongs to no module")


def included(path):
    for name in re.findall(r'^#include "([^"]+)"', path.read_text(), re.M):
        for base in (ROOT / "lib", ROOT / "cmd", path.parent):
            if (base / name).is_file():
                yield (base / name).resolve()
                break
        else:
            yield name


def public_faults(path):
    """What is wrong with a header for users."""
    text = path.read_text()
    for name in re.findall(r'^#include (\S+)', text, re.M):
        if not (name[0] == "<" and "." not in name and "/" not in name) and not name.startswith('"viewproj/'):
            yield f"includes {name}"
    code = re.sub(r'//[^\n]*|"(?:[^"\\\n]|\\.)*"', "", text)
    for word in sorted(set(match.group(1) for match in ARITHMETIC.finditer(code))):
        yield f"names {word}"
    for macro in re.findall(r"^#define (\w+)", code, re.M):
        if not macro.startswith("VIEWPROJ_"):
            yield f"defines {macro}"
    outside = re.sub(r"^#.*$", "", code, flags=re.M)
    inside = re.fullmatch(r"\s*(namespace viewproj \{.*\}\s*)?", outside, re.S)
    depth = 0
    for at, mark in ((m.start(), m.group()) for m in re.finditer(r"[{}]", outside)):
        depth += 1 if mark == "{" else -1
        if depth == 0 and outside[at + 1:].strip() and not outside[at + 1:].lstrip().startswith("namespace viewproj"):
            inside = None
    if not inside:
        yield "declares something outside of viewproj"
    for name in re.findall(r"^namespace ([\w:]+)", code, re.M):
        if name not in ("viewproj", "detail", "conventions"):
            yield f"opens namespace {name}"


def circles(graph):
    """Strongly connected components of more than one (Tarjan)."""
    index, low, stack, found = {}, {}, [], []

    def visit(v):
        index[v] = low[v] = len(index)
        stack.append(v)
        for w in graph.get(v, ()):
            if w not in index:
                visit(w)
                low[v] = min(low[v], low[w])
            elif w in stack:
                low[v] = min(low[v], index[w])
        if low[v] == index[v]:
            of = []
            while not of or of[-1] != v:
                of.append(stack.pop())
            if len(of) > 1:
                found.append(sorted(of))

    for v in list(graph):
        if v not in index:
            visit(v)
    return found


def main():
    sys.setrecursionlimit(10000)
    files = [path for part in ("lib", "cmd") for end in ("cpp", "hpp", "inc") for path in sorted((ROOT / part).rglob(f"*.{end}"))]
    if len(files) < 100:
        raise SystemExit(f"layers: only {len(files)} files")
    wrong, graph, arrows, lines = [], {}, Counter(), Counter()
    for path in files:
        source = module_of(path)
        if path.parent == ROOT / "lib" / "viewproj":
            wrong += [f"{path.relative_to(ROOT)} {fault}" for fault in public_faults(path)]
            if path.stem not in PUBLIC:
                wrong.append(f"{path.relative_to(ROOT)} is of no module: PUBLIC in layers.py lists them")
        lines[source] += path.read_text().count("\n")
        stem = str(path.relative_to(ROOT).with_suffix(""))
        graph.setdefault(stem, set())
        for target in included(path):
            if isinstance(target, str):
                wrong.append(f"{path.relative_to(ROOT)} includes {target}, which is not there")
                continue
            module = module_of(target)
            graph[stem].add(str(target.relative_to(ROOT).with_suffix("")))
            if module != source:
                arrows[source, module] += 1
                if RANK[module] >= RANK[source]:
                    wrong.append(f"{path.relative_to(ROOT)} includes {target.relative_to(ROOT)}, which is not further down")
        graph[stem].discard(stem)
    wrong += [f"these include one another: {' '.join(circle)}" for circle in circles(graph)]
    if "--table" in sys.argv:
        for module in sorted(lines, key=lambda module: -RANK[module]):
            to = ", ".join(f"{target} {count}" for (source, target), count in sorted(arrows.items()) if source == module)
            print(f"{module:22} {lines[module]:6}  -> {to}")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
