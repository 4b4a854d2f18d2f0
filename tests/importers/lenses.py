# Lenses, and where OpenCV's projectPoints puts points through them, and undistortPoints those pixels: one a line, as JSON.
#   python3 lenses.py COUNT
import json
import random
import sys

import cv2
import numpy as np


def coefficients(sizes):
    return [round(random.uniform(-size, size), 5) for size in sizes]


for trial in range(int(sys.argv[1])):
    random.seed(trial)
    width, height = random.randint(640, 4000), random.randint(480, 3000)
    f = round(random.uniform(0.4, 2) * width, 3)
    K = np.array([[f, 0, round(width * random.uniform(0.45, 0.55), 2)],
                  [0, round(f * random.uniform(0.98, 1.02), 3), round(height * random.uniform(0.45, 0.55), 2)], [0, 0, 1]])
    model = "fisheye" if trial % 3 == 0 else "brown"
    if model == "fisheye":
        vector = coefficients((0.2, 0.1, 0.05, 0.02))
    else:  # OpenCV's vectors of 4, 5 and 8
        vector = coefficients((0.5, 0.3, 0.01, 0.01, 0.2, 0.3, 0.2, 0.1)[:random.choice((4, 5, 8))])
    points = []
    for _ in range(2):
        z = 10 ** random.uniform(-0.5, 2)
        pixel = np.array([random.uniform(-0.2, 1.2) * width, random.uniform(-0.2, 1.2) * height, 1])
        points.append([round(float(c), 6) for c in np.linalg.inv(K) @ pixel * z])
    given, none = np.array(points).reshape(-1, 1, 3), np.zeros(3)
    if model == "fisheye":
        pixels = cv2.fisheye.projectPoints(given, none, none, K, np.array(vector))[0]
        back = cv2.fisheye.undistortPoints(pixels, K, np.array(vector))
    else:
        pixels = cv2.projectPoints(given, none, none, K, np.array(vector))[0]
        back = cv2.undistortPoints(pixels, K, np.array(vector))
    print(json.dumps({"size": [width, height], "K": [f, K[1][1], K[0][2], K[1][2]], "model": model, "vector": vector,
                      "points": points, "pixels": pixels.reshape(-1, 2).tolist(),
                      "undistorted": [[float(f"{v:.12g}") for v in p] for p in back.reshape(-1, 2)]},
                     separators=(",", ":")))
