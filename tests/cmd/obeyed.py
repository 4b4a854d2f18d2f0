"""What is typed is obeyed or refused: each option of each command, as its help lists them.

    obeyed.py VIEWPROJ [COMMAND | OPTION]...

An option of a camera field gives what a camera file with that field gives (CAMERA); any other does what its row says
(ROWS). Either changes what the command writes. Where an answer does not depend on a field (UNSEEN), a value that is none is
refused. Of a list of names in help, no two write the same. An option without a row fails.
"""
import base64
import concurrent.futures
import copy
import functools
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

TOOL = pathlib.Path(sys.argv[1]).resolve()
WANTED = sys.argv[2:]
os.chdir(FOLDER := tempfile.mkdtemp())

# ---- Cameras, each with the fields that its options lie over

SEEN = {"position": [3, 2, 5], "target": [0, 0, 0], "viewport": {"width": 640, "height": 480}}
DEEP = {"near": 0.1, "far": 100}
LENS = SEEN | {"projection": {"type": "perspective", "fovY": 60} | DEEP}
SENSOR = SEEN | {"projection": {"type": "perspective", "focalLength": 20, "sensorWidth": 32, "sensorHeight": 24} | DEEP}
DIAGONAL = SEEN | {"projection": {"type": "perspective", "focalLength": 20, "sensorDiagonal": 30} | DEEP}
FRUSTUM = SEEN | {"projection": {"type": "frustum", "left": -0.08, "right": 0.08, "bottom": -0.06, "top": 0.06} | DEEP}
BOX = SEEN | {"projection": {"type": "orthographic", "width": 8, "height": 6} | DEEP}
PINHOLE = SEEN | {"projection": {"type": "intrinsics", "fx": 500, "fy": 500, "cx": 320, "cy": 240} | DEEP}
BROWN = PINHOLE | {"distortion": {"model": "brown", "k": [-0.1, 0.02]}}
LOCAL = {"world": "enu", "position": [3, -5, 2], "heading": -31, "pitch": -19, "roll": 0, "viewport": SEEN["viewport"],
         "projection": LENS["projection"]}
EARTH = {"position": {"lat": 46, "lon": 7, "height": 900}, "heading": 20, "pitch": -30, "roll": 0,
         "viewport": SEEN["viewport"], "projection": {"type": "perspective", "fovY": 60, "near": 0.1}}
STATED = LENS | {"convention": "opengl"}


def changed(document, changes):
    """The document with fields in place of its own; None takes one out."""
    made = copy.deepcopy(document)
    for path, value in changes.items():
        *groups, name = path.split(".")
        place = functools.reduce(lambda part, group: part.setdefault(group, {}), groups, made)
        place[name] = value
        if value is None:
            del place[name]
    return made


def field(value, base, changes, *beside):
    return lambda option: (option if value is None else f"{option}={value}", base, changes, beside)


POSE = {"position": None, "target": None}
CAMERA = {
    "--position": field("1,2,6", LENS, {"position": [1, 2, 6]}),
    "--target": field("0.5,0.25,0", LENS, {"target": [0.5, 0.25, 0]}),
    "--direction": field("-0.5,-0.4,-1", LENS, {"direction": [-0.5, -0.4, -1], "target": None}),
    "--up": field("0.25,1,0", LENS, {"up": [0.25, 1, 0]}),
    "--rotation": field("-0.1,0.3,0,1", LENS, {"rotation": [-0.1, 0.3, 0, 1], "target": None}),
    "--euler": field("YXZ:30,-20,5", LENS, {"euler": {"order": "YXZ", "degrees": [30, -20, 5]}, "target": None}),
    "--heading": field("-25", LOCAL, {"heading": -25}),
    "--pitch": field("-17", LOCAL, {"pitch": -17}),
    "--roll": field("7", LOCAL, {"roll": 7}),
    "--fov-y": field("50", LENS, {"projection.fovY": 50}),
    "--fov-x": field("50", LENS, {"projection.fovY": None, "projection.fovX": 50}),
    "--fov-diagonal": field("50", LENS, {"projection.fovY": None, "projection.fovDiagonal": 50}),
    "--focal-length": field("24", SENSOR, {"projection.focalLength": 24}),
    "--sensor-width": field("36", changed(SENSOR, {"projection.sensorHeight": None}), {"projection.sensorWidth": 36}),
    "--sensor-height": field("36", changed(SENSOR, {"projection.sensorWidth": None}), {"projection.sensorHeight": 36}),
    "--sensor-diagonal": field("40", DIAGONAL, {"projection.sensorDiagonal": 40}),
    "--left": field("-0.04", changed(FRUSTUM, {"viewport.width": 480}), {"projection.left": -0.04}),
    "--right": field("0.04", changed(FRUSTUM, {"viewport.width": 480}), {"projection.right": 0.04}),
    "--bottom": field("-0.03", changed(FRUSTUM, {"viewport.height": 360}), {"projection.bottom": -0.03}),
    "--top": field("0.03", changed(FRUSTUM, {"viewport.height": 360}), {"projection.top": 0.03}),
    "--ortho-width": field("6", changed(BOX, {"projection.height": None}), {"projection.width": 6}),
    "--ortho-height": field("5", changed(BOX, {"projection.width": None}), {"projection.height": 5}),
    "--fx": field("400", PINHOLE, {"projection.fx": 400}),
    "--fy": field("400", PINHOLE, {"projection.fy": 400}),
    "--cx": field("300", PINHOLE, {"projection.cx": 300}),
    "--cy": field("250", PINHOLE, {"projection.cy": 250}),
    "--near": field("5.5", LENS, {"projection.near": 5.5}),
    "--far": field("6.5", LENS, {"projection.far": 6.5}),
    "--shift": field("0.1,-0.2", LENS, {"projection.shift": [0.1, -0.2]}),
    "--distortion": field('{"model":"brown","k":[-0.1,0.02]}', PINHOLE, {"distortion": BROWN["distortion"]}),
    "--viewport": field("320x200", LENS, {"viewport.width": 320, "viewport.height": 200}),
    "--set": field("projection.fovY=50", LENS, {"projection.fovY": 50}),
    "--ignore-distortion": field(None, BROWN, {"distortion": None}),
    "--read-as": field("unreal", LENS, {"convention": "unreal"}),
    "--world-from-camera": field('{"rotation":[0,0.2,0,1],"translation":[0,0,6]}', LENS, POSE | {
        "worldFromCamera": {"rotation": [0, 0.2, 0, 1], "translation": [0, 0, 6]}}),
    "--camera-from-world": field('{"rotation":[0,0.2,0,1],"translation":[0,0,-6]}', LENS, POSE | {
        "cameraFromWorld": {"rotation": [0, 0.2, 0, 1], "translation": [0, 0, -6]}}),
    "--aspect": field("1.5", LENS, {"projection.aspect": 1.5}, "--allow-stretch"),
    "--orthographic": field(None, LENS, {"projection": {"type": "orthographic", "height": 8} | DEEP}, "--ortho-height=8"),
    "--geoid": lambda _: ("--geoid=50", changed(EARTH, {"position.height": None, "position.altitude": 850}),
                          {"position.altitude": None, "position.height": 900}, ("--geoid=50",)),
}

# ---- Commands: options beside the camera, and what is on standard input

POINTS = "x,y,z\n0.5,0.25,1\n-1,0.5,-3\n0,0,0.5\n0,1,9\n"
SHAPES = "x,y,z,radius\n" + "".join(f"{x / 2},{y / 2},{x % 3},0.1\n" for x in range(-9, 10) for y in range(-9, 10))
PIXELS = "x,y,depth\n320,240,0.5\n200,150,0.99\n20,400,0.97\n"
PAIRS = "x,y,z,u,v\n0.5,0.25,1,300,200\n-1,0.5,-3,250,180\n0,0,0.5,340,260\n"
BASES = {
    "project": ("--fields screen,depth,viewDistance,visible,outside,ndc,clip,view,range", POINTS),
    "ray": ("--plane z=0 --fields origin,direction,point,range,hit", PIXELS),
    "cull": ("", SHAPES),
    "matrix": ("--to json", ""),
    "convert": ("--to camera", ""),
    "check": ("--to json", PAIRS),
    "info": ("--to json", ""),
    "footprint": ("--plane z=0 --max-distance 40 --to json", ""),
    "triangulate": ("", "u1,v1,u2,v2\n300,200,290,205\n320,240,350,235\n"),
    "explain": ("--point 0.5,0.25,1 --to json", ""),
    "depth": ("--to json", ""),
    "measure": ("--to json", POINTS),
    "draw": ("", "x,y,z,u,v,name\n0.5,0.25,1,300,200,a\n-1,0.5,-3,250,180,b\n0,1,9,1,1,c\n"),
    "fit": ("", POINTS[:-len("0,1,9\n")]),
    "schema": ("", ""),
    "help": ("project", ""),
}
EVERY = list(BASES)
CAMERAS, STATELESS = EVERY[:14], EVERY[14:]
# What a command's answer does not depend on: it is read all the same, and a value that is none is refused.
UNSEEN = {
    "depth": set(CAMERA) - {"--near", "--far", "--orthographic"},
    "check": {"--near", "--far"},
    "triangulate": {"--near", "--far"},
    "footprint": {"--near", "--far"},
}
BAD = {"check": 1, "triangulate": 1}  # the status of pairs that disagree, and of rays that do not meet
PLACED = "lat,lon,height\n46.01,7,600\n46.02,7.01,500\n"
ON_EARTH = {
    "ray": ("--height 0", "x,y\n320,240\n"),
    "check": ("--to json", "lat,lon,height,u,v\n46.01,7,600,300,200\n46.02,7.01,500,250,180\n"),
    "footprint": ("--height 0", ""),
    "triangulate": BASES["triangulate"],
    "explain": ("--point lat=46.01,lon=7,height=600 --to json", ""),
}


def several(document):
    """Two cameras, a and b, the second beside the first."""
    place = document.get("position")
    if place:
        place = place | {"lon": place["lon"] + 0.0001} if isinstance(place, dict) else [place[0] + 1, *place[1:]]
    return {"cameras": [{"name": "a"} | document, {"name": "b"} | document | ({"position": place} if place else {})]}


def timeless(text):
    shown = text.decode(errors="replace")
    return re.sub(r'"nsPerPoint": [-0-9.e]+|\s', "", shown) if "nsPerPoint" in shown else shown


class Run:
    """A command line as it ran. What takes time is left out."""

    def __init__(self, command, options, records):
        done = subprocess.run([TOOL, command, *options], input=records if isinstance(records, bytes) else records.encode(),
                              capture_output=True, check=False)
        self.line, self.status = f"{command} {' '.join(options)}", done.returncode
        self.out, self.err = timeless(done.stdout), done.stderr.decode(errors="replace")
        self.body = self.out.split("\n", 1)[-1]

    def __str__(self):
        return f"  viewproj {self.line}\n  [{self.status}] {self.err.strip()}\n  {self.out[:300]}"


run = functools.lru_cache(None)(Run)


def ran(command, document, options=(), beside=None, records=None):
    extras, usual = BASES[command]
    if document and isinstance(document.get("position"), dict):
        extras, usual = ON_EARTH.get(command, (extras, PLACED))
    if document and command == "triangulate" and "cameras" not in document:
        document = several(document)
    camera = ("-c", json.dumps(document)) if document else ()
    words = (extras if beside is None else beside).split()
    return run(command, (*camera, *words, *options), usual if records is None else records)


def require(holds, what, *runs):
    if not holds:
        raise AssertionError("\n".join([what, *map(str, runs)]))


def fine(command, result):
    return result.status in (0, BAD.get(command, 0))


def row_of(command, option):
    typed, judge, document, beside, records = ROWS[command, option]
    if command in STATELESS:
        document = None
    if beside is None:
        beside = re.sub(rf"{option} \S+", "", BASES[command][0])
    judge(ran(command, document, (), beside, records), ran(command, document, typed, beside, records), command)


def field_of(command, option):
    typed, document, changes, beside = CAMERA[option](option)
    if command == "triangulate":
        document = several(document)
    expected = changed(document, changes)
    if command == "triangulate":
        expected = {"cameras": [changed(each, changes) for each in document["cameras"]]}
    before, obeyed = ran(command, document), ran(command, document, dict.fromkeys((typed, *beside)))
    if command == "triangulate" and option in ("--world-from-camera", "--camera-from-world"):
        return require(obeyed.status == 2 and option in obeyed.err, "puts two cameras on one pose", obeyed)
    like = ran(command, expected, beside)
    require(obeyed.status == like.status and obeyed.out == like.out, "is not the camera with that field", obeyed, like)
    require(obeyed.status in (0, BAD.get(command, 0)) or option[2:] in obeyed.err, "fails", obeyed)
    if option in UNSEEN.get(command, ()):
        wrong = ran(command, document, (f"{option}={{",))
        require(wrong.status and option in wrong.err, "is not read: a value that is none is not refused", obeyed, wrong)
    else:
        require((before.out, before.err) != (obeyed.out, obeyed.err), "changes nothing", before, obeyed)


# ---- What else there is: the commands, what is typed, and what it does

ROWS = {}


def row(commands, typed, judge, document=LENS, beside=None, records=None):
    option, *value = typed.split(" ", 1)
    words = value and (value[0].split(" ") if " --" in value[0] else value)
    for command in commands.split() if isinstance(commands, str) else commands:
        ROWS[command, option] = ((option, *words), judge, document, beside, records)


def says(pattern):
    """What is written has this, and had not without the option."""
    def judge(before, after, _):
        require(after.status in (0, 1) and re.search(pattern, after.out), f"does not say {pattern}", after)
        require(not re.search(pattern, before.out), f"says {pattern} without the option", before)
    return judge


def same(document=LENS, beside=None, records=None, whole=True):
    """The output (but for its header) is that of this other command line, and was not without the option."""
    def judge(before, after, command):
        other = ran(command, document, (), beside, records)
        one, two = (after.out, other.out) if whole else (after.body, other.body)
        require(fine(command, after) and after.status == other.status and one == two, "is not the same as", after, other)
        require(before.out != after.out, "changes nothing", before, after)
    return judge


def alike(bad):
    """What is written stays, since the option is of time or memory; a value that is none is refused."""
    def judge(before, after, command):
        require(before.out == after.out and before.status == after.status == 0, "changes the output", before, after)
        wrong = ran(command, LENS, (bad,))
        require(wrong.status == 2 and bad.split("=")[0] in wrong.err, "is not refused", wrong)
    return judge


def holds(what, test):
    return lambda before, after, _: require(test(before, after), what, before, after)


def fails_as(pattern):
    """The input cannot be read so."""
    return lambda before, after, command: require(fine(command, before) and after.status and re.search(pattern, after.err),
                                            f"does not fail by {pattern}", before, after)


def most_digits(text):
    return max(len(n.replace(".", "").strip("0")) for n in re.findall(r"(?<![\w.])-?(\d+(?:\.\d+)?)", text))


def digits(before, after, command):
    require(fine(command, after) and most_digits(before.out) > 3 >= most_digits(after.out), "has more digits", before, after)


def matrix(name, result):
    return json.loads(result.out)[name]


def place(result):
    return json.loads(result.out)["position"]


def floats(numbers):
    return [struct.unpack("f", struct.pack("f", number)) for number in numbers]


def last(result):
    return float(result.body.split(",")[-1])


def differs(before, after, _):
    require(before.status == after.status == 0 and before.out != after.out, "changes nothing", before, after)


STREAMS = ["project", "ray", "cull"]
READERS = [*STREAMS, "check", "measure", "draw", "fit", "triangulate"]
REPORTS = ["check", "info", "footprint", "explain", "depth", "measure"]
SET = several(LENS)


def compact(**members):
    return json.dumps(members, separators=(",", ":"))


BALL = {"id": "ball", "sphere": {"center": [0, 0, 0], "radius": 1}}
FLOOR = {"id": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}
OWN = {command: BASES[command][1] for command in READERS}
VALUES = [1, 1, 1, 300, 200, 0.5, 1, 0, 320, 240, 0, 0, 1, 310, 250]
NUMBERED = {"ray": "1,2", "check": "x=1,y=2,z=3,u=4,v=5", "triangulate": "u1=1,v1=2,u2=3,v2=4"}
NOTED = changed(LENS, {"projection.fovY": 1.2, "projection.far": 1000})
# 4 by 3 pixels
PHOTO = "iVBORw0KGgoAAAANSUhEUgAAAAQAAAADCAAAAACRn/EaAAAADklEQVR4nGNoAAIGOAEALQ8GAa0C414AAAAASUVORK5CYII="
BESIDE = {"direction": [0, 0, -1], "viewport": SEEN["viewport"], "projection": {"type": "perspective", "fovY": 90},
          "cameras": [{"name": "abcd"[x], "position": [x, 0, 5]} for x in range(4)]}
APART = "point,camera,u,v\np,a,300,200\nq,a,320,240\np,b,290,205\nq,b,350,235\n"
BY_POINT = "point,camera,u,v\np,a,300,200\np,b,290,205\nq,a,320,240\nq,b,350,235\n"


def written(before, after, command):
    """-o: what would be written stands in the file."""
    there = timeless(pathlib.Path(command + ".out").read_bytes())
    require(after.status == before.status and not after.out and there == before.out, "is not in the file", before, after)


def quiet(before, after, _):
    require("note:" in before.err and not after.err and before.out == after.out, "notes", before, after)


def goes_on(before, after, _):
    require(before.status and after.status and len(before.out) < len(after.out), "does not go on", before, after)


def as_usual(before, after, command):
    """These records are read as the command's own."""
    usual = ran(command, LENS)
    require(fine(command, after) and after.body.replace("|", ",") == usual.body, "reads other records than", after, usual)
    require(after.out != before.out, "changes nothing", before, after)


def as_json(before, after, _):
    require(json.loads(after.out) and before.out != after.out, "is no JSON", after)


def unchanged(before, after, _):
    require(before.out == after.out and before.status == after.status == 0, "changes the output", before, after)


def fewer(before, after, _):
    require(set() < set(after.out.splitlines()) < set(before.out.splitlines()), "is no part", before, after)


row(EVERY, "--help", lambda _, after, command: require(after.out == run("help", (command,), "").out, "is another help", after))
row(CAMERAS, "--quiet", quiet, NOTED)
row(STATELESS, "--quiet", unchanged)  # they have no notes
for command in EVERY:
    row(command, f"--output {command}.out", written)


# Records
VALUES = [1, 1, 1, 300, 200, 0.5, 1, 0, 320, 240, 0, 0, 1, 310, 250]
PACKED, LINES = struct.pack("<15d", *VALUES), re.sub(r"((?:\S+ ){5})", r"\1\n", " ".join(map(str, VALUES)) + " ")
NUMBERED = {"ray": "1,2", "check": "x=1,y=2,z=3,u=4,v=5", "triangulate": "u1=1,v1=2,u2=3,v2=4"}
RENAMED = {
    "project": ("e,n,h", "e,n,h"),
    "ray": ("e,n,depth", "x=e,y=n,depth=depth"),
    "cull": ("e,n,h,radius", "x=e,y=n,z=h,radius=radius"),
    "check": ("e,n,h,p,q", "x=e,y=n,z=h,u=p,v=q"),
    "measure": ("e,n,h", "x=e,y=n,z=h"),
    "draw": ("e,n,h,u,v,name", "x=e,y=n,z=h,u=u,v=v"),
    "fit": ("e,n,h", "e,n,h"),
    "triangulate": ("a,b,c,d", "u1=a,v1=b,u2=c,v2=d"),
}
for command, text in OWN.items():
    head, first, *rest = text.splitlines()
    row(command, "--keep-going", goes_on, records="\n".join([head, "?" + first[1:], first, *rest, ""]))
    row(command, "--delimiter |", as_usual, records=text.replace(",", "|"))
    row(command, "--from json", fails_as("an array of numbers or an object"))
    row(command, f"--columns {RENAMED[command][1]}", as_usual, records="\n".join([RENAMED[command][0], first, *rest, ""]))
    columns = f"{BASES[command][0]} --columns {NUMBERED.get(command, '1,2,3')}" + " --to ndjson" * (command in STREAMS)
    row(command, "--width 5", same(LENS, columns + " --from text", LINES, whole=False), LENS, columns + " --from f64", PACKED)
row([*STREAMS, "triangulate"], "--prefix p_", says("p_(screen|origin|cull|position)"))
row([*STREAMS, "triangulate"], "--no-header", holds("has a header", lambda before, after: after.out == before.body))
row([*STREAMS, "triangulate"], "--to json", as_json)
row(["project", "ray", "triangulate", *REPORTS], "--digits 3", digits)
row(STREAMS, "--jobs 1", alike("--jobs=0"))
row("project cull", "--visible", fewer)
for command in (*STREAMS, "check"):
    head, *lines = OWN[command].splitlines()
    named = "\n".join([head + ",camera", *(line + ",b" for line in lines), ""])
    like_b = same(SET["cameras"][1], None, named) if command != "check" else says(r'"camerasMended"|"cameras": \[')
    row(command, "--camera-by camera", like_b, SET, records=named)
for command in STREAMS:
    head, *lines = OWN[command].splitlines()
    opened = "\n".join([head + ",fovY", *(line + ",50" for line in lines), ""])
    row(command, "--camera-in-record", same(changed(LENS, {"projection.fovY": 50}), None, opened), records=opened)
    row(command, "--each-camera", holds("is not each", lambda before, after:
        before.status and not after.status and re.search(",a,.*\n.*,b,", after.out)), SET)

# Points, pixels and shapes in place of FILE
row("project cull measure draw fit", "--point 1,1,1", same(records='{"position":[1,1,1]}'))
row("explain", "--point 1,1,1", says('"point": \\[1, 1, 1\\]'), beside="--to json")
row("check", "--point 1,1,1", same(records='{"position":[1,1,1],"pixel":[300,200]}'), beside="--to json --pixel 300,200")
row("ray", "--pixel 300,200", same(records='{"screen":[300,200]}'))
row("explain", "--pixel 300,200", says('"pixel": \\[300, 200\\]'), beside="--to json")
row("check", "--pixel 300,200", same(records='{"position":[1,1,1],"pixel":[300,200]}'), beside="--to json --point 1,1,1")
row("draw", "--pixel 300,200", says("300, ?200"))
row("cull", "--sphere 1,1,1,2", same(records='{"sphere":{"center":[1,1,1],"radius":2}}'))
row("cull", "--box 0,0,0,1,1,1", same(records='{"box":{"min":[0,0,0],"max":[1,1,1]}}'))
row("ray", f"--scene {compact(objects=[BALL])}", says("ball"), beside="--to ndjson")
row("draw", f"--scene {compact(objects=[BALL])}", says("ball"))
row("fit", f"--scene {compact(objects=[BALL])}", same(records=compact(sphere=BALL["sphere"])))
row("ray", "--all-hits", says("floor.*ball|ball.*floor"), beside=f"--scene {compact(objects=[BALL, FLOOR])} --to ndjson")
row("ray", "--plane z=0", says("hit"), beside="")
row("footprint", "--plane z=1", same(beside="--plane 0,0,1,-1 --max-distance 40 --to json"))
row("ray", "--height 1", same(LOCAL, beside="--plane z=1 --fields origin,hit"), LOCAL, beside="--fields origin,hit")
row("footprint", "--height 1", same(LOCAL, "--plane z=1 --to csv --max-distance 40"), LOCAL, "--to csv --max-distance 40")
row("ray footprint draw info", "--altitude 400", same(EARTH, beside="--geoid 50 --height 450"), EARTH, beside="--geoid 50")
row("info", "--height 0", says('"horizon": {'), LOCAL)
row("draw", "--height 0", says("ground"), LOCAL)


# A model, another world, and what is written
MODEL = '{"translation":[0.5,0,0]}'
MOVED = changed(LENS, {"position": [2.5, 2, 5], "target": [-0.5, 0, 0]})
row("project", f"--model {MODEL}", same(LENS, "--to text", "1,0.25,1\n-0.5,0.5,-3\n0.5,0,0.5\n0.5,1,9\n"), LENS, "--to text")
row("ray", f"--model {MODEL}", same(MOVED, "--to text --digits 9"), LENS, "--to text --digits 9")
row("explain", f"--model {MODEL}", says('"world.x".*"value": 1,'))
row("matrix", f"--model {MODEL}", says('"modelViewProjection"'))
row("matrix", "--map x,z,-y", same(changed(LENS, {"position": [3, 5, -2], "up": [0, 0, -1]})))
row("convert", "--map x,z,-y", says(r'"position": \[3, 5, -2\]'))
row("matrix", "--scale 10", says(r"-61\.644"))
row("convert", "--scale 10", says(r'"position": \[30, 20, 50\]'))
row("convert", "--angles YXZ", says(r'"euler": {"order": "YXZ", "degrees": \[30.96'))
row("info", "--angles YXZ", says(r'"order": "YXZ", "degrees": \[30.96'))
row("matrix", "--inverse", says('"viewInverse"'))
row("matrix", "--which view", holds("writes others", lambda _, after: [*json.loads(after.out)] == ["convention", "view"]))
row("matrix", "--bake-viewport", holds("is not baked", lambda before, after: matrix("view", before) == matrix("view", after)
                                       and matrix("projection", after)[0][0] == 320 * matrix("projection", before)[0][0]))
row("matrix", "--relative-to-eye", says('"eye": \\[3, 2, 5\\]'))
row("matrix", "--float", holds("is not float32", lambda before, after:
    floats(matrix("view", before)[0]) == floats(matrix("view", after)[0]) and most_digits(after.out) <= 9))
row("matrix", "--all", holds("is not all", lambda before, after: before.status and after.out.count('"view": [') == 2), SET)
row("matrix", "--to c", says(r"view\[16\]"))
row("convert", "--to opencv", says("camera_matrix"))
row("info", "--which K", holds("reads no K", lambda before, after: before.out != after.out and
    [reading["kind"] for reading in json.loads(after.out)["matrices"][0]["readings"]] == ["K"]),
    None, "--to json", records="K: [500 0 320; 0 500 240; 0 0 1]\n")
row("info", "--at 2,4", says(r'"distance": 4,'))
row("depth", "--at 2,4", says(r'"distance": 4,'))
row("depth", "--gap 0.5", says(r'"d16": 0.07547'), beside="--at 50 --to json")
row("depth", "--depth 0.5", says(r'"depths": \[{"depth": 0.5, "distance": 0.19'))
row("check", "--within 999", says('"agrees": true'))
row(REPORTS, "--to csv", holds("is no CSV", lambda before, after: "," in after.out.split("\n")[0] and "{" not in after.out))
row("project", "--precision standard", differs, beside="--fields bound")
row("project ray", "--fields viewDistance", holds("are others", lambda _, after:
    after.out.split("\n")[0].endswith(",view_distance")), beside="")
row("triangulate", "--fields misses", says('"misses":\\['), beside="--to json")
row("triangulate", "--camera-by camera --by point", says("\np,0[.]38.*\nq,"), SET, records=BY_POINT)
row("triangulate", "--by point", says("p,|q,"), SET, beside="--camera-by camera", records=BY_POINT)
row("triangulate", "--sorted", says(r"(\np,.*\nq,.*){2}"), SET, "--camera-by camera --by point", APART)
row("triangulate", "--robust", says(r"\np,[^,]*,[^,]*,[^,]*,,3,"), BESIDE, "--camera-by camera --by point",
    "point,camera,u,v\np,a,320,240\np,b,272,240\np,c,224,240\np,d,200,250\n")
row("triangulate", "--noise 2", holds("is no noise", lambda before, after: last(after) == 2 * last(before)))
row("footprint", "--max-distance 9", says('"cut": \\["distance"'), beside="--plane z=0 --to json")
row("footprint", "--error 0.1", holds("has as many vertices", lambda before, after:
    before.out.count('"x"') > after.out.count('"x"')), BROWN)
row("fit", "--by fov", holds("moves", lambda before, after: place(after) == [3, 2, 5] != place(before)))
row("fit", "--margin 20%", holds("has no margin", lambda before, after: place(after)[2] > place(before)[2]))
row("draw", "--stems", says("down to the ground"), LOCAL, "--height 0")
row("draw", "--label v", says(">180<"))
row("draw", "--title Anders", says("Anders"))
row("draw", "--picture photo.png", says("data:image/png;base64"), changed(LENS, {"viewport.width": 4, "viewport.height": 3}))
pathlib.Path("photo.png").write_bytes(base64.b64decode(PHOTO))

# How a camera is read, and in which convention it is written
TYPED = "--position 3,2,5 --target 0,0,0 --fov-y 60 --viewport 640x480 --near 0.1 --far 100"
ROWS_OF_4 = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -6], [0, 0, 0, 1]]
PARTED = {"convention": "opencv", "worldFromCamera": ROWS_OF_4, "viewport": SEEN["viewport"],
          "projection": {"type": "intrinsics", "fx": 500, "fy": 500, "cx": 320, "cy": 240, "pixels": [640, 480]}}
PARTS = {"A": [[500, 0, 320], [0, 500, 240], [0, 0, 1]], "w": 640, "h": 480, "T": ROWS_OF_4}


def kept(width):
    def judge(_, after, __):
        window = json.loads(after.out)["projection"]
        require(abs(window.get("width", window.get("right", 0) - window.get("left", 0)) - width) < 1e-9, "is not kept", after)
    return judge


def stretched(before, after, command):
    if command != "depth":  # has no picture to stretch
        require(before.status and "--allow-stretch" in before.err, "has no mend", before)
    require(fine(command, after), "is no leave", before, after)


for command in CAMERAS:
    extras = BASES[command][0]
    if command != "triangulate":
        row(command, f"--camera {json.dumps(LENS)}", same(None, f"{TYPED} {extras}"), None, extras)
    needs = " --near 1 --far 90"
    row(command, "--parts K=A,size=w+h,worldFromCamera=T", same(PARTED, extras + needs), PARTS, extras + needs)
    row(command, "--allow-stretch", stretched, changed(LENS, {"projection.aspect": 1}))
    if command in ("info", "depth", "footprint"):
        row(command, "--convention d3d", same(changed(LENS, {"convention": "d3d"})), None, f"{TYPED} {extras}")
    elif command not in ("project", "matrix", "convert", "explain"):
        row(command, "--convention d3d", lambda _, after, __: require(
            after.status == 2 and "--read-as d3d" in after.err, "does not say what to do", after))
row("triangulate", f"--camera {json.dumps(SET)}", same(SET), None)
row("triangulate", "--parts K=A,size=w+h,worldFromCamera=T", lambda _, after, __: require(
    "two cameras" in after.err, "is another camera", after), None, f"-c {compact(**PARTS)}")
row("convert", "--geoid 50", holds("is no mend", lambda before, after:
    before.status == 2 and "--geoid" in before.err and not after.status), CAMERA["--geoid"]("")[1])
row("fit", "--ortho-width 12", kept(12), changed(BOX, {"projection.height": None}))
row("fit", "--ortho-height 9", kept(12), changed(BOX, {"projection.width": None}))
for command in ("project", "matrix", "convert", "explain"):
    row(command, "--convention d3d", differs)
    row(command, "--reverse-z", differs)
    row(command, "--no-reverse-z", differs, changed(LENS, {"convention": {"preset": "opengl", "reverseZ": True}}))
    row(command, "--ndc-z 0..1", differs)
for command in ("ray", "info", "depth"):
    reversed_as = BASES[command][0].replace("--plane z=0 --fields origin,direction,point,range,hit", "--fields point")
    row(command, "--reverse-z", same(changed(LENS, {"convention": {"preset": "opengl", "reverseZ": True}}), reversed_as),
        None, f"{TYPED} {reversed_as}")


LISTS = ["--to", "--fields", "--by", "--precision", "--which"]


def listed(page, option):
    """The names that help lists for the option's value."""
    text = re.search(rf"^  {option} .*?(?=^  -|^$)", page, re.M | re.S)
    found = re.search(r": ([\w-]+(?:,\s+[\w-]+)+)", text[0]) if text else None
    return re.split(r",\s+", found[1]) if found else []


def each_name(command, option, known):
    """Each name that help lists makes another output than the others, or has a message."""
    beside = "" if option == "--fields" else re.sub(rf"{option} \S+", "", BASES[command][0])
    runs = [ran(command, LENS, (option, name), beside) for name in known]
    taken = [result for result in runs if not result.err]
    require(len({result.out for result in taken}) == len(taken) > 1, "two names make the same output", *taken)


def main():
    jobs = []
    for command in EVERY:
        page = run(command, ("--help",), "").out
        options = [word for line in re.findall(r"^  (-\S.*?)(?:  .*)?$", page.split("\nExample")[0], re.M)
                   for word in re.findall(r"(?<!\S)(?:-\w,)?(--[\w-]+)", line)]
        for option in options:
            jobs.append((command, option, lambda c, o: row_of(c, o) if (c, o) in ROWS else field_of(c, o)))
            known = listed(page, option) if option in LISTS and command != "info" else []
            if known:
                jobs.append((command, option, functools.partial(each_name, known=known)))

    def judged(job):
        command, option, judge = job
        try:
            require((command, option) in ROWS or option in CAMERA, "has no row")
            judge(command, option)
        except (AssertionError, ValueError, LookupError) as fault:
            return f"{command} {option}: {fault}"
        return ""

    wanted = [job for job in jobs if not WANTED or set(job[:2]) & set(WANTED)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failures = [fault for fault in pool.map(judged, wanted) if fault]
    gone = [" ".join(row) + ": help does not list it" for row in sorted(set(ROWS) - {job[:2] for job in jobs})]
    print(*failures, *gone, sep="\n")
    print(len(wanted), "options and lists,", run.cache_info().currsize, "command lines,", len(failures + gone), "failures")
    shutil.rmtree(FOLDER)
    sys.exit(bool(failures or gone) or not wanted)


main()
