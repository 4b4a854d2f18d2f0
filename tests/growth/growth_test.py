"""Twice the input, twice the work, and in a stream the same memory: every reader, writer and command, bad input included.

    VIEWPROJ_TOOL=build/viewproj python3 growth_test.py [--table] [WORDS]

A row of the table is a path through the tool and a kind of input. Work is counted in instructions, by valgrind, at a
size and at four times that; memory is the peak of runs without valgrind on more of the same. WORDS: only rows whose
names have all of them. --table: print what was counted.
"""
import concurrent.futures
import dataclasses
import os
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Callable, Optional

TOOL = os.path.abspath(os.environ.get("VIEWPROJ_TOOL", "viewproj"))
MOST_SECONDS = 100  # of processor time; what needs more does not grow linearly
TIMES = 4
# Four times the input is four times the work; sorting adds a little, a quadratic term would make it sixteen.
MOST_WORK = 5.2
# What the pipeline and the allocator keep at hand, and the largest sample of it that a longer run may catch.
SLACK = 4 << 20
MOST_KEPT = 4  # bytes for each byte of what is not closed
BIG = 2 << 20  # bytes of input, for the peaks

CAMERA = (
    '{"position":[3,2,5],"target":[0,0,0],"projection":{"type":"perspective","fovY":60,"near":0.1,"far":1000},'
    '"viewport":{"width":1280,"height":720}}'
)
POINT = b'{"id":"p","x":1.5,"y":2.25,"z":-3}'
IDENTITY = "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]"


@dataclasses.dataclass
class Row:
    name: str
    size: int  # n of the smaller run
    arguments: Callable  # of n
    given: Callable  # of n: standard input
    file: Optional[Callable] = None  # of n: the text of "input", or of its files by name, where it is a folder
    status: int = 0
    says: str = ""  # found in what is written, or said
    # Or linear; kept, which is little more than the input itself; unmeasured, where the command line is the input; bounded, where the work does not grow from some size on.
    memory: str = "flat"
    big: int = 0  # n of the smaller run whose peak is taken; 0: BIG bytes

    def kind(self):
        return self.name.split(":")[0]


ROWS = []


def constant(value):
    return lambda n: value


def add(name, size, arguments, given=b"", **more):
    """arguments, given, file: as they are, or functions of n."""
    for key, value in (("arguments", arguments), ("given", given)):
        more[key] = value if callable(value) else constant(value)
    ROWS.append(Row(name, size, **more))


def project(*arguments):
    return ["project", "-c", CAMERA, "--jobs", "1", *arguments]


def ray(*arguments):
    return ["ray", "-c", CAMERA, "--jobs", "1", *arguments]


def cull(*arguments):
    return ["cull", "-c", CAMERA, "--jobs", "1", *arguments]


def lines(record, before=b""):
    return lambda n: before + (record + b"\n") * n


def listed(record, before=b"[", after=b"]"):
    return lambda n: before + b",".join([record] * n) + after


def readers():
    inputs = {
        "lines": lines(POINT),
        "lines that a reader of plain numbers passes on": lines(b'{"x":1.5,"y":2.25,"z":-3,"more":[{"a":null}]}'),
        "indented": lines(b'{\n  "x": 1.5,\n  "y": 2.25,\n  "z": -3\n}'),
        "array": listed(POINT),
        "array of arrays": listed(b"[1.5,2.25,-3]"),
        "document": listed(POINT, b'{"points":[', b"]}"),
        "lines that end in CR": lambda n: (POINT + b"\r\n") * n,
        "shapes of their own": lambda n: b"".join(b'{"a%d":1,"x":1,"y":2,"z":3}\n' % i for i in range(n)),
        "directions, places and segments": lines(
            b'{"direction":[1,2,-3]}\n{"segment":[[0,0,0],[4,2,9]]}\n{"position":[1,2,3]}'
        ),
        "other names": lines(b'{"pos":[1,2,-3]}\n{"X":1,"Y":2,"Z":-3}\n{"location":{"X":1,"y":2,"z":-3},"point":"A12"}'),
        "points as objects": lines(b'{"position":{"x":1,"y":2,"z":-3}}\n{"position":{"z":-3,"y":2,"x":1}}'),
    }
    for kind, text in inputs.items():
        add(f"read json: {kind}", 300, project(), text, says='"screen"|screen_x')
    add("read csv: plain", 300, project(), lines(b"p,1.5,2.25,-3", b"id,x,y,z\n"), says="screen_x")
    add("read csv: quoted line breaks", 300, project(), lines(b'"p\n""q""",1.5,2.25,-3', b"id,x,y,z\n"), says="screen_x")
    for kind, separator in {"semicolons": b";", "tabs": b"\t", "blanks": b" "}.items():
        add(f"read csv: {kind}", 300, project("--delimiter", kind), lines(separator.join([b'"p q"', b"1.5", b"2.25", b"-3"]), separator.join([b"id", b"X", b"Y", b"Z"]) + b"\n"), says="screen_x")
    add("read text: comments", 300, project(), lines(b"# a, b\n1.5 2.25 -3"), says="[0-9]")
    add("read csv: no header", 300, project("--from", "csv"), lines(b"1.5,2.25,-3"), says="687|,")
    add("read text", 300, project(), lines(b"1.5 2.25 -3"), says="inFront|true|[0-9]")
    add("read f64", 20000, project("--from", "f64"), lambda n: struct.pack("<3d", 1.5, 2.25, -3) * n)
    add("read pixels", 300, ray(), lines(b"[640,360]"), says="direction")
    add("read pixels: csv", 300, ray(), lines(b"640,360,0.5", b"x,y,depth\n"), says="direction_x")
    add("cull shapes", 300, cull(), lines(b'{"id":1,"sphere":{"center":[1,1,1],"radius":0.5}}\n[1,2,3]'), says="cull")
    add("read from a file", 300, project("input"), file=lines(POINT), says="screen")


def writers():
    for form in ("ndjson", "json", "csv", "text", "f64", "table"):
        add(f"write {form}", 1200 if form == "table" else 300, project("--to", form), lines(POINT))
        if form not in ("text", "f64"):
            add(f"write {form}: hits", 1200 if form == "table" else 200, ray("--scene", "input", "--to", form),
                lines(b'{"id":"q","x":640,"y":360}'),
                file=constant(b'{"objects":[{"sphere":{"center":[1,1,1],"radius":5}}]}'), says="distance")
            add(f"write {form}: verdicts", 1200 if form == "table" else 300, cull("--to", form), lines(POINT), says="cull")


def bad_records():
    bad = {
        "nothing there": b'{"a":1}',
        "no number": b'{"x":"one","y":2,"z":3}',
        "no JSON": b'{"x":}',
        "NaN": b"[NaN,0,0]",
        "a missing comma": b"[1 2 3]",
        "an overflow": b'{"x":1e400,"y":1,"z":1}',
        "a key twice": b'{"x":1,"x":1,"y":1,"z":1}',
        "an unclosed string": b'{"x":"1',
        "an unclosed bracket": b'{"x":[1',
        "a bracket too many": b'{"x":1}]',
        "a word": b"nothing",
    }
    for kind, record in bad.items():
        for form in ("ndjson", "csv", "table") if kind == "NaN" else ("csv",):
            # A header comes from a good record.
            text = lines(record, POINT + b"\n")
            # What is open may be closed by any later line, and is kept until then, as far as the longest record reaches.
            memory = "kept" if kind.startswith("an unclosed") else "flat"
            add(f"keep going, write {form}: {kind}", 1000, project("--keep-going", "--to", form), text, status=1, says="error|input:|<stdin>", memory=memory)
        add(f"keep going in an array: {kind}", 2000, project("--keep-going"), listed(record, b"[" + POINT + b","), status=1, says="<stdin>", memory=memory)
    add("keep going, all bad, write csv", 400, project("--keep-going", "--to", "csv"), lines(b'{"a":1}'), status=1, says="<stdin>")
    csv = {"few fields": b"1,2", "many fields": b"1,2,3,4", "no number": b"1,two,3", "a lone quote": b'1,"2,3'}
    for kind, record in csv.items():
        add(f"keep going, csv: {kind}", 400, project("--keep-going"), lines(record, b"x,y,z\n1,2,3\n"), status=1, says="<stdin>")
    add("keep going, text: a word", 400, project("--keep-going", "--from", "text"), lines(b"1 2 x", b"1 2 3\n"), status=1, says="<stdin>")
    add("keep going, every other is bad", 200, project("--keep-going"), lines(POINT + b"\n[1]"), status=1, says="<stdin>")


def long_records():
    """One record, whose length is n."""
    more = {"memory": "linear"}
    add("a record of many fields", 2000, project(), lambda n: b'{"x":1,"y":2,"z":3' + b"".join(b',"a%d":1' % i for i in range(n)) + b"}", says="screen", **more)
    add("a record of many fields, write csv", 2000, project("--to", "csv"), lambda n: b'{"x":1,"y":2,"z":3' + b"".join(b',"a%d":1' % i for i in range(n)) + b"}", says="a0", big=200000, **more)
    add("a record of many fields, write table", 2000, project("--to", "table"), lambda n: b'{"x":1,"y":2,"z":3' + b"".join(b',"a%d":1' % i for i in range(n)) + b"}", says="a0", big=200000, **more)
    # Longer than a block: shorter ones are read another way.
    add("a long string", 800000, project(), lambda n: b'{"x":1,"y":2,"z":3,"a":"' + b"x" * n + b'"}', says="screen", **more)
    add("a long string, write csv", 200000, project("--to", "csv"), lambda n: b'{"x":1,"y":2,"z":3,"a":"' + b'\\"x' * n + b'"}', says="screen", **more)
    add("a long string, write table", 200000, project("--to", "table"), lambda n: b'{"x":1,"y":2,"z":3,"a":"' + b"x" * n + b'"}', says="screen", **more)
    add("a deep record", 20000, project(), lambda n: b'{"x":1,"y":2,"z":3,"a":' + b"[" * n + b"]" * n + b"}", says="screen", **more)
    add("a long number", 100000, project(), lambda n: b'{"x":1.' + b"5" * n + b',"y":2,"z":3}', says="screen", **more)
    add("a long number: csv", 100000, project(), lambda n: b"x,y,z\n1." + b"5" * n + b",2,3\n", says="screen", **more)
    add("a long number: text", 100000, project(), lambda n: b"1." + b"5" * n + b" 2 3\n", **more)
    add("many columns", 2000, project(), lambda n: b"x,y,z" + b"".join(b",a%d" % i for i in range(n)) + b"\n1,2,3" + b",1" * n + b"\n", says="a0", big=200000, **more)
    add("many columns, write json", 2000, project("--to", "json"), lambda n: b"x,y,z" + b"".join(b",a%d" % i for i in range(n)) + b"\n1,2,3" + b",1" * n + b"\n", says="screen", big=200000, **more)
    add("many columns of one name", 2000, project(), lambda n: b"x,y,z" + b",a" * n + b"\n1,2,3" + b",1" * n + b"\n", status=1, says="twice|same|column", big=200000, **more)
    add("many keys in an object that may be a point", 2000, project(), lambda n: b'{"x":1,"y":2,"z":3}\n{"pos":{"x":1,"y":2,"z":3' + b"".join(b',"a%d":1' % i for i in range(n)) + b"}}", says="screen", **more)
    add("many columns in blanks", 2000, project("--delimiter", "blanks"), lambda n: b"x y z" + b"".join(b" a%d" % i for i in range(n)) + b"\n1 2 3" + b" 1" * n + b"\n", says="a0", big=200000, **more)
    add("many columns without names", 2000, project("--to", "json"), lambda n: b"x,y,z" + b"," * n + b"\n1,2,3" + b",1" * n + b"\n", says="screen", big=200000, **more)
    add("many columns beside names in another case", 2000, project(), lambda n: b"X,Y,Z" + b"".join(b",a%d" % i for i in range(n)) + b"\n1,2,3" + b",1" * n + b"\n", says="X,Y,Z", big=200000, **more)
    add("a header of many words without coordinates", 2000, project(), lambda n: b",".join(b"a%d" % i for i in range(n)) + b"\n", status=1, says="has no columns", big=200000, **more)
    add("a long cell", 200000, project(), lambda n: b"x,y,z,a\n1,2,3," + b"x" * n + b"\n", says="screen", **more)
    add("many numbers beside one that overflows", 5000, project(), lambda n: b'{"x":1,"y":2,"z":3,"a":[' + b"1e308," * n + b"1e400]}", status=1, says="overflow", **more)
    add("many keys beside one given twice", 2000, project(), lambda n: b'{"x":1,"y":2,"z":3' + b"".join(b',"a%d":1' % i for i in range(n)) + b',"x":1}', status=1, says="twice", **more)
    add("fields in another order, write csv", 2000, project("--to", "csv"),
        lambda n: b"".join(b'{"x":1,"y":2,"z":3%s}\n' % b"".join(b',"a%d":1' % i for i in order) for order in (range(n), range(n)[::-1])), says="a0", big=100000, **more)
    add("nulls and results of many prefixes, write csv", 500, project("--to", "csv", "--fields", "depth"),
        lambda n: b'{"x":1,"y":2,"z":3' + b"".join(b',"P%dscreen":null,"P%ddepth":null,"P%dviewDistance":1,"P%dvisible":true' % (i, i, i, i) for i in range(n)) + b"}\n"
        + b'{"x":1,"y":2,"z":3' + b"".join(b',"P%dscreen":null' % i for i in range(n)) + b"}", says="P0screen_x", big=20000, **more)
    add("documents that are not closed, keep going", 1000, project("--keep-going"), lambda n: b'{"points":[\n' * n, status=1, says="<stdin>", memory="kept")
    add("an unclosed string", 200000, project(), lambda n: b'{"a":"' + b"x" * n, status=1, says="<stdin>", **more)
    add("unclosed brackets", 100000, project(), lambda n: b"[" * n, status=1, says="<stdin>", **more)
    add("unclosed brackets, keep going", 50000, project("--keep-going"), lambda n: b"[" * n, status=1, says="<stdin>", **more)
    add("unclosed braces", 50000, project("--from", "json"), lambda n: b'{"a":' * n, status=1, says="<stdin>", **more)
    add("brackets that close nothing", 50000, project("--from", "json"), lambda n: b"]" * n, status=1, says="<stdin>", **more)
    add("brackets that close nothing, keep going", 2000, project("--from", "json", "--keep-going"), lambda n: b"]\n" * n, status=1, says="<stdin>")
    add("an unclosed quote", 200000, project(), lambda n: b'x,y,z\n1,2,"' + b"x" * n, status=1, says="<stdin>", **more)
    add("an unclosed quote, lines", 20000, project("--keep-going"), lambda n: b'x,y,z\n1,2,"' + b"1,2,3\n" * n, status=1, says="<stdin>", **more)
    add("a line of many words, columns by number", 5000, project("--from", "text", "--columns", "2,3,4", "--to", "json"), lambda n: b"a 1 2 3" + b" b" * n, says="column5", big=200000, **more)
    add("an array of much, columns by number", 5000, project("--columns", "2,3,4"), lambda n: b"[0,1,2,3" + b',"b"' * n + b"]", says="column5", big=200000, **more)
    add("many columns without a header, by number", 2000, project("--columns", "2,3,4", "--to", "json"), lambda n: b"a,1,2,3" + b",b" * n + b"\n", says="column5", big=200000, **more)
    add("many fields, one of them asked for is not there", 2000, project("--columns", "E,N,U"), lambda n: b'{"x":1' + b"".join(b',"a%d":1' % i for i in range(n)) + b"}", status=1, says="no field E", big=200000, **more)
    add("a line of many words", 5000, project("--from", "text"), lambda n: b"1 " * n, status=1, says="<stdin>", **more)


def white_space():
    for kind, blank in (("blanks", b" "), ("lines", b"\n"), ("tabs and lines", b"\t\r\n")):
        add(f"white space before a record: {kind}", 300000, project("--from", "json"), lambda n, blank=blank: blank * n + POINT, says="screen")
        add(f"white space between records: {kind}", 300000, project(), lambda n, blank=blank: POINT + blank * n + POINT, says="screen")
        add(f"white space in an array: {kind}", 300000, project(), lambda n, blank=blank: b"[" + POINT + blank * n + b"," + POINT + blank * n + b"]", says="screen")
    add("white space before a record", 300000, project("--from", "json"), lambda n: b" " * n + POINT, says="screen")
    add("lines before a header", 300000, project("--from", "csv"), lambda n: b"\n" * n + b"x,y,z\n1,2,3\n", says="screen")
    add("lines between rows", 300000, project("--from", "csv"), lambda n: b"x,y,z\n1,2,3\n" + b"\n" * n + b"1,2,3\n", says="screen")
    add("lines in text", 300000, project("--from", "text"), lambda n: b"1 2 3\n" + b"\n" * n + b"1 2 3\n")


def number_of_matrices(n):
    return "{" + ",".join(f'"m{i}":{IDENTITY}' for i in range(n)) + "}"


def gltf(nodes, cameras='{"type":"perspective","perspective":{"yfov":0.7,"znear":0.1,"aspectRatio":1.5}}', more=""):
    return f'{{"asset":{{"version":"2.0"}},"cameras":[{cameras}],"nodes":[{",".join(nodes)}]{more}}}'.encode()


def frames(frame):
    return lambda n: ('{"w":1280,"h":720,"fl_x":900,"frames":[' + ",".join(frame % {"i": i} for i in range(n)) + "]}").encode()


def three(child, n, last=""):
    """Objects that hang 60 below the scene."""
    text = '{"object":{"type":"Scene","children":[' + '{"type":"Group","children":[' * 60
    return (text + ",".join([child] * n) + last + "]}" * 60 + "]}}").encode()


FRAME = '{"file_path":"f%(i)d","transform_matrix":[[1,0,0,0],[0,1,0,0],[0,0,1,%(i)d],[0,0,0,1]]}'
THREE = '{"type":"PerspectiveCamera","name":"c","fov":50,"zoom":1,"near":0.1,"far":1000,"aspect":1.5,"matrix":%s}' % IDENTITY


def formats():
    """Of each format whose files hold many cameras: a file of n, and the name of one."""
    entries = lambda text: lambda n: ",".join(text % {"i": i} for i in range(n)).encode()
    array = lambda text: lambda n: b"[" + entries(text)(n) + b"]"
    under = lambda before, text, after: lambda n: before + entries(text)(n) + after
    link = lambda i: ',"T_cn_cnm1":[[1,0,0,0.1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]' if i else ""
    chain = lambda n: ("{" + ",".join('"cam%d":{"intrinsics":[90,90,50,50],"resolution":[100,100]%s}' % (i, link(i)) for i in range(n)) + "}").encode()

    def colmap(n, points=""):
        images = "".join(f"{i + 1} 1 0 0 0 {i} 0 0 1 {i}.jpg\n{points}" for i in range(n))
        return {"input/cameras.txt": b"1 PINHOLE 640 480 500 501 320 240\n", "input/images.txt": images.encode()}

    return {
        "glTF": (lambda n: gltf(['{"camera":0,"name":"n%d"}' % i for i in range(n)]), "n5"),
        "glTF, nodes under one": (lambda n: gltf(['{"camera":0,"name":"n%d"}' % i for i in range(n)] + ['{"children":%s}' % list(range(n))]), "n5"),
        "glTF, each node under the one before": (lambda n: gltf(['{"camera":0,"name":"n%d","translation":[1,0,0]%s}' % (i, ',"children":[%d]' % (i + 1) if i < n - 1 else "") for i in range(n)]), "n5"),
        "three.js": (lambda n: three(THREE.replace('"c"', '"c%d"') % n, n), "5"),
        "transforms.json": (frames(FRAME), "f5"),
        "3D Gaussian splatting": (array('{"id":%(i)d,"img_name":"f%(i)d","width":100,"height":100,"fx":90,"fy":90,"position":[0,0,1],"rotation":[[1,0,0],[0,1,0],[0,0,1]]}'), "f5"),
        "an Open3D trajectory": (under(b'{"parameters":[', '{"extrinsic":%s,"intrinsic":{"width":100,"height":100,"intrinsic_matrix":[90,0,0,0,90,0,50,50,1]}}' % IDENTITY, b"]}"), "5"),
        "RealSense": (under(b"{", '"s%(i)d":{"fx":90,"fy":90,"ppx":50,"ppy":50,"width":100,"height":100,"model":"none","coeffs":[0,0,0,0,0]}', b"}"), "s5"),
        "Kalibr, a chain": (chain, "cam5"),
        "COLMAP": (lambda n: colmap(n, "1.5 2.5 -1 3.5 4.5 7\n"), "5.jpg"),
    }


def documents():
    def document(name, size, arguments, text, status=0, says="", **more):
        more.setdefault("memory", "linear")
        add(f"document: {name}", size, arguments, file=text, status=status, says=says, **more)

    def camera(name, size, text, pick="", status=0, says="", arguments=(), **more):
        document(name, size, ["matrix", "-c", "input" + pick, "--which", "view", *arguments], text, status, says or "view", **more)

    def with_field(field):
        return lambda n: (CAMERA[:-1] + "," + field(n) + "}").encode()

    sphere = '{"id":"s%d","sphere":{"center":[1,1,1],"radius":%d}}'
    scene = lambda n: ('{"objects":[' + ",".join(sphere % (i, i + 1) for i in range(n)) + "]}").encode()
    document("scene objects", 500, ray("--pixel", "1,1", "--scene", "input"), scene, says="hit")
    document("scene objects, all hits", 500, ray("--pixel", "640,360", "--all-hits", "--scene", "input"), scene, says="s1")
    document("scene objects, the last has no shape", 500, ray("--pixel", "1,1", "--scene", "input"),
             lambda n: scene(n)[:-2] + b',{"id":1}]}', 1, "needs a shape")
    document("scene with a key twice at its end", 500, ray("--pixel", "1,1", "--scene", "input"), lambda n: scene(n)[:-1] + b',"objects":[]}', 1, "given twice")
    node = '{"name":"n%d","translation":[1,2,3]}'
    camera("glTF nodes", 500, lambda n: gltf([node % i for i in range(n)] + ['{"camera":0,"name":"c"}']), "#c")
    camera("glTF nodes in a chain", 500, lambda n: gltf(['{"children":[%d],"translation":[1,0,0]}' % (i + 1) for i in range(n)] + ['{"camera":0,"name":"c"}']), "#c")
    camera("glTF nodes under one", 500, lambda n: gltf([node % i for i in range(n)] + ['{"camera":0,"name":"c"}', '{"children":%s}' % list(range(n + 1))]), "#c")
    camera("glTF nodes in a circle", 500, lambda n: gltf(['{"children":[%d],"translation":[1,0,0]}' % (i + 1) for i in range(n)] + ['{"camera":0,"name":"c","children":[0]}']), "#c", 1, "among its own descendants")
    camera("glTF, the last node is no object", 500, lambda n: gltf([node % i for i in range(n)] + ['{"camera":0}', "1"]), "", 1, "expected an object")
    camera("glTF, a camera on many nodes", 300, lambda n: gltf(['{"camera":0}'] * n, '{"name":"%s","type":"%s"}' % ("x" * n, "y" * n)), "#x", 1, "has no camera 'x'", big=20000)
    document("list: glTF", 300, ["info", "input"], lambda n: gltf(['{"camera":0,"name":"n%d"}' % i for i in range(n)]), says="n5 ")
    document("list: transforms.json", 300, ["info", "input"], frames(FRAME), says="f5 ")
    document("list: three.js", 200, ["info", "input"], lambda n: three(THREE, n), says="5 ", big=20000)
    camera("glTF, many cameras of one name", 500, lambda n: gltf(['{"camera":0,"name":"c"}'] * n), "#c", 1, "called 'c'")
    camera("glTF, many cameras and none picked", 500, lambda n: gltf(['{"camera":0,"name":"c%d"}' % i for i in range(n)]), "", 1, "pick one")
    camera("transforms.json, frames", 300, frames(FRAME), "#f7")
    camera("transforms.json, the last frame is bad", 300, lambda n: frames(FRAME)(n)[:-2] + b',{"file_path":"last","transform_matrix":[[1,2],[3]]}]}', "#last", 1, "4 rows of 4")
    yaml_frames = lambda n: ("w: 100\nh: 100\nfl_x: 90\nframes:\n" + "".join(f"- file_path: f{i}\n  transform_matrix:\n  - [1, 0, 0, {i}]\n  - [0, 1, 0, 2]\n  - [0, 0, 1, 3]\n" for i in range(n))).encode()
    camera("transforms.json in YAML, frames", 300, yaml_frames, "#f7")
    camera("transforms.json in YAML, the last frame is bad", 300, lambda n: yaml_frames(n) + b"- file_path: last\n  transform_matrix: [[1,2],[3]]\n", "#last", 1, "4 rows of 4")
    camera("YAML, a key twice, far down", 1000, lambda n: ("name: a\n" + "".join(f"a{i}: {{b: 1}}\n" for i in range(n)) + "name: b\n").encode(), "", 1, "'name' is given twice")
    camera("YAML, anchors and aliases", 1000, lambda n: ("a: &a {b: [1, 2, 3]}\n" + "".join(f"a{i}: [*a] # and more of it\n" for i in range(n))).encode(), "", 1, "not a camera file of a known kind")
    for kind, (text, pick) in formats().items():
        document(f"--all of {kind}", 200, ["matrix", "--all", "--which", "view", "input"], text, says='"camera"')
        document(f"list: {kind}, all that it holds", 200, ["info", "input"], text, says="(intrinsics|perspective)")
        camera(f"one of {kind}", 500, text, "#" + pick)
    camera("KITTI, with lines of other sensors", 500, lambda n: ("P0: 90 0 50 0 0 90 50 0 0 0 1 0\n" + "".join(f"Tr_{i}: 1 2 3 4\n" for i in range(n))).encode(), "#P0", arguments=("--viewport", "100x100"))
    camera("ROS, with other fields", 500, lambda n: ("width: 100\nheight: 100\nK: [90, 0, 50, 0, 90, 50, 0, 0, 1]\nP: [90, 0, 50, 0, 0, 90, 50, 0, 0, 0, 1, 0]\nD: [0]\n" + "".join(f"a{i}: {{b: 1}}\n" for i in range(n))).encode(), "#raw")
    camera("COLMAP, a long line of points", 5000, lambda n: {"input/cameras.txt": b"1 PINHOLE 640 480 500 501 320 240\n", "input/images.txt": b"1 1 0 0 0 0 0 0 1 a.jpg\n" + b"1.5 2.5 -1 " * n + b"\n"}, "#a.jpg", memory="bounded")
    document("--all of transforms.json, the last is bad", 300, ["matrix", "input", "--all", "--which", "view"], lambda n: frames(FRAME)(n)[:-2] + b",7]}", status=1, says="expected an object")
    document("--all of transforms.json whose cameras are bad", 300, ["matrix", "input", "--all"], frames(FRAME.replace("{", '{"fl_x":"no",', 1)), status=1, says="frames.5.fl_x: expected")
    document("list: transforms.json whose cameras are bad", 300, ["info", "input"], frames(FRAME.replace("{", '{"fl_x":"no",', 1)), says="cannot be read: input: frames.5.fl_x")
    camera("a calibration of many flags", 500, lambda n: ('{"K":[900,0,640,0,900,360,0,0,1],"width":1280,"height":720,' + ",".join(f'"ftheta{i}":0' for i in range(n)) + "}").encode())
    document("--all of transforms.json whose distortion is ignored", 200, ["matrix", "input", "--all", "--ignore-distortion"], frames(FRAME.replace("{", '{"k1":0.1,', 1)), says="f5")
    camera("three.js", 200, lambda n: three(THREE, n), "#5", big=20000)
    camera("three.js, no camera", 300, lambda n: three('{"type":"Mesh"}', n), "", 1, "holds no camera", big=20000)
    camera("three.js, many bare objects", 1000, lambda n: three("{}", n), "", 1, "holds no camera", big=50000)
    camera("OpenCV, coefficients", 5000, lambda n: ('{"K":[[900,0,640],[0,900,360],[0,0,1]],"width":1280,"height":720,"dist":[' + ",".join(["0"] * n) + "]}").encode())
    camera("OpenCV, a K of many numbers", 2000, lambda n: ('{"width":9,"height":9,"K":[' + ",".join(["[0,1]"] * n) + "]}").encode(), "", 1, "not a camera file of a known kind")
    camera("matrices beside others", 400, lambda n: ('{"view":%s,"projection":[2,0,0,0,0,2,0,0,0,0,-1.002,-1,0,0,-0.2,0],"convention":"opengl",' % IDENTITY + number_of_matrices(n)[1:]).encode())
    camera("comments", 20000, with_field(lambda n: "/* a */ // b\n" * n + '"name":"n"'))
    camera("comments that do not end", 50000, with_field(lambda n: "/* " * n), "", 1, "not valid JSON")
    camera("slashes that are no comments", 50000, with_field(lambda n: '"name":"n"' + "/ " * n), "", 1, "not valid JSON")
    camera("a field under two names, one long", 20000, with_field(lambda n: '"from":{"lat":1,"x":[' + "1," * n + "1]}"), "", 1, "is there too; keep one")
    camera("unknown keys", 1000, with_field(lambda n: ",".join(f'"a{i}":{{"b":1}}' for i in range(n))), "", 1, "is not known")
    camera("a long unknown key", 100000, with_field(lambda n: f'"{"k" * n}":1'), "", 1, "is not known")
    camera("a key twice, far down", 1000, with_field(lambda n: '"name":"a",' + ",".join(f'"a{i}":{{"b":1}}' for i in range(n)) + ',"name":"b"'), "", 1, "'name' is given twice")
    camera("keys given twice", 1000, with_field(lambda n: ",".join(['"name":"a"'] * n)), "", 1, "'name' is given twice")
    camera("keys with escapes", 1000, with_field(lambda n: ",".join(f'"\\u0061{i}":{{"b":1}}' for i in range(n)) + ',"\\u0061"'), "", 1, "not valid JSON")
    camera("many numbers beside one that overflows", 5000, with_field(lambda n: '"name":["1e400",' + "1e308," * n + "1e400]"), "", 1, "overflow parsing '1e400'")
    camera("a long number that overflows", 50000, with_field(lambda n: '"name":' + "9" * n), "", 1, "overflow")
    camera("a long number", 50000, with_field(lambda n: '"name":0.' + "9" * n), "", 1, "expected a text")
    camera("a long name", 200000, with_field(lambda n: f'"name":"{"k" * n}"'))
    camera("a long string that is none of the known", 100000, with_field(lambda n: f'"convention":"{"k" * n}"'), "", 1, "convention.preset: is not known")
    camera("arrays in arrays, no deeper than is read", 100, lambda n: gltf(['{"camera":0}'], more=',"extras":[%s]' % ",".join(["[" * 190 + "1" + "]" * 190] * n)), big=5000)
    camera("arrays nested too deep", 50000, with_field(lambda n: '"name":' + "[" * n), "", 1, "nested deeper", memory="bounded")
    camera("an unclosed string", 200000, with_field(lambda n: '"name":"' + "x" * n), "", 1, "not valid JSON|missing")
    camera("no JSON at its end", 1000, with_field(lambda n: ",".join(f'"a{i}":{{"b":1}}' for i in range(n)) + "x"), "", 1, "not valid JSON")
    camera("white space", 200000, with_field(lambda n: " " * n + '"name":"n"'))
    document("model", 5000, project("--point", "1,1,1", "--model", "input"), lambda n: ('{"translation":[0,1,0],"extras":[' + "1," * n + "1]}").encode(), says="screen")
    document("explain", 300, ["explain", "-c", "input#c", "--point", "1,1,1", "--viewport", "150x100"],
             lambda n: gltf([node % i for i in range(n)] + ['{"camera":0,"name":"c"}']), says="clip")
    document("depth", 300, ["depth", "-c", "input#c"], lambda n: gltf([node % i for i in range(n)] + ['{"camera":0,"name":"c"}']), says="d24")


def inspected():
    def inspect(name, size, text, status=0, says="", arguments=(), big=2000, memory="linear"):
        add(f"inspect: {name}", size, ["inspect", *arguments, "input"], file=text, status=status, says=says, memory=memory, big=big)

    text = lambda n: (("# m\n" + "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n\n") * n).encode()
    bad = lambda n: ("7 " * 16 * n).encode()
    inspect("matrices of JSON", 40, lambda n: number_of_matrices(n).encode(), says="name  m5")
    inspect("matrices of JSON, none known", 100, lambda n: number_of_matrices(n).replace(",1]", ",0]").encode(), 1, "nothing known")
    inspect("matrices of JSON, the last is short", 400, lambda n: (number_of_matrices(n)[:-1] + ',"z":[[1,2],[3]]}').encode(), 1, "expected 16 numbers")
    inspect("matrices of JSON, the last overflows", 400, lambda n: (number_of_matrices(n)[:-1] + ',"z":[1e400]}').encode(), 1, "overflow")
    inspect("JSON without a matrix", 1000, lambda n: ("{" + ",".join(f'"m{i}":[1,2]' for i in range(n)) + "}").encode(), 1, "has no matrix", big=15000)
    # What is told of a matrix is a thousand times its numbers, and is not kept.
    for form in ("table", "json"):
        inspect(f"matrices of text, write {form}", 40, lambda n: b"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n" * n, says="matri", arguments=["--to", form], big=1000, memory="kept")
    inspect("matrices of JSON, write json", 40, lambda n: number_of_matrices(n).encode(), says="entries", arguments=["--to", "json"])
    inspect("matrices of JSON, converted", 40, lambda n: number_of_matrices(n).replace(IDENTITY, "[1,0,0,0,0,1,0,0,0,0,-1.5,-1,0,0,-2.5,0]").encode(), says="storage", arguments=["--convention", "d3d", "--read-as", "opengl"])
    inspect("matrices of JSON, which", 40, lambda n: number_of_matrices(n).encode(), says="m5", arguments=["--which", "m5"])
    inspect("matrices of JSON, which is not there", 1000, lambda n: number_of_matrices(n).encode(), 1, "has no matrix 'q'", arguments=["--which", "q"], big=5000)
    inspect("matrices of long names, which is not there", 10, lambda n: ("{" + ",".join(f'"{"m" * 1000}{i}":{IDENTITY}' for i in range(n)) + "}").encode(), 1, "has no matrix", arguments=["--which", "q" * 90], big=200)
    add("inspect: which, many names", 200, lambda n: ["inspect", "--which", ",".join(f"m{i}" for i in range(n)), "--read-as", "vulkan", "input"],
        file=lambda n: number_of_matrices(n).encode(), says="name  m", memory="linear", big=2000)
    inspect("matrices of text", 40, text, says="name  m")
    inspect("matrices of text, none known", 100, bad, 1, "nothing known")
    inspect("matrices of text, the last is short", 400, lambda n: text(n) + b"1 2 3", 1, "ends after|more than", big=5000)
    inspect("matrices of text, no number", 400, lambda n: text(n) + b"nan", 1, "not a finite number", big=5000)
    inspect("C", 40, lambda n: ("static const float m[4][4] = {{1,0,0,0},{0,1,0,0},{0,0,1,0},{0,0,0,1}};\n" * n).encode(), says="name  m")
    inspect("brackets that are never closed", 20000, lambda n: b"(" * n, 1, "has no numbers", big=200000)
    inspect("words", 100000, lambda n: b"a<" * n, 1, "has no numbers", big=100000)
    inspect("comments", 20000, lambda n: b"/**/" * n, 1, "has no numbers", big=50000)
    inspect("a comment that is never closed", 200000, lambda n: b"/*" + b"\n" * n, 1, "has no numbers", big=200000)
    inspect("a long number", 20000, lambda n: b"0." + b"1" * n, 1, "ends after 1 number", big=200000)
    inspect("a long number that overflows", 20000, lambda n: b"1" * n, 1, "not a finite number", big=200000)
    inspect("declarations", 5000, lambda n: b"m[1]=" * n, 1, "has no numbers", big=50000)


def pictures():
    def draw(name, size, given=b"", arguments=(), says="<svg", **more):
        add(f"draw: {name}", size, arguments if callable(arguments) else ["draw", "-c", CAMERA, *arguments], given, says=says, **more)

    spread = lambda n, text: "".join(text % {"i": i, "x": i * 7 % 101 / 25 - 2, "y": i * 13 % 103 / 25 - 2} for i in range(n)).encode()
    records = {
        "points": '{"id":"p%(i)d","x":%(x)g,"y":%(y)g,"z":0}\n',
        "points in one place": '{"id":"p%(i)d","x":1,"y":1,"z":0}\n',
        "points behind": '{"id":"p%(i)d","x":%(x)g,"y":%(y)g,"z":100}\n',
        "boxes": '{"id":"p%(i)d","box":{"min":[%(x)g,%(y)g,0],"max":[9,9,1]}}\n',
        "segments": '{"id":"p%(i)d","segment":[[%(x)g,%(y)g,0],[1,1,0]]}\n',
        "spheres": '{"id":"p%(i)d","sphere":{"center":[%(x)g,%(y)g,0],"radius":0.1}}\n',
    }
    for kind, text in records.items():
        draw(kind, 20 if kind == "spheres" else 150, lambda n, text=text: spread(n, text), ["-"], memory="linear", big=6000)
    draw("pixels", 200, arguments=lambda n: ["draw", "-c", CAMERA, *[f"--pixel={i * 7 % 1280},{i * 13 % 720}" for i in range(n)]], memory="unmeasured")
    draw("pixels in one place", 200, arguments=lambda n: ["draw", "-c", CAMERA, *["--pixel=640,360"] * n], memory="unmeasured")
    draw("planes", 300, arguments=["--scene", "input"], file=lambda n: ('{"objects":[' + ",".join(['{"plane":{"point":[0,0,0],"normal":[0,1,0]}}'] * n) + "]}").encode(),
         says="has no outline", memory="linear")
    draw("objects", 100, arguments=["--scene", "input"], file=lambda n: ('{"objects":[' + ",".join(['{"triangle":[[0,0,0],[1,0,0],[0,1,0]]}'] * n) + "]}").encode(), memory="linear", big=10000)


def options():
    def many(name, size, arguments, status=0, says="", memory="unmeasured"):
        add(f"options: {name}", size, arguments, status=status, says=says, memory=memory)

    matrix = ["matrix", "-c", CAMERA, "--which", "view"]
    many("--set of one field", 300, lambda n: matrix + ["--set=projection.fovY=50"] * n, says="view")
    many("--set of unknown fields", 300, lambda n: matrix + [f"--set=a{i}=1" for i in range(n)], 1, "is not known")
    many("--set, a long path", 10000, lambda n: matrix + ["--set=" + "a." * n + "a=1"], 1, "is not known")
    many("--set, a long value", 20000, lambda n: matrix + ["--set=name=" + "a" * n], says="view")
    many("--set, a deep value", 10000, lambda n: matrix + ["--set=name=" + "[" * n + "]" * n], 2, "nested deeper")
    many("--point", 200, lambda n: project(*["--point=1,2,3"] * n), says="screen")
    many("--pixel", 200, lambda n: ray(*["--pixel=1,2"] * n), says="direction")
    many("--pixel, bad", 200, lambda n: ray(*["--pixel=1,2,9"] * n), 2, "beyond infinity")
    many("--at", 200, lambda n: ["depth", "-c", CAMERA, "--at", ",".join(f"{i + 1}" for i in range(n))], says="d24")
    many("--columns", 10000, lambda n: project("--columns", "x," * n, "--from", "csv"), 2, "named twice")
    many("--columns, roles", 2000, lambda n: project("--columns", ",".join(f"x{i}=1{i}" for i in range(n)), "--from", "csv"), 2, "too many")
    many("# in the camera's name", 10000, lambda n: ["matrix", "-c", "#" * n], 1, "No such file|too long", memory="bounded")
    many("unknown words", 300, lambda n: ["matrix", *["word"] * n], 2, "was not expected")
    many("a long unknown option", 20000, lambda n: ["matrix", "--" + "x" * n], 2, "was not expected")


def checked():
    pairs = lines(b"1.5,2.25,-3,687,291", b"x,y,z,u,v\n")
    add("check, pairs that disagree", 4000, ["check", "-c", CAMERA], pairs, status=1, says="agrees  *no")
    add("check, pairs that every mistake explains", 4000, ["check", "-c", CAMERA, "--within", "1e9"], pairs, says="agrees  *yes")


def measured():
    add("measure, too few points", 4000, ["measure", "-c", CAMERA], lines(b'{"direction":[1,2,3]}'), status=1, says="has no points", memory="flat")


class Failure(Exception):
    pass


def texts(row, n):
    text = row.file(n) if row.file else {}
    return text if isinstance(text, dict) else {"input": text}


def run(row, n, folder, before=()):
    """How many bytes went in, and the process's peak of memory in bytes."""
    for name, text in texts(row, n).items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(text)
    given = row.given(n)
    arguments = row.arguments(n)
    with open(folder / "out", "w+b") as out, open(folder / "err", "w+b") as err:
        done = subprocess.run([*before, TOOL, *arguments], input=given, stdout=out, stderr=err, cwd=folder, check=False,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS)))
        if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL, 128 + signal.SIGXCPU, 128 + signal.SIGKILL):
            raise Failure(f"n = {n} takes more than {MOST_SECONDS} s")
        said = b""
        for stream in (out, err):
            stream.seek(0)
            said += stream.read(1 << 16)
            stream.seek(max(stream.tell(), stream.seek(0, os.SEEK_END) - (1 << 16)))
            said += stream.read()
    if done.returncode != row.status or not re.search(row.says.encode(), said):
        raise Failure(f"n = {n} ends with {done.returncode} and says {said[:300]!r}")
    return len(given) + sum(map(len, texts(row, n).values())) + sum(len(a) for a in arguments if row.memory == "unmeasured")


def instructions(row, n, folder):
    log = folder / "log"
    size = run(row, n, folder, ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", f"--log-file={log}"])
    return size, int(re.search(r"Collected : (\d+)", log.read_text())[1])


def peak(row, n, folder):
    log = folder / "log"
    size = run(row, n, folder, ["time", "-q", "-f", "%M", "-o", str(log)])
    return size, int(log.read_text()) << 10


def big_size(row):
    """How many make BIG bytes; of a document a quarter of that."""
    if row.big:
        return row.big
    once, twice = (len(row.given(n)) + sum(map(len, texts(row, n).values())) for n in (row.size, 2 * row.size))
    wanted = BIG if row.memory in ("flat", "kept") else BIG // 4
    return max(row.size, row.size * wanted // (twice - once))


def measure(row, least):
    """The line of the table, and what is wrong. least: instructions that any run takes."""
    with tempfile.TemporaryDirectory(prefix="viewproj-growth-") as name:
        folder = Path(name)
        line = {"row": row.name}
        try:
            # A pipe read in many pieces, as on a busy machine, takes up to half as much again: the least of three counts.
            for _ in range(3):
                line["bytes"], counts = zip(*[instructions(row, n, folder) for n in (row.size, TIMES * row.size)])
                line["instructions"] = [min(both) for both in zip(counts, line.get("instructions", counts))]
                small, large = line["instructions"]
                work = (large - least) / (small - least)
                if work <= MOST_WORK:
                    break
            if work > MOST_WORK:
                return line, f"{TIMES} times the input, {work:.1f} times the work"
            # What starting costs may outweigh a small input: each byte has to cost something.
            per_byte = (large - small) / max(1, line["bytes"][1] - line["bytes"][0])
            if work < TIMES / 2 and per_byte < 1 and row.memory != "bounded":
                return line, f"{TIMES} times the input, only {work:.1f} times the work: is it read?"
            if row.memory in ("unmeasured", "bounded"):
                return line, ""
            big = big_size(row)
            line["big"], line["peaks"] = zip(*[peak(row, n, folder) for n in (big, TIMES * big)])
            small, large = line["peaks"]
            most = MOST_WORK * small
            if row.memory == "flat":
                most = small
            elif row.memory == "kept":
                most = small + MOST_KEPT * (line["big"][1] - line["big"][0])
            if large > SLACK + most:
                return line, f"{TIMES} times the input, a peak of {large >> 20} MiB after {small >> 20} MiB"
        except Failure as failure:
            return line, str(failure)
        return line, ""


def shown(line):
    text = f"{line['row'][:70]:70}"
    for unit, keys, size in (("Minstr", ("bytes", "instructions"), 1e6), ("MiB", ("big", "peaks"), 1 << 20)):
        if keys[1] in line:
            for given, value in zip(line[keys[0]], line[keys[1]]):
                text += f"{given / 1000:10.1f} kB {value / size:8.1f} {unit}"
    return text


def main():
    arguments = sys.argv[1:]
    table = "--table" in arguments
    words = [word for word in arguments if not word.startswith("--")]
    for define in (readers, writers, bad_records, long_records, white_space, documents, inspected, pictures, options, checked, measured):
        before = len(ROWS)
        define()
        assert len(ROWS) > before
    assert len({row.name for row in ROWS}) == len(ROWS), "two rows of one name"
    chosen = [row for row in ROWS if all(word in row.name for word in words)]
    missing = [program for program in ("valgrind", "time") if not shutil.which(program)]
    if missing or any(name in Path(TOOL).read_bytes() for name in (b"__asan_init", b"__tsan_init")):
        print(f"skipped: without {' and '.join(missing)}" if missing else "skipped: valgrind runs no sanitized program")
        return 77
    failed = 0
    with tempfile.TemporaryDirectory() as name:
        least = instructions(Row("", 0, constant(["--version"]), constant(b"")), 0, Path(name))[1]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for line, fault in pool.map(lambda row: measure(row, least), chosen):
            if table:
                print(shown(line), flush=True)
            if fault:
                print(f"{line['row']}: {fault}", flush=True)
            failed += bool(fault)
    print(f"{len(chosen)} rows, {failed} of them not as they should be")
    return 1 if failed or not chosen else 0


if __name__ == "__main__":
    sys.exit(main())
