"""Four times the input, four times the work, and in a stream the same memory: one row for each reader, writer and importer.

    VIEWPROJ_TOOL=build/viewproj python3 growth_test.py [WORDS]      rows whose names have all of them

Work is counted in instructions, by valgrind, at a size and at four times that; memory is the peak of runs without valgrind
on more of the same.
"""
import concurrent.futures
import os
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

TOOL = os.path.abspath(os.environ.get("VIEWPROJ_TOOL", "viewproj"))
TIMES = 4
# Sorting adds a little to four times; a quadratic term would make it sixteen.
MOST_WORK = 5.2
# What the pipeline and the allocator keep at hand.
SLACK = 4 << 20
BIG = 1 << 20  # bytes of input, for the peaks
CAMERA = (
    '{"position":[3,2,5],"target":[0,0,0],"projection":{"type":"perspective","fovY":60,"near":0.1,"far":1000},'
    '"viewport":{"width":1280,"height":720}}'
)
POINT = b'{"id":"p","x":1.5,"y":2.25,"z":-3}'
IDENTITY = "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]"
PROJECT = ["project", "-c", CAMERA, "--jobs", "1"]
VIEW = ["matrix", "--which", "view", "-c"]


def lines(record, before=b""):
    return lambda n: before + (record + b"\n") * n


def joined(record, before="[", after="]", between=","):
    """record: with %d, or without."""
    return lambda n: (before + between.join(record.replace("%d", str(i)) for i in range(n)) + after).encode()


def many(field):
    """One record with so many of these fields."""
    return joined(field, '{"x":1,"y":2,"z":3,', "}")


def gltf(nodes, more='{"camera":0,"name":"c"}'):
    camera = '{"type":"perspective","perspective":{"yfov":0.7,"znear":0.1,"aspectRatio":1.5}}'
    return joined(nodes, f'{{"asset":{{"version":"2.0"}},"cameras":[{camera}],"nodes":[{more},', "]}")


def colmap(n):
    images = "".join(f"{i + 1} 1 0 0 0 {i} 0 0 1 {i}.jpg\n1.5 2.5 -1\n" for i in range(n))
    return {"input/cameras.txt": b"1 PINHOLE 640 480 500 501 320 240\n", "input/images.txt": images.encode()}


FRAME = '{"file_path":"f%d","transform_matrix":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}'
THREE = '{"type":"PerspectiveCamera","name":"c%%d","fov":50,"zoom":1,"near":0.1,"far":1000,"aspect":1.5,"matrix":%s}' % IDENTITY
SPHERE = '{"id":"s%d","sphere":{"center":[1,1,1],"radius":2}}'
PLAIN = b"1.5 2.25 -3"

RIG = ('{"cameras":[{},{"position":[1,0,0]}],"position":[0,0,0],"direction":[0,0,-1],"projection":{"type":"perspective","fovY":60},'
       '"viewport":{"width":640,"height":480}}')
MEET = ["triangulate", "-c", RIG, "--camera-by", "camera", "--by", "point"]


def seen_twice(n):
    return b"".join(b'{"point":%d,"camera":%d,"pixel":[%d,200]}\n' % (i // 2, i % 2, 400 - 70 * (i % 2)) for i in range(2 * n))


# name, size, arguments, standard input of n, file of n, what memory is to the input: flat or linear, and status
ROWS = [
    ("read json: lines", 300, PROJECT, lines(POINT)),
    ("read json: array", 300, PROJECT, joined(POINT.decode())),
    ("read json: document", 300, PROJECT, joined("[1.5,2.25,-3]", '{"points":[', "]}")),
    ("read json: shapes of their own", 300, PROJECT, joined('{"a%d":1,"x":1,"y":2,"z":3}', "", "\n", "\n")),
    ("read csv: quoted line breaks", 300, PROJECT, lines(b'"p\n""q""",1.5,2.25,-3', b"id,x,y,z\n")),
    ("read text", 300, PROJECT, lines(PLAIN)),
    ("read f32", 20000, [*PROJECT, "--from", "f32", "--to", "text"], lambda n: struct.pack("<3f", 1.5, 2.25, -3) * n),
    ("read f64", 20000, [*PROJECT, "--from", "f64"], lambda n: struct.pack("<3d", 1.5, 2.25, -3) * n),
    ("read pixels", 300, ["ray", "-c", CAMERA, "--jobs", "1"], lines(b"[640,360]")),
    ("read shapes", 300, ["cull", "-c", CAMERA, "--jobs", "1"], lines(b'{"sphere":{"center":[1,1,1],"radius":0.5}}')),
    ("read sightings: sorted", 300, [*MEET, "--sorted"], seen_twice),
    ("read sightings", 300, MEET, seen_twice, None, "linear"),
    *((f"write {to}", 1200 if to == "table" else 300, [*PROJECT, "--to", to], lines(POINT))
      for to in ("ndjson", "json", "csv", "text", "f64", "table")),
    ("keep going: no JSON", 1000, [*PROJECT, "--keep-going"], lines(b'{"x":}', POINT + b"\n"), None, "flat", 1),
    ("keep going: an array of NaN", 1000, [*PROJECT, "--keep-going"], joined("[NaN,0,0]", "[[1,2,3],"), None, "flat", 1),
    ("keep going: an unclosed bracket", 1000, [*PROJECT, "--keep-going"], lines(b'{"x":[1', POINT + b"\n"), None, "linear", 1),
    ("keep going: lines cut off", 400, [*PROJECT, "--keep-going"], lines(b'{"x":1,"y":', POINT + b"\n"), None, "linear", 1),
    ("keep going: quotes not closed", 400, [*PROJECT, "--keep-going"], lines(b'1,2,"3', b"x,y,z\n1,2,3\n"), None, "linear", 1),
    ("keep going: few fields of CSV", 400, [*PROJECT, "--keep-going"], lines(b"1,2", b"x,y,z\n1,2,3\n"), None, "flat", 1),
    ("a record of many fields, write csv", 2000, [*PROJECT, "--to", "csv"], many('"a%d":1'), None, "linear"),
    ("a long string", 800000, PROJECT, lambda n: b'{"x":1,"y":2,"z":3,"a":"' + b"x" * n + b'"}', None, "linear"),
    ("a deep record", 20000, PROJECT, lambda n: b'{"x":1,"y":2,"z":3,"a":' + b"[" * n + b"]" * n + b"}", None, "linear", 1),
    ("many columns", 2000, PROJECT,
     lambda n: b"x,y,z" + b"".join(b",a%d" % i for i in range(n)) + b"\n1,2,3" + b",1" * n + b"\n", None, "linear"),
    ("brackets that close nothing", 50000, [*PROJECT, "--from", "json"], lambda n: b"]" * n, None, "linear", 1),
    ("an unclosed quote", 200000, PROJECT, lambda n: b'x,y,z\n1,2,"' + b"x" * n, None, "linear", 1),
    ("white space between records", 300000, PROJECT, lambda n: POINT + b" \n" * n + POINT),
    ("white space after an array", 300000, PROJECT, lambda n: b"[" + POINT + b"]" + b" \n" * n, None, "linear"),
    ("white space in a document's end", 300000, PROJECT, lambda n: b'{"points":[' + POINT + b"]" + b" " * n + b"}", None, "linear"),
    ("shapes in turn", 10, PROJECT, lambda n: b"".join(b'{"a%d":1,"x":1,"y":2,"z":3}\n' % (i % n) for i in range(40 * n))),
    ("scene", 500, ["ray", "-c", CAMERA, "--pixel", "640,360", "--all-hits", "--scene", "input"], None,
     joined(SPHERE, '{"objects":[', "]}"), "linear"),
    ("glTF", 300, [*VIEW, "input#n5"], None, gltf('{"camera":0,"name":"n%d"}'), "linear"),
    ("glTF, all", 200, ["matrix", "--all", "--which", "view", "input"], None, gltf('{"camera":0,"name":"n%d"}'), "linear"),
    ("glTF, nodes in a chain", 500, [*VIEW, "input#c"], None,
     lambda n: gltf("%d")(1)[:-3] + b",".join(b'{"children":[%d]}' % (i + 2) for i in range(n)) + b',{"name":"end"}]}', "linear"),
    ("three.js", 200, [*VIEW, "input#c5"], None, joined(THREE, '{"object":{"type":"Scene","children":[', "]}}"), "linear"),
    ("transforms.json", 300, [*VIEW, "input#f5"], None, joined(FRAME, '{"w":1280,"h":720,"fl_x":900,"frames":[', "]}"), "linear"),
    ("transforms.json, listed", 300, ["info", "input"], None,
     joined(FRAME, '{"w":1280,"h":720,"fl_x":900,"frames":[', "]}"), "linear"),
    ("COLMAP", 500, [*VIEW, "input#5.jpg"], None, colmap, "linear"),
    ("OpenCV, YAML", 1000, [*VIEW, "input"], None,
     joined("a%d: {b: [1, 2]}\n", "%YAML:1.0\nwidth: 100\nheight: 100\nK: [90, 0, 50, 0, 90, 50, 0, 0, 1]\n", "", ""), "linear"),
    ("YAML, nested deep", 2000, [*VIEW, "input"], None, lambda n: b"a: " + b"[" * n, "linear", 1),
    ("points for a camera", 3000, [*VIEW, "input"], None, joined("[%d,2,3]"), "linear", 1),
    ("a camera file, unknown keys", 1000, [*VIEW, "input"], None, joined('"a%d":{"b":1}', CAMERA[:-1] + ",", "}"), "linear", 1),
    ("info: matrices, JSON", 40, ["info", "input"], None, joined(f'"m%d":{IDENTITY}', "{", "}"), "linear"),
    ("info: matrices, text", 40, ["info", "input"], None, lines(b"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"), "linear"),
    ("draw", 150, ["draw", "-c", CAMERA, "-"], joined('{"id":"p%d","x":1,"y":1,"z":0}', "", "", "\n"), None, "linear"),
    ("--set, a deep value", 10000, lambda n: [*VIEW, CAMERA, "--set=position=" + "[" * n + "]" * n], None, None, "options", 2),
    ("--point", 200, lambda n: [*PROJECT, *["--point=1,2,3"] * n], None, None, "options"),
]


class Failure(Exception):
    pass


def run(row, n, folder, before=()):
    """How many bytes went in."""
    _, _, arguments, given, file, _, status = row
    arguments = arguments(n) if callable(arguments) else arguments
    given = given(n) if given else b""
    texts = file(n) if file else {}
    texts = texts if isinstance(texts, dict) else {"input": texts}
    for name, text in texts.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(text)
    with open(folder / "err", "wb") as err:
        done = subprocess.run([*before, TOOL, *arguments], input=given, stdout=subprocess.DEVNULL, stderr=err, cwd=folder, check=False,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (100, 100)))
    if done.returncode != status:
        raise Failure(f"n = {n} ends with {done.returncode}: {(folder / 'err').read_bytes()[:300]!r}")
    return len(given) + sum(map(len, arguments)) + sum(map(len, texts.values()))


def instructions(row, n, folder):
    log = folder / "log"
    run(row, n, folder, ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", f"--log-file={log}"])
    return int(re.search(r"Collected : (\d+)", log.read_text())[1])


def peak(row, n, folder):
    log = folder / "log"
    run(row, n, folder, ["time", "-q", "-f", "%M", "-o", str(log)])
    return int(log.read_text()) << 10


def fault_of(row, least):
    """What is wrong, or nothing. least: instructions that any run takes."""
    size, memory = row[1], row[5]
    with tempfile.TemporaryDirectory(prefix="viewproj-growth-") as name:
        folder = Path(name)
        try:
            small, large = (instructions(row, n, folder) for n in (size, TIMES * size))
            work = (large - least) / (small - least)
            if work > MOST_WORK:
                return f"{TIMES} times the input, {work:.1f} times the work"
            if memory == "options":
                return ""
            big = max(size, size * (BIG if memory == "flat" else BIG // 5) // run(row, size, folder))
            small, large = (peak(row, n, folder) for n in (big, TIMES * big))
            if large > SLACK + (small if memory == "flat" else MOST_WORK * small):
                return f"{TIMES} times the input, a peak of {large >> 20} MiB after {small >> 20} MiB"
        except Failure as failure:
            return str(failure)
    return ""


def main():
    rows = [(*row, *(None, "flat", 0)[len(row) - 4 :]) for row in ROWS]
    chosen = [row for row in rows if all(word in row[0] for word in sys.argv[1:])]
    missing = [program for program in ("valgrind", "time") if not shutil.which(program)]
    if missing:
        print(f"skipped: without {' and '.join(missing)}")
        return 77
    with tempfile.TemporaryDirectory() as name:
        least = instructions(("", 0, ["--version"], None, None, "flat", 0), 0, Path(name))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = [(row[0], fault) for row, fault in zip(chosen, pool.map(lambda row: fault_of(row, least), chosen)) if fault]
    for name, fault in faults:
        print(f"{name}: {fault}")
    print(f"{len(chosen)} rows, {len(faults)} of them not as they should be")
    return 1 if faults or not chosen else 0


if __name__ == "__main__":
    sys.exit(main())
