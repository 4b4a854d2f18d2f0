"""Cameras in other programs' files put points where those programs put them, show what they show, and put pixels back there.

    python3 judged.py VIEWPROJ three|opencv|decimals

The judge runs here and now and prints one case a line, as JSON: a file, points, and what it says of them. 77: it is not there.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TOOL, JUDGE = os.path.abspath(sys.argv[1]), sys.argv[2]
HERE = Path(__file__).resolve().parent
PIXELS = 1e-9  # the most by which a pixel may differ, and of larger numbers the share
PLACES = 1e-11  # of a point that comes back from its pixel, of its size and distance
# Kinds of cases, how often each field is compared, and each side met, at least.
LEAST = {
    "three": (24, {"screen": 150, "depth": 150, "viewDistance": 200, "visible": 200, "outside": 200, "left": 10, "right": 10,
                   "bottom": 10, "top": 10, "near": 10, "far": 10, "behind": 10}),
    "opencv": (22, {"screen": 500, "viewDistance": 800, "visible": 800, "outside": 800, "left": 25, "right": 25, "bottom": 25,
                    "top": 25, "near": 2, "far": 2, "behind": 25, "lens": 60}),
    "decimals": (27, {"screen": 250, "viewDistance": 300, "visible": 300, "outside": 300, "left": 25, "right": 25, "bottom": 25,
                      "top": 25, "behind": 25}),
}
counts = {}


def judge():
    if JUDGE == "three":
        if not shutil.which("node") or not (HERE.parent / "node_modules/three").is_dir():
            sys.exit(print("node or tests/node_modules is not there; sh samples/setup.sh tests installs them") or 77)
        return ["node", HERE / "threejs.mjs"]
    if JUDGE == "opencv":
        try:
            import cv2  # noqa: F401
        except ImportError:
            sys.exit(print("python3-opencv is not installed; sh samples/setup.sh tests installs it") or 77)
    return [sys.executable, HERE / f"{JUDGE}.py"]


def run(*arguments):
    return json.loads(subprocess.run([TOOL, *arguments], stdout=subprocess.PIPE, check=True, stderr=subprocess.DEVNULL).stdout)


def write(path, content):
    path.write_text(content if isinstance(content, str) else json.dumps(content), newline="")
    return str(path)


def close(got, said, within):
    """Numbers within that, and arrays of them; everything else is equal."""
    if isinstance(got, list) and isinstance(said, list) and len(got) == len(said):
        return all(close(a, b, within) for a, b in zip(got, said))
    if isinstance(got, (int, float)) and isinstance(said, (int, float)) and not isinstance(said, bool):
        return abs(got - said) <= within
    return got == said


def check(case, folder):
    camera = write(folder / "camera", case["file"])
    if "files" in case:  # the camera's is a folder
        camera = folder / "files"
        shutil.rmtree(camera, ignore_errors=True)
        camera.mkdir()
        for name, text in case["files"].items():
            if text is not None:
                write(camera / name, text)
    options = ["-c", str(camera) + ("#" + case["pick"] if case["pick"] else ""), *case.get("options", ())]
    if case["viewport"]:
        options += ["--viewport", case["viewport"]]
    projected = run("project", *options, write(folder / "points.json", case["points"]))
    pixels = [{"screen": said["screen"], "viewDistance": said["viewDistance"]} for said in case["judgements"]]
    back = run("ray", *options, write(folder / "pixels.json", pixels))
    assert len(projected) == len(back) == len(case["judgements"]) > 0
    for point, got, ray, said in zip(case["points"], projected, back, case["judgements"]):
        for field, value in said.items():  # a judge leaves out what it does not know
            larger = abs(value) if isinstance(value, float) else 1
            assert close(got[field], value, PIXELS * max(1, larger)), (case["name"], field, got, said)
            counts[field] = counts.get(field, 0) + 1
        size = abs(said["viewDistance"]) + max(map(abs, point)) + max(map(abs, ray["origin"] or [0]))
        assert close(ray["point"], point if said["screen"] else None, PLACES * size), (case["name"], ray, point)
        for side in said["outside"]:
            counts[side] = counts.get(side, 0) + 1


kinds = set()
with tempfile.TemporaryDirectory() as scratch:
    for line in subprocess.run(judge(), stdout=subprocess.PIPE, check=True, text=True).stdout.splitlines():
        one = json.loads(line)
        kinds.add(one["name"])
        check(one, Path(scratch))
print(len(kinds), "kinds of cases,", counts)
least_kinds, least = LEAST[JUDGE]
assert len(kinds) == least_kinds and all(counts.get(name, 0) >= number for name, number in least.items())
