"""A bad record changes no other: what is written of the good ones is what is written of them alone.

    python3 -B neighbours.py VIEWPROJ [TRIALS]

Random streams of points, directions, segments and shapes, with bad records among them, through project, cull and ray.
"""
import csv
import io
import json
import random
import subprocess
import sys

TOOL, TRIALS = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 150
CAMERA = (
    '{"position":[3,2,5],"target":[0,0,0],"projection":{"type":"perspective","fovY":60,"near":0.1,"far":1000},'
    '"viewport":{"width":1280,"height":720}}'
)


def vector(rnd):
    return [round(rnd.uniform(-5, 5), rnd.randint(0, 3)) for _ in range(3)]


def box(rnd):
    corners = list(zip(vector(rnd), vector(rnd)))
    return {"box": {"min": [min(c) for c in corners], "max": [max(c) for c in corners]}}


KINDS = [
    lambda rnd: {"n": rnd.randrange(99), "position": vector(rnd)},
    lambda rnd: dict(zip("xyz", vector(rnd))),
    lambda rnd: {"pos": dict(zip("xyz", vector(rnd)))},
    lambda rnd: {"direction": vector(rnd)},
    lambda rnd: {"segment": [vector(rnd), vector(rnd)]},
    lambda rnd: {"sphere": {"center": vector(rnd), "radius": abs(vector(rnd)[0])}},
    lambda rnd: {"triangle": [vector(rnd), vector(rnd), vector(rnd)]},
    box,
]
# Some are bad at once, others when their results are computed or written.
BAD = [
    '{"x":1}', "[1,2]", "[NaN,0,0]", '{"position":[1e95,0,0]}', '{"segment":[[0,0,0],[1e95,1,1]]}', "nonsense", "[0,0,0,0]",
    '{"sphere":{"center":[0,0,0],"radius":-1}}', '{"box":{"min":[1,1,1],"max":[0,0,0]}}', '{"x":1,"y":2,"z":3,"screen":[1,2],"cull":1}',
    '{"segment":[[0,0,0],[1,1,1]],"visible":1}', '{"sphere":{"center":[0,0,0],"radius":1},"outside":1,"plane":1}', '"a"', '{"a":"b',
    "[1,2,3", '{"sphere":{"center":[0,0,0],"radius":1},"extra":}', '{"segment":[[0,0,0],[1,1,1]],"s":"\\x"}',
]
UNCLOSED = [b'{"a":"b', b"[1,2,3"]
BAD_IN_CSV = [*BAD, '{"sphere":{"center":[0,0,0],"radius":1},"extra":7}', '{"segment":[[0,0,0],[1,1,1]],"extra":7}', '{"extra":7,"x":1,"y":2,"z":3}']
BAD_CELLS = ["", "x", "1e999", "1,5", '"a"b', "\t", "+-1", "0x10", "1 2", "'1'", "inf", "1e95"]
CSV_KINDS = {
    "n,x,y,z": lambda rnd: ["a", *map(str, vector(rnd))],
    "n,min_x,min_y,min_z,max_x,max_y,max_z": lambda rnd: ["b", *(str(v) for of in box(rnd)["box"].values() for v in of)],
    "n,center_x,center_y,center_z,radius": lambda rnd: ["c", *map(str, vector(rnd)), "1.5"],
}


def run(arguments, records, header=()):
    text = b"\n".join([*(h.encode() for h in header), *records, b""])
    done = subprocess.run([TOOL, *arguments], input=text, capture_output=True, check=False)
    return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")


def rows(text, form):
    """The lines without the header, and whether each is of a bad record."""
    if form == "ndjson":
        return [(line, "error" in json.loads(line)) for line in text.splitlines()]
    lines = text.splitlines()[1:]
    return [(line, next(csv.reader(io.StringIO(line)))[-1] != "") for line in lines]


def json_stream(rnd, form, command):
    # In CSV all have the fields of the first, which is good: cull takes no direction and no segment.
    kinds = [rnd.choice(KINDS if command == "project" else KINDS[:3] + KINDS[5:])] if form == "csv" else KINDS
    good = lambda: json.dumps(rnd.choice(kinds)(rnd)).encode()
    bad = BAD_IN_CSV if form == "csv" else BAD
    records = [good()]
    for _ in range(rnd.randint(1, 30)):
        # What begins with no bracket would belong to what is not closed before it.
        may_be_bad = records[-1] not in UNCLOSED
        records.append(rnd.choice(bad).encode() if may_be_bad and rnd.random() < 0.4 else good())
    return records, ()


def csv_stream(rnd):
    header = rnd.choice(list(CSV_KINDS))
    records = [",".join(CSV_KINDS[header](rnd)).encode()]
    for _ in range(rnd.randint(1, 30)):
        cells = CSV_KINDS[header](rnd)
        what = rnd.random()
        if what < 0.2:
            cells[rnd.randrange(1, len(cells))] = rnd.choice(BAD_CELLS)
        record = ",".join(cells).encode()
        if 0.2 <= what < 0.3:
            record = b"\xe4" + record  # bad where it becomes JSON
        elif 0.3 <= what < 0.35:
            record += b",9"
        records.append(record)
    return records, (header,)


def trial(seed):
    rnd = random.Random(seed)
    form, command = rnd.choice(["ndjson", "csv"]), rnd.choice(["project", "project", "cull"])
    source = rnd.choice(["json", "csv"])
    records, header = json_stream(rnd, form, command) if source == "json" else csv_stream(rnd)
    arguments = [command, "-c", CAMERA, "--keep-going", "--from", source, "--to", form, "--jobs", str(rnd.randint(1, 3))]
    if command == "project" and rnd.random() < 0.3:
        arguments += ["--fields", rnd.choice(["all", "screenBox,visible", "depth"])]
    status, out, err = run(arguments, records, header)
    found = rows(out, form)
    if status not in (0, 1) or len(found) != len(records):
        return f"{len(records)} records, {len(found)} rows, status {status}: {arguments} {records}\n{out}{err}"
    kept = [record for record, (_, is_bad) in zip(records, found) if not is_bad]
    good = [row for row, is_bad in found if not is_bad]
    _, alone, _ = run(arguments, kept, header)
    expected = [row for row, _ in rows(alone, form)]
    visited["bad"] += len(found) - len(good)
    visited["good"] += len(good)
    if good != expected:
        return f"{arguments} {header} {records}\nwith bad ones {good}\nalone {expected}"
    return None


visited = {"good": 0, "bad": 0}
faults = [fault for fault in map(trial, range(TRIALS)) if fault]
for fault in faults[:3]:
    print(fault)
print(f"{TRIALS} streams, {visited['good']} good records among {visited['bad']} bad ones, {len(faults)} changed")
sys.exit(1 if faults or min(visited.values()) < 3 * TRIALS else 0)
