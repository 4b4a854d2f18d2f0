"""One camera and one point: what `project`, `ray`, `cull`, `explain` and `info` say of them agrees, and with a textbook's
arithmetic on info's own numbers.

    agreed.py VIEWPROJ
"""
import concurrent.futures
import json
import math
import os
import random
import subprocess
import sys

TOOL = sys.argv[1]
W, H = 640, 480
SIDES = ["left", "right", "bottom", "top", "near", "far"]


def run(*arguments, records=None):
    lines = records and "".join(json.dumps(r) + "\n" for r in records)
    done = subprocess.run([TOOL, *arguments], input=lines, capture_output=True, text=True, check=False)
    assert done.returncode == 0, (arguments, done.stderr)
    return [json.loads(line) for line in done.stdout.splitlines()] if records else json.loads(done.stdout)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def away(a, b):
    return [x - y for x, y in zip(a, b)]


def along(a, k, b):
    return [x + k * y for x, y in zip(a, b)]


def unit(a):
    return [x / math.hypot(*a) for x in a]


def turn(rng):
    """The columns of a random rotation."""
    x, y, z, w = unit([rng.gauss(0, 1) for _ in range(4)])
    return [[1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
            [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
            [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)]]


def near(a, b, share, size=1.0):
    return all(abs(x - y) <= share * (size + abs(y)) for x, y in zip(a, b))


def document(rng):
    eye, columns = [rng.uniform(-9, 9) for _ in range(3)], turn(rng)
    pose = rng.choice([{"position": eye, "target": [rng.uniform(-1, 1) for _ in range(3)]},
                       {"position": eye, "euler": {"order": rng.choice(["XYZ", "YXZ", "ZXZ"]),
                                                   "degrees": [rng.uniform(-180, 180) for _ in range(3)]}},
                       {"worldFromCamera": [[round(c[i], 4) for c in columns] + [eye[i]] for i in range(3)]}])
    end = rng.choice([12, 50, None])
    lens = rng.choice([{"type": "perspective", "fovY": rng.uniform(20, 100), "near": rng.uniform(0.1, 3), "far": end},
                       {"type": "frustum", "left": -0.8, "right": 1.6, "bottom": 0.2, "top": 2, "near": 2, "far": end},
                       {"type": "intrinsics", "fx": 500, "fy": 480, "cx": 300, "cy": 260, "near": 0.5, "far": end},
                       {"type": "orthographic", "width": 16, "height": 12, "near": rng.uniform(-9, 2), "far": 14}])
    viewport = {"width": W, "height": H, "origin": rng.choice(["top-left", "bottom-left"]), "pixelCenter": rng.choice([0, 0.5])}
    if rng.random() < 0.3:
        viewport["crop"] = {"x": 400, "y": 50, "width": 160, "height": 120}
    preset = rng.choice(["opengl", "d3d", "vulkan", "unreal", "opencv"])
    made = {"convention": preset, **pose, "projection": lens, "viewport": viewport}
    if lens["type"] == "intrinsics" and rng.random() < 0.5:
        made["distortion"] = {"model": "brown", "k": [-0.1, 0.02], "p": [0.001, -0.002]}
    return made


def agree(seed):
    rng = random.Random(seed)
    made = document(rng)
    text, orthographic, lens = json.dumps(made), made["projection"]["type"] == "orthographic", "distortion" in made
    counts = dict.fromkeys(["visible", "outside", "hits", "hit behind", "none", "lens"], 0)
    info = run("info", "-c", text, "--to", "json", "--at", "5")
    eye, right, up, forward, p, v = *(info[k] for k in ["eye", "right", "up", "forward", "projection"]), info["viewport"]
    down = 1 if v["origin"] == "top-left" else -1
    points = [[e + rng.uniform(-14, 14) for e in eye] for _ in range(20)]
    for d in range(1, 21):
        ahead = along(eye, d + 0.37, forward)
        points.append(along(along(ahead, rng.uniform(-0.5, 0.5) * d, right), rng.uniform(-0.5, 0.5) * d, up))
    projected = run("project", "-c", text, "--to", "ndjson", records=points)
    culled = [None] * len(points) if lens else run("cull", "-c", text, "--to", "ndjson", records=points)
    for point, there, verdict in zip(points, projected, culled):
        inside = not there["outside"]
        counts["visible" if inside else "outside"] += 1
        assert there["visible"] == inside, there
        if verdict:
            assert verdict["cull"] == ("inside" if inside else "outside"), (made, there, verdict)
            assert inside or "behind" in there["outside"] or verdict["plane"] in there["outside"], (there, verdict)
            for side in SIDES:
                if (plane := info["planes"][side]) and "behind" not in there["outside"]:
                    assert (dot(plane[:3], point) + plane[3] < 0) == (side in there["outside"]), (side, plane, there)
        if there["screen"] and not lens:
            x, y, z = (dot(axis, away(point, eye)) for axis in (right, up, forward))
            w = 1 if orthographic else z
            textbook = [p["cx"] + p["fx"] * x / w, p["cy"] - down * p["fy"] * y / w]
            assert near(textbook, there["screen"], 2e-3 if "worldFromCamera" in made else 1e-9, W), (made, textbook, there)
    seen = [r for r in projected if r["screen"]]
    # Back by the distance, and by the depth where it keeps the digits.
    for name, share in (("viewDistance", 1e-9), ("depth", 1e-6)):
        some = [r for r in seen if r["visible"]]
        pixels = [{"screen": r["screen"], name: r[name]} for r in some]
        for there, ray in zip(some, run("ray", "-c", text, "--to", "ndjson", records=pixels) if some else []):
            assert near(ray["point"], there["position"], share), (made, there, ray)
            t = dot(away(there["position"], ray["origin"]), ray["direction"])
            assert near(along(ray["origin"], t, ray["direction"]), there["position"], 1e-9), (there, ray)
    # What a ray hits is what project shows at that pixel, and nothing else.
    plane = [rng.uniform(-1, 1) for _ in range(3)] + [rng.uniform(-9, 9)]
    screens = [{"screen": r["screen"]} for r in seen]
    rays = run("ray", "-c", text, "--plane=" + ",".join(map(repr, plane)), "--to", "ndjson", records=screens)
    hits = [r for r in rays if r["hit"]]
    shown = run("project", "-c", text, "--to", "ndjson", records=[r["hit"]["point"] for r in hits]) if hits else []
    for ray, there in zip(hits, shown):
        point, distance = ray["hit"]["point"], ray["hit"]["distance"]
        assert abs(dot(plane[:3], point) + plane[3]) < 1e-12 * (1 + math.hypot(*point)), ray
        assert near(along(ray["origin"], distance, ray["direction"]), point, 1e-12), ray
        assert near(there["screen"], ray["screen"], 1e-9, W) and not {"near", "far"} & set(there["outside"]), (ray, there)
        counts["hits"] += 1
        counts["hit behind"] += distance < 0
    missed = [r for r in rays if r["direction"] and not r["hit"]]
    distances = [-(dot(plane[:3], r["origin"]) + plane[3]) / dot(plane[:3], r["direction"]) for r in missed]
    crossed = [along(r["origin"], t, r["direction"]) for r, t in zip(missed, distances)]
    for there in run("project", "-c", text, "--to", "ndjson", records=crossed) if crossed else []:
        assert not there["visible"], (made, plane, there)
        counts["none"] += 1
    for point, there in list(zip(points, projected))[::13]:
        told = run("explain", "-c", text, "--point=" + ",".join(map(repr, point)), "--to", "json")["result"]
        assert all(told[name] == there[name] for name in told), (told, there)
    # Corners, size of a pixel, angles, and the lens as info tells them.
    corners = (info["corners"]["near"] or []) + (info["corners"]["far"] or [])
    plain = ["--ignore-distortion", "--quiet"] * lens
    first, last = [v["x"], v["y"]], [v["x"] + v["width"], v["y"] + v["height"]]
    first, last = ([n + v["pixelCenter"] - 0.5 for n in corner] for corner in (first, last))
    low, high = (last[1], first[1]) if down > 0 else (first[1], last[1])
    expected = [[first[0], low], [last[0], low], [last[0], high], [first[0], high]] * 2
    for corner, there in zip(expected, run("project", "-c", text, *plain, "--to", "ndjson", records=corners)):
        assert near(there["screen"], corner, 1e-7, W), (made, there, corner)
    size, ahead = info["pixelSizes"][0], along(eye, 5, forward)
    if "worldFromCamera" not in made:
        beside = [ahead, along(ahead, size["across"], right), along(ahead, size["down"], up)]
        a, b, c = (r["screen"] for r in run("project", "-c", text, *plain, "--to", "ndjson", records=beside))
        assert near(away(b, a), [1, 0], 1e-9) and near(away(c, a), [0, -down], 1e-9), (info, a, b, c)
    if not orthographic:
        for angle, edges in (("fovX", ("left", "right")), ("fovY", ("bottom", "top"))):
            assert abs(p[angle] - sum(math.degrees(math.atan(s * p[e])) for e, s in zip(edges, (-1, 1)))) < 1e-9, (angle, p)
    if lens and seed % 3 == 0:
        pixels = [[first[0] + i / 16 * v["width"], first[1] + j / 16 * v["height"]] for i in range(17) for j in range(17)]
        rays = [r for r in run("ray", "-c", text, "--to", "ndjson", records=[{"screen": q} for q in pixels]) if r["direction"]]
        straight = run("project", "-c", text, *plain, "--to", "ndjson", records=[r["direction"] + [0] for r in rays])
        shift = max(math.dist(ray["screen"], there["screen"]) for ray, there in zip(rays, straight))
        assert abs(shift - info["distortion"]["largestShift"]) < 1e-9 * (1 + shift), (made, shift)
        counts["lens"] += 1
    return counts


def turned(seed):
    """heading, pitch and roll compose to the axes, straight down and up too."""
    rng = random.Random(seed)
    lat, lon, heading, roll = rng.uniform(-89, 89), rng.uniform(-180, 180), rng.uniform(0, 360), rng.uniform(-180, 180)
    tilt = rng.choice([-90, 90, -90 + 10 ** rng.uniform(-14, -2), 90 - 10 ** rng.uniform(-14, -2), rng.uniform(-90, 90)])
    info = run("info", f"--position=lat={lat!r},lon={lon!r},height=500", f"--heading={heading!r}", f"--pitch={tilt!r}",
               f"--roll={roll!r}", "--to", "json")
    a, o, h, p, r = map(math.radians, [info["place"]["lat"], info["place"]["lon"], info["heading"], info["pitch"], info["roll"]])
    east, north = [-math.sin(o), math.cos(o), 0], [-math.sin(a) * math.cos(o), -math.sin(a) * math.sin(o), math.cos(a)]
    up = [math.cos(a) * math.cos(o), math.cos(a) * math.sin(o), math.sin(a)]

    def of(e, n, u):
        return [e * x + n * y + u * z for x, y, z in zip(east, north, up)]

    level_right, level_up = of(math.cos(h), -math.sin(h), 0), of(-math.sin(p) * math.sin(h), -math.sin(p) * math.cos(h), math.cos(p))
    axes = {"forward": of(math.cos(p) * math.sin(h), math.cos(p) * math.cos(h), math.sin(p)),
            "right": [math.cos(r) * x - math.sin(r) * y for x, y in zip(level_right, level_up)],
            "up": [math.sin(r) * x + math.cos(r) * y for x, y in zip(level_right, level_up)]}
    for name, axis in axes.items():
        assert near(axis, info[name], 2e-12), (seed, name, axis, info)
    assert abs(tilt) != 90 or info["roll"] == 0, info
    return abs(tilt) == 90


def eyes():
    """P times its eye is zero, whatever its skew."""
    rng, rows = random.Random(1), []
    for _ in range(200):
        k = [[rng.uniform(100, 2000), rng.choice([0, 1]) * rng.uniform(-300, 300), rng.uniform(0, 900)],
             [0, rng.uniform(100, 2000), rng.uniform(0, 900)], [0, 0, 1]]
        columns, eye, size = turn(rng), [rng.uniform(-9, 9) for _ in range(3)], rng.choice([1, -1, 0.37])
        pose = [[c[i] for c in columns] + [-dot([c[i] for c in columns], eye)] for i in range(3)]
        rows.append([[size * sum(k[i][j] * pose[j][n] for j in range(3)) for n in range(4)] for i in range(3)])
    text = "".join(f"M{i} = {json.dumps(p)}\n" for i, p in enumerate(rows))
    done = subprocess.run([TOOL, "info", "--which", "P", "--to", "json"], input=text, capture_output=True, text=True, check=True)
    told = json.loads(done.stdout)["matrices"]
    assert len(told) == len(rows)
    for p, one in zip(rows, told):
        eye = one["readings"][0]["eye"]["value"]
        assert all(abs(dot(row, eye + [1])) <= 1e-12 * sum(abs(a * b) for a, b in zip(row, eye + [1])) for row in p), (p, one)


with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    all_counts = list(pool.map(agree, range(60)))
    vertical = sum(pool.map(turned, range(150)))
eyes()
counts = {name: sum(each[name] for each in all_counts) for name in all_counts[0]}
print(counts, vertical, "straight down or up")
least = {"visible": 300, "outside": 900, "hits": 300, "hit behind": 20, "none": 100, "lens": 2}
assert vertical > 30 and all(counts[name] >= number for name, number in least.items()), counts
