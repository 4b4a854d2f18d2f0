"""Every step of an explanation, recomputed exactly from the steps above it and the matrices beside them, and its end compared
with `project`, `ray` and `matrix`.

    explained.py VIEWPROJ
"""
import json
import math
import random
import re
import subprocess
import sys
from fractions import Fraction

TOOL = sys.argv[1]
PRESETS = ["opengl", "opengl-lh", "d3d", "d3d-rh", "vulkan", "unity", "unreal", "opencv", "ps2"]
counts = {}


def run(*arguments):
    return json.loads(subprocess.run([TOOL, *arguments], capture_output=True, check=True, text=True).stdout)


def count(what, holds=True):
    counts[what] = counts.get(what, 0) + bool(holds)


def evaluated(formula, values, turn):
    """The formula's value, each name replaced by what turn makes of its number."""
    names = re.findall(r"[A-Za-z][\w.]*(?:\[\d\]\[\d\])?", formula)
    text = formula
    for name in sorted(set(names) - {"sqrt"}, key=len, reverse=True):
        text = re.sub(r"(?<![\w.\]])" + re.escape(name) + r"(?![\w.\[])", f'(turn(values["{name}"]))', text)
    return eval(text, {"turn": turn, "values": values, "sqrt": lambda x: Fraction(math.sqrt(x))})


def check(explanation, eye):
    """eye: the size of what it may be rounded by."""
    values = {f"{name}[{i}][{j}]": x for name, rows in explanation["matrices"].items()
              for i, row in enumerate(rows) for j, x in enumerate(row)}
    for step in explanation["steps"]:
        name, formula, value = step["name"], step["formula"], step["value"]
        if formula is not None and value is not None:
            got = evaluated(formula, values, Fraction)
            size = evaluated(formula.replace(" - ", " + "), values, lambda x: abs(Fraction(x)))
            slack = Fraction(1e-14) * (abs(size) + abs(got)) + Fraction(eye) * Fraction(2e-15)
            assert abs(got - Fraction(value)) <= slack, (step, float(got), float(slack))
            count("steps")
            count("cancelling", step["note"] and "cancel" in step["note"])
        if value is not None:
            values[name] = value
    return values


def camera(rng):
    preset = rng.choice(PRESETS)
    document = {"convention": preset, "position": [rng.uniform(-9, 9) for _ in range(3)],
                "target": [rng.uniform(-1, 1) for _ in range(3)],
                "projection": {"type": "perspective", "fovY": rng.uniform(20, 100), "near": 0.1, "far": rng.choice([50, None])},
                "viewport": {"width": 640, "height": 480, "origin": rng.choice(["top-left", "bottom-left"])}}
    if rng.random() < 0.25:
        document["projection"] = {"type": "orthographic", "width": 8, "height": 6, "near": -2, "far": 30}
    if rng.random() < 0.1:
        document["projection"] = {"type": "perspective", "fovY": 60}
    if rng.random() < 0.2:  # a matrix that is not quite a rotation
        del document["target"]
        document["convention"], document["cameraAxes"] = "opengl", "RUB"
        document["worldFromCamera"] = [[1, 4e-4, 3e-4, 0], [0, 1, -2e-4, 0], [0, 1e-4, 1, 0]]
    return document


def main():
    for trial in range(150):
        rng = random.Random(trial)
        document = camera(rng)
        text = json.dumps(document)
        writing = [] if rng.random() < 0.3 else ["--quiet", "--convention", rng.choice(PRESETS)] + rng.choice([[], ["--reverse-z"]])
        has_near = document["projection"].get("near") is not None
        point = [rng.uniform(-6, 6) for _ in range(3)] + rng.choice([[], [], [rng.choice([0, 2, -0.5])]])
        given = "=" + ",".join(map(repr, point))
        explanation = run("explain", "-c", text, "--point" + given, "--to", "json", *writing)
        assert explanation["point"] == point, explanation["point"]
        values = check(explanation, max(map(abs, document["position"])))
        projected = run("project", "-c", text, "--point" + given, "--to", "json")
        result = (projected[0] if isinstance(projected, list) else projected)
        for name in ["screen", "depth", "viewDistance", "visible"]:
            assert explanation["result"][name] == result[name], (name, explanation["result"], result)
        assert explanation["result"]["outside"] == result.get("outside", []), (explanation["result"], result)
        if result["screen"]:
            assert [values["screen.x"], values["screen.y"]] == result["screen"]
        if has_near:
            matrices = run("matrix", "-c", text, "--relative-to-eye", *writing)
            assert explanation["matrices"]["V"] == matrices["view"] and explanation["matrices"]["P"] == matrices["projection"]
            for side in ["left", "right", "bottom", "top", "near", "far"]:
                margin = values.get("margin." + side)
                if margin is not None and abs(margin) > 1e-9 and result["screen"]:
                    assert (margin < 0) == (side in result.get("outside", [])), (side, margin, result)
                    count("margins")
        count("behind", "behind" in explanation["result"]["outside"])
        count("orthographic", document["projection"]["type"] == "orthographic")
        count("without near", not has_near)
        count("exchanged", any("exchanges" in (step["note"] or "") for step in explanation["steps"]))

        pixel = [rng.uniform(-100, 700), rng.uniform(-100, 500)] + ([rng.uniform(0.1, 0.9)] if has_near else [])
        given = "=" + ",".join(map(repr, pixel))
        explanation = run("explain", "-c", text, "--pixel" + given, "--to", "json", *writing)
        check(explanation, 1e-3 * max(map(abs, document["position"])))
        cast = run("ray", "-c", text, "--pixel" + given, "--to", "json")
        ray = cast[0] if isinstance(cast, list) else cast
        assert explanation["result"] == {name: ray[name] for name in explanation["result"]}, (explanation["result"], ray)

    # A pixel that the lens does not reach has a distance all the same, and no point.
    text = json.dumps({"position": [0, 0, 0], "direction": [0, 0, -1], "projection": {"type": "perspective", "fovY": 60, "near": 1, "far": 100},
                       "viewport": {"width": 640, "height": 480}, "distortion": {"model": "fisheye", "k": []}})
    explanation = run("explain", "-c", text, "--pixel", "5000,240,0.5", "--to", "json")
    values = check(explanation, 1)
    assert values["reciprocal"] == 0.505 and explanation["result"] == {"origin": [0, 0, 0], "direction": None, "point": None}, explanation["result"]

    # A model: moved, turned and doubled.
    text = json.dumps({"position": [0, 0, 5], "target": [0, 0, 0], "projection": {"type": "perspective", "fovY": 60, "near": 1},
                       "viewport": {"width": 640, "height": 480}})
    model = '{"translation": [1, 2, -3], "rotation": [0, 0, 0.6, 0.8], "scale": [2, 2, 2]}'
    for point in ["1,2,3", "1,2,3,4"]:
        explanation = run("explain", "-c", text, "--point", point, "--model", model, "--to", "json")
        check(explanation, 5)
        projected = run("project", "-c", text, "--point", point, "--model", model, "--to", "json")
        assert explanation["result"]["screen"] == (projected[0] if isinstance(projected, list) else projected)["screen"]
    print(counts)
    least = {"steps": 3000, "cancelling": 50, "margins": 200, "behind": 10, "orthographic": 20, "without near": 5, "exchanged": 20}
    assert all(counts.get(name, 0) >= number for name, number in least.items()), counts


main()
