"""Signals end a run at once, whatever it waits for."""
import os
import signal
import subprocess
from pathlib import Path

import tool
from tool import CAMERA, POINTS, FaultTest, run

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)


def defaults():
    """Whatever the tests were started with (a shell's background jobs ignore SIGINT)."""
    for number in (*ENDING, signal.SIGPIPE):
        signal.signal(number, signal.SIG_DFL)


class Signals(FaultTest):
    def start(self, arguments, **more):
        more.setdefault("preexec_fn", defaults)
        return self.started(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **more)

    def test_a_signal_ends_whatever_waits_for_input(self):
        os.mkfifo("pipe")
        for arguments in (
            ["matrix"],
            ["draw", "-c", CAMERA],
            ["project", "-c", CAMERA],
            ["project", "-c", CAMERA, "-o", "file"],
            ["project", "-c", CAMERA, "pipe"],
            ["matrix", "pipe", "-o", "file"],
        ):
            for number in ENDING:
                with self.subTest(f"{arguments} {number.name}"):
                    process = self.start(arguments, stdin=subprocess.PIPE)
                    tool.wait_until_still(process)
                    process.send_signal(number)
                    self.assertEqual(process.communicate(timeout=tool.PATIENCE), (b"", b""))
                    self.assertEqual((process.returncode, os.listdir(".")), (-number, ["pipe"]))

    def test_a_signal_ends_an_endless_stream(self):
        """While nobody reads what it writes, and while it writes a file, which is then as it was."""
        for before in (None, "before"):
            if before:
                self.file("file", before)
            for output in ([], ["-o", "file"]):
                for jobs, number in zip(("1", "4", "2"), ENDING):
                    with self.subTest(f"{output} {jobs} {number.name}"):
                        feeder = subprocess.Popen(["yes", "[1,2,3]"], stdout=subprocess.PIPE)
                        process = self.start(["project", "-c", CAMERA, "--jobs", jobs, *output], stdin=feeder.stdout)
                        feeder.stdout.close()
                        if output:
                            while not (beside := [name for name in os.listdir(".") if name != "file"]) or not os.path.getsize(beside[0]):
                                pass
                        else:
                            tool.wait_until_still(process)
                        process.send_signal(number)
                        self.assertEqual(process.wait(tool.PATIENCE), -number)
                        self.assertEqual(process.stderr.read(), b"")
                        feeder.wait(tool.PATIENCE)
                        self.assertEqual(os.listdir("."), ["file"] if before else [])
                        self.assertEqual(before, Path("file").read_text() if before else None)

    def test_a_signal_that_is_ignored_stays_ignored(self):
        for output in ([], ["-o", "/dev/stdout"], ["-o", "file"]):
            for number in ENDING:
                process = self.start(
                    ["project", "-c", CAMERA, *output],
                    stdin=subprocess.PIPE,
                    preexec_fn=lambda: signal.signal(number, signal.SIG_IGN),
                )
                tool.wait_until_still(process)
                process.send_signal(number)
                out, err = process.communicate(POINTS["json"], timeout=tool.PATIENCE)
                if "file" in output:
                    out = Path("file").read_bytes()
                self.assertEqual((process.returncode, out.count(b"\n"), err), (0, 2, b""))


if __name__ == "__main__":
    tool.main()
