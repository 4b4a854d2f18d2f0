"""Where rays meet, and what the Earth hides, judged by others.

  python3 -B triangulated.py VIEWPROJ        exits with 77 where Python has no OpenCV

triangulate: through OpenCV's projectPoints, lens and all, no point near a position misses its pixels less, and misses,
rms and sigma are those of its own derivatives; without noise the position is triangulatePoints'; a pixel that is moved
by 50 is named, and --robust gives what the others give alone; and --sorted writes the same bytes.
project: a point is hidden by the Earth where the way to it goes below the surface, found by looking at many of its
points; and heights above sea level are those of GeographicLib's GeoidEval, where it is installed.
"""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile

try:
    import cv2
    import numpy as np
except ImportError:
    sys.exit(77)

TOOL = sys.argv[1]


def run(*arguments, given="", status=0):
    done = subprocess.run([TOOL, *arguments], input=given.encode(), capture_output=True, check=False)
    assert done.returncode == status, (arguments, done.returncode, done.stderr.decode())
    return done.stdout.decode()


def records(*arguments, given="", status=0):
    return [json.loads(line) for line in run(*arguments, given=given, status=status).splitlines()]


# ---- Where rays meet

K = np.array([[900, 0, 640], [0, 880, 360], [0, 0, 1.0]])


def some_cameras(random, count, lens):
    cameras, poses = [], []
    for i in range(count):
        eye = random.normal(size=3)
        eye *= 6 / np.linalg.norm(eye)
        forward = -eye / np.linalg.norm(eye)
        right = np.cross(forward, [0, 0, 1])
        right /= np.linalg.norm(right)
        rotation = np.array([right, np.cross(forward, right), forward])
        poses.append((rotation, -rotation @ eye))
        cameras.append({"name": f"c{i}", "cameraFromWorld": {"rotation": rotation.tolist(), "translation": (-rotation @ eye).tolist()}})
    shared = {"cameras": cameras, "convention": "opencv", "viewport": {"width": 1280, "height": 720},
              "projection": {"type": "intrinsics", "fx": 900, "fy": 880, "cx": 640, "cy": 360}}
    if lens is not None:
        shared["distortion"] = {"model": "brown", "k": [lens[0], lens[1], 0], "p": list(lens[2:])}
    return json.dumps(shared), poses


def pixels(point, poses, lens):
    return np.array([cv2.projectPoints(np.array([point]), cv2.Rodrigues(r)[0], t, K, lens)[0].reshape(2) for r, t in poses])


def meet(cameras, seen, *options, status=0):
    given = "".join(json.dumps({"point": point, "camera": f"c{i}", "pixel": list(pixel)}) + "\n"
                    for point, all_of_it in enumerate(seen) for i, pixel in all_of_it)
    arguments = ["triangulate", "-c", cameras, "--camera-by", "camera", "--by", "point", *options]
    text = run(*arguments, given=given, status=status)
    assert text == run(*arguments, "--sorted", given=given, status=status)
    return [json.loads(line) for line in text.splitlines()]


def judge_meetings():
    for trial in range(24):
        random = np.random.default_rng(trial)
        lens = [None, np.array([-0.1, 0.02, 1e-3, -5e-4])][trial % 2]
        count, noise = 2 + trial % 5, [0, 0.5][trial // 2 % 2]
        cameras, poses = some_cameras(random, count, lens)
        points = random.uniform(-1, 1, (20, 3))
        seen = [pixels(point, poses, lens) + random.normal(size=(count, 2)) * noise for point in points]
        found = meet(cameras, [list(enumerate(each.tolist())) for each in seen], "--fields", "misses")
        for point, given, got in zip(points, seen, found):
            at = np.array(got["position"])
            miss = given - pixels(at, poses, lens)
            assert np.allclose(miss, [m["miss"] for m in got["misses"]], atol=1e-7)
            assert math.isclose(got["rmsMiss"], math.sqrt((miss ** 2).sum() / count), abs_tol=1e-7)
            assert math.isclose(got["largestMiss"], np.hypot(*miss.T).max(), abs_tol=1e-7)
            step = 1e-5
            slope = np.stack([(pixels(at + step * e, poses, lens) - pixels(at - step * e, poses, lens)).reshape(-1) / (2 * step)
                              for e in np.eye(3)], 1)
            variance = np.linalg.inv(slope.T @ slope)
            assert np.allclose(np.sqrt(np.diag(variance)), got["sigma"], rtol=1e-5)
            away = variance @ slope.T @ miss.reshape(-1)  # to the least squares, in units of sigma
            assert (np.abs(away) / got["sigma"]).max() < 1e-6, (trial, away)
            directions = [r.T @ np.append(cv2.undistortPoints(p.reshape(1, 1, 2), K, lens).reshape(2), 1) for (r, _), p in zip(poses, given)]
            angles = [math.degrees(math.acos(min(1, abs(a @ b) / np.linalg.norm(a) / np.linalg.norm(b))))
                      for i, a in enumerate(directions) for b in directions[:i]]
            assert math.isclose(got["angle"], max(angles), abs_tol=1e-4)
            if noise == 0:
                assert np.allclose(at, point, atol=1e-9)
            if noise == 0 and lens is None and count == 2:
                four = cv2.triangulatePoints(*[K @ np.c_[r, t] for r, t in poses], given[0], given[1]).reshape(4)
                assert np.allclose(four[:3] / four[3], at, atol=1e-9)


def judge_wrong_rays():
    right = alarms = 0
    for trial in range(8):
        random = np.random.default_rng(trial)
        count = 4 + trial % 4
        cameras, poses = some_cameras(random, count, None)
        seen, moved, rest = [], random.integers(count, size=30), []
        for bad in moved:
            all_of_it = pixels(random.uniform(-1, 1, 3), poses, None) + random.normal(size=(count, 2)) * 0.3
            alarms += meet(cameras, [list(enumerate(all_of_it.tolist()))])[0]["wrong"] is not None
            turn = random.uniform(0, 2 * math.pi)
            all_of_it[bad] += 50 * np.array([math.cos(turn), math.sin(turn)])
            seen.append(list(enumerate(all_of_it.tolist())))
            rest.append([one for one in seen[-1] if one[0] != bad])
        robust, without = meet(cameras, seen, "--robust"), meet(cameras, rest)
        for i, (bad, got, alone) in enumerate(zip(moved, robust, without)):
            right += got["wrong"] == i * count + bad + 1
            if got["wrong"] == i * count + bad + 1:
                assert np.allclose(got["position"], alone["position"], atol=1e-9)
                assert got["rays"] == count - 1
    assert right >= 238 and alarms <= 2, (right, alarms)  # of 240


# ---- The Earth

A, B = 6378137.0, 6356752.314245179


def ecef(lat, lon, height):
    la, lo, e2 = math.radians(lat), math.radians(lon), 1 - B * B / A / A
    n = A / math.sqrt(1 - e2 * math.sin(la) ** 2)
    return np.array([(n + height) * math.cos(la) * math.cos(lo), (n + height) * math.cos(la) * math.sin(lo),
                     (n * (1 - e2) + height) * math.sin(la)])


def judge_hidden():
    random = np.random.default_rng(1)
    counts = [0, 0]
    for eye_height in (-26, 0, 2, 100, 9000, 4e5):
        eye = (47, 8, eye_height)
        points = [(47 + d * math.cos(a), 8 + d * math.sin(a), int(h)) for d, a, h in
                  zip(10 ** random.uniform(-3, 1.5, 60), random.uniform(0, 6.28, 60), random.choice([-40, 0, 20, 3000], 60))]
        given = "".join(json.dumps({"lat": p[0], "lon": p[1], "height": p[2]}) + "\n" for p in points)
        camera = ["--position", f"lat=47,lon=8,height={eye_height}", "--heading", "0", "--fov-y", "60", "--viewport", "99x99"]
        for point, got in zip(points, records("project", *camera, given=given)):
            up = min(0, eye_height - 1, point[2] - 1)
            way = np.linspace(0, 1, 20001)[:, None]
            along = (ecef(*eye) * (1 - way) + ecef(*point) * way) / [A + up, A + up, B + up]
            lowest = (along ** 2).sum(1).min() - 1
            if abs(lowest) < 1e-8:
                continue  # too near for these steps
            assert ("earth" in got["outside"]) == (lowest < 0), (eye, point, got)
            assert not (lowest < 0 and got["visible"])
            counts[int(lowest < 0)] += 1
    assert min(counts) > 60, counts


def judge_geoid():
    tool = shutil.which("GeoidEval")
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "small.pgm")
        rows, columns = 61, 120  # every 3 degrees
        grid = np.array([[int(32768 + 12000 * math.sin(3 * i) * math.cos(2 * j * math.pi / columns)) for j in range(columns)] for i in range(rows)])
        grid[0] = grid[0][0]
        grid[-1] = grid[-1][0]
        with open(name, "wb") as file:
            file.write(f"P5\n# Description made for a test\n# Offset -108\n# Scale 0.003\n# Origin 90N 0E\n{columns} {rows}\n65535\n".encode())
            file.write(grid.astype(">u2").tobytes())
        places = [(46.95, 7.45), (-33.1, 151.2), (0, -179.9), (89.5, 10), (-90, 0)]
        camera = ["--position", "lat=46,lon=7,height=900", "--heading", "0", "--fov-y", "60", "--viewport", "99x99"]
        given = "".join(json.dumps({"lat": lat, "lon": lon, "altitude": 500}) + "\n" for lat, lon in places)
        by_file = records("project", *camera, "--geoid", name, "--fields", "screen,range", given=given)
        for (lat, lon), got in zip(places, by_file):
            if tool is None:
                break
            done = subprocess.run([tool, "-n", "small", "-d", folder, "--input-string", f"{lat} {lon}"], capture_output=True, check=True)
            level = float(done.stdout)
            assert abs(level) > 0.5
            typed = records("project", *camera, "--point", f"lat={lat},lon={lon},height={500 + level}", "--fields", "screen,range")[0]
            assert abs(typed["range"] - got["range"]) < 1e-4, (typed, got)  # it prints to 0.1 mm


judge_meetings()
judge_wrong_rays()
judge_hidden()
judge_geoid()
print("where rays meet and what the Earth hides agree")
