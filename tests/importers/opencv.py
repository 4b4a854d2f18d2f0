# Calibrations and transforms.json, and where OpenCV's projectPoints puts points: one case a line, as JSON.
#   python3 opencv.py
import json
import math
import os
import random
import tempfile

import cv2
import numpy as np


def points_around(R, t, K, size, near, far):
    """World points in the picture and beside it, before near, beyond far and behind the camera."""
    points = []
    for i in range(9):
        z = (10 ** random.uniform(-0.5, 2), 0.9 * near, 1.1 * far, -1.0, 1.0)[i % 5]
        pixel = np.array([random.uniform(-0.2, 1.2) * size[0], random.uniform(-0.2, 1.2) * size[1], 1])
        points.append(np.linalg.inv(R) @ (np.linalg.inv(K) @ pixel * z - t))
    return np.array(points)


def write(name, file, R, t, K, size, pick=None, viewport=None, shift=0.0, options=(), near=None, far=None):
    """shift: from OpenCV's pixel positions, whose whole numbers are pixel centres, to the file's."""
    points = points_around(R, t, K, size, near or 0.5, far or 1000)
    pixels = cv2.projectPoints(points.reshape(-1, 1, 3), R, t, K, None)[0].reshape(-1, 2)
    judgements = []
    for point, pixel in zip(points, pixels):
        z = float((R @ point + t)[2])
        beyond = {"left": pixel[0] < -0.5, "right": pixel[0] > size[0] - 0.5, "bottom": pixel[1] > size[1] - 0.5,
                  "top": pixel[1] < -0.5, "near": near and z < near, "far": far and z > far}
        outside = ["behind"] if z <= 0 else [side for side, is_beyond in beyond.items() if is_beyond]
        judgements.append({"screen": None if z <= 0 else (pixel + shift).tolist(), "viewDistance": z,
                           "visible": not outside, "outside": outside})
    print(json.dumps({"name": name, "pick": pick, "viewport": viewport, "options": list(options), "file": file,
                      "points": points.tolist(), "judgements": judgements}, separators=(",", ":")))


def random_vector(size):
    return np.array([random.uniform(-size, size) for _ in range(3)])


def rotation_vector(angle):
    axis = random_vector(1)
    return axis / np.linalg.norm(axis) * angle


def calibration():
    size = (random.randint(640, 4000), random.randint(480, 3000))
    f = random.uniform(0.6, 2) * size[0]
    K = np.array([[f, 0, size[0] * random.uniform(0.45, 0.55)],
                  [0, f * random.uniform(0.98, 1.02), size[1] * random.uniform(0.45, 0.55)], [0, 0, 1]])
    return size, K


def stored(matrices, form="json"):
    """Matrices as cv2.FileStorage writes them to JSON, or the text that it writes to YAML."""
    path = tempfile.mktemp(suffix="." + form)
    format_ = cv2.FILE_STORAGE_FORMAT_JSON if form == "json" else cv2.FILE_STORAGE_FORMAT_YAML
    storage = cv2.FileStorage(path, cv2.FILE_STORAGE_WRITE | format_)
    for key, value in matrices.items():
        storage.write(key, value)
    storage.release()
    with open(path) as text:
        result = json.load(text) if form == "json" else text.read()
    os.remove(path)
    return result


def opencv_cases():
    size, K = calibration()
    rvec, t = rotation_vector(random.uniform(0.1, 3)), random_vector(5)
    R = cv2.Rodrigues(rvec)[0]
    write("OpenCV K, R, t", {"K": K.tolist(), "R": R.tolist(), "t": t.tolist(), "width": size[0], "height": size[1],
                             "dist": [0, 0, 0, 0, 0], "near": 0.25, "far": 80}, R, t, K, size, near=0.25, far=80)
    write("OpenCV K, R, t flat, viewport given", {"K": K.ravel().tolist(), "R": R.ravel().tolist(),
                                                  "t": t.reshape(3, 1).tolist()}, R, t, K, size,
          viewport=f"{size[0]}x{size[1]}")
    for angle in (1e-9, random.uniform(0.1, 3), math.pi, random.uniform(3.2, 6.2), random.uniform(7, 30)):
        rvec = rotation_vector(angle)
        R = cv2.Rodrigues(rvec)[0]
        name = "OpenCV rvec " + ("tiny" if angle < 1e-6 else "beyond pi" if angle > 3.15 else
                                 "of pi" if angle == math.pi else "ordinary")
        write(name, {"camera_matrix": K.tolist(), "distortion_coefficients": [[0.0] * 5],
                     "rvec": rvec.reshape(3, 1).tolist(), "tvec": t.reshape(3, 1).tolist(),
                     "image_width": size[0], "image_height": size[1]}, R, t, K, size)
    file = stored({"image_width": size[0], "image_height": size[1], "camera_matrix": K,
                   "distortion_coefficients": np.zeros((5, 1)), "rvec": rvec.reshape(3, 1), "tvec": t.reshape(3, 1)})
    write("OpenCV FileStorage", file, R, t, K, size)
    write("OpenCV without a pose", {"mtx": K.tolist(), "dist_coeff": [[0.0] * 5], "image_size": size}, np.eye(3), np.zeros(3), K, size)
    R = cv2.Rodrigues(rvec)[0] + np.array([random_vector(1e-4) for _ in range(3)])
    write("OpenCV R nearly a rotation", {"cameraMatrix": K.tolist(), "distCoeffs": [0] * 5, "R": R.tolist(), "T": t.tolist(),
                                         "width": size[0], "height": size[1]}, R, t, K, size)


def opencv_yaml():
    size, K = calibration()
    rvec, t = rotation_vector(random.uniform(0.1, 3)), random_vector(5)
    R = cv2.Rodrigues(rvec)[0]
    own = {"calibration_time": "Tue 01 Jan 2019 12:34:56", "image_width": size[0], "image_height": size[1],
           "distortion_coefficients": np.zeros((5, 1)), "avg_reprojection_error": 0.25}
    write("OpenCV FileStorage YAML", stored({**own, "camera_matrix": K, "rvec": rvec.reshape(3, 1), "tvec": t.reshape(3, 1)}, "yml"),
          R, t, K, size)


def nerf_frame(worldFromCamera, path, **more):
    return {"file_path": path, "sharpness": 100.0, "transform_matrix": worldFromCamera.tolist(), **more}


def nerf_pose(noise):
    m = np.eye(4)
    m[:3, :3] = cv2.Rodrigues(rotation_vector(random.uniform(0.1, 3)))[0] + np.array(
        [random_vector(noise) for _ in range(3)])
    m[:3, 3] = random_vector(5)
    return m


def opencv_pose(worldFromCamera):
    """OpenCV's R and t: its y points down, its z forward."""
    m = np.diag([1.0, -1, -1, 1]) @ np.linalg.inv(worldFromCamera)
    return m[:3, :3], m[:3, 3]


def nerf_cases():
    size, K = calibration()
    centred = K.copy()
    centred[:2, 2] -= 0.5
    both = {"camera_angle_x": 2 * math.atan(size[0] / 2 / K[0, 0]), "fl_x": K[0, 0], "fl_y": K[1, 1], "cx": K[0, 2],
            "cy": K[1, 2], "w": float(size[0]), "h": float(size[1]), "aabb_scale": 16}
    for name, noise, lens, options in (
            ("transforms.json", 0, {"k1": 0, "k2": 0.0, "p1": 0, "p2": 0}, []),
            ("transforms.json nearly a rotation", 1e-4, {}, []),
            ("transforms.json with distortion to ignore", 0, {"k1": 0.05, "k2": -0.08}, ["--ignore-distortion"])):
        poses = [nerf_pose(noise) for _ in range(3)]
        frames = [nerf_frame(m, f"./images/{i:04}.jpg") for i, m in enumerate(poses)]
        which = random.randint(0, 2)
        R, t = opencv_pose(poses[which])
        write(name, {**both, **lens, "frames": frames}, R, t, centred, size,
              pick=random.choice([str(which), f"./images/{which:04}.jpg", f"images/{which:04}.jpg"]), shift=0.5,
              options=options)
    pose = nerf_pose(0)
    R, t = opencv_pose(pose)
    own = {"fl_x": K[0, 0], "fl_y": K[1, 1], "cx": K[0, 2], "cy": K[1, 2], "w": size[0], "h": size[1]}
    write("transforms.json per-frame intrinsics",
          {"frames": [nerf_frame(nerf_pose(0), "a.png"), nerf_frame(pose, "b.png", **own)]},
          R, t, centred, size, pick="b.png", shift=0.5)
    angle = random.uniform(0.4, 1.5)
    f = size[0] / 2 / math.tan(angle / 2)
    blender = np.array([[f, 0, size[0] / 2 - 0.5], [0, f, size[1] / 2 - 0.5], [0, 0, 1]])
    write("transforms.json of Blender", {"camera_angle_x": angle, "frames": [
        {"file_path": "./train/r_0", "rotation": 0.012566370614359171, "transform_matrix": pose.tolist()}]},
          R, t, blender, size, viewport=f"{size[0]}x{size[1]}", shift=0.5)


def nerf_names():
    """The rest of the fields, for all frames or one's own."""
    size, K = calibration()
    centred = K.copy()
    centred[:2, 2] -= 0.5
    pose = nerf_pose(0)
    R, t = opencv_pose(pose)
    near, far = random.uniform(0.1, 1), random.uniform(50, 500)
    lens = {"fl_x": K[0, 0], "fl_y": K[1, 1], "cx": K[0, 2], "cy": K[1, 2], "w": size[0], "h": size[1]}
    for own in (False, True):
        fisheye = {"camera_model": "OPENCV_FISHEYE", "is_fisheye": True, "k3": 0.1, "k4": 0.2}
        file = {**({} if own else fisheye), **lens, "near": near, "far": far,
                "frames": [nerf_frame(pose, "a.png", **(fisheye if own else {}))]}
        write("transforms.json of a fisheye", file, R, t, centred, size, shift=0.5, options=["--ignore-distortion"],
              near=near, far=far)
    angles = {"camera_angle_x": 2 * math.atan(size[0] / 2 / K[0, 0]), "camera_angle_y": 2 * math.atan(size[1] / 2 / K[1, 1])}
    middle = np.array([[K[0, 0], 0, size[0] / 2 - 0.5], [0, K[1, 1], size[1] / 2 - 0.5], [0, 0, 1]])
    for own in (False, True):
        file = {**({} if own else angles), "w": size[0], "h": size[1], "camera_model": "SIMPLE_PINHOLE",
                "frames": [nerf_frame(pose, "a.png", **(angles if own else {}))]}
        write("transforms.json by angles", file, R, t, middle, size, shift=0.5)
    for model in ("PINHOLE", "OPENCV", "FULL_OPENCV", "SIMPLE_RADIAL", "RADIAL", "PERSPECTIVE"):
        write("transforms.json of three rows",
              {**lens, "camera_model": model, "is_fisheye": False, "frames": [nerf_frame(pose[:3], "a.png")]},
              R, t, centred, size, shift=0.5)
    for model in ("RADIAL_FISHEYE", "SIMPLE_RADIAL_FISHEYE", "FISHEYE"):
        write("transforms.json of a fisheye", {**lens, "camera_model": model, "frames": [nerf_frame(pose, "a.png")]},
              R, t, centred, size, shift=0.5, options=["--ignore-distortion"])


def limit_of(k, p):
    """The first radius where the distortion is certainly not one-to-one, or has a pole; by small steps."""
    r = np.linspace(0, 30, 300001)
    u = r * r
    n, d = 1 + u * (k[0] + u * (k[1] + u * k[2])), 1 + u * (k[3] + u * (k[4] + u * k[5]))
    dn, dd = k[0] + u * (2 * k[1] + u * 3 * k[2]), k[3] + u * (2 * k[4] + u * 3 * k[5])
    with np.errstate(all="ignore"):
        q = n / d + 2 * u * (dn * d - n * dd) / (d * d)
        end = (d <= 0) | (q - 6 * np.hypot(*p) * r <= 0)
    return r[np.argmax(end)] if end.any() else math.inf


def fisheye_limit_of(k):
    """The angle to the axis at which the radius turns back; it may be beyond 90 degrees."""
    t = np.linspace(0, math.pi, 200001)
    w = t * t
    end = 1 + w * (3 * k[0] + w * (5 * k[1] + w * (7 * k[2] + w * 9 * k[3]))) <= 0
    return t[np.argmax(end)] if end.any() else math.inf


def fisheye_behind(point, K, k):
    """The pixel of a point behind the eye plane, which cv2.fisheye mirrors to the front."""
    off = np.hypot(point[0], point[1])
    t = math.atan2(off, point[2])
    radius = t * (1 + t * t * (k[0] + t * t * (k[1] + t * t * (k[2] + t * t * k[3]))))
    return (K @ np.array([*(point[:2] / off * radius), 1]))[:2]


def lens_cases(number):
    """Random lenses. A point beyond the limit, which projectPoints folds back, at times into the picture, has no pixel."""
    global folded
    size, K = calibration()
    is_fisheye = number % 3 == 0
    if is_fisheye:
        vector = [random.uniform(-s, s) for s in (0.1, 0.03, 0.01, 0.003)]
        angle_limit = fisheye_limit_of(vector)
        limit = math.tan(angle_limit) if angle_limit < math.pi / 2 else math.inf
    else:
        vector = [random.uniform(-s, s) for s in (0.4, 0.3, 0.003, 0.003, 0.1, 0.4, 0.3, 0.1)][:random.choice((4, 5, 8))]
        k = vector + [0] * (8 - len(vector))
        limit = limit_of(k[:2] + k[4:], k[2:4])
    file = {"K": K.tolist(), "D": vector, "width": size[0], "height": size[1],
            "distortion_model": "fisheye" if is_fisheye else "plumb_bob"}
    points, judgements = [], []
    for i in range(6):
        radius, angle = random.uniform(0, min(2 * limit, 4)) * (1 if i % 2 else 0.3), random.uniform(0, 2 * math.pi)
        z = 10 ** random.uniform(-0.5, 2) * (-1 if i == 5 else 1)
        point = np.array([radius * math.cos(angle), radius * math.sin(angle), 1]) * z
        share = math.atan2(radius * abs(z), z) / angle_limit if is_fisheye else radius / limit
        if 0.999 < share < 1.001:
            continue
        is_seen = share < 1 and (is_fisheye or z > 0)
        project = cv2.fisheye.projectPoints if is_fisheye else cv2.projectPoints
        pixel = project(point.reshape(1, 1, 3), np.zeros(3), np.zeros(3), K, np.array(vector))[0].reshape(2)
        if is_seen and z < 0:
            pixel = fisheye_behind(point, K, vector)
        if is_seen and abs(pixel).max() > 1e4:  # of which doubles know no 1e-9
            continue
        beyond = {"left": pixel[0] < -0.5, "right": pixel[0] > size[0] - 0.5, "bottom": pixel[1] > size[1] - 0.5,
                  "top": pixel[1] < -0.5}
        sides = [side for side, is_beyond in beyond.items() if is_beyond]
        outside = sides if is_seen else ["behind"] if z < 0 else ["lens"]
        folded += z > 0 and radius > limit and all(-0.5 <= n <= side - 0.5 for n, side in zip(pixel, size))
        points.append(point.tolist())
        judgements.append({"screen": pixel.tolist() if is_seen else None, "viewDistance": z,
                           "visible": not outside, "outside": outside})
    print(json.dumps({"name": "OpenCV " + ("fisheye" if is_fisheye else f"distortion of {len(vector)}"), "pick": None, "viewport": None,
                      "options": [], "file": file, "points": points, "judgements": judgements}, separators=(",", ":")))


random.seed(0)
opencv_cases()
nerf_cases()
nerf_names()
random.seed("yaml 0")
opencv_yaml()
folded = 0
for number in range(300):
    random.seed(f"lens {number}")
    lens_cases(number)
assert folded > 10, folded
