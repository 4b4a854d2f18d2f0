"""What footprint writes, judged from its output alone.

  python3 -B footprint.py VIEWPROJ

Of each camera: a vertex with a pixel projects back to it; one on the horizon is where the line of sight touches the
surface, one on --max-distance is that far away; between two vertices of one side of the picture the ground lies within
the stated error of the map's line; the area is the integral over the polygon, by quadrature, and at height 0 that of
GeographicLib's Planimeter, where it is installed; and GeoJSON keeps the rules of RFC 7946 and has the same area. Where
a lens ends inside the picture, the area is that of the directions that its formula puts there.
"""
import json
import math
import shutil
import subprocess
import sys

TOOL = sys.argv[1]
A, F = 6378137.0, 1 / 298.257223563
E2 = F * (2 - F)


def earth(lat, lon, height, heading, pitch, *more):
    return ["--position", f"lat={lat},lon={lon},height={height}", "--heading", f"{heading}", "--pitch", f"{pitch}", *more]


def fisheye(f, k=0):
    return ["--fx", f"{f}", "--fy", f"{f}", "--cx", "400", "--cy", "300", "--viewport", "800x600", "--set",
            f'distortion={{"model":"fisheye","k":[{k},0,0,0]}}']


SMALL = ["--fov-x", "70", "--viewport", "800x600"]
SQUARE = ["--viewport", "500x500"]
BENT = ["--fov-x", "90", "--viewport", "800x600", "--set", 'distortion={"model":"brown","k":[-0.2,0.03,0],"p":[0.001,0]}']
# name, camera, surface, what is cut
CASES = [
    ("drone", earth(46.9481, 7.4474, 640, 212, -35, "--roll", "1.5", *SMALL), ["--height", "545"], []),
    ("nadir", earth(-33, 151, 1000, 0, -90, *SMALL), ["--height", "0"], []),
    ("brown", earth(46.9, 7.4, 745, 20, -60, *BENT), ["--height", "545"], []),
    ("horizon", earth(46.9493, 7.44785, 640.3, 12.1, -8, *SMALL), ["--height", "545"], ["horizon"]),
    ("at sea", earth(10, 20, 30, 300, 0, *SMALL), ["--height", "0"], ["horizon"]),
    ("five kilometres", earth(46.9, 7.4, 640, 12.1, -8, *SMALL), ["--height", "545", "--max-distance", "5000"],
     ["distance"]),
    ("antimeridian", earth(12.5, 179.6, 7e5, 20, -75, "--fov-x", "15", *SQUARE), ["--height", "0"], []),
    ("antimeridian at the horizon", earth(-17, -179.9, 2000, 250, -3, *SMALL), ["--height", "0"], ["horizon"]),
    ("north pole", earth(88, 30, 2e6, 0, -90, "--fov-x", "40", *SQUARE), ["--height", "0"], []),
    ("south pole", earth(-86, 170, 2e6, 75, -88, "--fov-x", "60", *SQUARE), ["--height", "1000"], []),
    ("disc", earth(20, 175, 4e7, 0, -90, "--fov-x", "30", *SQUARE), ["--height", "0"], ["horizon"]),
    ("disc with the pole", earth(70, -100, 4e7, 0, -90, "--fov-x", "30", *SQUARE), ["--height", "0"], ["horizon"]),
    ("near disc", earth(46.9, 7.4, 1000, 0, -90, "--fov-x", "150", *SQUARE), ["--height", "0", "--max-distance", "1500"],
     ["distance"]),
    ("clouds", earth(46.9, 7.4, 640, 20, 10, *SMALL), ["--height", "2000"], ["horizon"]),
    ("clouds overhead", earth(46.9, 7.4, 640, 20, 90, *SMALL), ["--height", "2000"], []),
    ("all sky", earth(46.9, 7.4, 640, 20, 90, *fisheye(200)), ["--height", "545"], ["horizon"]),
    ("fisheye", earth(46.9, 7.4, 640, 20, -40, *fisheye(150)), ["--height", "545"], ["horizon", "lens"]),
    ("end of the lens", earth(46.9, 7.4, 640, 20, -70, *fisheye(120, -0.1)), ["--height", "545"], ["horizon", "lens"]),
    ("sky", earth(46.9, 7.4, 640, 20, 45, *SMALL), ["--height", "545"], ["sky"]),
    ("too far", earth(46.9, 7.4, 640, 20, -45, *SMALL), ["--height", "545", "--max-distance", "50"], ["distance"]),
    ("far below", earth(10, 20, 1e8, 3, -84, "--fov-x", "20", *SQUARE), ["--height", "0", "--max-distance", "9e7"],
     ["distance"]),
]
LOCAL = [
    ("square", ["--position", "3,2,95", "--target", "3,2,0", "--up", "0,1,0", "--fov-x", "60", *SQUARE], ["--height", "0"],
     (2 * 95 * math.tan(math.radians(30))) ** 2),
    ("disc", ["--position", "3,2,3", "--target", "3,2,0", "--up", "0,1,0", "--fov-x", "160", *SQUARE],
     ["--plane", "z=0", "--max-distance", "5"], math.pi * 16),
    ("orthographic", ["--orthographic", "--position", "0,0,10", "--target", "10,0,0", "--up", "0,0,1", "--set",
                      "projection.height=4", "--near", "0.1", "--far", "100", "--viewport", "300x200"],
     ["--plane", "z=0"], 24 * math.sqrt(2)),
    ("left-handed", ["--convention", "unity", "--position", "0,5,0", "--target", "0,4,4", "--fov-y", "50",
                     "--viewport", "300x200"], ["--plane", "y=0", "--max-distance", "50"], None),
]
# k1, k2, p1, p2, and the principal point of a picture of 640 x 480.
ENDING = [(-0.5, 0, 0, 0, 320, 240), (-0.283, 0, 0, 0, 320, 240), (2e-4, 1e-4, -0.283, 0.0739, 320, 240),
          (0, 0, 0, 1.76, 320, 240), (-0.5, 0, 0, 0, -80, 300), (-0.5, 0, 0, 0, -80, -60)]


def run(command, options, given=""):
    done = subprocess.run([TOOL, command, *options], input=given, capture_output=True, text=True, check=False,
                          timeout=10)
    if done.returncode != 0:
        sys.exit(f"viewproj {command} {' '.join(options)}: {done.stderr}")
    return done.stdout


def lines(command, options, records):
    text = run(command, options, "".join(json.dumps(one) + "\n" for one in records))
    return [json.loads(line) for line in text.splitlines()]


def require(good, what):
    if not good:
        sys.exit(f"{name}: {what}")


def normal(lat, lon):
    lat, lon = math.radians(lat), math.radians(lon)
    return math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat)


def ecef(lat, lon, height):
    n = normal(lat, lon)
    r = A / math.sqrt(1 - E2 * n[2] ** 2)
    return (r + height) * n[0], (r + height) * n[1], (r * (1 - E2) + height) * n[2]


def radii(lat, height):
    w = math.sqrt(1 - E2 * math.sin(math.radians(lat)) ** 2)
    return A * (1 - E2) / w ** 3 + height, A / w + height


GAUSS = [(-math.sqrt(0.6), 5 / 9), (0, 8 / 9), (math.sqrt(0.6), 5 / 9)]


def strip(a, b, height):
    """The area for a radian of longitude between two latitudes."""
    parts = max(1, math.ceil(abs(b - a) / 2))
    total, step = 0, (b - a) / parts
    for k in range(parts):
        for x, w in GAUSS:
            lat = a + step * (k + (1 + x) / 2)
            m, n = radii(lat, height)
            total += w / 2 * math.radians(step) * m * n * math.cos(math.radians(lat))
    return total


def area_of(ring, height, base):
    """Signed, anticlockwise above 0; [lon, lat] without jumps. Straight lines of the map."""
    total = 0
    for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
        for x, w in GAUSS:
            total -= w / 2 * math.radians(x1 - x0) * strip(base, y0 + (y1 - y0) * (1 + x) / 2, height)
    return total


def unwrapped(ring):
    out = [ring[0]]
    for x, y in ring[1:]:
        out.append((out[-1][0] + math.remainder(x - out[-1][0], 360), y))
    return out


def close(got, expected, share):
    return abs(got - expected) <= share * abs(expected)


def check_geojson(camera, surface, area, error, height, base):
    collection = json.loads(run("footprint", [*camera, *surface, "--to", "geojson", "--error", repr(error)]))
    require(collection["type"] == "FeatureCollection" and len(collection["features"]) == 1, "one feature")
    feature = collection["features"][0]
    geometry = feature["geometry"]
    require(feature["type"] == "Feature" and feature["properties"]["area"] == area, "the properties")
    if area == 0:
        require(geometry is None, "a geometry of nothing")
        return
    polygons = geometry["coordinates"]
    if geometry["type"] == "Polygon":
        polygons = [polygons]
    else:
        require(geometry["type"] == "MultiPolygon" and len(polygons) > 1, "the type " + geometry["type"])
    total = 0
    for polygon in polygons:
        for k, ring in enumerate(polygon):
            require(len(ring) >= 4 and ring[0] == ring[-1], "a ring that is not closed")
            require(all(abs(x) <= 180 and abs(y) <= 90 and h == height for x, y, h in ring), "a place off the map")
            places = [(x, y) for x, y, _ in ring[:-1]]
            steps = zip(places, places[1:] + places[:1])
            require(all(abs(a[0] - b[0]) < 180 or abs(a[1]) == abs(b[1]) == 90 for a, b in steps), "a jump")
            signed = area_of(places, height, base)
            require((signed > 0) == (k == 0), "a ring that turns the wrong way")
            total += signed
    require(close(total, area, 2e-4), f"GeoJSON has an area of {total}, not {area}")


def check_vertices(camera, polygons, eye, height, most):
    vertices = [v for polygon in polygons for v in polygon]
    seen = [v for v in vertices if v["pixel"]]
    records = [{"lat": v["lat"], "lon": v["lon"], "height": v["height"]} for v in seen]
    for v, got in zip(seen, lines("project", [*camera, "--fields", "screen"], records) if seen else []):
        require(math.dist(got["screen"], v["pixel"]) < 1e-6, f"{v} projects to {got['screen']}")
    for v in vertices:
        require(v["height"] == height, "another height")
        if v["pixel"] is None and not LENS:
            at = ecef(v["lat"], v["lon"], height)
            away = math.dist(eye, at)
            slope = sum((p - q) * n for p, q, n in zip(at, eye, normal(v["lat"], v["lon"]))) / away
            require(most and abs(away - most) < 1e-5 or abs(slope) < 1e-6 or ABOVE, f"{v} is on no horizon")


def check_error(camera, surface, polygon, height, error):
    """Half-way between two pixels of one side of the picture."""
    edges = [(a, b) for a, b in zip(polygon, polygon[1:] + polygon[:1])
             if a["pixel"] and b["pixel"] and (a["pixel"][0] == b["pixel"][0] or a["pixel"][1] == b["pixel"][1])]
    halves = [[(p + q) / 2 for p, q in zip(a["pixel"], b["pixel"])] for a, b in edges]
    hits = lines("ray", [*camera, *surface, "--fields", "direction,hit"], [{"screen": h} for h in halves]) if halves else []
    forward = json.loads(run("info", [*camera, "--to", "json"]))["forward"]
    for (a, b), got in zip(edges, hits):
        if sum(p * q for p, q in zip(got["direction"], forward)) < 0:
            continue  # ray hits nothing behind the plane of the eye
        require(got["hit"], f"no ground between {a} and {b}")
        place = got["hit"]
        m, n = radii(place["lat"], height)
        across = n * math.cos(math.radians(place["lat"]))
        def metres(to):
            return math.radians(math.remainder(to["lon"] - a["lon"], 360)) * across, math.radians(to["lat"] - a["lat"]) * m
        (x, y), (dx, dy) = metres(place), metres(b)
        require(abs(x * dy - y * dx) / math.hypot(dx, dy) <= error, f"off the line at {place}")


def planimeter(ring):
    if not shutil.which("Planimeter"):
        return None
    dense = []  # its edges are geodesics, not lines of the map
    for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
        dx = math.remainder(x1 - x0, 360)
        parts = math.ceil(max(abs(dx), abs(y1 - y0)) / 0.02)
        dense += [(x0 + dx * k / parts, y0 + (y1 - y0) * k / parts) for k in range(parts)]
    text = "".join(f"{y!r} {x!r}\n" for x, y in dense)
    out = subprocess.run(["Planimeter"], input=text, capture_output=True, text=True, check=True).stdout
    return abs(float(out.split()[2]))


checked = 0
for name, camera, surface, cut in CASES:
    got = json.loads(run("footprint", [*camera, *surface, "--to", "json"]))
    require(got["cut"] == cut, f"cut {got['cut']}")
    lat, lon, eye_height = (float(part.split("=")[1]) for part in camera[1].split(","))
    height = got["surface"]["height"]
    most = float(surface[3]) if len(surface) > 2 else None
    ABOVE, LENS = height > eye_height, "lens" in cut
    check_geojson(camera, surface, got["area"], (got["error"] or 1) / 30, height, lat)
    if got["polygon"] is None:
        require(got["area"] == 0 and got["error"] is None, "an area of nothing")
        continue
    polygons = got.get("polygons", [got["polygon"]])
    check_vertices(camera, polygons + got.get("holes", []), ecef(lat, lon, eye_height), height, most)
    for polygon in polygons:
        check_error(camera, surface[:2], polygon, height, got["error"])
    # Finer, so that chords do not count.
    fine = json.loads(run("footprint", [*camera, *surface, "--to", "json", "--error", repr(got["error"] / 300)]))
    require(close(fine["area"], got["area"], 1e-12), "an area that depends on the error")
    total, by_planimeter = 0, 0
    for sign, rings in ((1, fine.get("polygons", [fine["polygon"]])), (-1, fine.get("holes", []))):
        for vertices in rings:
            ring = unwrapped([(v["lon"], v["lat"]) for v in vertices])
            last = ring[-1][0] + math.remainder(ring[0][0] - ring[-1][0], 360)
            if abs(last - ring[0][0]) > 1:
                pole = math.copysign(90, lat)
                ring += [(last, ring[0][1]), (last, pole), (ring[0][0], pole)]
            total += sign * abs(area_of(ring, height, lat))
            by_planimeter += sign * (planimeter([(v["lon"], v["lat"]) for v in vertices]) or 0)
    require(close(got["area"], total, 1e-5), f"area {got['area']}, by quadrature {total}")
    if height == 0 and by_planimeter:
        require(close(got["area"], by_planimeter, 1e-5), f"area {got['area']}, by Planimeter {by_planimeter}")
    checked += 1
for name, camera, surface, expected in LOCAL:
    got = json.loads(run("footprint", [*camera, *surface, "--to", "json"]))
    fine = json.loads(run("footprint", [*camera, *surface, "--to", "json", "--error", repr(got["error"] / 100)]))
    places = [(v["x"], v["y"] if surface[1] != "y=0" else v["z"]) for v in fine["polygon"]]
    shoelace = abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(places, places[1:] + places[:1]))) / 2
    require(close(got["area"], shoelace, 1e-4), f"area {got['area']}, by its vertices {shoelace}")
    if expected:
        require(close(got["area"], expected, 1e-7), f"area {got['area']}, not {expected}")
    seen = [v for v in got["polygon"] if v["pixel"]]
    for v, back in zip(seen, lines("project", [*camera, "--fields", "screen"],
                                   [{k: v[k] for k in "xyz"} for v in seen]) if seen else []):
        require(math.dist(back["screen"], v["pixel"]) < 1e-9, f"{v} projects to {back['screen']}")
    for v in got["polygon"]:
        at = [float(x) for x in camera[camera.index("--position") + 1].split(",")]
        if v["pixel"] is None:
            require(close(math.dist(at, [v["x"], v["y"], v["z"]]), float(surface[3]), 1e-12), f"{v} is not on the limit")
    checked += 1


def area_through(lens):
    """On a plane at distance 1, by turns around the axis: as far as the lens goes, and only what is in the picture."""
    k1, k2, p1, p2, cx, cy = lens
    end, beyond = 0.0, 2.0  # the least slope is 1 + 3 k1 u + 5 k2 u^2 - 6 |p| r
    for _ in range(60):
        r = (end + beyond) / 2
        grows = 1 + 3 * k1 * r ** 2 + 5 * k2 * r ** 4 - 6 * math.hypot(p1, p2) * r > 0
        end, beyond = (r, beyond) if grows else (end, r)

    def is_in(x, y):
        u = x * x + y * y
        g = 1 + k1 * u + k2 * u * u
        return -0.5 <= 458 * (x * g + 2 * p1 * x * y + p2 * (u + 2 * x * x)) + cx <= 639.5 and (
            -0.5 <= 458 * (y * g + p1 * (u + 2 * y * y) + 2 * p2 * x * y) + cy <= 479.5)

    turns, radii, total = 1000, 24, 0
    for i in range(turns):
        c, s = math.cos(2 * math.pi * i / turns), math.sin(2 * math.pi * i / turns)
        was, before = is_in(0, 0), 0
        for k in range(1, radii + 1):
            r = end * k / radii
            now = is_in(r * c, r * s)
            if now != was:
                low, high = end * (k - 1) / radii, r
                for _ in range(40):
                    middle = (low + high) / 2
                    low, high = (middle, high) if is_in(middle * c, middle * s) == was else (low, middle)
                if was:
                    total += low ** 2 - before ** 2
                was, before = now, low
        if was:
            total += end ** 2 - before ** 2
    return total / 2 * 2 * math.pi / turns


for lens in ENDING:
    name = f"lens {lens}"
    k1, k2, p1, p2, cx, cy = lens
    camera = {"convention": "opencv", "position": [0, 0, 0], "rotation": [0, 0, 0, 1],
              "projection": {"type": "intrinsics", "fx": 458, "fy": 458, "cx": cx, "cy": cy},
              "distortion": {"model": "brown", "k": [k1, k2], "p": [p1, p2]}, "viewport": {"width": 640, "height": 480}}
    given = ["-c", json.dumps(camera)]
    got = json.loads(run("footprint", [*given, "--plane", "z=5", "--to", "json"]))
    require(got["cut"] == ["lens"], f"cut {got['cut']}")
    expected = 25 * area_through(lens)
    require(close(got["area"], expected, 2e-4), f"area {got['area']}, by turns {expected}")
    places = [(v["x"], v["y"]) for v in got["polygon"]]
    apart = [math.dist(a, b) for a, b in zip(places, places[1:] + places[:1])]
    require(min(apart) > got["error"] / 100, "a place twice")
    run("draw", [*given, "--height", "5"])
    checked += 1
name = "all"
require(checked == len(CASES) - 3 + len(LOCAL) + len(ENDING), "some cameras were not judged")
print(f"{checked} footprints are right")
