"""Files that `viewproj convert` writes put points where it puts them itself, as their own programs read them.

    python3 converted.py VIEWPROJ opencv|ros|colmap|three|open3d|formulas

Where no owner of a format can be installed, its formula is here, and takes the file alone. 77: the judge is not there.
"""
import csv
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

TOOL, JUDGE = os.path.abspath(sys.argv[1]), sys.argv[2]
HERE = Path(__file__).resolve().parent
PIXELS = 1e-9  # the most by which a pixel may differ
counts = {}


def run(*arguments):
    return subprocess.run([TOOL, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True, text=True).stdout


# ---- Cameras of ours

def lens_of(model):
    u = random.uniform
    return {"none": None,
            "brown": {"model": "brown", "k": [u(-0.2, 0.2), u(-0.1, 0.1)], "p": [u(-0.002, 0.002), u(-0.002, 0.002)]},
            "brown5": {"model": "brown", "k": [u(-0.2, 0.2), u(-0.1, 0.1), u(-0.05, 0.05)], "p": [u(-0.002, 0.002), u(-0.002, 0.002)]},
            "rational": {"model": "brown", "k": [u(-0.2, 0.2), u(-0.1, 0.1), u(-0.05, 0.05), u(-0.1, 0.1), u(-0.05, 0.05), u(-0.01, 0.01)],
                         "p": [u(-0.002, 0.002), u(-0.002, 0.002)]},
            "fisheye": {"model": "fisheye", "k": [u(-0.05, 0.05), u(-0.02, 0.02), u(-0.01, 0.01), u(-0.001, 0.001)]},
            "omni": {"model": "omni", "xi": u(0.2, 2), "k": [u(-0.2, 0.2), u(-0.1, 0.1)], "p": [u(-0.002, 0.002), u(-0.002, 0.002)]},
            "unified": {"model": "unified", "alpha": u(0.2, 0.7), "beta": u(0.8, 1.2)},
            "double-sphere": {"model": "double-sphere", "xi": u(-0.3, 0.3), "alpha": u(0.3, 0.7)},
            "fov": {"model": "fov", "omega": u(0.3, 1.4)}}[model]


def camera_of(lens="none", centred=False, posed=True, far=False, square=False, size=None):
    """Looks at the origin from about 10 away."""
    w, h = size or (random.randint(300, 4000), random.randint(200, 3000))
    f = random.uniform(0.8, 1.6) * w
    camera = {"convention": "opengl", "viewport": {"width": w, "height": h},
              "projection": {"type": "intrinsics", "fx": f, "fy": f if square else f * random.uniform(0.9, 1.1), "near": 0.1,
                             "cx": w / 2 if centred else w * random.uniform(0.4, 0.6), "cy": h / 2 if centred else h * random.uniform(0.4, 0.6)}}
    if far:
        camera["projection"]["far"] = 50
    if posed:
        eye = np.array([random.gauss(0, 1) for _ in range(3)])
        camera.update(position=list(eye / np.linalg.norm(eye) * random.uniform(8, 12)), target=[0, 0, 0], up=[random.gauss(0, 1) for _ in range(3)])
    else:
        camera.update(position=[0, 0, 0], rotation=[0, 0, 0, 1], cameraAxes="RDF")
    if lens_of(lens):
        camera["distortion"] = lens_of(lens)
    return camera


def points_for(camera, number=8):
    """World points about the origin, or before a camera that stands there."""
    if "target" in camera:
        return [[random.uniform(-1.5, 1.5) for _ in range(3)] for _ in range(number)]
    return [[random.uniform(-0.3, 0.3) * z, random.uniform(-0.3, 0.3) * z, z] for z in (random.uniform(1, 20) for _ in range(number))]


class Case:
    """Cameras of a set, a folder, and where our own project puts points, from the picture's corner."""

    def __init__(self, folder, cameras):
        self.folder, self.cameras = Path(folder), cameras
        self.set = self.folder / "cameras.json"
        self.set.write_text(json.dumps({"cameras": cameras} if len(cameras) > 1 else cameras[0]))
        self.points = points_for(cameras[0])
        (self.folder / "points.json").write_text(json.dumps(self.points))
        self.pixels = []
        for i in range(len(cameras)):
            pick = f"#{i}" if len(cameras) > 1 else ""
            records = json.loads(run("project", "-c", f"{self.set}{pick}", self.folder / "points.json"))
            self.pixels.append([record["screen"] for record in records])

    def convert(self, form, name):
        out = self.folder / name
        run("convert", self.set, "--to", form, "-o", out)
        return out

    def compare(self, kind, said, shift=0.0):
        """said: pixels of each camera; shift: of its pixel centres from ours at halves."""
        assert len(said) == len(self.pixels), (kind, len(said))
        for ours, theirs in zip(self.pixels, said):
            for mine, other in zip(ours, theirs):
                assert mine is not None, kind
                miss = max(abs(a - (b + shift)) for a, b in zip(mine, other))
                assert miss <= PIXELS, (kind, mine, other, miss)
                counts[kind] = counts.get(kind, 0) + 1


# ---- Formulas

def seen(R, t, points):
    return (np.array(R).reshape(3, 3) @ np.array(points).T).T + np.array(t).reshape(3)


def from_rows(m):
    """R and t of cameraFromWorld, of rows of worldFromCamera."""
    m = np.array(m, float)
    back = np.linalg.inv(m[:3, :3])
    return back, -back @ m[:3, 3]


FLIP = np.diag([1.0, -1, -1])


def pinhole(P, fx, fy, cx, cy, bend=None):
    xy = np.array([bend(p) if bend else p[:2] / p[2] for p in P])
    return (xy * [fx, fy] + [cx, cy]).tolist()


def brown(k1=0, k2=0, p1=0, p2=0, k3=0, k4=0, k5=0, k6=0):
    def bend(p, q=None):
        x, y = p[:2] / p[2] if q is None else q
        u = x * x + y * y
        g = (1 + u * (k1 + u * (k2 + u * k3))) / (1 + u * (k4 + u * (k5 + u * k6)))
        return x * g + 2 * p1 * x * y + p2 * (u + 2 * x * x), y * g + p1 * (u + 2 * y * y) + 2 * p2 * x * y
    return bend


def fisheye(k1, k2, k3, k4):
    def bend(p):
        r = math.hypot(p[0], p[1])
        t = math.atan2(r, p[2])
        return p[:2] / r * t * (1 + k1 * t**2 + k2 * t**4 + k3 * t**6 + k4 * t**8)
    return bend


def omni(xi, *rest):
    return lambda p: brown(*rest)(p, p[:2] / (p[2] + xi * np.linalg.norm(p)))


def double_sphere(xi, alpha):
    def bend(p):
        d = np.linalg.norm(p)
        k = xi * d + p[2]
        return p[:2] / (alpha * math.sqrt(p[0]**2 + p[1]**2 + k * k) + (1 - alpha) * k)
    return bend


def unified(alpha, beta):
    return lambda p: p[:2] / (alpha * math.sqrt(beta * (p[0]**2 + p[1]**2) + p[2]**2) + (1 - alpha) * p[2])


def fov(omega):
    def bend(p):
        r = math.hypot(p[0], p[1]) / p[2]
        return p[:2] / p[2] / r * math.atan(2 * r * math.tan(omega / 2)) / omega
    return bend


def quaternion(x, y, z, w):
    n = 2 / (x * x + y * y + z * z + w * w)
    return np.array([[1 - n * (y * y + z * z), n * (x * y - z * w), n * (x * z + y * w)],
                     [n * (x * y + z * w), 1 - n * (x * x + z * z), n * (y * z - x * w)],
                     [n * (x * z - y * w), n * (y * z + x * w), 1 - n * (x * x + y * y)]])


# ---- Judges

def cases(number, make):
    for seed in range(number):
        random.seed(f"{JUDGE} {seed}")
        with tempfile.TemporaryDirectory() as folder:
            make(seed, folder)


def opencv():
    import cv2

    def make(seed, folder):
        lens = ("none", "brown", "brown5", "rational", "fisheye", "omni")[seed % 6]
        case = Case(folder, [camera_of(lens, posed=seed % 5 != 0)])
        for ending in ("yml", "json", "xml"):
            storage = cv2.FileStorage(str(case.convert("opencv", "camera." + ending)), cv2.FILE_STORAGE_READ)
            read = lambda name: storage.getNode(name).mat()
            K, D, R, T = (read(name) for name in ("camera_matrix", "distortion_coefficients", "R", "T"))
            assert storage.getNode("image_width").real() == case.cameras[0]["viewport"]["width"]
            rvec = np.zeros(3) if R is None else cv2.Rodrigues(R)[0].reshape(3)
            tvec = np.zeros(3) if T is None else T.reshape(3)
            points = np.array(case.points).reshape(-1, 1, 3)
            if storage.getNode("fisheye_model").real() == 1:
                pixels = cv2.fisheye.projectPoints(points, rvec, tvec, K, D)[0]
            elif not storage.getNode("xi").empty():
                pixels = cv2.omnidir.projectPoints(points, rvec, tvec, K, storage.getNode("xi").real(), D)[0]
            else:
                pixels = cv2.projectPoints(points, rvec, tvec, K, D)[0]
            case.compare(f"{ending} {lens}", [pixels.reshape(-1, 2).tolist()], 0.5)
    cases(30, make)
    return 18, 40


def ros():
    import cv2
    from camera_calibration_parsers import readCalibration

    def make(seed, folder):
        lens = ("none", "brown", "brown5", "rational", "fisheye")[seed % 5]
        case = Case(folder, [camera_of(lens, posed=False)])
        name, info = readCalibration(str(case.convert("ros", "camera.yaml")))
        assert name == "camera" and (info.width, info.height) == tuple(case.cameras[0]["viewport"].values()), name
        model = info.distortion_model
        assert model == {"rational": "rational_polynomial", "fisheye": "equidistant"}.get(lens, "plumb_bob"), model
        assert list(info.P) == [*info.K[:3], 0, *info.K[3:6], 0, *info.K[6:], 0] and list(info.R) == [1, 0, 0, 0, 1, 0, 0, 0, 1]
        case.compare(lens, [seen(info, case.points)], 0.5)

    def seen(info, points, R=np.eye(3), eye=np.zeros(3)):
        project = cv2.fisheye.projectPoints if info.distortion_model == "equidistant" else cv2.projectPoints
        pixels = project(np.array(points).reshape(-1, 1, 3), cv2.Rodrigues(R.T)[0], -R.T @ eye, np.array(info.K).reshape(3, 3), np.array(info.D))[0]
        return pixels.reshape(-1, 2).tolist()

    def pair(seed, folder):
        """Two cameras before rectification: R turns to the pictures of P, whose Tx is -fx times the baseline."""
        cameras = [camera_of(("none", "brown5", "fisheye")[seed % 3], posed=False, size=(640, 480)) for _ in range(2)]
        for i, camera in enumerate(cameras):
            camera.update(name=("left", "right")[i], position=[0.3 * i, 0, 0], rotation=[random.uniform(-0.1, 0.1) for _ in range(3)] + [1])
        case, said = Case(folder, cameras), []
        out = case.convert("ros", "rig/")
        for name in "left", "right":
            read, info = readCalibration(str(out / f"{name}.yaml"))
            P, R = np.array(info.P).reshape(3, 4), np.array(info.R).reshape(3, 3)
            assert read == name and (P[:, :3] == np.array(readCalibration(str(out / "left.yaml"))[1].K).reshape(3, 3)).all()
            said.append(seen(info, case.points, R, np.array([-P[0, 3] / P[0, 0], 0, 0])))
        case.compare("pair", said, 0.5)
    cases(15, make)
    cases(6, pair)
    return 6, 20


def colmap():
    if not shutil.which("colmap"):
        raise ImportError("colmap")

    def make(seed, folder):
        """Its bundle adjustment, which may not move anything, tells how far our pixels are from its own."""
        lens = ("none", "brown", "brown5", "rational", "fisheye", "fov")[seed % 6]
        case = Case(folder, [{**camera_of(lens), "name": f"{i}.jpg"} for i in range(3)])
        model = case.convert("colmap", "model/")
        # Its model converter reads the model as it is.
        (case.folder / "text").mkdir()
        environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
        colmap = lambda *a: subprocess.run(["colmap", *map(str, a)], env=environment, stdout=subprocess.PIPE, check=True, text=True).stdout
        colmap("model_converter", "--input_path", model, "--output_path", case.folder / "text", "--output_type", "TXT")
        poses = lambda path: sorted([float(n) for n in line.split()[:8]] for line in path.read_text().splitlines() if line.endswith(".jpg"))
        assert np.allclose(poses(model / "images.txt"), poses(case.folder / "text/images.txt"), rtol=0, atol=1e-14)
        lines = (model / "images.txt").read_text().splitlines()
        for i, pixels in enumerate(case.pixels):
            at = next(n for n, line in enumerate(lines) if line.endswith(f" {i}.jpg"))
            assert lines[at + 1] == ""
            lines[at + 1] = " ".join(f"{x!r} {y!r} {n + 1}" for n, (x, y) in enumerate(pixels))
        (model / "images.txt").write_text("\n".join(lines) + "\n")
        (model / "points3D.txt").write_text("".join(
            f"{n + 1} {x!r} {y!r} {z!r} 0 0 0 0 " + " ".join(f"{i + 1} {n}" for i in range(3)) + "\n" for n, (x, y, z) in enumerate(case.points)))
        (case.folder / "out").mkdir()
        text = colmap("bundle_adjuster", "--input_path", model, "--output_path", case.folder / "out", "--BundleAdjustment.max_num_iterations", 0)
        cost = float(re.search(r"Initial cost : (\S+) \[px\]", text)[1])
        assert cost < PIXELS, (lens, cost)
        counts[lens] = counts.get(lens, 0) + 3 * len(case.points)
    cases(12, make)
    return 6, 48


def three():
    if not shutil.which("node") or not (HERE.parent / "node_modules/three").is_dir():
        raise ImportError("three")

    def make(seed, folder):
        orthographic = seed % 3 == 0
        cameras = [camera_of(centred=True, far=seed % 2 == 0, square=True, size=(640, 360)) for _ in range(1 + seed % 3)]
        for i, camera in enumerate(cameras):
            camera["name"] = f"camera {i}"
            if orthographic:
                camera["projection"] = {"type": "orthographic", "height": random.uniform(3, 6), "near": 0.1, "far": 50}
        case = Case(folder, cameras)
        node = lambda file: json.loads(subprocess.run(["node", HERE / "converted.mjs", file, case.folder / "points.json", "640", "360"],
                                                      stdout=subprocess.PIPE, check=True, text=True).stdout)
        kind = "orthographic" if orthographic else "perspective"
        case.compare("glTF " + kind, node(case.convert("gltf", "scene.gltf")))
        for camera in cameras:
            camera["projection"]["far"] = 50
            if not orthographic:
                camera["projection"].update(cx=640 * random.uniform(0.4, 0.6), cy=360 * random.uniform(0.4, 0.6), fy=random.uniform(500, 900))
            elif seed % 2 == 0:
                camera["projection"]["shift"] = [0.1, -0.2]
        case = Case(folder, cameras)
        case.compare("three.js " + kind, node(case.convert("threejs", "scene.json")))
    cases(9, make)
    return 4, 24


def open3d():
    import open3d as o3d

    def make(seed, folder):
        case = Case(folder, [camera_of() for _ in range(1 + seed % 3)])
        file, said = str(case.convert("open3d", "cameras.json")), []
        one = len(case.cameras) == 1
        for camera in [o3d.io.read_pinhole_camera_parameters(file)] if one else o3d.io.read_pinhole_camera_trajectory(file).parameters:
            K, m = np.array(camera.intrinsic.intrinsic_matrix), np.array(camera.extrinsic)
            said.append(pinhole(seen(m[:3, :3], m[:3, 3], case.points), K[0, 0], K[1, 1], K[0, 2], K[1, 2]))
        case.compare("one" if one else "trajectory", said, 0.5)
    cases(6, make)
    return 2, 8


def formulas():
    import yaml

    def transforms(case):
        file, said = json.loads(case.convert("transforms", "transforms.json").read_text()), []
        for frame in file["frames"]:
            at = {**file, **frame}
            R, t = from_rows(np.array(at["transform_matrix"]) @ np.diag([1, -1, -1, 1]))
            bend = {"PINHOLE": None, "OPENCV": lambda: brown(*(at[n] for n in ("k1", "k2", "p1", "p2", "k3"))),
                    "OPENCV_FISHEYE": lambda: fisheye(*(at[n] for n in ("k1", "k2", "k3", "k4")))}[at["camera_model"]]
            said.append(pinhole(seen(R, t, case.points), at["fl_x"], at["fl_y"], at["cx"], at["cy"], bend and bend()))
            assert [at["w"], at["h"]] == list(case.cameras[len(said) - 1]["viewport"].values())
            assert not ("fl_x" in file and "fl_x" in frame)
        case.compare("transforms", said)

    def splats(case):
        said = []
        for entry in json.loads(case.convert("3dgs", "cameras.json").read_text()):
            R = np.array(entry["rotation"]).T
            said.append(pinhole(seen(R, -R @ entry["position"], case.points), entry["fx"], entry["fy"], entry["width"] / 2, entry["height"] / 2))
        case.compare("3dgs", said)

    def kalibr(case):
        file, said, chain = yaml.safe_load(case.convert("kalibr", "chain.yaml").read_text()), [], np.eye(4)
        for i in range(len(case.cameras)):
            camera = file[f"cam{i}"]
            assert all(type(n) is float for n in camera["intrinsics"] + camera["distortion_coeffs"]) and all(type(n) is int for n in camera["resolution"])
            if i > 0:
                chain = np.array(camera["T_cn_cnm1"]) @ chain
            onImu = np.array(camera["T_cam_imu"])
            first = np.array(file["cam0"]["T_cam_imu"])
            assert np.allclose(chain @ first, onImu, atol=1e-13)
            own, c = camera["intrinsics"][:-4], camera["distortion_coeffs"]
            bend = {"omni": lambda: omni(*own, *c), "ds": lambda: double_sphere(*own), "eucm": lambda: unified(*own),
                    "pinhole": lambda: {"none": lambda: None, "radtan": brown, "equidistant": fisheye, "fov": fov}[camera["distortion_model"]](*c)}
            said.append(pinhole(seen(onImu[:3, :3], onImu[:3, 3], case.points), *camera["intrinsics"][-4:], bend[camera["camera_model"]]()))
        case.compare("kalibr", said, 0.5)

    def kitti(case):
        said = []
        for i, line in enumerate(case.convert("kitti", "calib.txt").read_text().splitlines()):
            name, *numbers = line.split()
            assert name == f"P{i}:"
            h = np.hstack([case.points, np.ones((len(case.points), 1))]) @ np.array(numbers, float).reshape(3, 4).T
            said.append((h[:, :2] / h[:, 2:]).tolist())
        case.compare("kitti", said, 0.5)

    def kitti_poses(case):
        said = []
        for line, camera in zip(case.convert("kitti-poses", "00.txt").read_text().splitlines(), case.cameras):
            m, k = np.array(line.split(), float).reshape(3, 4), camera["projection"]
            said.append(pinhole(seen(*from_rows(m), case.points), k["fx"], k["fy"], k["cx"], k["cy"]))
        case.compare("kitti-poses", said)

    def tum(case):
        lines = [line.split() for line in case.convert("tum", "poses.txt").read_text().splitlines() if not line.startswith("#")]
        said = []
        for i, (line, camera) in enumerate(zip(lines, case.cameras)):
            time, *t, x, y, z, w = map(float, line)
            assert time == i
            R, k = quaternion(x, y, z, w).T, camera["projection"]
            said.append(pinhole(seen(R, -R @ t, case.points), k["fx"], k["fy"], k["cx"], k["cy"]))
        case.compare("tum", said)

    def table(case):
        with open(case.convert("csv", "cameras.csv"), newline="") as file:
            rows = [{name: cell if name in ("name", "distortion.model", "cameraAxes") else float(cell or 0) for name, cell in row.items()} for row in csv.DictReader(file)]
        said = []
        for row in rows:
            R = FLIP @ quaternion(*(row[n] for n in ("qx", "qy", "qz", "qw"))).T
            number = lambda *names: [row.get(n, 0) for n in names]
            bend = {"": lambda: None, "brown": lambda: brown(*number("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6")),
                    "fisheye": lambda: fisheye(*number("k1", "k2", "k3", "k4")), "omni": lambda: omni(*number("distortion.xi", "k1", "k2", "p1", "p2")),
                    "double-sphere": lambda: double_sphere(*number("distortion.xi", "distortion.alpha")),
                    "unified": lambda: unified(*number("distortion.alpha", "distortion.beta")), "fov": lambda: fov(*number("distortion.omega"))}
            said.append(pinhole(seen(R, -R @ number("x", "y", "z"), case.points), *number("fx", "fy", "cx", "cy"), bend[row.get("distortion.model", "")]()))
        case.compare("csv", said)

    def matrices(case):
        """K, [R | t], P and the window's edges, as Python."""
        k, v = case.cameras[0]["projection"], case.cameras[0]["viewport"]
        names = {}
        exec(run("matrix", case.set, "--which", "intrinsics,extrinsics,P,tangents", "--to", "numpy"), names)
        K, m = names["intrinsics"], names["extrinsics"]
        h = np.hstack([case.points, np.ones((len(case.points), 1))]) @ names["P"].T
        case.compare("matrices", [pinhole(seen(m[:, :3], m[:, 3], case.points), K[0, 0], K[1, 1], K[0, 2], K[1, 2])])
        case.compare("matrices", [(h[:, :2] / h[:, 2:]).tolist()])
        edges = [-k["cx"] / k["fx"], (v["width"] - k["cx"]) / k["fx"], k["cy"] / k["fy"], (k["cy"] - v["height"]) / k["fy"]]
        assert np.allclose(names["tangents"], edges, rtol=1e-14) and np.allclose(names["angles"], np.arctan(edges), rtol=1e-14)

    def make(seed, folder):
        u = random.randint(1, 3)
        pick = lambda *lenses: [camera_of(random.choice(lenses)) for _ in range(u)]
        transforms(Case(folder, pick("none", "brown5") if seed % 2 else pick("fisheye", "none", "brown")))
        shared = camera_of("brown5")
        transforms(Case(folder, [{**camera_of(), **{name: shared[name] for name in ("projection", "viewport", "distortion")}} for _ in range(2)]))
        splats(Case(folder, [camera_of(centred=True) for _ in range(u)]))
        kalibr(Case(folder, pick("none", "brown", "fisheye", "omni", "double-sphere", "unified", "fov")))
        kitti(Case(folder, pick("none")))
        tum(Case(folder, pick("none")))
        kitti_poses(Case(folder, pick("none")))
        matrices(Case(folder, [camera_of()]))
        table(Case(folder, pick("none", "brown", "rational", "fisheye", "omni", "double-sphere", "unified", "fov")))
    cases(10, make)
    return 8, 100


try:
    kinds, least = {"opencv": opencv, "ros": ros, "colmap": colmap, "three": three, "open3d": open3d, "formulas": formulas}[JUDGE]()
except ImportError as missing:
    sys.exit(print(f"{missing.name or missing} is not installed; sh samples/setup.sh tests installs it") or 77)
print(counts)
assert len(counts) == kinds and all(count >= least for count in counts.values()), counts
