# Camera files of other programs, and where their points lie: one case a line, as JSON.
#   python3 decimals.py
# Each pixel is computed from the camera that the file was written for, not from the file: rational numbers where the
# camera has them, 40 digits elsewhere. Nothing of viewproj or of another program is used.
import json
import random
from decimal import Decimal as D, getcontext

getcontext().prec = 40


# ---- Vectors and matrices of decimals.

def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def times(m, v):
    return [dot(row, v) for row in m]


def transposed(m):
    return [list(column) for column in zip(*m)]


def product(a, b):
    return [[dot(row, column) for column in transposed(b)] for row in a]


def inverse(m):
    (a, b, c), (d, e, f), (g, h, i) = m
    cofactors = [[e * i - f * h, c * h - b * i, b * f - c * e], [f * g - d * i, a * i - c * g, c * d - a * f],
                 [d * h - e * g, b * g - a * h, a * e - b * d]]
    determinant = a * cofactors[0][0] + b * cofactors[1][0] + c * cofactors[2][0]
    return [[n / determinant for n in row] for row in cofactors]


def decimals(m):
    """The doubles that a file has, exactly."""
    return [[D(n) for n in row] for row in m] if isinstance(m[0], (list, tuple)) else [D(n) for n in m]


def doubles(m):
    return [[float(n) for n in row] for row in m] if isinstance(m[0], (list, tuple)) else [float(n) for n in m]


def pi():
    a, b, t, p = D(1), 1 / D(2).sqrt(), D("0.25"), D(1)
    for _ in range(7):
        a, b, t, p = (a + b) / 2, (a * b).sqrt(), t - p * ((a - b) / 2) ** 2, 2 * p
    return (a + b) ** 2 / (4 * t)


PI = pi()


def sine(x):
    total, term, n = D(0), x, 1
    while abs(term) > D(10) ** -42:
        total, term, n = total + term, -term * x * x / ((n + 1) * (n + 2)), n + 2
    return total


def cosine(x):
    return 1 - 2 * sine(x / 2) ** 2


def tangent(x):
    return sine(x) / cosine(x)


def rotation_of_quaternion(w, x, y, z):
    s = 2 / (w * w + x * x + y * y + z * z)
    return [[1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
            [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)],
            [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)]]


def rotation_of_vector(r):
    angle = dot(r, r).sqrt()
    s = sine(angle / 2) / angle
    return rotation_of_quaternion(cosine(angle / 2), *[s * n for n in r])


# ---- Cameras: R and t from the world to axes right, down, forward; f and c in pixels from the picture's corner.

class Camera:
    def __init__(self, R, t, fx, fy, cx, cy, size, near=None, far=None):
        self.R, self.t, self.fx, self.fy, self.cx, self.cy = R, t, fx, fy, cx, cy
        self.size, self.near, self.far = size, near, far

    def points(self):
        """World points in the picture and beside it, before near, beyond far and behind the camera."""
        points = []
        for i in range(9):
            z = D(repr((10 ** random.uniform(-0.5, 2), 0.9 * float(self.near or 0.01), 1.1 * float(self.far or 1000), -1.0, 1.0)[i % 5]))
            u, v = (D(random.uniform(-0.2, 1.2)) * D(side) for side in self.size)
            seen = [(u - self.cx) / self.fx * z, (v - self.cy) / self.fy * z, z]
            points.append(doubles(times(inverse(self.R), [s - o for s, o in zip(seen, self.t)])))
        return points

    def judge(self, point, shift):
        x, y, z = [n + o for n, o in zip(times(self.R, decimals(point)), self.t)]
        if z <= 0:
            return {"screen": None, "viewDistance": float(z), "visible": False, "outside": ["behind"]}
        u, v = self.fx * x / z + self.cx, self.fy * y / z + self.cy
        beyond = {"left": u < 0, "right": u > self.size[0], "bottom": v > self.size[1], "top": v < 0,
                  "near": self.near and z < self.near, "far": self.far and z > self.far}
        outside = [side for side, is_beyond in beyond.items() if is_beyond]
        return {"screen": [float(u + shift), float(v + shift)], "viewDistance": float(z), "visible": not outside,
                "outside": outside}


def write(name, file, camera, pick=None, viewport=None, options=(), centers=False, text=None, files=None):
    """centers: whole numbers of the file's pixels are centres of pixels. text: the file, where it is no JSON. files: those of
    a folder."""
    points = camera.points()
    shift = D("-0.5") if centers else D(0)
    print(json.dumps({"name": name, "pick": pick, "viewport": viewport, "options": list(options),
                      "file": file if text is None else text, **({"files": files} if files else {}), "points": points,
                      "judgements": [camera.judge(point, shift) for point in points]}, separators=(",", ":")))


def number(low, high):
    return D(random.uniform(low, high))


def vector(size):
    return [number(-size, size) for _ in range(3)]


def unit_quaternion():
    """Doubles, and so not quite of unit length."""
    q = [random.gauss(0, 1) for _ in range(4)]
    length = sum(n * n for n in q) ** 0.5
    return [D(n / length) for n in q]


def rotation():
    """A matrix of doubles, and so not quite a rotation."""
    return decimals(doubles(rotation_of_quaternion(*unit_quaternion())))


def lens():
    size = (random.randint(640, 4000), random.randint(480, 3000))
    f = number(0.6, 2) * size[0]
    return size, D(float(f)), D(float(f * number(0.98, 1.02))), D(float(number(0.45, 0.55) * size[0])), D(float(number(0.45, 0.55) * size[1]))


def to_camera(R, position):
    """R and t of a matrix from the camera to the world."""
    back = inverse(R)
    return back, [-n for n in times(back, position)]


def flipped(R):
    """To axes right, down, forward from right, up, back: rows."""
    return [R[0], [-n for n in R[1]], [-n for n in R[2]]]


def rows4(R, t):
    return doubles([[*R[i], t[i]] for i in range(3)] + [[D(0), D(0), D(0), D(1)]])


def K(fx, fy, cx, cy):
    return doubles([[fx, D(0), cx], [D(0), fy, cy], [D(0), D(0), D(1)]])


def flat(m):
    return [n for row in m for n in row]


HALF = D("0.5")
ORIGIN = decimals([[1, 0, 0], [0, 1, 0], [0, 0, 1]])


# ---- The files.

def yaml(value, depth=0):
    """Objects in lines, arrays of arrays in lines of their own, all else as JSON has it."""
    lines = []
    for key, each in value.items():
        start = "  " * depth + key + ":"
        if isinstance(each, dict):
            lines += [start, *yaml(each, depth + 1)]
        elif isinstance(each, list) and each and isinstance(each[0], list):
            lines += [start, *("  " * depth + "- " + json.dumps(row) for row in each)]
        else:
            lines.append(start + " " + (each if isinstance(each, str) else json.dumps(each)))
    return lines


def as_yaml(value):
    return "\n".join(yaml(value)) + "\n"


def kitti():
    """The cameras stand beside one another: P's last column has where, and six centimetres of depth."""
    size, fx, fy, cx, cy = lens()
    t = decimals(doubles([number(-0.6, 0.6), number(-0.01, 0.01), number(0, 0.06)]))
    p4 = decimals(doubles([fx * t[0] + cx * t[2], fy * t[1] + cy * t[2], t[2]]))
    k = [[fx, D(0), cx], [D(0), fy, cy], [D(0), D(0), D(1)]]
    at = times(inverse(k), p4)
    placed = Camera(ORIGIN, at, fx, fy, cx + HALF, cy + HALF, size)
    text = lambda m: " ".join("%.17e" % n for n in flat(m))
    p = [[*row, n] for row, n in zip(k, p4)]
    none = [[*row, D(0)] for row in k]
    lines = [f"P{i}: {text(p if i == 2 else none)}" for i in range(4)]
    lines += ["R0_rect: 1 0 0 0 1 0 0 0 1", "Tr_velo_to_cam: 0 -1 0 0 0 0 -1 0 1 0 0 0", "Tr_imu_to_velo: 1 0 0 0 0 1 0 0 0 0 1 0", ""]
    write("KITTI object", None, placed, pick="P2", viewport=f"{size[0]}x{size[1]}", centers=True, text="\n".join(lines))
    lines = ["calib_time: 09-Jan-2012 13:57:47", "corner_dist: 9.950000e-02"]
    for i in range(4):
        lines += [f"S_0{i}: 1.392000e+03 5.120000e+02", f"D_0{i}: -3.7e-01 2.0e-01 1.3e-03 -1.9e-03 -7.2e-02",
                  f"S_rect_0{i}: {size[0]:e} {size[1]:e}", f"P_rect_0{i}: {text(p if i == 3 else none)}"]
    write("KITTI raw", None, placed, pick="P_rect_03", centers=True, text="\n".join(lines) + "\n")


def matrix34():
    """Any K [R | t], up to a factor."""
    size, fx, fy, cx, cy = lens()
    R, t = rotation_of_quaternion(*unit_quaternion()), vector(3)
    k = [[fx, D(0), cx], [D(0), fy, cy], [D(0), D(0), D(1)]]
    scale = number(0.5, 2)
    rows = [[scale * n for n in row] for row in product(k, [[*R[i], t[i]] for i in range(3)])]
    for name, width, height in (("P", "width", "height"), ("projection_matrix", "image_width", "image_height"), ("P_matrix", "width", "height")):
        write("P of any rotation", {name: doubles(rows), width: size[0], height: size[1]},
              Camera(R, t, fx, fy, cx + HALF, cy + HALF, size), centers=True)


def inria():
    size, fx, fy, _, _ = lens()
    R, position = rotation(), decimals(doubles(vector(5)))
    back, t = to_camera(R, position)
    entry = {"id": 7, "img_name": "DSC0007", "width": size[0], "height": size[1], "position": doubles(position),
             "rotation": doubles(R), "fy": float(fy), "fx": float(fx)}
    file = [dict(entry, id=3, img_name="DSC0003", fx=1.0, fy=1.0), entry]
    write("3dgs by picture or id", file, Camera(back, t, fx, fy, D(size[0]) / 2, D(size[1]) / 2, size),
          pick=random.choice(["DSC0007", "7", "1"]))


def open3d():
    size, fx, fy, cx, cy = lens()
    R, t = rotation(), decimals(doubles(vector(5)))
    camera = Camera(R, t, fx, fy, cx + HALF, cy + HALF, size)
    intrinsic = {"width": size[0], "height": size[1], "intrinsic_matrix": flat(transposed(K(fx, fy, cx, cy)))}
    file = {"class_name": "PinholeCameraParameters", "extrinsic": flat(transposed(rows4(R, t))), "intrinsic": intrinsic,
            "version_major": 1, "version_minor": 0}
    write("Open3D camera", file, camera, centers=True)
    other = json.loads(json.dumps(file))
    other["intrinsic"]["intrinsic_matrix"][0] = 1.0
    write("Open3D trajectory", {"class_name": "PinholeCameraTrajectory", "parameters": [other, other, file]}, camera,
          pick="2", centers=True)
    here = Camera(ORIGIN, [D(0)] * 3, fx, fy, cx + HALF, cy + HALF, size)
    write("Open3D intrinsics", intrinsic, here, centers=True)


def realsense():
    size, fx, fy, cx, cy = lens()
    here = Camera(ORIGIN, [D(0)] * 3, fx, fy, cx + HALF, cy + HALF, size)
    file = {"fx": float(fx), "fy": float(fy), "ppx": float(cx), "ppy": float(cy), "width": size[0], "height": size[1],
            "model": "distortion.brown_conrady", "coeffs": [0.0] * 5, "depth_scale": 0.001}
    write("RealSense intrinsics", file, here, centers=True)
    write("RealSense color and depth", {"color": file, "depth": dict(file, fx=1.0), "serial": "1234"}, here,
          pick="color", centers=True)


def colmap():
    size, fx, fy, cx, cy = lens()
    q, t = unit_quaternion(), decimals(doubles(vector(5)))
    here = ORIGIN
    numbers = lambda *all: " ".join(repr(float(n)) for n in all)
    zeros = lambda n: " 0" * n
    models = (("SIMPLE_PINHOLE", numbers(fx, cx, cy), True), ("PINHOLE", numbers(fx, fy, cx, cy), False),
              ("SIMPLE_RADIAL", numbers(fx, cx, cy) + zeros(1), True), ("RADIAL", numbers(fx, cx, cy) + zeros(2), True),
              ("OPENCV", numbers(fx, fy, cx, cy) + zeros(4), False), ("FULL_OPENCV", numbers(fx, fy, cx, cy) + zeros(8), False))
    cameras = "# Camera list with one line of data per camera:\n#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n" + "".join(
        f"{i + 1} {model} {size[0]} {size[1]} {numbers_}\n" for i, (model, numbers_, _) in enumerate(models))
    which = random.randrange(len(models))
    images = ("# Image list with two lines of data per image:\n1 1 0 0 0 1 2 3 1 first.jpg\n\n"
              f"7 {numbers(*q)} {numbers(*t)} {which + 1} a folder/the second.jpg\n1.5 2.5 -1 30 40 17\n8 1 0 0 0 0 0 0 2 last.jpg\n1 2 3\n")
    other = fx if models[which][2] else fy
    write("COLMAP, a picture", None, Camera(rotation_of_quaternion(*q), t, fx, other, cx, cy, size),
          pick=random.choice(["a folder/the second.jpg", "7"]), files={"cameras.txt": cameras, "images.txt": images})
    write("COLMAP, a camera", None, Camera(here, [D(0)] * 3, fx, other, cx, cy, size), pick=str(which + 1),
          files={"cameras.txt": cameras, "images.txt": None})


def ros():
    size, fx, fy, cx, cy = lens()
    gx, gy, hx, hy = (D(float(n)) for n in (fx * D("1.02"), fy * D("1.02"), cx + 3, cy - 2))
    here = lambda *f: Camera(ORIGIN, [D(0)] * 3, f[0], f[1], f[2] + HALF, f[3] + HALF, size)
    raw, rectified = here(fx, fy, cx, cy), here(gx, gy, hx, hy)
    eye = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    p = flat([[*row, 0.0] for row in K(gx, gy, hx, hy)])
    for upper, pick in ((True, "raw"), (False, "rectified"), (False, "raw")):
        file = {"header": {"frame_id": "cam"}, "width": size[0], "height": size[1], "distortion_model": "plumb_bob",
                "D": [0.0 if pick == "raw" else 0.1] * 5, "K": flat(K(fx, fy, cx, cy)), "R": eye, "P": p, "binning_x": 0, "binning_y": 1,
                "roi": {"x_offset": 0, "y_offset": 0, "height": size[1], "width": 0, "do_rectify": False}}
        if not upper:
            file = {key.lower(): value for key, value in file.items()}
        if pick == "rectified":  # as camera_calibration writes it
            names = {"d": "distortion_coefficients", "k": "camera_matrix", "r": "rectification_matrix", "p": "projection_matrix"}
            shapes = {"d": (1, 5), "k": (3, 3), "r": (3, 3), "p": (3, 4)}
            named = {names.get(key, key): dict(zip(("rows", "cols"), shapes[key]), data=value) if key in names else value for key, value in file.items()}
            named.update(image_width=named.pop("width"), image_height=named.pop("height"), roi=None)
            write("ROS file, " + pick, named, rectified, pick=pick, centers=True)
            write("ROS file in YAML, " + pick, named, rectified, pick=pick, centers=True, text=as_yaml(dict(named, roi={"x_offset": 0})))
        write("ROS message, " + pick, file, raw if pick == "raw" else rectified, pick=pick, centers=True)


def turned():
    """R of a ROS camera plays no part in K, of points in the camera's frame, nor in P, of points in the rectified one; it leads from there to K."""
    size, fx, fy, cx, cy = lens()
    eye = ORIGIN
    base = D(float(number(-0.5, 0.5) * fx))
    raw = Camera(eye, [D(0)] * 3, fx, fy, cx + HALF, cy + HALF, size)
    rectified = Camera(eye, [base / fy, D(0), D(0)], fy, fy, cy + HALF, cx + HALF, size)
    p = K(fy, fy, cy, cx)
    R = doubles(rotation())
    back = inverse(decimals(R))
    stereo = Camera(back, times(back, [base / fy, D(0), D(0)]), fx, fy, cx + HALF, cy + HALF, size)
    file = {"width": size[0], "height": size[1], "distortion_model": "plumb_bob", "D": [0.0] * 5, "K": flat(K(fx, fy, cx, cy)),
            "R": flat(R), "P": [*p[0], float(base), *p[1], 0.0, *p[2], 0.0]}
    write("ROS, turned, raw", file, raw, pick="raw", centers=True)
    write("ROS, turned, rectified", file, rectified, pick="rectified", centers=True)
    write("ROS, turned, stereo", file, stereo, pick="stereo", centers=True)


def opencv():
    """K by each of its names, at the origin or placed: a matrix, or a rotation as matrix or vector with a translation."""
    size, fx, fy, cx, cy = lens()
    r, R, t = decimals(doubles(vector(1.5))), rotation(), decimals(doubles(vector(5)))
    at = lambda R, t: Camera(R, t, fx, fy, cx + HALF, cy + HALF, size)
    here, placed = at(ORIGIN, [D(0)] * 3), at(R, t)
    k, zeros = K(fx, fy, cx, cy), [[0.0] * 5]
    for name in ("Camera_Matrix", "cam_matrix", "intrinsic_matrix"):
        write("OpenCV by other names", {name: k, "img_size": size, "distortion_model": "plumb_bob"}, here, centers=True)
    write("OpenCV by other names", {"Camera_Matrix": k, "image_Width": size[0], "image_Height": size[1]}, here, centers=True)
    write("OpenCV by other names", {"mtx": k, "resolution": size}, here, centers=True)
    for name in ("distortion", "dist_coeffs"):
        write("OpenCV matrix", {"matrix": k, name: zeros, "width": size[0], "height": size[1]}, here, centers=True)
    file = {"K": k, "width": size[0], "height": size[1]}
    write("OpenCV K, R, t", {**file, "R": doubles(R), "t": doubles(t), "dist": zeros}, placed, centers=True)
    column = {"translation_vector": [[n] for n in doubles(t)]}
    write("OpenCV, a pose by longer names", {**file, "rotation_matrix": doubles(R), **column}, placed, centers=True)
    write("OpenCV, a pose by longer names", {**file, "rotation_vector": doubles(r), **column}, at(rotation_of_vector(r), t), centers=True)
    m = rows4(R, t)
    for name, given in (("extrinsic", m), ("extrinsics", m[:3]), ("extrinsic_matrix", {"rows": 4, "cols": 4, "dt": "d", "data": flat(m)}),
                        ("T_cam_world", flat(m))):
        write("OpenCV, a matrix of the pose", {**file, name: given}, placed, centers=True)
    write("OpenCV, a matrix to the world", {**file, "T_world_cam": m}, at(*to_camera(R, t)), centers=True)


def kalibr():
    """A chain's cameras in the world of the first, by the links of neighbours; EuRoC's in the body's."""
    size, fx, fy, cx, cy = lens()
    sensor = {"camera_model": "pinhole", "intrinsics": doubles([fx, fy, cx, cy]), "distortion_model": "radtan",
              "distortion_coeffs": [0.0] * 4, "resolution": list(size), "rostopic": "/cam/image_raw"}
    R, t = rotation(), decimals(doubles(vector(0.5)))
    link = {"T_cn_cnm1": rows4(R, t)}
    chain = {"cam0": sensor, "cam1": dict(sensor, **link, intrinsics=doubles([fy, fx, cy, cx])),
             "cam2": dict(sensor, **link, camera_model="eucm", intrinsics=doubles([D(1), D(1), fx, fy, cx, cy]))}
    second = Camera(R, t, fy, fx, cy + HALF, cx + HALF, size)
    write("Kalibr", chain, second, pick="cam1", centers=True)
    write("Kalibr in YAML", None, second, pick="1", centers=True, text=as_yaml(chain))
    R, t = rotation(), decimals(doubles(vector(0.1)))
    euroc = dict(sensor, sensor_type="camera", T_BS={"cols": 4, "rows": 4, "data": flat(rows4(R, t))},
                 distortion_model="radial-tangential", distortion_coefficients=[0.0] * 4)
    write("EuRoC", None, Camera(*to_camera(R, t), fx, fy, cx + HALF, cy + HALF, size), centers=True, text=as_yaml(euroc))


for each in (colmap, kitti, matrix34, ros, turned, kalibr, opencv, inria, open3d, realsense):
    random.seed(f"{each.__name__} 0")
    each()
