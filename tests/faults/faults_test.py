"""What goes wrong around the tool: outputs, inputs, signals, limits, and each of its calls of the system.

    VIEWPROJ_TOOL=build/viewproj VIEWPROJ_FAULT_LIBRARY=build/tests/faults/libfault.so python3 faults_test.py [TEST]...

VIEWPROJ_FAULT_ALL=1: every allocation fails once, where a sample of them is tried otherwise.
"""
import ctypes
import errno
import fcntl
import functools
import os
import pty
import re
import resource
import signal
import socket
import stat
import subprocess
import tempfile
import threading
import time
import unittest
from pathlib import Path

TOOL = os.environ.get("VIEWPROJ_TOOL", "viewproj")
LIBRARY = os.environ.get("VIEWPROJ_FAULT_LIBRARY", "")
MOST_A_RUN = 10**9 if "VIEWPROJ_FAULT_ALL" in os.environ else 3
PATIENCE = 60  # seconds; who needs them hangs
# What a shell starts in the background ignores it, and so would what is started here.
signal.signal(signal.SIGINT, signal.default_int_handler)
SANITIZED = any(name in Path(TOOL).read_bytes() for name in (b"__asan_init", b"__tsan_init"))
ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)

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
    "f64": (bytes(6) + b"\xf0\x3f") * 3,
}
PIXELS = b"[640,360]\n[1,2]\n"
PROJECT = ["project", "-c", CAMERA]


def _runs():
    """(arguments, standard input): every command, and a stream in every form."""
    for form, text in POINTS.items():
        yield [*PROJECT, "--from", form], text
    for form in ("ndjson", "json", "csv", "text", "f64", "table"):
        yield [*PROJECT, "--to", form], POINTS["json"]
    yield PROJECT, b'{"points":[[1,1,1],[2,2,2]],"name":"n"}'
    yield [*PROJECT, "--point", "1,1,1"], b""
    yield ["ray", "-c", CAMERA, "--scene", SCENE], PIXELS
    yield ["cull", "-c", CAMERA], POINTS["json"]
    yield ["matrix"], CAMERA.encode()
    yield ["info"], CAMERA.encode()
    yield ["info", "--to", "json"], MATRIX
    yield ["explain", "-c", CAMERA, "--point", "1,1,1"], b""
    yield ["depth"], CAMERA.encode()
    yield ["draw", "-c", CAMERA, "--scene", SCENE, "--pixel", "1,2", "-"], POINTS["json"]
    yield ["schema"], b""
    yield ["--help"], b""


RUNS = list(_runs())
# Where a file goes in the command line, what else is on standard input, and what the file holds.
FILES = [
    (lambda file: ["project", "-c", file], POINTS["json"], CAMERA.encode()),
    (lambda file: ["info", file], b"", MATRIX),
    (lambda file: ["ray", "-c", CAMERA, "--scene", file], PIXELS, SCENE.encode()),
    *((lambda file, form=form: [*PROJECT, "--from", form, file], b"", text) for form, text in POINTS.items()),
]


def run(arguments, given=b"", before=None, env=None, **more):
    """Runs it to its end. before: what the process does before it becomes the tool."""
    more.setdefault("stdout", subprocess.PIPE)
    more.setdefault("stderr", subprocess.PIPE)
    if "stdin" not in more:
        more["input"] = given
    return subprocess.run([TOOL, *arguments], preexec_fn=before, env=env, timeout=PATIENCE, check=False, **more)


@functools.cache
def _untroubled(arguments, given):
    return run(arguments, given)


def untroubled(arguments, given):
    """What it does where nothing goes wrong."""
    return _untroubled(tuple(arguments), given)


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
    for power in (1, 2):  # dac_override, dac_read_search
        prctl(24, power, 0, 0, 0)  # drop from the bounding set


def faulty(arguments, given, call, number, kind):
    """With its so-manyth call of that name failing: see fault.cpp."""
    return run(arguments, given, env={**os.environ, "LD_PRELOAD": LIBRARY, "VIEWPROJ_FAULT": f"{call} {number} {kind}"})


class FaultTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="viewproj-faults-")
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def each(self, check, rows=None):
        """check of every run, or of these rows."""
        for row in RUNS if rows is None else rows:
            with self.subTest(" ".join(row[0]("FILE") if callable(row[0]) else row[0])):
                check(*row)

    def started(self, arguments, **more):
        """A process that is gone when the test ends."""
        process = subprocess.Popen([TOOL, *arguments], **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **more})
        self.addCleanup(process.__exit__, None, None, None)
        self.addCleanup(process.kill)
        return process

    def file(self, name, content):
        Path(os.fsdecode(name)).write_bytes(content.encode() if isinstance(content, str) else content)
        return name

    def assert_fails(self, done, message):
        """Exit 1 and this message alone."""
        self.assertEqual((done.stderr, done.returncode), (b"viewproj: " + message.encode() + b"\n", 1))

    def assert_ends(self, done, message):
        """Exit 1, and this message last."""
        self.assertEqual(done.returncode, 1)
        self.assertTrue(done.stderr.endswith(b"viewproj: " + message.encode() + b"\n"), done.stderr)

    def assert_same(self, done, expected, name=b"FILE"):
        """But for the file's name."""
        self.assertEqual((done.returncode, done.stdout, done.stderr.replace(name, b"FILE")),
                         (expected.returncode, expected.stdout, expected.stderr))


class Outputs(FaultTest):
    def test_an_output_that_is_full_closed_or_may_not_grow_is_one_message_and_status_1(self):
        def check(arguments, given):
            expected = untroubled(arguments, given)
            self.assertEqual((expected.returncode, expected.stderr), (0, b""))
            with open("/dev/full", "wb") as full:
                self.assert_ends(run(arguments, given, stdout=full), "standard output: No space left on device")
            self.assert_ends(run(arguments, given, before=lambda: os.close(1)), "standard output: Bad file descriptor")
            with open("out", "wb") as out:
                grow = limited(resource.RLIMIT_FSIZE, len(expected.stdout) // 2)
                self.assert_ends(run(arguments, given, stdout=out, before=grow), "standard output: File too large")
            self.assertTrue(expected.stdout.startswith(Path("out").read_bytes()))

        self.each(check)

    def test_messages_that_cannot_be_written_change_nothing_else(self):
        arguments, bad = [*PROJECT, "--keep-going"], POINTS["json"] + b"[1,2]\n" * 9
        told = run(arguments, bad)
        with open("/dev/full", "wb") as full:
            untold = [run(arguments, bad, stderr=full), run(arguments, bad, before=lambda: os.close(2))]
        for done in untold:
            self.assertEqual((done.returncode, done.stdout), (told.returncode, told.stdout))

    def test_a_pipe_without_a_reader_ends_quietly(self):
        def check(arguments, given):
            reader, writer = os.pipe()
            os.close(reader)
            done = run(arguments, given, stdout=writer)
            os.close(writer)
            self.assertEqual((done.returncode, done.stderr), (0, b""))

        self.each(check)

    def test_workers_that_wait_for_input_end_with_the_reader_and_with_a_bad_record(self):
        for last in ("0 0 2", "0 0"):
            feeder = subprocess.Popen(["sh", "-c", f"yes 0 0 2 | head -n 28000; echo {last}; exec sleep 60"], stdout=subprocess.PIPE)
            process = self.started([*PROJECT, "--jobs", "4", "--from", "text", "--to", "ndjson"], stdin=feeder.stdout)
            self.addCleanup(feeder.wait)
            self.addCleanup(feeder.kill)
            feeder.stdout.close()
            wait_until_still(process)
            if last == "0 0":
                out, err = process.communicate(timeout=10)
                self.assertEqual((process.returncode, out.count(b"\n"), err[:26]), (1, 28000, b"viewproj: <stdin>:28001:1:"))
            else:
                process.stdout.close()
                self.assertEqual((process.wait(10), process.stderr.read()), (0, b""))

    def test_files_are_not_taken_for_closed_descriptors(self):
        self.file("points.csv", POINTS["csv"])
        self.file("camera.json", CAMERA)
        for closed in ((0,), (1,), (2,), (0, 1), (0, 2), (1, 2), (0, 1, 2)):
            done = run(["project", "-c", "camera.json", "points.csv"], stdin=subprocess.DEVNULL,
                       before=lambda: [os.close(i) for i in closed])
            self.assertEqual(done.returncode, 1 if 1 in closed else 0)
            self.assertEqual((Path("points.csv").read_bytes(), Path("camera.json").read_text()), (POINTS["csv"], CAMERA))

    def test_slow_pipes_lose_nothing_blocking_or_not(self):
        self.file("many", b'{"x":1,"y":2,"z":3}\n' * 3000)
        for arguments, descriptor in ((PROJECT, 1), ([*PROJECT, "--jobs", "4"], 1), (["draw", "-c", CAMERA], 1),
                                      ([*PROJECT, "--keep-going", "--columns", "E,N,U"], 2)):
            done = run([*arguments, "many"])
            for blocking in (False, True):
                reader, writer = os.pipe()
                fcntl.fcntl(writer, fcntl.F_SETPIPE_SZ, 4096)
                os.set_blocking(writer, blocking)
                streams = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, ("", "stdout", "stderr")[descriptor]: writer}
                process = self.started([*arguments, "many"], **streams)
                os.close(writer)
                out = b""
                while piece := os.read(reader, 5000):
                    out += piece
                    if len(out) % 20 == 0:
                        time.sleep(0.005)
                os.close(reader)
                self.assertEqual(process.wait(PATIENCE), done.returncode)
                self.assertTrue(out == (done.stdout if descriptor == 1 else done.stderr), arguments)


class NamedOutputs(FaultTest):
    """-o FILE is whole, or as it was."""

    def test_a_file_is_what_standard_output_would_be_and_after_an_error_as_it_was(self):
        def check(arguments, given):
            if "--help" not in arguments:
                self.assertEqual(run([*arguments, "-o", "file"], given).stdout, b"")
                self.assertEqual(Path("file").read_bytes(), untroubled(arguments, given).stdout)
                self.assertEqual(os.listdir("."), ["file"])

        self.each(check)
        bad = POINTS["json"] + b"[1,2]\n" + POINTS["json"]
        self.assertEqual((run([*PROJECT, "-o", "new"], bad).returncode, os.listdir(".")), (1, ["file"]))
        self.file("file", "before")
        self.assertEqual((run([*PROJECT, "-o", "file"], bad).returncode, Path("file").read_text()), (1, "before"))
        self.assertEqual(run([*PROJECT, "--keep-going", "-o", "file"], bad).returncode, 1)
        self.assertEqual(Path("file").read_bytes().count(b"\n"), 5)

    def test_a_file_may_be_read_and_written_at_once(self):
        self.file("points.csv", "x,y,z\n" + "1,2,3\n" * 100000)
        self.assertEqual(run(["cull", "-c", CAMERA, "points.csv", "-o", "points.csv"]).returncode, 0)
        self.assertEqual(len(Path("points.csv").read_text().splitlines()), 100001)

    def test_it_keeps_its_mode_and_where_a_link_leads(self):
        self.file("old", "before")
        os.chmod("old", 0o640)
        os.symlink("old", "link")
        os.symlink("nowhere", "dangling")
        os.symlink("loop", "loop")
        self.assertEqual([run(["schema", "-o", name]).returncode for name in ("link", "dangling")], [0, 0])
        self.assertTrue(os.path.islink("link") and os.path.islink("dangling") and Path("nowhere").exists())
        self.assertEqual(stat.S_IMODE(os.stat("old").st_mode), 0o640)
        self.assertIn("camera", Path("old").read_text())
        self.assert_fails(run(["schema", "-o", "loop"]), "loop: Too many levels of symbolic links")

    def test_devices_pipes_and_descriptors_are_written_as_they_are(self):
        self.assertEqual(run(["schema", "-o", "/dev/null"]).returncode, 0)
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/null").st_mode))
        for name in ("/dev/stdout", "/dev/fd/1", "-"):
            with open("log", "ab") as log:
                run([*PROJECT, "--point", "1,1,1", "--fields", "visible", "-o", name], stdout=log)
        self.assertEqual(Path("log").read_bytes().count(b"\n"), 3)  # each goes on where the file stands
        os.mkfifo("pipe")
        reader = subprocess.Popen(["cat", "pipe"], stdout=subprocess.PIPE)
        self.assertEqual(run(["schema", "-o", "pipe"]).returncode, 0)
        self.assertIn(b"camera", reader.communicate(timeout=PATIENCE)[0])

    def test_what_cannot_be_written_or_replaced_is_named_and_as_it_was(self):
        self.file("old", "before")
        done = run([*PROJECT, "-o", "old"], POINTS["text"] * 50000, before=limited(resource.RLIMIT_FSIZE, 1000))
        self.assert_fails(done, "old: File too large")
        os.mkdir("closed")
        os.chmod("closed", 0o500)
        os.chmod("old", 0o400)
        for name, message in (("old", "Permission denied"), ("closed/new", "Permission denied"), ("closed", "Is a directory"),
                              ("missing/file", "No such file or directory"), ("/dev/full", "No space left on device")):
            self.assert_fails(run(["schema", "-o", name], before=without_power_over_files), f"{name}: {message}")
        self.assertEqual((sorted(os.listdir(".")), Path("old").read_text()), (["closed", "old"], "before"))


class Inputs(FaultTest):
    def test_a_file_that_cannot_be_read_is_named(self):
        Path("folder").mkdir()
        os.symlink("loop", "loop")
        self.file("unreadable", CAMERA)
        os.chmod("unreadable", 0)
        with socket.socket(socket.AF_UNIX) as listening:
            listening.bind("socket")

        def check(arguments, given, content):
            for name, message in (("missing", "No such file or directory"), ("folder", "Is a directory"),
                                  ("loop", "Too many levels of symbolic links"), ("unreadable", "Permission denied"),
                                  ("socket", "No such device or address"), ("x" * 300, "File name too long")):
                self.assert_fails(run(arguments(name), given, before=without_power_over_files), f"{name}: {message}")
            if content not in POINTS.values():
                self.assert_fails(run(arguments("/dev/zero"), given), "/dev/zero: longer than 64 MiB, the most that is read")

        self.each(check, FILES)

    def test_names_pipes_and_descriptors_are_files_whatever_they_hold(self):
        os.mkfifo("pipe")

        def piped(arguments, given, content):
            writer = threading.Thread(target=lambda: Path("pipe").write_bytes(content))
            writer.start()
            done = run(arguments("pipe"), given)
            writer.join()
            return done

        def check(arguments, given, content):
            self.file("FILE", content)
            expected = run(arguments("FILE"), given)
            self.assertEqual(expected.returncode, 0)
            for name in (b"a\nb", b"\xff", b"'\"$`\\", b"n" * 255):
                self.file(name, content)
                self.assert_same(run(arguments("./" + os.fsdecode(name)), given), expected, b"./" + name)
            self.assert_same(piped(arguments, given, content), expected, b"pipe")
            if not given:
                self.assert_same(run(arguments("/dev/stdin"), content), expected, b"/dev/stdin")
                self.assert_same(run(arguments("-"), content), expected, b"<stdin>")
            # Nothing is nothing wherever it comes from.
            self.file("FILE", b"")
            expected = run(arguments("FILE"), given)
            self.assert_same(run(arguments("/dev/null"), given), expected, b"/dev/null")
            self.assert_same(piped(arguments, given, b""), expected, b"pipe")
            if not given:
                closed = run(arguments("-"), stdin=subprocess.DEVNULL, before=lambda: os.close(0))
                self.assert_same(closed, expected, b"<stdin>")

        self.each(check, FILES)

    def test_a_file_that_goes_away_grows_or_is_cut_off_is_read_to_its_end(self):
        """The tool is stuck behind a full pipe while its input changes."""
        for form, record in (("json", b'{"x":1,"y":2,"z":3}\n'), ("csv", b"1,2,3\n"), ("f64", POINTS["f64"])):
            for change, count in ((os.unlink, 300000), (lambda name: os.write(os.open(name, os.O_WRONLY | os.O_APPEND), record * 1000), 301000),
                                  (lambda name: os.truncate(name, 299000 * len(record)), 299000)):
                name = self.file("points", record * 300000)
                process = self.started([*PROJECT, "--jobs", "4", "--from", form, name])
                os.read(process.stdout.fileno(), 1)
                wait_until_still(process)
                change(name)
                out, err = process.communicate(timeout=PATIENCE)
                written = (len(out) + 1) // 24 if form == "f64" else (b"\n" + out).count(b"\n") - 1
                self.assertEqual((process.returncode, written, err), (0, count, b""), form)

    def test_input_byte_by_byte_gives_the_same_blocking_or_not(self):
        for arguments, given in [RUNS[0], RUNS[1], RUNS[3]]:
            for blocking in (True, False):
                reading, writing = os.pipe()
                os.set_blocking(reading, blocking)
                process = self.started(arguments, stdin=reading)
                os.close(reading)
                if not blocking:
                    wait_until_still(process)
                for i in range(len(given)):
                    os.write(writing, given[i : i + 1])
                os.close(writing)
                self.assertEqual(process.communicate(timeout=PATIENCE), (untroubled(arguments, given).stdout, b""))

    def test_a_record_is_answered_before_the_next_one_is_there(self):
        for arguments, said, size in (
            (["--jobs", "4"], (b"[1,2,3]\n", b'{"x":1,\n"y":2,"z":3}\n', b"[1,2,3]\n"), 0),
            (["--to", "ndjson"], (b"[[1,2,3]", b",[1,2,3]", b",\n[1,2,3]", b",[1,2,3]]"), 0),
            ([], (b"x,y,z\n", b"1,2,3\n", b'"1",2,3\n'), 0),
            (["--from", "f64"], (POINTS["f64"], POINTS["f64"]), 24),
        ):
            process = self.started([*PROJECT, *arguments], stdin=subprocess.PIPE, bufsize=0)
            for text in said:
                process.stdin.write(text)
                answer = process.stdout.read(size) if size else process.stdout.readline()
                self.assertGreater(len(answer), 2, text)
            process.stdin.close()
            self.assertEqual(process.wait(PATIENCE), 0)


class Limits(FaultTest):
    def test_a_signal_ends_whatever_runs_at_once_and_one_that_is_ignored_stays_so(self):
        defaults = lambda: [signal.signal(number, signal.SIG_DFL) for number in (*ENDING, signal.SIGPIPE)]
        for arguments in (["matrix"], ["draw", "-c", CAMERA], PROJECT, [*PROJECT, "-o", "file"]):
            for number in ENDING:
                process = self.started(arguments, stdin=subprocess.PIPE, preexec_fn=defaults)
                wait_until_still(process)
                process.send_signal(number)
                self.assertEqual((process.communicate(timeout=PATIENCE), process.returncode), ((b"", b""), -number))
                self.assertEqual(os.listdir("."), [])
        feeder = subprocess.Popen(["yes", "[1,2,3]"], stdout=subprocess.PIPE)
        process = self.started([*PROJECT, "--jobs", "4"], stdin=feeder.stdout, preexec_fn=defaults)
        feeder.stdout.close()
        wait_until_still(process)
        if not SANITIZED:  # a reader that sleeps costs no memory
            status = Path(f"/proc/{process.pid}/status").read_text()
            self.assertLess(int(re.search(r"^VmHWM:\s*(\d+)", status, re.M)[1]), 32 << 10)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(PATIENCE), -signal.SIGTERM)
        feeder.wait(PATIENCE)
        process = self.started(PROJECT, stdin=subprocess.PIPE, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        wait_until_still(process)
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.communicate(POINTS["json"], timeout=PATIENCE)[0].count(b"\n"), 2)

    @unittest.skipIf(SANITIZED, "a sanitizer takes all the space there is")
    def test_little_memory_is_one_message_or_enough(self):
        many = self.file("many.json", b'{"x":1,"y":2,"z":3}\n' * 8000)
        big = self.file("big.json", b'["' + b"x" * 6000000 + b'"]')
        told, well = 0, 0
        for arguments in ([*PROJECT, "--jobs", "4", many], [*PROJECT, "--to", "table", many], [*PROJECT, "--from", "json", big],
                          ["draw", "-c", CAMERA, many], ["matrix", big]):
            expected = run(arguments)
            for mebibytes in (12, 13, 14, 16, 18, 20, 24, 32, 48, 72):
                done = run(arguments, before=limited(resource.RLIMIT_AS, mebibytes << 20))
                if done.returncode == 127 or b"error while loading" in done.stderr:
                    continue
                if b"memory" in done.stderr:
                    told += 1
                    self.assert_ends(done, "out of memory")
                else:
                    well += 1
                    self.assert_same(done, expected)
        self.assertGreater(min(told, well), 8)

    def test_a_thousand_threads_and_small_stacks_give_what_one_gives(self):
        many = self.file("many.json", b'{"x":1,"y":2,"z":3}\n' * 60000)
        expected = run([*PROJECT, "--jobs", "1", many])
        self.assert_same(run([*PROJECT, "--jobs", "1024", many]), expected)
        small = limited(resource.RLIMIT_STACK, 256 << 10)
        self.each(lambda arguments, given: self.assert_same(run(arguments, given, before=small), untroubled(arguments, given)))

    def test_a_terminal_is_told_of_keyboards_and_progress_and_gets_no_f64(self):
        def all_of(end):
            text = b""
            try:
                while part := os.read(end, 1 << 16):
                    text += part
            except OSError:  # nobody has the other end any more
                pass
            os.close(end)
            return text

        def shown(arguments, typed=b""):
            child, end = pty.fork()
            if child == 0:
                os.execv(TOOL, [TOOL, *arguments])
            os.write(end, typed)
            text = all_of(end)
            return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), text

        self.assertIn(b"viewproj: reading from the keyboard; Ctrl-D ends the input", shown(PROJECT, b"1 1 1\n\x04")[1])
        self.assertNotIn(b"keyboard", shown([*PROJECT, "--point", "1,1,1"])[1])
        self.assertEqual(shown([*PROJECT, "--point", "1,1,1", "--to", "f64"])[0], 2)
        shows, terminal = pty.openpty()
        process = self.started(PROJECT, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=terminal)
        os.close(terminal)
        for _ in range(14):
            process.stdin.write(b"[1,2,3]\n")
            process.stdin.flush()
            time.sleep(0.1)
        process.stdin.close()
        process.wait(PATIENCE)
        self.assertRegex(all_of(shows), rb"records, .* records/s.*\r\x1b\[K$")


@unittest.skipIf(SANITIZED or not LIBRARY, "a sanitizer allocates in its own way")
class Calls(FaultTest):
    """Calls of the system that fail, one after the other."""

    def each_call(self, call, kinds, check):
        """check(arguments, done, expected) of the calls of that name in every run."""
        tried = 0
        for arguments, given in RUNS:
            counting = {**os.environ, "LD_PRELOAD": LIBRARY, "VIEWPROJ_FAULT_COUNTS": "counts"}
            expected = run(arguments, given, env=counting)
            calls = int(dict(line.split() for line in Path("counts").read_text().splitlines())[call])
            step = max(1, calls // MOST_A_RUN)
            for number in range(1 + tried % step, calls + 1, step):
                for kind in kinds:
                    tried += 1
                    with self.subTest(f"{call} {number} of {calls}, {kind}: {' '.join(arguments)}"):
                        done = faulty(arguments, given, call, number, kind)
                        self.assertTrue(done.returncode == 0 or self.is_whole(arguments, done.stdout, expected.stdout), done.stdout)
                        check(done, expected)
        self.assertGreater(tried, 20)

    def is_whole(self, arguments, out, expected):
        """What was written is what would have been, up to the end of a record; an array is closed."""
        if out.endswith(b"\n]\n") and expected.startswith(out[:-3]):
            return True
        binary = arguments[-2:] in (["--to", "f64"], ["--from", "f64"])
        return expected.startswith(out) and (binary or out[-1:] in (b"", b"\n", b"[", b"}"))

    def test_memory_that_is_not_to_be_had_is_one_message_and_status_1(self):
        def check(done, expected):
            if done.returncode == 0:
                self.assert_same(done, expected)
            else:
                self.assert_fails(done, "out of memory")

        self.each_call("malloc", (f"{errno.ENOMEM}", f"{errno.ENOMEM}+"), check)

    def test_interrupted_and_short_calls_change_nothing(self):
        for call in ("read", "write"):
            self.each_call(call, (errno.EINTR, errno.EAGAIN, "short", "short+"), self.assert_same)

    def test_reads_and_writes_that_fail_are_one_message_and_status_1(self):
        self.each_call("read", (f"{errno.EIO}+",), lambda done, _: self.assert_fails(done, "<stdin>: Input/output error"))
        self.each_call("write", (f"{errno.EDQUOT}+",), lambda done, _: self.assert_ends(done, "standard output: Disk quota exceeded"))
        self.file("camera.json", CAMERA)
        done = faulty(["project", "-c", "camera.json"], b"", "open", 1, errno.EMFILE)
        self.assert_fails(done, "camera.json: Too many open files")

    def test_without_threads_fewer_do_the_work(self):
        many = self.file("many.json", b'{"x":1,"y":2,"z":3}\n' * 40000)
        arguments = [*PROJECT, "--jobs", "6", many]
        for number in range(1, 6):
            self.assert_same(faulty(arguments, b"", "thread", number, f"{errno.EAGAIN}+"), run(arguments))


if __name__ == "__main__":
    unittest.main()
