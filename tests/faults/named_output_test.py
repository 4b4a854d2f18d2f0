"""-o FILE is whole, or as it was; and what stands on a terminal."""
import os
import pty
import resource
import stat
import subprocess
from pathlib import Path

import tool
from tool import CAMERA, POINTS, FaultTest, run

BAD = POINTS["json"] + b"[1,2]\n" + POINTS["json"]


class NamedOutput(FaultTest):
    def names(self):
        return sorted(os.listdir("."))

    def test_a_file_is_what_standard_output_would_be(self):
        for arguments, given in tool.RUNS:
            if "--help" in arguments or "--version" in arguments or arguments[0] == "measure":
                continue
            with self.subTest(" ".join(arguments)):
                expected = run(arguments, given)
                done = run([*arguments, "-o", "file"], given)
                self.assertEqual((done.returncode, done.stdout, done.stderr), (expected.returncode, b"", expected.stderr))
                self.assertEqual(Path("file").read_bytes(), expected.stdout)
                self.assertEqual(self.names(), ["file"])

    def test_after_an_error_it_is_as_it_was(self):
        done = run(["project", "-c", CAMERA, "-o", "new"], BAD)
        self.assertEqual((done.returncode, self.names()), (1, []))
        self.file("old", "before")
        done = run(["project", "-c", CAMERA, "-o", "old"], BAD)
        self.assertEqual((done.returncode, Path("old").read_text(), self.names()), (1, "before", ["old"]))
        done = run(["project", "-c", CAMERA, "--keep-going", "-o", "old"], BAD)
        self.assertEqual((done.returncode, Path("old").read_bytes().count(b"\n")), (1, 5))

    def test_a_file_may_be_read_and_written_at_once(self):
        self.file("points.csv", "x,y,z\n" + "1,2,3\n" * 100000)
        self.assertEqual(run(["cull", "-c", CAMERA, "points.csv", "-o", "points.csv"]).returncode, 0)
        self.assertEqual(len(Path("points.csv").read_text().splitlines()), 100001)

    def test_it_keeps_its_mode_and_where_a_link_leads(self):
        self.file("old", "before")
        os.chmod("old", 0o640)
        os.symlink("old", "link")
        self.assertEqual(run(["schema", "-o", "link"]).returncode, 0)
        self.assertTrue(os.path.islink("link"))
        self.assertEqual(stat.S_IMODE(os.stat("old").st_mode), 0o640)
        self.assertIn("camera", Path("old").read_text())
        os.symlink("nowhere", "dangling")
        self.assertEqual(run(["schema", "-o", "dangling"]).returncode, 0)
        self.assertTrue(os.path.islink("dangling") and Path("nowhere").exists())
        os.symlink("loop", "loop")
        self.assert_fails(run(["schema", "-o", "loop"]), "loop: Too many levels of symbolic links")
        before = os.umask(0o027)
        try:
            self.assertEqual(run(["schema", "-o", "new"]).returncode, 0)
        finally:
            os.umask(before)
        self.assertEqual(stat.S_IMODE(os.stat("new").st_mode), 0o640)

    def test_what_is_no_regular_file_is_written_as_it_is(self):
        self.assertEqual(run(["schema", "-o", "/dev/null"]).returncode, 0)
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/null").st_mode))
        self.assertIn(b"camera", run(["schema", "-o", "/dev/stdout"]).stdout)
        self.assertIn(b"camera", run(["schema", "-o", "-"]).stdout)
        # A descriptor's file goes on where it stands.
        one = [tool.TOOL, "project", "-c", CAMERA, "--point", "1,1,1", "--fields", "visible", "-o"]
        for name in ("/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):
            with open("log", "wb") as log:
                for _ in range(3):
                    subprocess.run([*one, name], stdout=log, check=True, timeout=tool.PATIENCE)
            self.assertEqual(Path("log").read_bytes().count(b"\n"), 3)
        with open("log", "ab") as log:
            subprocess.run([*one, "/dev/stderr"], stderr=log, check=True, timeout=tool.PATIENCE)
        self.assertEqual(Path("log").read_bytes().count(b"\n"), 4)
        os.mkfifo("pipe")
        reader = subprocess.Popen(["cat", "pipe"], stdout=subprocess.PIPE)
        self.assertEqual(run(["schema", "-o", "pipe"]).returncode, 0)
        self.assertIn(b"camera", reader.communicate(timeout=tool.PATIENCE)[0])

    def test_where_there_cannot_be_one_is_said_before_anything_is_read(self):
        Path("folder").mkdir()
        for name, message in (
            ("folder", "Is a directory"),
            ("missing/file", "No such file or directory"),
            ("x" * 300, "File name too long"),
            ("/dev/full", "No space left on device"),
        ):
            self.assert_fails(run(["schema", "-o", name]), f"{name}: {message}")

    def test_what_another_run_left_is_no_hindrance(self):
        script = 'touch file.viewproj-$$ && exec "$VIEWPROJ_TOOL" schema -o file'  # the same number
        self.assertEqual(subprocess.run(["sh", "-c", script]).returncode, 0)
        left = [name for name in self.names() if name != "file"]
        self.assertEqual((len(left), Path(left[0]).read_text(), Path("file").stat().st_size > 0), (1, "", True))

    def test_what_cannot_be_written_or_replaced_is_as_it_was(self):
        self.file("old", "before")
        full = tool.limited(resource.RLIMIT_FSIZE, 1000)
        for jobs in ("1", "4"):
            done = run(["project", "-c", CAMERA, "--jobs", jobs, "-o", "old"], POINTS["text"] * 50000, before=full)
            self.assert_fails(done, "old: File too large")
        os.mkdir("closed")
        self.file("closed/old", "before")
        os.chmod("closed", 0o500)
        os.chmod("old", 0o400)
        for name in ("old", "closed/old", "closed/new"):
            done = run(["schema", "-o", name], before=tool.without_power_over_files)
            self.assert_fails(done, f"{name}: Permission denied")
        os.chmod("closed", 0o700)
        self.assertEqual((self.names(), os.listdir("closed")), (["closed", "old"], ["old"]))
        self.assertEqual((Path("old").read_text(), Path("closed/old").read_text()), ("before", "before"))


class Terminal(FaultTest):
    def shown(self, arguments, typed=b""):
        """What a terminal shows of it that is its input, its output and its messages."""
        child, end = pty.fork()
        if child == 0:
            os.execv(tool.TOOL, [tool.TOOL, *arguments])
        shown = b""
        os.write(end, typed)
        try:
            while part := os.read(end, 1 << 16):
                shown += part
        except OSError:  # nobody has the other end any more
            pass
        os.close(end)
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), shown.decode(errors="replace")

    def test_who_waits_for_a_person_says_so(self):
        status, shown = self.shown(["project", "-c", CAMERA], b"1 1 1\n\x04")
        self.assertEqual(status, 0)
        self.assertIn("viewproj: reading from the keyboard; Ctrl-D ends the input", shown)
        self.assertNotIn("keyboard", self.shown(["project", "-c", CAMERA, "--point", "1,1,1"])[1])

    def test_f64_is_not_for_terminals(self):
        arguments = ["project", "-c", CAMERA, "--point", "1,1,1", "--to", "f64"]
        status, shown = self.shown(arguments)
        self.assertEqual(status, 2)
        self.assertIn("| cat", shown)
        self.assertEqual(len(run(arguments).stdout), 24)

    def test_help_is_as_wide_as_the_terminal(self):
        for width in (40, 60, 132):
            os.environ["COLUMNS"] = str(width)
            try:
                longest = max(len(line) for line in self.shown(["depth", "--help"])[1].split("Examples")[0].splitlines())
            finally:
                del os.environ["COLUMNS"]
            self.assertLessEqual(longest, width)
            self.assertGreater(longest, width - 14)


if __name__ == "__main__":
    tool.main()
