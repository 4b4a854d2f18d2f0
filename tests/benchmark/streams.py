"""The same points through viewproj and through other filters, as ratios of one run.

    python3 tests/benchmark/streams.py [VIEWPROJ [POINTS]]      build/viewproj, 1000000

All have one camera: 4x4 matrix times point, division and viewport; they append screen x, y and depth to each record. Their
first answers are compared with viewproj's. cct has no division: it goes to view coordinates. Programs take turns, ROUNDS times
(5; 0: once, and no times), their output to /dev/null. What is not installed (jq, node, mawk, mlr, cct) is left out with a word.
"""
import array
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

TOOL = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else "build/viewproj")
POINTS = int(sys.argv[2]) if len(sys.argv) > 2 else 1000000
ROUNDS = int(os.environ.get("ROUNDS", 5))
CAMERA = json.dumps({"position": [30, 40, 150], "target": [0, 5, 0], "viewport": {"width": 1920, "height": 1080},
                     "projection": {"type": "perspective", "fovY": 60, "near": 0.1, "far": 1000}})


def matrix(which):
    done = subprocess.run([TOOL, "matrix", "-c", CAMERA, "--which", which], capture_output=True, check=True)
    return json.loads(done.stdout)[which]


def program(x, y, z, assign, join):
    """The formulas in a language of infix operators."""
    w, sx, sy, d = (" + ".join(f"{p} * ({n!r})" for p, n in zip((x, y, z, "1"), row)) for row in (M[3], M[0], M[1], M[2]))
    lines = [assign("w", w), assign("sx", f"(({sx}) / {join}w + 1) / 2 * 1920"),
             assign("sy", f"(1 - ({sy}) / {join}w) / 2 * 1080"), assign("d", f"(({d}) / {join}w + 1) / 2")]
    return " ".join(lines)


def write_points(folder):
    chosen = random.Random(1)
    points = [[chosen.randrange(-50000, 50001) / 1000 for _ in range(3)] for _ in range(POINTS)]
    with open(f"{folder}/p.ndjson", "w") as ndjson, open(f"{folder}/p.csv", "w") as csv, open(f"{folder}/p.text", "w") as text:
        csv.write("id,x,y,z\n")
        for i, (x, y, z) in enumerate(points):
            ndjson.write(f'{{"id":"p{i}","x":{x},"y":{y},"z":{z}}}\n')
            csv.write(f"p{i},{x},{y},{z}\n")
            text.write(f"{x} {y} {z}\n")
    with open(f"{folder}/p.f64", "wb") as file:
        array.array("d", (number for point in points for number in point)).tofile(file)


def contenders():
    """(form, name, command)."""
    project = [TOOL, "project", "-c", CAMERA, "--fields", "screen,depth", "--jobs"]
    for form in ("ndjson", "csv", "text", "f64"):
        extra = ["--from", "f64"] if form == "f64" else []
        yield form, "viewproj", [*project, "1", *extra, f"p.{form}"]
        yield form, "viewproj --precision standard", [*project, "1", "--precision", "standard", *extra, f"p.{form}"]
        yield form, "viewproj --jobs 2", [*project, "2", *extra, f"p.{form}"]
        yield form, "cat", ["cat", f"p.{form}"]
    assign = lambda name, value: f"({value}) as ${name} |"
    yield "ndjson", "jq", ["jq", "-c", program(".x", ".y", ".z", assign, "$") + " . + {screen: [$sx, $sy], depth: $d}", "p.ndjson"]
    script = "const p = JSON.parse(line); " + program("p.x", "p.y", "p.z", lambda name, value: f"const {name} = {value};", "")
    yield "ndjson", "node", ["node", "-e", "const lines = require('fs').readFileSync('p.ndjson', 'utf8').trimEnd().split('\\n');"
                             f"let out = ''; for (const line of lines) {{ {script} p.screen = [sx, sy]; p.depth = d; out += JSON.stringify(p) + '\\n'; }}"
                             "require('fs').writeSync(1, out);"]
    script = program("$2", "$3", "$4", lambda name, value: f"{name} = {value};", "")
    yield "csv", "mawk", ["mawk", "-F,", f'NR > 1 {{ {script} printf "%s,%.17g,%.17g,%.17g\\n", $0, sx, sy, d }}', "p.csv"]
    script = program("$x", "$y", "$z", lambda name, value: f"num {name} = {value};", "")
    yield "csv", "mlr", ["mlr", "--icsv", "--ocsv", "put", script + " $screen_x = sx; $screen_y = sy; $depth = d", "p.csv"]
    affine = [f"+{name}={number!r}" for i, row in enumerate(matrix("view")[:3])
              for name, number in zip([f"s{i + 1}1", f"s{i + 1}2", f"s{i + 1}3", "xyz"[i] + "off"], row)]
    yield "text", "cct, to view coordinates", ["cct", "-d", "12", "+proj=affine", *affine, "p.text"]


def numbers(text, columns=slice(-3, None)):
    """Screen x, y and depth of the first records, or other columns of a text."""
    lines = [line for line in text.decode().splitlines()[:200] if not line.startswith("id")]
    if text.startswith(b"{"):
        return [json.loads(line)["screen"] + [json.loads(line)["depth"]] for line in lines]
    return [[float(n) for n in line.replace(",", " ").split()[columns]] for line in lines]


def first_answers(command, *columns):
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        text = b"".join(process.stdout.readline() for _ in range(101))
        process.stdout.close()
        process.terminate()
    return numbers(text[:text.rindex(b"\n") + 1], *columns)


def timed(command):
    """Seconds by the clock, and of processors."""
    begun = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    assert status == 0, command
    return time.monotonic() - begun, used.ru_utime + used.ru_stime


def main():
    all_of_them = list(contenders())
    absent = sorted({command[0] for _, _, command in all_of_them if not shutil.which(command[0])})
    if absent:
        print("left out:", *absent)
    chosen = [c for c in all_of_them if c[2][0] not in absent]
    screen, view = (first_answers([TOOL, "project", "-c", CAMERA, "--fields", fields, "p.text"]) for fields in ("screen,depth", "view"))
    for form, name, command in chosen:
        if name != "cat" and form != "f64":
            answers = (first_answers(command, slice(3)), view) if command[0] == "cct" else (first_answers(command), screen)
            off = max(abs(a - b) for theirs, own in zip(*answers) for a, b in zip(theirs, own))
            assert off < 1e-9 or "standard" in name, (name, off)
    taken = {i: [timed(command) for i, (_, _, command) in [(i, chosen[i])]] for i in range(len(chosen))}
    for _ in range(ROUNDS - 1):
        for i, (_, _, command) in enumerate(chosen):
            taken[i].append(timed(command))
    print(f"{len(chosen)} commands agree")
    for i in sorted(taken, key=lambda i: chosen[i][0]) if ROUNDS else ():
        form, name, _ = chosen[i]
        clock = sorted(t[0] for t in taken[i])[len(taken[i]) // 2]
        base = sorted(t[0] for t in next(taken[k] for k in taken if chosen[k][0] == form))[len(taken[i]) // 2]
        print(f"{form:7} {name:32} {clock / POINTS * 1e9:9.1f} ns  cpu {min(t[1] for t in taken[i]) / POINTS * 1e9:9.1f} ns"
              f"  ratio {clock / base:6.2f}")


M = matrix("viewProjection")
with tempfile.TemporaryDirectory() as work:
    write_points(work)
    os.chdir(work)
    main()
    os.chdir("/")
