"""Reads the includes of lib and cmd: each goes to a file of the same room or of one further down, and no room reaches itself
through others. A public header includes public headers and the standard library alone.  python3 tests/checks/includes.py"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# From the bottom up; those of one line do not include one another. A public header counts as one of the room that implements it.
FLOORS = (
    ("lib/numbers",), ("lib/camera",), ("lib/lens",), ("lib/projection",), ("lib/matrices",), ("lib/cameras_of", "lib/scene", "lib/geodesy"), ("lib/viewproj",),
    ("cmd/text",), ("cmd/camera",), ("cmd/formats",), ("cmd/records",), ("cmd/output",), ("cmd/stream",), ("cmd/picture",), ("cmd/commands",), ("cmd",),
)
PUBLIC = {
    "vectors": "lib/numbers", "shared": "lib/numbers", "version": "lib/numbers", "convention": "lib/camera", "camera": "lib/camera", "lens": "lib/lens", "screen": "lib/projection",
    "matrices": "lib/matrices", "cameras_of": "lib/cameras_of", "scene": "lib/scene", "geodesy": "lib/geodesy", "viewproj": "lib/viewproj",
}
FLOOR = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}


def room_of(path):
    if path.parent == ROOT / "lib" / "viewproj":
        return PUBLIC[path.stem]
    return next(str(folder) for folder in path.relative_to(ROOT).parents if str(folder) in FLOOR)


wrong, files = [], [path for part in ("lib", "cmd") for end in ("cpp", "hpp", "inc") for path in (ROOT / part).rglob(f"*.{end}")]
for path in files:
    where, room = path.relative_to(ROOT), room_of(path)
    for line, bracket, name in re.findall(r'^(#include ([<"])([^>"]+).*)', path.read_text(), re.M):
        if path.parent == ROOT / "lib" / "viewproj" and (bracket == "<") == ("/" in name or "." in name):
            wrong.append(f"{where} is public: {line}")
        if bracket == "<":
            continue
        target = next((base / name for base in (ROOT / "lib", ROOT / "cmd") if (base / name).is_file()), None)
        if not target:
            wrong.append(f"{where} includes {name}, which is not there")
        elif room_of(target) != room and FLOOR[room_of(target)] >= FLOOR[room]:
            wrong.append(f"{where} includes {name}, which is not further down")
        elif room.startswith("cmd") and target.is_relative_to(ROOT / "lib") and not name.startswith(("viewproj/", "numbers/")):
            wrong.append(f"{where} includes {name}, which is private to the library")
print("\n".join(wrong) or f"{len(files)} files", file=sys.stderr if wrong else sys.stdout)
sys.exit(bool(wrong) or len(files) < 100)
