"""Signals: while waiting, while working, and while nobody takes what is written."""
import json
import os
import pty
import re
import select
import signal
import subprocess
import termios
import time
from pathlib import Path

import tool
from tool import CAMERA, POINTS, SCENE, FaultTest, run

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
FILTERS = (["project", "-c", CAMERA], ["ray", "-c", CAMERA], ["ray", "-c", CAMERA, "--scene", SCENE], ["cull", "-c", CAMERA])
RECORD = {"project": b'{"x":1,"y":2,"z":3}', "ray": b"[1,2]", "cull": b"[1,2,3]"}


def defaults():
    """Whatever the tests were started with (a shell's background jobs ignore SIGINT)."""
    for number in (*ENDING, signal.SIGPIPE):
        signal.signal(number, signal.SIG_DFL)


def read_so_far(process):
    return Path(f"/proc/{process.pid}/io").read_bytes()


class Signals(FaultTest):
    def start(self, arguments, **more):
        more.setdefault("preexec_fn", defaults)
        more.setdefault("stdout", subprocess.PIPE)
        process = tool.start(arguments, stderr=subprocess.PIPE, **more)
        if process.stdout:
            self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        return process

    def end(self, process, number):
        """Its output, once it has died of that signal without a word."""
        process.send_signal(number)
        out, err = process.communicate(timeout=tool.PATIENCE)
        self.assertEqual((process.returncode, err), (-number, b""))
        return out

    def assert_whole(self, out, form):
        if form == "f64":
            self.assertEqual(len(out) % 24, 0)
        elif form == "json":
            self.assertIsInstance(json.loads(out), list)
        else:
            self.assertTrue(out.endswith(b"\n") or not out)
            lines = out.splitlines()
            if form == "ndjson" and lines:
                json.loads(lines[-1])
            # csv and table: as many columns in every line, text: as many numbers
            separator = {"csv": b",", "text": b" "}.get(form)
            if separator:
                self.assertEqual(len({line.count(separator) for line in lines}), 1 if lines else 0)

    def test_a_signal_ends_whatever_waits_for_standard_input(self):
        waiting = (
            ["matrix"],
            ["depth"],
            ["inspect"],
            ["draw", "-c", CAMERA],
            ["draw", "-c", "-", "--pixel", "1,2"],
            ["measure", "-c", CAMERA],
            ["explain", "-c", "-", "--point", "1,1,1"],
            *FILTERS,
            ["project", "-c", CAMERA, "--from", "csv"],
        )
        for arguments in waiting:
            for number in ENDING:
                with self.subTest(f"{arguments} {number.name}"):
                    process = self.start(arguments, stdin=subprocess.PIPE)
                    tool.wait_until_still(process)
                    self.assertEqual(self.end(process, number), b"")
                    process.stdin.close()

    def test_a_signal_ends_whatever_waits_for_the_writer_of_a_named_pipe(self):
        os.mkfifo("pipe")
        waiting = (
            ["project", "-c", CAMERA, "pipe"],
            ["project", "-c", "pipe"],
            ["ray", "-c", CAMERA, "--scene", "pipe"],
            ["measure", "-c", CAMERA, "pipe"],
            ["draw", "-c", CAMERA, "pipe"],
            ["matrix", "pipe"],
            ["inspect", "pipe"],
        )
        for arguments in waiting:
            for number in ENDING:
                with self.subTest(f"{arguments} {number.name}"):
                    process = self.start(arguments, stdin=subprocess.DEVNULL)
                    tool.wait_until_still(process)
                    self.assertEqual(self.end(process, number), b"")

    def test_a_signal_ends_a_stream_behind_whole_records(self):
        """Endless input; the output is read slowly at first, so that the tool is in the midst of writing."""
        for arguments in FILTERS:
            for form in ("ndjson", "json", "csv", "text", "f64"):
                if form in ("text", "f64") and (arguments[0] == "cull" or SCENE in arguments):
                    continue
                for jobs, number in zip(("1", "4", "2"), ENDING):
                    with self.subTest(f"{arguments} {form} {number.name}"):
                        feeder = subprocess.Popen(["yes", RECORD[arguments[0]].decode()], stdout=subprocess.PIPE)
                        process = self.start(
                            [*arguments, "--from", "json", "--to", form, "--jobs", jobs], stdin=feeder.stdout
                        )
                        feeder.stdout.close()
                        out = os.read(process.stdout.fileno(), 100000)
                        out += self.end(process, number)
                        feeder.wait(tool.PATIENCE)
                        self.assertNotEqual(out, b"")
                        self.assert_whole(out, form)

    def test_a_signal_ends_a_run_whose_messages_nobody_reads(self):
        for number in ENDING:
            feeder = subprocess.Popen(["yes", "[1,2]"], stdout=subprocess.PIPE)
            with open("out", "wb") as out:
                process = self.start(
                    ["project", "-c", CAMERA, "--keep-going", "--jobs", "2"], stdin=feeder.stdout, stdout=out
                )
            feeder.stdout.close()
            os.read(process.stderr.fileno(), 1)
            tool.wait_until_still(process)
            process.send_signal(number)
            self.assertEqual(process.wait(tool.PATIENCE), -number)
            feeder.wait(tool.PATIENCE)
            self.assertTrue(Path("out").read_bytes().endswith(b"}\n"))

    def test_a_stopped_terminal_keeps_neither_the_run_nor_a_signal(self):
        """The terminal is stopped (Ctrl-S) before the progress line is due."""
        end, terminal = pty.openpty()
        termios.tcflow(terminal, termios.TCOOFF)
        feeder = subprocess.Popen(["yes", "[1,2,3]"], stdout=subprocess.PIPE)
        with open("/dev/null", "wb") as nowhere:
            process = tool.start(
                ["project", "-c", CAMERA], stdin=feeder.stdout, stdout=nowhere, stderr=terminal, preexec_fn=defaults
            )
        feeder.stdout.close()
        time.sleep(1.5)
        before = read_so_far(process)
        time.sleep(0.5)
        self.assertNotEqual(read_so_far(process), before)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(tool.PATIENCE), -signal.SIGTERM)
        feeder.wait(tool.PATIENCE)
        os.close(terminal)
        os.close(end)

    def test_progress_tells_hours_too(self):
        """A file of 64 GiB, nearly all of it a hole, and a reader that takes 64 KiB at a time."""
        with open("big.f64", "wb") as file:
            file.truncate(1 << 36)
        end, terminal = pty.openpty()
        process = tool.start(["project", "-c", CAMERA, "big.f64"], stdout=subprocess.PIPE, stderr=terminal)
        os.close(terminal)
        shown = b""
        for _ in range(200):
            os.read(process.stdout.fileno(), 1 << 16)
            if select.select([end], [], [], 0.1)[0]:
                shown += os.read(end, 1000)
            if b"left" in shown:
                break
        process.kill()
        process.communicate()
        os.close(end)
        self.assertRegex(shown, rb"0 %, .* records/s, \d+:\d\d:\d\d left")

    def test_progress_tells_the_share_that_is_done(self):
        """Of a file of f64, which gives as many bytes as it has."""
        size = 24 << 20
        with open("half.f64", "wb") as file:
            file.truncate(size)
        end, terminal = pty.openpty()
        process = tool.start(["project", "-c", CAMERA, "half.f64"], stdout=subprocess.PIPE, stderr=terminal)
        os.close(terminal)
        begun = time.monotonic()
        read = 0
        while read < size * 6 // 10:
            read += len(os.read(process.stdout.fileno(), 1 << 16))
        time.sleep(max(0, begun + 1.1 - time.monotonic()))
        shown = b""
        while b"left" not in shown and read < size:
            read += len(os.read(process.stdout.fileno(), 1 << 14))
            if select.select([end], [], [], 0.01)[0]:
                shown += os.read(end, 1000)
        process.kill()
        process.communicate()
        os.close(end)
        self.assertRegex(shown, rb"\d+ %, .* records/s, \d+:\d\d left")
        percent = int(re.search(rb"(\d+) %", shown)[1])
        self.assertTrue(50 <= percent <= 100, percent)

    def test_a_signal_that_is_ignored_stays_ignored(self):
        for number in ENDING:
            process = self.start(
                ["project", "-c", CAMERA], stdin=subprocess.PIPE, preexec_fn=lambda: signal.signal(number, signal.SIG_IGN)
            )
            tool.wait_until_still(process)
            process.send_signal(number)
            out, err = process.communicate(POINTS["json"], timeout=tool.PATIENCE)
            self.assertEqual((process.returncode, out.count(b"\n"), err), (0, 2, b""))

    def test_signals_that_end_nothing_change_nothing(self):
        many = self.file("many.json", b'{"x":1,"y":2,"z":3}\n' * 100000)
        for form in ("ndjson", "json", "csv", "text", "f64"):
            arguments = ["project", "-c", CAMERA, "--jobs", "3", "--to", form, many]
            expected = run(arguments).stdout
            # A leak sanitizer's own stopping of threads, at the end, does not outlast a SIGSTOP and SIGCONT from outside.
            options = os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0"
            process = self.start(arguments, stdin=subprocess.DEVNULL, env={**os.environ, "ASAN_OPTIONS": options})
            pieces = []
            while piece := os.read(process.stdout.fileno(), 1 << 16):
                pieces.append(piece)
                for number in (signal.SIGWINCH, signal.SIGURG, signal.SIGPIPE, signal.SIGSTOP, signal.SIGCONT):
                    if len(pieces) % 10 == 1:
                        process.send_signal(number)
            self.assertEqual(process.wait(tool.PATIENCE), 0)
            self.assertTrue(b"".join(pieces) == expected)

    def test_a_stopped_run_goes_on_where_it_was(self):
        process = self.start(["project", "-c", CAMERA], stdin=subprocess.PIPE)
        records = POINTS["json"].splitlines(keepends=True)
        process.stdin.write(records[0])
        process.stdin.flush()
        out = process.stdout.readline()
        process.send_signal(signal.SIGSTOP)
        process.stdin.write(records[1])
        process.stdin.flush()
        process.send_signal(signal.SIGCONT)
        out += process.communicate(timeout=tool.PATIENCE)[0]
        self.assertEqual((process.returncode, out), (0, run(["project", "-c", CAMERA], POINTS["json"]).stdout))


if __name__ == "__main__":
    tool.main()
