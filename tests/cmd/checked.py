"""Every mistake of `check` is found in pixels that a textbook's projection made with it, and what it says mends it does. Nothing
is found in pixels that no single mistake makes. The threads from which the mistakes are taken stand beside their rows.

    checked.py VIEWPROJ
"""
import concurrent.futures
import copy
import json
import math
import os
import random
import re
import shlex
import subprocess
import sys

TOOL = sys.argv[1]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return [x / math.sqrt(dot(a, a)) for x in a]


def direction(r, size):
    return [size * x for x in unit([r.gauss(0, 1) for _ in range(3)])]


class Scene:
    """A camera as a textbook has it: right-handed, y down from the picture's top, pixels from their corner; six points in it."""

    def __init__(self, seed):
        self.random = r = random.Random(seed)
        self.eye, self.target = direction(r, 10 ** r.uniform(0.5, 1.5)), direction(r, r.uniform(0.1, 1))
        self.upright = r.choice([[0, 1, 0], [0, 0, 1]])
        self.degrees, self.w, self.h = r.uniform(25, 90), 640 + 8 * r.randrange(160), 360 + 8 * r.randrange(30)
        self.forward = unit([t - e for t, e in zip(self.target, self.eye)])
        self.right = unit(cross(self.forward, self.upright))
        self.up = cross(self.right, self.forward)
        self.focal = self.h / 2 / math.tan(math.radians(self.degrees) / 2)
        self.points = [self.point(r.uniform(-0.9, 0.9), r.uniform(-0.9, 0.9), 10 ** r.uniform(0.3, 1.3)) for _ in range(6)]

    def point(self, x, y, distance):
        """x, y from -1 to 1 across the picture."""
        a, b = x * self.w / 2 / self.focal * distance, y * self.h / 2 / self.focal * distance
        return [e + a * r + b * u + distance * f for e, r, u, f in zip(self.eye, self.right, self.up, self.forward)]

    def pixel(self, p):
        d = [a - b for a, b in zip(p, self.eye)]
        z = dot(d, self.forward)
        return self.w / 2 + self.focal * dot(d, self.right) / z, self.h / 2 - self.focal * dot(d, self.up) / z

    def scaled(self, q, x, y):
        return self.w / 2 + x * (q[0] - self.w / 2), self.h / 2 + y * (q[1] - self.h / 2)

    def rotation(self):
        """x, y, z, w of the rotation from right, up, back to the world (Shepperd's method, by the largest of four)."""
        m = list(zip(self.right, self.up, [-f for f in self.forward]))
        trace = m[0][0] + m[1][1] + m[2][2]
        q = [2 * m[i][i] - trace for i in range(3)] + [trace]
        most = q.index(max(q))
        s = 2 * math.sqrt(1 + q[most])
        skew = [(m[(i + 2) % 3][(i + 1) % 3] - m[(i + 1) % 3][(i + 2) % 3]) / s for i in range(3)]
        if most == 3:
            return skew + [s / 4]
        j, k = (most + 1) % 3, (most + 2) % 3
        q[most], q[j], q[k], q[3] = s / 4, (m[j][most] + m[most][j]) / s, (m[k][most] + m[most][k]) / s, skew[most]
        return q

    def turn(self):
        """The rotation as its axis times its angle in radians."""
        *axis, w = self.rotation()
        return [2 * math.atan2(math.hypot(*axis), w) * n for n in unit(axis)]

    def bent(self, q, back=False):
        """Through the lens of K1, or by halving the pixel that it puts there."""
        x, y = (q[0] - self.w / 2) / self.focal, (q[1] - self.h / 2) / self.focal
        put = math.hypot(x, y)
        low, high = (0, put) if back else (1 + K1 * put * put, 0)
        for _ in range(60 if back else 0):
            r = (low + high) / 2
            low, high = (r, high) if r * (1 + K1 * r * r) < put else (low, r)
        return self.scaled(q, low / put, low / put) if back else self.scaled(q, low, low)


K1 = 0.1
RATIOS = (1.25, 1.5, 2, 3)  # of device pixels to CSS pixels


def look(s):
    return {"position": s.eye, "target": s.target, "up": s.upright, "projection": {"type": "perspective", "fovY": s.degrees, "near": 0.1},
            "viewport": {"width": s.w, "height": s.h}}


def rotation(s):
    return {"position": s.eye, "rotation": s.rotation(), "projection": look(s)["projection"], "viewport": look(s)["viewport"]}


def intrinsics(s):
    lens = {"type": "intrinsics", "fx": s.focal, "fy": s.focal, "cx": s.w / 2, "cy": s.h / 2, "near": 0.1}
    return {**rotation(s), "projection": lens}


def lens(s):
    return {**look(s), "distortion": {"model": "brown", "k": [K1]}}


def changed(form, **members):
    """The document with these members of a scene merged into it; None leaves one out."""
    def merged(into, patch):
        for name, value in patch.items():
            if isinstance(value, dict) and isinstance(into.get(name), dict):
                merged(into[name], value)
            else:
                into[name] = value
        return {name: value for name, value in into.items() if value is not None}

    return lambda s: merged(copy.deepcopy(form(s)), {name: make(s) if callable(make) else make for name, make in members.items()})


def inverse_pose(s):
    axes = (s.right, s.up, [-f for f in s.forward])
    return [[*axis, -dot(axis, s.eye)] for axis in axes] + [[0, 0, 0, 1]]


def same(s, q):
    return q


# The name; the mistake; the document; the pixel made of the right one, and the point. exact: a mend scales the pixels, and noise.
ROWS = [
    # sceneview PR#93, camera-picking-ray#1, antvis/G PR#1778, bevy-mouse-tracking PR#33; H - 1 - y: libgdx PR#7469,
    # thunder#350, cesium#12751, mrirecon/view PR#7
    ("y from the bottom", "y-flipped", look, lambda s, q: (q[0], s.h - q[1])),
    ("y from the bottom, intrinsics", "y-flipped", intrinsics, lambda s, q: (q[0], s.h - q[1])),
    ("y from the bottom of a crop", "y-flipped",
     changed(look, viewport=lambda s: {"crop": {"x": 40, "y": 25, "width": s.w - 80, "height": s.h - 60}}),
     lambda s, q: (q[0] - 40, s.h - 35 - q[1])),
    ("y from the bottom as an index", "y-flipped-index", look, lambda s, q: (q[0], s.h - 1 - q[1])),
    ("x mirrored", "x-mirrored", look, lambda s, q: (s.w - q[0], q[1])),
    ("z of the points negated", "x-mirrored", look, same, lambda p: [p[0], p[1], -p[2]]),
    ("centres at whole numbers", "pixel-centre", look, lambda s, q: (q[0] - 0.5, q[1] - 0.5)),
    ("centres at whole numbers, intrinsics", "pixel-centre", intrinsics, lambda s, q: (q[0] - 0.5, q[1] - 0.5)),
    # x3dom#612, three.js PR#7272, gl-mesh3d PR#9, megaplot#49, playcanvas/engine#328, TouchFree PR#250
    ("device pixels", "pixel-ratio", look, lambda s, q: [n * RATIOS[s.w // 8 % 4] for n in q]),
    ("CSS pixels", "pixel-ratio", look, lambda s, q: [n / RATIOS[s.w // 8 % 4] for n in q]),
    # bevy_mod_raycast#93
    ("the crop's corner left in", "viewport-offset",
     changed(look, viewport=lambda s: {"crop": {"x": 40, "y": 25, "width": s.w - 80, "height": s.h - 60}}), same),
    ("the viewport's corner left out", "viewport-offset", changed(look, viewport={"x": 64, "y": 48}), same),
    ("intrinsics of a picture 1.75 times as wide", "picture-size",
     changed(intrinsics, projection=lambda s: {"fx": 1.75 * s.focal, "fy": 1.75 * s.focal, "cx": 0.875 * s.w, "cy": 0.875 * s.h}), same),
    ("... whose pixels count from their centres", "picture-size",
     changed(intrinsics, viewport={"pixelCenter": 0},
             projection=lambda s: {"fx": 1.75 * s.focal, "fy": 1.75 * s.focal, "cx": 0.875 * s.w - 0.5, "cy": 0.875 * s.h - 0.5}),
     lambda s, q: (q[0] - 0.5, q[1] - 0.5)),
    # fovY in three.js and GLM, fovX in Unreal and Magnum
    ("fovY that is fovX", "fov-axis",
     changed(look, projection=lambda s: {"fovY": 2 * math.degrees(math.atan(s.w / 2 / s.focal))}), same),
    ("fovX for fovY", "fov-axis", changed(look, projection=lambda s: {"fovY": None, "fovX": s.degrees}), same),
    ("aspect 1, as of two integers divided", "aspect", look, lambda s, q: s.scaled(q, s.w / s.h, 1)),
    ("aspect inverted", "aspect", look, lambda s, q: s.scaled(q, (s.w / s.h) ** 2, 1)),
    ("radians as degrees", "radians", changed(look, projection=lambda s: {"fovY": math.radians(s.degrees)}), same),
    ("degrees as radians", "radians", look,
     lambda s, q: s.scaled(q, *[s.h / 2 / math.tan(s.degrees / 2) / s.focal] * 2), None, True),
    ("a direction as target", "direction-as-target", changed(look, target=lambda s: [t - e for t, e in zip(s.target, s.eye)]), same),
    ("a target as direction", "direction-as-target", changed(look, target=None, direction=lambda s: s.target), same),
    ("points with z up", "up-axis", look, same, lambda p: [p[0], -p[2], p[1]]),
    ("points with y up", "up-axis", look, same, lambda p: [p[0], p[2], -p[1]]),
    ("points with y and z exchanged", "up-axis", look, same, lambda p: [p[0], p[2], p[1]]),
    ("up of another axis", "up-axis", changed(look, up=lambda s: s.upright[:1] + s.upright[:0:-1]), same),
    # nerfplusplus#41, HouseCat6D#9, kalibr#751, RenderMe-360#6
    ("world to camera as camera to world", "pose-inverted",
     changed(rotation, position=None, rotation=None, worldFromCamera=inverse_pose), same),
    ("rotation matrix transposed", "pose-inverted",
     changed(rotation, position=None, rotation=None,
             worldFromCamera=lambda s: {"rotation": [s.right, s.up, [-n for n in s.forward]], "translation": s.eye}), same),
    ("rotation vector negated", "pose-inverted",
     changed(rotation, position=None, rotation=None, worldFromCamera=lambda s: {"rotationVector": [-n for n in s.turn()], "translation": s.eye}), same),
    ("rotation inverted", "pose-inverted", changed(rotation, rotation=lambda s: [-n for n in s.rotation()[:3]] + s.rotation()[3:]), same),
    # Align3R#11, IsaacLab-Arena PR#673, colmap#2934
    ("w first", "quaternion-order", changed(rotation, rotation=lambda s: s.rotation()[3:] + s.rotation()[:3]), same),
    ("w last, read as if it were first", "quaternion-order", changed(rotation, rotation=lambda s: s.rotation()[1:] + s.rotation()[:1]), same),
    ("w first, each number by its name", "quaternion-order",
     changed(rotation, convention="opengl", rotation=lambda s: dict(zip("xyzw", s.rotation()[3:] + s.rotation()[:3]))), same),
    # gaussian-splatting PR#111, nerfstudio#1504, instant-ngp#1486, 4DGaussians#191
    ("OpenCV's axes as OpenGL's", "camera-axes", changed(rotation, cameraAxes="RDF"), same),
    ("a distortion left out", "distortion-ignored", lens, same),
    ("a distortion twice", "distortion-twice", lens, lambda s, q: s.bent(s.bent(q))),
    ("pixels undistorted twice", "distortion-twice", lens, lambda s, q: s.bent(q, back=True), None, True),
    ("0..1 for pixels", "normalized", look, lambda s, q: (q[0] / s.w, q[1] / s.h), None, True),
    ("NDC for pixels", "ndc", look, lambda s, q: (2 * q[0] / s.w - 1, 1 - 2 * q[1] / s.h), None, True),
]
ROWS = [(*row, *(None, False)[len(row) - 4 :]) for row in ROWS]


def report(document, pairs, within, options=()):
    """What check says; nothing where the mistake leaves no camera."""
    table = "x,y,z,u,v\n" + "".join(",".join(map(repr, (*map(float, p), *map(float, q)))) + "\n" for p, q in pairs)
    done = subprocess.run([TOOL, "check", "-c", json.dumps(document), "--within", repr(within), "--to", "json", *options],
                          input=table, capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1) or not options, done.stderr
    return json.loads(done.stdout) if done.returncode < 2 else None


def made(scene, pixel=same, point=None, noise=0.0):
    return [((point or list)(p), tuple(n + scene.random.uniform(-noise, noise) for n in pixel(scene, scene.pixel(p)))) for p in scene.points]


# The lens taken off the pixels, or put back, so many times.
UNDISTORT = {"undistort the pixels once; the lens is in them twice": -1,
             "do not undistort the pixels; they are undistorted twice, or the coefficients are of the inverse model": 2}


def mended(scene, document, pairs, told):
    """Whether they agree once it is done as it says."""
    def value(formula, **names):
        return eval(re.sub(r"([\d.])([xyz])", r"\1*\2", formula), names)

    for words in (told["pairs"] or "").split(", and "):
        if at := re.fullmatch(r"replace (?:x by (\S.*?))?(?: and )?(?:y by (\S.*?))? in the pixels", words):
            pairs = [(p, (value(at[1] or "x", x=q[0], y=q[1]), value(at[2] or "y", x=q[0], y=q[1]))) for p, q in pairs]
        elif at := re.fullmatch(r"replace x,y,z of the points by (\S+)", words):
            pairs = [(list(value(at[1], x=p[0], y=p[1], z=p[2])), q) for p, q in pairs]
        elif words:
            times = UNDISTORT[words]
            for _ in range(abs(times)):
                pairs = [(p, scene.bent(q, back=times < 0)) for p, q in pairs]
    return report(document, pairs, 0.2, shlex.split(told["mend"] or ""))["agrees"]


def explained(row):
    """How often a mistake was found of so many, and how often another as well."""
    name, mistake, form, pixel, point, exact = row
    found = others = 0
    for seed in range(25):
        scene = Scene(seed)
        pairs = made(scene, pixel, point, 0 if exact else 0.05)
        told = report(form(scene), pairs, 0.2)
        if told and not told["agrees"]:
            found += 1
            names = [one["mistake"] for one in told["explanations"]]
            others += names != [mistake]
            assert names[:1] == [mistake], (name, seed, names)
            assert mistake != "y-flipped" or told["explanations"][0]["mend"], (name, seed, told)
            for one in told["explanations"]:
                assert mended(scene, form(scene), pairs, one), (name, seed, one)
    assert found >= 20, (name, found)
    return found, others


def unexplained(seed):
    """Pixels that no single mistake makes: none is a little off as these are."""
    scene = Scene(seed)
    told = report((look, rotation, intrinsics)[seed % 3](scene), made(scene, noise=3), 1)
    assert not told["agrees"] and not told["explanations"], (seed, told)


def both(case):
    """One mistake of the document and one of the pixels: what is said of them mends both."""
    document, pixels, seed = case
    scene = Scene(seed)
    pairs = made(scene, pixels[3])
    told = report(document[2](scene), pairs, 0.01)
    assert not told or not told["agrees"], (document[0], pixels[0], seed)
    if not told or not told["explanations"]:
        return 0, told is not None
    one = told["explanations"][0]
    assert one["rmsMiss"] > 0.1 or mended(scene, document[2](scene), pairs, one), (document[0], pixels[0], seed, one)
    return set(one["mistake"].split(" + ")) == {document[1], pixels[1]}, True


# Of two that are one: aspect 1 of the other axis; and no corner changes 0..1 and NDC.
ONE = [("fov-axis", "aspect"), ("viewport-offset", "normalized"), ("viewport-offset", "ndc")]
pairs_of_rows = [(a, b, seed) for a in ROWS for b in ROWS for seed in range(2)
                 if a[3] is same and not a[4] and b[3] is not same and b[2] is look and a[1] != b[1] and (a[1], b[1]) not in ONE]
with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    found = list(pool.map(explained, ROWS))
    list(pool.map(unexplained, range(60)))
    named, visited = map(sum, zip(*pool.map(both, pairs_of_rows)))
total, others = (sum(numbers) for numbers in zip(*found))
print(f"{total} found, {others} with another as well; {visited} pairs of mistakes, {named} with both named")
assert others * 100 < total and visited > 200 and named * 2 > visited
