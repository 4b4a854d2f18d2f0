"""Files that cannot be read, are none, or are strange, as every file that a command reads."""
import os
import socket
import subprocess
import threading
import time
from pathlib import Path

import tool
from tool import CAMERA, MATRIX, PIXELS, POINTS, SCENE, FaultTest, run

# Where the file goes in the command line, what else is on standard input, and what the file holds.
FILES = [
    (lambda file: ["project", "-c", file], POINTS["json"], CAMERA),
    (lambda file: ["ray", "-c", file], PIXELS["json"], CAMERA),
    (lambda file: ["cull", "-c", file], POINTS["json"], CAMERA),
    (lambda file: ["matrix", "-c", file], b"", CAMERA),
    (lambda file: ["matrix", file], b"", CAMERA),
    (lambda file: ["explain", "-c", file, "--point", "1,1,1"], b"", CAMERA),
    (lambda file: ["depth", "-c", file], b"", CAMERA),
    (lambda file: ["depth", file], b"", CAMERA),
    (lambda file: ["measure", "-c", file], POINTS["json"], CAMERA),
    (lambda file: ["draw", "-c", file], POINTS["json"], CAMERA),
    (lambda file: ["inspect", file], b"", MATRIX),
    (lambda file: ["ray", "-c", CAMERA, "--scene", file], PIXELS["json"], SCENE),
    (lambda file: ["draw", "-c", CAMERA, "--scene", file], b"", SCENE),
    (lambda file: ["ray", "-c", CAMERA, file], b"", PIXELS["json"]),
    (lambda file: ["cull", "-c", CAMERA, file], b"", POINTS["json"]),
    (lambda file: ["measure", "-c", CAMERA, file], b"", POINTS["json"]),
    (lambda file: ["draw", "-c", CAMERA, file], b"", POINTS["json"]),
    *((lambda file, form=form: ["project", "-c", CAMERA, "--from", form, file], b"", text) for form, text in POINTS.items()),
]


class Files(FaultTest):
    def each_file(self, check):
        """check(arguments of a file, standard input, content)."""
        for arguments, given, content in FILES:
            with self.subTest(" ".join(arguments("FILE"))):
                check(arguments, given, content if isinstance(content, bytes) else content.encode())

    def assert_same(self, done, expected, name):
        """But for the file's name and what was timed."""
        self.assertEqual(done.returncode, expected.returncode)
        if b"nsPerPoint" not in done.stdout:
            self.assertEqual(done.stdout, expected.stdout)
            self.assertEqual(done.stderr.replace(name, b"FILE"), expected.stderr)

    def test_draw_with_a_scene_does_not_wait_for_a_terminal(self):
        _, terminal = os.openpty()  # on which nobody ever types
        arguments = [tool.TOOL, "draw", "-c", CAMERA, "--scene", SCENE]
        done = subprocess.run(arguments, stdin=terminal, capture_output=True, timeout=tool.PATIENCE)
        self.assertEqual((done.returncode, done.stderr), (0, b""))

    def test_a_file_that_cannot_be_opened_is_named(self):
        Path("folder").mkdir()
        os.symlink("loop", "loop")
        Path("closed").mkdir()
        self.file("closed/file", "")
        self.file("unreadable", CAMERA)
        os.chmod("closed", 0)
        os.chmod("unreadable", 0)
        with socket.socket(socket.AF_UNIX) as listening:
            listening.bind("socket")

        def check(arguments, given, content):
            for name, message in (
                ("missing", "No such file or directory"),
                ("folder", "Is a directory"),
                ("folder/", "Is a directory"),
                ("unreadable/file", "Not a directory"),
                ("loop", "Too many levels of symbolic links"),
                ("unreadable", "Permission denied"),
                ("closed/file", "Permission denied"),
                ("socket", "No such device or address"),
                ("x" * 300, "File name too long"),
                ("x/" * 2500, "File name too long"),
            ):
                done = run(arguments(name), given, before=tool.without_power_over_files)
                self.assert_fails(done, f"{name}: {message}")

        self.each_file(check)
        os.chmod("closed", 0o700)

    def test_names_are_names_whatever_they_hold(self):
        def check(arguments, given, content):
            self.file("FILE", content)
            expected = run(arguments("FILE"), given)
            self.assertEqual(expected.returncode, 0)
            for name in (b"a b", b"a\nb", b"\xc3\xa4", b"\xff", b"'\"$`\\", b"*", b"~", b"n" * 255, b"./" * 2000 + b"f"):
                self.file(name, content)
                self.assert_same(run(arguments(os.fsdecode(name)), given), expected, name)
            self.file("-", b"not this one")
            for name in (b"-", b"-x", b"--", b"--help"):
                self.file(name, content)
                self.assert_same(run(arguments("./" + os.fsdecode(name)), given), expected, b"./" + name)

        self.each_file(check)

    def test_a_leading_dash_follows_two_dashes_or_an_equals_sign(self):
        self.file("-p.json", POINTS["json"])
        self.file("-c.json", CAMERA)
        expected = run(["project", "-c", CAMERA], POINTS["json"]).stdout
        for arguments in (["-c", CAMERA, "--", "-p.json"], ["--camera=-c.json", "--", "-p.json"]):
            done = run(["project", *arguments])
            self.assertEqual((done.stdout, done.stderr), (expected, b""))

    def test_pipes_devices_and_descriptors_are_files_too(self):
        os.mkfifo("pipe")

        def check(arguments, given, content):
            self.file("FILE", content)
            expected = run(arguments("FILE"), given)
            if not given:
                self.assert_same(run(arguments("/dev/stdin"), content), expected, b"/dev/stdin")
                self.assert_same(run(arguments("-"), content), expected, b"<stdin>")
            writer = threading.Thread(target=lambda: Path("pipe").write_bytes(content))
            writer.start()
            done = run(arguments("pipe"), given)
            writer.join()
            self.assert_same(done, expected, b"pipe")

        self.each_file(check)

    def test_nothing_is_nothing_wherever_it_comes_from(self):
        os.mkfifo("pipe")

        def check(arguments, given, content):
            self.file("FILE", b"")
            expected = run(arguments("FILE"), given)
            self.assertTrue(expected.returncode == 0 or tool.is_one_message(expected.stderr), expected.stderr)
            self.assert_same(run(arguments("/dev/null"), given), expected, b"/dev/null")
            writer = threading.Thread(target=lambda: Path("pipe").write_bytes(b""))
            writer.start()
            done = run(arguments("pipe"), given)
            writer.join()
            self.assert_same(done, expected, b"pipe")
            if not given:
                closed = run(arguments("-"), stdin=subprocess.DEVNULL, before=lambda: os.close(0))
                self.assert_same(closed, expected, b"<stdin>")

        self.each_file(check)

    def test_the_last_line_needs_no_line_break(self):
        def check(arguments, given, content):
            self.file("FILE", content)
            expected = run(arguments("FILE"), given)
            self.file("FILE", content.rstrip(b"\n"))
            self.assert_same(run(arguments("FILE"), given), expected, b"FILE")

        self.each_file(check)

    def test_a_device_without_end_is_no_document(self):
        def check(arguments, given, content):
            if content in (*POINTS.values(), *PIXELS.values()):
                return
            most = 1 if arguments("")[0] == "inspect" else 64
            done = run(arguments("/dev/zero"), given)
            self.assert_fails(done, f"/dev/zero: longer than {most} MiB, the most that is read")

        self.each_file(check)


class ChangingFiles(FaultTest):
    """The tool is stuck behind a full pipe while its input changes."""

    RECORDS = {"json": b'{"x":1,"y":2,"z":3}\n', "csv": b"1,2,3\n", "text": b"1 2 3\n", "f64": POINTS["f64"]}

    def changed(self, form, change, count):
        """Status, number of records that were written, messages."""
        record = self.RECORDS[form]
        name = self.file("points." + form, record * count)
        process = tool.start(
            ["project", "-c", CAMERA, "--jobs", "4", "--from", form, name], stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        os.read(process.stdout.fileno(), 1)
        before = -1
        while (now := Path(f"/proc/{process.pid}/io").read_bytes()) != before:  # until it moves no more
            before = now
            time.sleep(0.05)
        change(name, record)
        out, err = process.communicate(timeout=tool.PATIENCE)
        written = (len(out) + 1) // 24 if form == "f64" else (b"\n" + out).count(b"\n") - 1
        return process.returncode, written, err

    def test_a_file_that_goes_away_is_read_to_its_end(self):
        for form in self.RECORDS:
            with self.subTest(form):
                self.assertEqual(self.changed(form, lambda name, record: os.unlink(name), 300000), (0, 300000, b""))

    def test_a_file_that_grows_is_read_to_its_new_end(self):
        def grow(name, record):
            with open(name, "ab") as file:
                file.write(record * 1000)

        for form in self.RECORDS:
            with self.subTest(form):
                self.assertEqual(self.changed(form, grow, 300000), (0, 301000, b""))

    def test_a_file_that_is_cut_off_ends_there(self):
        for form, record in self.RECORDS.items():
            with self.subTest(form):
                left = 299000 * len(record)
                done = self.changed(form, lambda name, record: os.truncate(name, left), 300000)
                self.assertEqual(done, (0, 299000, b""))

    def test_a_file_that_is_emptied_ends_behind_what_was_read(self):
        for form in self.RECORDS:
            with self.subTest(form):
                status, written, err = self.changed(form, lambda name, record: os.truncate(name, 0), 300000)
                self.assertIn((status, err.count(b"\n")), ((0, 0), (1, 1)))  # it may have been in the midst of a record
                self.assertGreater(written, 0)
                self.assertLess(written, 300000)


if __name__ == "__main__":
    tool.main()
