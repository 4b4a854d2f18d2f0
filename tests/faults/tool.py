"""The tool as the fault tests run it: every command in every form that it writes."""
import ctypes
import functools
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

TOOL = os.environ.get("VIEWPROJ_TOOL", "viewproj")
PATIENCE = 60  # seconds; who needs them hangs
# What a shell starts in the background ignores it, and so would what is started here.
signal.signal(signal.SIGINT, signal.default_int_handler)
SANITIZED = any(name in Path(TOOL).read_bytes() for name in (b"__asan_init", b"__tsan_init"))

CAMERA = (
    '{"position":[3,2,5],"target":[0,0,0],"projection":{"type":"perspective","fovY":60,"near":0.1,"far":1000},'
    '"viewport":{"width":1280,"height":720}}'
)
SCENE = '{"objects":[{"id":"floor","plane":{"point":[0,0,0],"normal":[0,1,0]}},{"sphere":{"center":[1,1,1],"radius":2}}]}'
MATRIX = b"1.5 0 0 0\n0 2 0 0\n0 0 -1.002 -0.2002\n0 0 -1 0\n"

POINTS = {
    "json": b'{"id":"a","x":1,"y":1,"z":1}\n{"id":"b","x":3,"y":2,"z":6}\n',
    "csv": b"name,x,y,z\na,1,1,1\nb,3,2,6\n",
    "text": b"1 1 1\n3 2 6\n",
    "f64": bytes(6) + b"\xf0\x3f" + bytes(6) + b"\xf0\x3f" + bytes(6) + b"\xf0\x3f",
}
PIXELS = {"json": b"[640,360]\n[1,2]\n", "csv": b"x,y\n640,360\n", "text": b"640 360\n", "f64": POINTS["f64"]}
STREAM_FORMS = ("ndjson", "json", "csv", "text", "f64", "table")


def _runs():
    """(arguments, standard input) of every command and form."""
    streams = (("project", POINTS, ()), ("ray", PIXELS, ()), ("ray", PIXELS, ("--scene", SCENE)))
    for command, inputs, more in streams:
        for source, text in inputs.items():
            yield [command, "-c", CAMERA, "--from", source, *more], text
        for form in STREAM_FORMS:
            if not (more and form in ("text", "f64")):
                yield [command, "-c", CAMERA, "--to", form, *more], inputs["json"]
    yield ["project", "-c", CAMERA], b'{"points":[[1,1,1],[2,2,2]],"name":"n"}'
    yield ["project", "-c", CAMERA], b"[[1,1,1],[2,2,2]]"
    yield ["project", "-c", CAMERA, "--point", "1,1,1"], b""
    yield ["ray", "-c", CAMERA, "--pixel", "1,2,0.5"], b""
    for form in ("ndjson", "json", "csv", "table"):
        yield ["cull", "-c", CAMERA, "--to", form], POINTS["json"]
    for form in ("json", "text", "flat", "c", "glsl", "hlsl", "wgsl", "css", "numpy", "camera"):
        yield ["matrix", "--to", form], CAMERA.encode()
    yield ["info", "--to", "json"], CAMERA.encode()
    yield ["inspect"], MATRIX
    yield ["inspect", "--to", "json"], MATRIX
    yield ["inspect", "--convention", "d3d", "--read-as", "opengl", "--to", "text"], MATRIX
    for form in ("table", "json"):
        yield ["explain", "-c", CAMERA, "--to", form, "--point", "1,1,1"], b""
        yield ["explain", "-c", CAMERA, "--to", form, "--pixel", "1,2,0.5"], b""
        yield ["depth", "--to", form], CAMERA.encode()
    yield ["measure", "-c", CAMERA, "--to", "json"], POINTS["json"]
    for form in ("table", "json", "csv"):
        yield ["check", "-c", CAMERA, "--to", form], b"x,y,z,u,v\n1,1,1,687.1,291.3\n0,0,0,640,360\n"
    yield ["draw", "-c", CAMERA, "--scene", SCENE, "--pixel", "1,2", "-"], POINTS["json"]
    yield ["--version"], b""
    yield ["--help"], b""
    for command in commands():
        yield [command, "--help"], b""
    if "schema" in commands():
        yield ["schema"], b""


def commands():
    text = subprocess.run([TOOL, "--help"], capture_output=True, timeout=PATIENCE, check=True).stdout.decode()
    lines = text.split("Commands:\n")[1].split("\n\n")[0].splitlines()
    return [line.split()[0] for line in lines]


def failure(arguments):
    """The exit status of an error that is not the command line's."""
    return 2 if arguments[0] == "check" else 1


RUNS = list(_runs())
FILTERS = ("project", "ray", "cull")


def is_stream(arguments):
    """Whether it is a filter that reads and writes records."""
    return arguments[0] in FILTERS and not {"--help", "--planes", "--point", "--pixel"} & set(arguments)


def is_binary(arguments):
    return "f64" in arguments and "--to" not in arguments or arguments[-2:] == ["--to", "f64"]


def run(arguments, given=b"", before=None, env=None, **more):
    """Runs it to its end. before: what the process does before it becomes the tool."""
    more.setdefault("stdout", subprocess.PIPE)
    more.setdefault("stderr", subprocess.PIPE)
    if "stdin" not in more:
        more["input"] = given
    return subprocess.run([TOOL, *arguments], preexec_fn=before, env=env, timeout=PATIENCE, check=False, **more)


def untroubled(arguments, given):
    """What it does where nothing goes wrong."""
    return _untroubled(tuple(arguments), given)


@functools.cache
def _untroubled(arguments, given):
    return run(arguments, given)


def start(arguments, **more):
    return subprocess.Popen([TOOL, *arguments], **more)


def wait_until_still(process):
    """Until it neither reads nor writes any more."""
    before = None
    while True:
        with open(f"/proc/{process.pid}/io", encoding="ascii") as io, open(f"/proc/{process.pid}/comm", encoding="ascii") as name:
            now = io.read() if name.read() == "viewproj\n" else None
        if now and now == before:
            return
        before = now
        time.sleep(0.05)


def limited(which, soft):
    """A limit of the process, to be set before it becomes the tool."""
    return lambda: resource.setrlimit(which, (soft, soft))


def without_power_over_files():
    """Root is like others then."""
    prctl = ctypes.CDLL(None).prctl
    drop_from_bounding_set, dac_override, dac_read_search = 24, 1, 2
    for power in (dac_override, dac_read_search):
        prctl(drop_from_bounding_set, power, 0, 0, 0)


def is_one_message(err):
    """One line, of the tool itself."""
    return err.startswith(b"viewproj: ") and err.count(b"\n") == 1 and err.endswith(b"\n")


class FaultTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="viewproj-faults-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def each_run(self, check, wanted=lambda arguments: True):
        """check(arguments, given) for every command and form."""
        tried = [(arguments, given) for arguments, given in RUNS if wanted(arguments)]
        self.assertGreater(len(tried), 10)
        for arguments, given in tried:
            with self.subTest(" ".join(arguments)):
                check(arguments, given)

    def started(self, arguments, **more):
        """A process that is gone when the test ends."""
        process = start(arguments, **more)
        self.addCleanup(process.__exit__, None, None, None)
        self.addCleanup(process.kill)
        return process

    def file(self, name, content):
        Path(os.fsdecode(name)).write_bytes(content.encode() if isinstance(content, str) else content)
        return name

    def assert_fails(self, done, message, status=1):
        """This exit status and this message alone."""
        self.assertEqual((done.stderr, done.returncode), (b"viewproj: " + message.encode() + b"\n", status))

    def assert_goes_well(self, done):
        self.assertEqual((done.stderr, done.returncode), (b"", 0))


def main():
    unittest.main(module=sys.modules["__main__"])
