"""What `matrix` writes for a language, that language takes: compiled, evaluated, and compared with --to json.

    python3 pasted.py VIEWPROJ plain|c|shaders|numpy

In every preset, for cameras of every kind. plain: CSV and flat arrays; c: C and C++ by cc and c++; shaders: GLSL and HLSL
by glslangValidator, and the numbers of WGSL and CSS; numpy: NumPy. Status 77: the judge is not there.
"""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile

VIEWPROJ = os.path.abspath(sys.argv[1])
PRESETS = "opengl opengl-lh d3d d3d-rh vulkan metal webgpu unity unreal opencv ps2".split()
VIEWPORT = '"viewport":{"width":1280,"height":720,"x":10}'
CAMERAS = {
    "perspective": '{"position":[3,2,5],"target":[-1,0.5,0.25],%s,'
    '"projection":{"type":"perspective","fovY":60,"near":0.1,"far":1000}}' % VIEWPORT,
    "infinite, far from the origin": '{"position":[4400882.004,601648.647,4566227.855],"direction":[0.3,-0.9,-0.1],%s,'
    '"projection":{"type":"perspective","fovY":1e-5,"near":1e-7,"shift":[0.25,-1]}}' % VIEWPORT,
    "orthographic, of whole numbers": '{"position":[0,0,4],"direction":[0,0,-1],%s,'
    '"projection":{"type":"orthographic","left":-8,"right":24,"bottom":1,"top":19,"near":-1,"far":3}}' % VIEWPORT,
    "large and small": '{"position":[1e17,2,-3e20],"direction":[1e-9,1e-12,1],%s,'
    '"projection":{"type":"perspective","fovY":179.9999,"near":1e-10,"far":1e21}}' % VIEWPORT,
}
WHICH = ["--which", "view,projection,viewProjection"]
VARIANTS = [WHICH, WHICH + ["--float"], ["--inverse"], ["--relative-to-eye"], ["--bake-viewport", "--float"]]
POINT = [0.5, -0.25, -2.0, 1.0]

failures = 0


def missing(what):
    print(f"{what} is not installed")
    sys.exit(77)


def check(good, message):
    global failures
    if not good:
        failures += 1
        print("FAILED", message)


def run(*command, text=""):
    done = subprocess.run(command, input=text, capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout, done.stderr


def matrix(case, form):
    camera, preset, variant = case
    status, out, err = run(VIEWPROJ, "matrix", "-c", CAMERAS[camera], "--convention", preset, *variant, "--to", form)
    check(status == 0, f"{case} --to {form}: {err}")
    return out


def to_float(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def floats(rows):
    return [[to_float(x) for x in row] for row in rows]


def transposed(rows):
    return [list(column) for column in zip(*rows)]


class Expected:
    """Of one case: the matrices by name, as rows on paper and for column vectors."""

    def __init__(self, case):
        self.case = case
        written = json.loads(matrix(case, "json"))
        self.convention = written.pop("convention")
        self.eye = written.pop("eye", None)
        self.paper = written
        row = self.convention["vectors"] == "row"
        self.acting = {name: transposed(m) if row else m for name, m in written.items()}

    def memory(self, name):
        m = self.paper[name]
        m = m if self.convention["storage"] == "row-major" else transposed(m)
        return sum(m, [])


def identifier(case):
    return re.sub(r"\W", "_", " ".join([case[0], case[1]] + case[2]))


def c_family(cases):
    """Each case in a function of its own, which prints what the arrays hold."""
    source, calls = "#include <stdio.h>\n", ""
    for expected in cases:
        name = identifier(expected.case)
        prints = "".join(f'  for (i = 0; i < 16; ++i) printf("%.17g ", (double){m}[i]);\n' for m in expected.paper)
        if expected.eye:
            prints += '  for (i = 0; i < 3; ++i) printf("%.17g ", eye[i]);\n'
        source += f"static void {name}(void) {{\n{matrix(expected.case, 'c')}  int i;\n{prints}  puts(\"\");\n}}\n"
        calls += f"  {name}();\n"
    source += "int main(void) {\n" + calls + "  return 0;\n}\n"
    for compiler, suffix, standard in (("cc", "c", "c99"), ("c++", "cpp", "c++11")):
        if not shutil.which(compiler):
            missing(compiler)
        with tempfile.TemporaryDirectory() as work:
            path = f"{work}/pasted.{suffix}"
            with open(path, "w") as file:
                file.write(source)
            status, _, err = run(compiler, f"-std={standard}", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-o",
                                 f"{work}/pasted", path)
            check(status == 0, f"{compiler}: {err}")
            if status != 0:
                continue
            lines = run(f"{work}/pasted")[1].splitlines()
        check(len(lines) == len(cases), f"{compiler}: {len(lines)} answers for {len(cases)} cases")
        for expected, line in zip(cases, lines):
            numbers = sum((expected.memory(name) for name in expected.paper), [])
            if "--float" in expected.case[2]:
                numbers = [to_float(x) for x in numbers]
            check([float(x) for x in line.split()] == numbers + (expected.eye or []), f"{compiler} {expected.case}")
        print(f"{compiler}: {len(lines)} sets of matrices compiled and compared")


def numbers_in(text):
    """The sixteen numbers of each constructor, by name."""
    text = re.sub(r"//.*", "", text)
    return {
        name: [to_float(float(x)) for x in re.findall(r"[^][,\s]+", inside)]
        for name, inside in re.findall(r"const (?:\w+ )?(\w+)(?:: [^=]*)? = (?:[\w<>]+\(|\[)([^;)]*)[])];", text)
    }


def shaders(cases):
    """Compiled by Khronos's compiler; in the order that each language's constructor takes."""
    if not shutil.which("glslangValidator"):
        missing("glslangValidator")
    versions = {"es": "#version 300 es\nprecision highp float;\n", "core": "#version 450\n"}
    hlsl_text, products, compiled = "", "", 0
    with tempfile.TemporaryDirectory() as work:
        for expected in cases:
            names = list(expected.paper)
            glsl, hlsl, wgsl, css = (matrix(expected.case, form) for form in ("glsl", "hlsl", "wgsl", "css"))
            inside = re.findall(r"matrix3d\(([^)]*)\)", css)
            check([[to_float(float(x)) for x in numbers.split(",")] for numbers in inside] ==
                  [sum(floats(transposed(expected.acting[name])), []) for name in names], f"css {expected.case}")
            check(numbers_in(glsl) == numbers_in(wgsl), f"wgsl and glsl {expected.case}")
            check(numbers_in(glsl) == numbers_in(matrix(expected.case, "rust")), f"rust and glsl {expected.case}")
            for name in names:
                columns = sum(floats(transposed(expected.acting[name])), [])
                check(numbers_in(glsl)[name] == columns, f"glsl {expected.case} {name}")
                check(numbers_in(hlsl)[name] == sum(floats(expected.paper[name]), []), f"hlsl {expected.case} {name}")
            compiled += 1
            case = identifier(expected.case)
            product = " + ".join(f"{name} * vec4(1.0)" for name in names)
            for version, head in versions.items():
                with open(f"{work}/{case}.{version}.vert", "w") as file:
                    file.write(f"{head}{glsl}void main() {{ gl_Position = {product}; }}\n")
            row = expected.convention["vectors"] == "row"
            product = " + ".join(f"mul(p, {case}::{name})" if row else f"mul({case}::{name}, p)" for name in names)
            hlsl_text += f"namespace {case} {{\n{hlsl}}}\n"
            products += f" + {product}"
        status, out, _ = run("glslangValidator", *(f"{work}/{name}" for name in sorted(os.listdir(work))))
        check(status == 0 and out.count(".vert") == 2 * compiled, f"glsl: {out}")
    hlsl_text += f"float4 main(float4 p : POSITION) : SV_Position {{ return p{products}; }}\n"
    status, out, _ = run("glslangValidator", "--stdin", "-D", "-S", "vert", "-e", "main", "-V", "-o", os.devnull, text=hlsl_text)
    check(status == 0, f"hlsl: {out}")
    check(compiled >= 55, f"only {compiled} compiled")
    print(f"glslangValidator: {compiled} sets of matrices compiled as GLSL and as HLSL")


def times(m, v):
    """The product, and the sizes of the terms that each of its numbers sums."""
    return [sum(x * y for x, y in zip(row, v)) for row in m], [sum(abs(x * y) for x, y in zip(row, v)) for row in m]


def numpy_arrays(cases):
    try:
        import numpy
    except ImportError:
        missing("NumPy")
    for expected in cases:
        space = {}
        exec(matrix(expected.case, "numpy"), space)
        row = expected.convention["vectors"] == "row"
        for name, m in expected.paper.items():
            single = "--float" in expected.case[2]
            check(space[name].dtype == (numpy.float32 if single else numpy.float64), f"numpy {expected.case} {name}: type")
            check(space[name].tolist() == (floats(m) if single else m), f"numpy {expected.case} {name}")
        if expected.eye:
            check(space["eye"].tolist() == expected.eye, f"numpy {expected.case} eye")
        v, p = space["view"].astype(float), space["projection"].astype(float)
        clip = numpy.array(POINT) @ v @ p if row else p @ v @ numpy.array(POINT)
        view, sizes = times(expected.acting["view"], POINT)
        wanted, _ = times(expected.acting["projection"], view)
        sizes = times(expected.acting["projection"], sizes)[1]
        check(all(abs(a - b) <= 1e-6 * size for a, b, size in zip(clip, wanted, sizes)), f"numpy {expected.case} product")
    print(f"numpy: {len(cases)} sets of matrices loaded")


def plain(cases):
    """Text holds the rows on paper, each matrix under its name; flat the C array's order."""
    for expected in cases:
        blocks = [block.splitlines() for block in matrix(expected.case, "text").split("\n\n")]
        texts = {lines[0].removeprefix("# "): [[float(n) for n in line.split()] for line in lines[1:]] for lines in blocks[1:]}
        for name, m in expected.paper.items():
            check(texts.get(name) == m, f"text {expected.case} {name}")
        flat = [json.loads(line) for line in matrix(expected.case, "flat").splitlines()]
        check(flat == [expected.memory(name) for name in expected.paper], f"flat {expected.case}")
    print(f"{len(cases)} sets of matrices read as text and flat")


def calibration(judge):
    """K, [R | t], P and the window's edges: 3x3, 3x4, and four numbers; rows whatever the convention."""
    camera = CAMERAS["perspective"]
    of = lambda form: run(VIEWPROJ, "matrix", "-c", camera, "--convention", "d3d", "--which", "intrinsics,extrinsics,P,tangents", "--to", form)[1]
    said = {name: m if isinstance(m, list) else [list(m.values())] for name, m in json.loads(of("json")).items() if name != "convention"}
    rows = {name: sum(m, []) for name, m in said.items()}
    columns = {name: [to_float(x) for x in sum(m if len(m) == 1 else transposed(m), [])] for name, m in said.items()}
    check(list(map(len, rows.values())) == [9, 12, 12, 4, 4], f"calibration: {rows}")
    if judge == "plain":
        check([json.loads(line) for line in of("flat").splitlines()] == list(rows.values()), "flat calibration")
    elif judge == "c":
        prints = "".join(f'  for (i = 0; i < {len(n)}; ++i) printf("%.17g ", {name}[i]);\n' for name, n in rows.items())
        with tempfile.TemporaryDirectory() as work:
            with open(f"{work}/k.c", "w") as file:
                file.write(f"#include <stdio.h>\n{of('c')}int main(void) {{\n  int i;\n{prints}  return 0;\n}}\n")
            check(run("cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-o", f"{work}/k", f"{work}/k.c")[0] == 0, "cc calibration")
            check([float(x) for x in run(f"{work}/k")[1].split()] == sum(rows.values(), []), "c calibration")
    elif judge == "shaders":
        body = "vec4(P * vec4(1.0) + extrinsics * vec4(1.0) + intrinsics * vec3(1.0), 1.0) + tangents + angles"
        source = f"#version 450\n{of('glsl')}void main() {{ gl_Position = {body}; }}\n"
        check(run("glslangValidator", "--stdin", "-S", "vert", text=source)[0] == 0, "glsl calibration")
        body = "float4(mul(P, p) + mul(extrinsics, p) + mul(intrinsics, p.xyz), 1) + tangents + angles"
        source = f"{of('hlsl')}float4 main(float4 p : POSITION) : SV_Position {{ return {body}; }}\n"
        check(run("glslangValidator", "--stdin", "-D", "-S", "vert", "-e", "main", "-V", "-o", os.devnull, text=source)[0] == 0, "hlsl calibration")
        check(numbers_in(of("glsl")) == columns == numbers_in(of("wgsl")) == numbers_in(of("rust")), "glsl, wgsl and rust calibration")
        check(numbers_in(of("hlsl")) == {name: [to_float(x) for x in n] for name, n in rows.items()}, "hlsl calibration")


cases = [Expected((camera, preset, variant)) for camera in CAMERAS for preset in PRESETS for variant in VARIANTS]
test = {"plain": plain, "c": c_family, "shaders": shaders, "numpy": numpy_arrays}[sys.argv[2]]
# A language without doubles does not hold them all; those are errors, of which the golden cases tell.
test([e for e in cases if test is not shaders or e.case[0] != "large and small"])
calibration(sys.argv[2])
sys.exit(failures > 0)
